"""The numbers of README.md are those of docs/results.md, by data/studies/write_readme.py."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "data/studies"))
import write_readme  # noqa: E402

README = write_readme.README.read_text(encoding="utf-8")
RESULTS = write_readme.RESULTS.read_text(encoding="utf-8")


class ReadmeNumbers(unittest.TestCase):
    def test_are_those_of_the_results(self):
        self.assertEqual(write_readme.renewed(README, RESULTS), README,
                         "run data/studies/write_readme.py")

    def test_follow_another_result(self):
        heart = write_readme.tables_of(RESULTS)[write_readme.PAPER]["heart-stereo"]
        number = heart[write_readme.POINTS]
        self.assertIn(f" {number},", write_readme.renewed(README, RESULTS))
        other = write_readme.renewed(README, RESULTS.replace(f" {number} ", " 9.876 "))
        self.assertIn(" 9.876,", other)
        self.assertNotEqual(other, README)

    def test_a_case_that_is_gone_is_named(self):
        with self.assertRaisesRegex(SystemExit, "heart-stereo"):
            write_readme.renewed(README, RESULTS.replace("| heart-stereo |", "| heart |"))


if __name__ == "__main__":
    unittest.main()
