"""What holds for every file: a first line that says what it is, no paths of anyone's machine."""
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NOT_OURS = {".git", ".cache", "build", "out"}
SOURCES = {".h", ".cpp", ".cu", ".cuh"}
LONGEST_FILE = 400  # lines; a file is one noun or one verb

MACHINE_PATH = re.compile(r"(?<![\w.~-])/(?:home|root|work|Users)/[\w.]")
FOREIGN_READER = re.compile(r"#\s*include <(?:vtk\w*(?:Reader|Parser|Directory|Importer)\.h"
                            r"|opencv2/dnn\b.*)>")
UNFINISHED = re.compile(r"\b(?:TO" + r"DO|FIX" + r"ME|XX" + r"X)\b")


def all_files():
    for path in sorted(ROOT.rglob("*")):
        inside = path.relative_to(ROOT).parts
        if path.is_file() and inside[0] not in NOT_OURS and "__pycache__" not in inside:
            yield path


def text_of(path):
    """The text, or nothing where the file holds pictures or other bytes."""
    try:
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return ""


def describes_itself(name, first_line):
    return re.fullmatch(rf"// {re.escape(name)}: \S.*", first_line) is not None


def described_by_header(path, first_line):
    """A source beside its header, or a test that begins with the header of what it tests."""
    if path.suffix not in (".cpp", ".cu"):
        return False
    subject = re.escape(path.stem.replace("_test", ""))
    return path.with_suffix(".h").exists() or re.match(rf'#include ".*/{subject}.h"', first_line)


def undescribed(path):
    name = path.relative_to(ROOT).as_posix()
    first_line = text_of(path).partition("\n")[0]
    return not describes_itself(name, first_line) and not described_by_header(path, first_line)


def unguarded(text):
    """Includes a reader of VTK or of networks without the door to it, core/guarded_read.h."""
    return (FOREIGN_READER.search(text) is not None
            and '#include "core/guarded_read.h"' not in text)


class FileRules(unittest.TestCase):
    def none(self, wrong, complaint):
        if wrong:
            self.fail(f"these {complaint}:\n  " + "\n  ".join(wrong))

    def test_every_header_and_lone_source_begins_with_what_it_is(self):
        wrong = [path.relative_to(ROOT).as_posix() for path in all_files()
                 if path.suffix in SOURCES and undescribed(path)]
        self.none(wrong, "should begin with `// folder/file.h: what it is.`")

    def test_no_file_names_a_path_of_anyones_machine(self):
        wrong = [
            f"{path.relative_to(ROOT).as_posix()}:{number}"
            for path in all_files()
            for number, line in enumerate(text_of(path).splitlines(), start=1)
            if MACHINE_PATH.search(line)
        ]
        self.none(wrong, "name a path that exists on one machine only")

    def test_nothing_is_left_unfinished_or_too_long(self):
        sources = [path for path in all_files() if path.suffix in SOURCES]
        wrong = [path.relative_to(ROOT).as_posix() for path in sources
                 if UNFINISHED.search(text_of(path))
                 or len(text_of(path).splitlines()) > LONGEST_FILE]
        self.none(wrong, f"are unfinished or longer than {LONGEST_FILE} lines")

    def test_readers_of_vtk_run_behind_their_door(self):
        wrong = [path.relative_to(ROOT).as_posix() for path in all_files()
                 if path.suffix in SOURCES
                 and path.relative_to(ROOT).parts[0] not in ("tests", "cmake")
                 and unguarded(text_of(path))]
        self.none(wrong, "include a reader of VTK or of networks, but not core/guarded_read.h")

    def test_back_projection_is_defined_in_one_document(self):
        documents = sorted((ROOT / "docs").glob("*.md"))
        wrong = [path.name for path in documents
                 if path.name != "evaluation.md" and "**Back-projection**" in text_of(path)]
        self.none(wrong, "define back-projection, which docs/evaluation.md does")
        self.assertEqual(text_of(ROOT / "docs/evaluation.md").count("**Back-projection**:"), 1)
        rows = [line for path in documents for line in text_of(path).splitlines()
                if line.startswith("| `backprojection_mean_mm`")]
        self.assertTrue(rows)
        self.none([row for row in rows if "(evaluation.md#which-frames-count)" not in row],
                  "rows say what back-projection is, but name no definition")

    def test_the_rules_find_made_up_breaches(self):
        self.assertTrue(unguarded("#include <vtk" + "STLReader.h>\n"))
        self.assertTrue(unguarded("#include <opencv2" + "/dnn.hpp>\n"))
        self.assertFalse(unguarded('#include <vtk' + 'STLReader.h>\n'
                                   '#include "core/guarded_read.h"\n'))
        self.assertTrue(MACHINE_PATH.search("see /" + "home/someone/data"))
        self.assertTrue(MACHINE_PATH.search('"/' + 'root/x"'))
        self.assertFalse(MACHINE_PATH.search("build/work/x and https://example.org/home/x"))
        self.assertTrue(UNFINISHED.search("// TO" + "DO: later"))
        self.assertTrue(describes_itself("src/core/image.h", "// src/core/image.h: what it saw."))
        self.assertFalse(describes_itself("src/core/image.h", "// src/core/images.h: what it saw."))
        self.assertFalse(describes_itself("src/core/image.h", "#pragma once"))


if __name__ == "__main__":
    unittest.main()
