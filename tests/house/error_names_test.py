"""An error of a library names a setting as a program gives it; apps write the option."""
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ["src", "eval", "vtk_views", "toolkit", "python"]
STATEMENT = re.compile(r"\b(?:throw \w*Error|require|fail)\s*\((.*?)\);", re.S)
OPTION = re.compile(r'"(?:[^"\\]|\\.)*?(?<![\w-])(--[a-z][a-z-]+)(?:[^"\\]|\\.)*"')


def options_in_errors(text):
    """(line, option) of every option of the command line in the text of an error."""
    found = []
    for statement in STATEMENT.finditer(text):
        for option in OPTION.finditer(statement[1]):
            at = statement.start(1) + option.start(1)
            found.append((text.count("\n", 0, at) + 1, option[1]))
    return found


class ErrorNames(unittest.TestCase):
    def test_no_error_of_a_library_names_an_option(self):
        for folder in FOLDERS:
            for path in sorted((ROOT / folder).rglob("*.cpp")):
                for line, option in options_in_errors(path.read_text(encoding="utf-8")):
                    self.fail(f"{path.relative_to(ROOT)}:{line}: {option}; write the setting as "
                              f"`name=`, and apps/option_names.h makes the option of it")

    def test_an_option_is_found(self):
        for text in ['throw OptionError("--frame is " + name);',
                     'throw InputError(shown(file) +\n  ": holds none; give --save-every 1");',
                     'require(every >= 1, "--every", every, "must be 1 or more");']:
            self.assertEqual(len(options_in_errors(text)), 1, text)
        for text in ['throw OptionError("`frame=` is " + name);',
                     'words.push_back("--quiet"); throw Error("stopped");']:
            self.assertEqual(options_in_errors(text), [], text)


if __name__ == "__main__":
    unittest.main()
