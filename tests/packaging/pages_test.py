"""Man pages say what --help says; completions offer what the program takes."""
import functools
import gzip
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["SOFTSCOPE"]
PAGES = Path(os.environ["PAGES"])


@functools.lru_cache(maxsize=None)
def said(*words):
    return subprocess.run([PROGRAM, *words], check=True, capture_output=True, text=True).stdout


def commands():
    return re.findall(r"^  ([a-z][a-z-]+) ", said("--help").partition("example:")[0], re.M)


def options(command):
    return re.findall(r"^  (--[a-z0-9-]+)", said(command, "--help").partition("example:")[0], re.M)


def plain(page):
    """The text of a page, without roff's own words."""
    text = gzip.decompress((PAGES / page).read_bytes()).decode("utf-8")
    return re.sub(r"\\f[BIR]|\\&", "", text).replace("\\-", "-").replace("\\e", "\\")


def completed(*words, folder="."):
    """What bash offers for the last of these words."""
    script = (f"source {PAGES}/softscope.bash; compopt() {{ :; }}\n"
              'COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)); _softscope; printf "%s\\n" "${COMPREPLY[@]}"')
    found = subprocess.run(["bash", "-c", script, "bash", "softscope", *words], check=True,
                           capture_output=True, text=True, cwd=folder).stdout
    return [line for line in found.split("\n") if line]


class ManPages(unittest.TestCase):
    def test_the_overview_names_every_command(self):
        text = plain("softscope.1.gz")
        self.assertGreater(len(commands()), 10)
        for command in commands():
            self.assertIn(f".BR softscope-{command} (1)", text)

    def test_a_page_has_every_option_of_its_command(self):
        for command in commands():
            text = plain(f"softscope-{command}.1.gz")
            self.assertGreater(len(options(command)), 3)
            for option in options(command):
                self.assertRegex(text, rf"\.TP\n{option}\b", command)

    def test_no_line_of_text_is_taken_for_a_request(self):
        known = re.compile(r"\.(TH|SH|TP|BR|nf|fi)\b")
        for page in PAGES.glob("*.1.gz"):
            for line in gzip.decompress(page.read_bytes()).decode("utf-8").split("\n"):
                self.assertTrue(not line.startswith((".", "'")) or known.match(line), line)


class Completions(unittest.TestCase):
    def test_bash_offers_commands_options_and_settings(self):
        self.assertEqual(completed("recon"), ["reconstruct"])
        self.assertEqual(set(completed("")), set(commands()) | {"help", "--help", "--version"})
        self.assertEqual(completed("help", "sim"), ["simulate"])
        for command in commands():
            self.assertEqual(set(completed(command, "--")), set(options(command)), command)
        self.assertEqual(completed("reconstruct", "--set", "stereo.meth"), ["stereo.method="])
        self.assertIn("push.amplitude_mm=", completed("simulate", "--set", "push"))
        self.assertEqual(completed("reconstruct", "--save-every", ""), [])

    def test_bash_offers_files_or_folders(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "a folder").mkdir()
            (Path(folder) / "a.toml").touch()
            self.assertEqual(completed("reconstruct", "--out", "a", folder=folder), ["a folder"])
            self.assertEqual(set(completed("reconstruct", "--config", "a", folder=folder)),
                             {"a folder", "a.toml"})
            self.assertEqual(set(completed("info", "a", folder=folder)), {"a folder", "a.toml"})

    def test_each_shell_can_read_its_file(self):
        for shell, name in [("bash", "softscope.bash"), ("zsh", "_softscope"),
                            ("fish", "softscope.fish")]:
            with self.subTest(shell=shell):
                if shutil.which(shell) is None:
                    self.skipTest(f"{shell} is not installed")
                subprocess.run([shell, "-n", str(PAGES / name)], check=True)


if __name__ == "__main__":
    unittest.main()
