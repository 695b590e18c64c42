"""What cmake/progress.py tells of a build and of tests, from made-up lines of ninja and ctest."""
import importlib.util
import io
import tempfile
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "cmake/progress.py"
SPEC = importlib.util.spec_from_file_location("progress", SCRIPT)
progress = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(progress)


class Clock:
    """Every look takes a step."""

    def __init__(self, step):
        self.now, self.step = 0, step

    def __call__(self):
        self.now += self.step
        return self.now


class Terminal(io.StringIO):
    def isatty(self):
        return True


def ended(lines, status):
    yield from lines
    return status


def told(follow, lines, *more, status=0, out=None, step=10):
    out = out or io.StringIO()
    result = follow(ended(lines, status), progress.Progress(out, Clock(step)), *more)
    return result, out.getvalue()


def no_weights():
    return progress.TestWeights(Path("there is none"))


def case(name, status, output=""):
    element = xml.Element("testcase", name=name, status=status)
    xml.SubElement(element, "system-out").text = output
    return element


def not_run(name, why):
    element = case(name, "notrun")
    xml.SubElement(element, "skipped", message=why)
    return element


FAILED_TEST = """Running main() from gmock_main.cc
[ RUN      ] Depth.IsFound
tests/apps/test_depth.cpp:249: Failure
Expected equality of these values:
  outcome.err
    Which is: "WARNING"
  ""
[  FAILED  ] Depth.IsFound (312 ms)
[----------] 1 test from Depth
"""


class BuildLines(unittest.TestCase):
    def test_a_count_with_the_time_left(self):
        status, text = told(progress.follow_build, ["[1/4] Building a", "[2/4] Building b"])
        self.assertEqual(status, 0)
        self.assertIn("[2/4, ", text)
        self.assertRegex(text, r"about \d+ s left")
        self.assertNotIn("Building", text)

    def test_what_a_compiler_says_stays_and_so_does_the_exit_status(self):
        lines = ["[1/4] Building a", "FAILED: a.o", "a.cpp:3: error: no such thing"]
        status, text = told(progress.follow_build, lines, status=1)
        self.assertEqual(status, 1)
        self.assertIn("FAILED: a.o\n", text)
        self.assertIn("a.cpp:3: error: no such thing\n", text)

    def test_on_a_terminal_the_count_is_one_line(self):
        lines = [f"[{i}/9] Building" for i in range(1, 10)]
        _, text = told(progress.follow_build, lines, out=Terminal())
        self.assertEqual(text.count("\n"), 0)
        self.assertEqual(text.count("\r"), 9)

    def test_elsewhere_it_is_a_line_now_and_then(self):
        lines = [f"[{i}/1000] Building" for i in range(1, 1001)]
        _, text = told(progress.follow_build, lines, step=1)
        self.assertLess(text.count("\n"), 200)
        self.assertTrue(text.splitlines()[-1].strip().startswith("[1000/1000, "))


class TestLines(unittest.TestCase):
    LINES = ["      Start   1: io.A",
             " 1/3 Test   #1: io.A .............................   Passed    0.02 sec",
             " 2/3 Test  #12: stereo.Kernels/B.C/0 .............***Failed    1.02 sec",
             " 3/3 Test   #3: apps.D ...........................***Skipped   0.20 sec"]

    def test_a_failed_test_is_named_at_once(self):
        status, text = told(progress.follow_tests, self.LINES, no_weights(), status=8)
        self.assertEqual(status, 8)
        self.assertIn("stereo.Kernels/B.C/0: Failed\n", text)
        self.assertNotIn("io.A", text)
        self.assertNotIn("apps.D", text)
        self.assertIn("[3/3, ", text)

    def test_a_long_test_counts_for_more(self):
        with tempfile.TemporaryDirectory() as folder:
            costs = Path(folder, "CTestCostData.txt")
            costs.write_text("io.A 1 9\nio.B 1 1\n---\nio.B\n", encoding="utf-8")
            weights = progress.TestWeights(costs)
            self.assertAlmostEqual(weights.share("io.A", 1, 2), 0.9)
            self.assertEqual(weights.share("io.B", 2, 2), 1)

    def test_without_a_run_before_all_count_the_same(self):
        self.assertAlmostEqual(no_weights().share("io.A", 1, 4), 0.25)


class Report(unittest.TestCase):
    def test_when_all_is_well_it_is_one_line(self):
        lines = progress.report("release", [case("io.A", "run"),
                                            not_run("io.B", "SKIP_REGULAR_EXPRESSION_MATCHED")])
        self.assertEqual(lines, ["2 tests: 1 passed, 0 failed, 1 skipped"])

    def test_a_failed_test_its_message_and_how_to_run_it_alone(self):
        lines = progress.report("release", [case("apps.Depth.IsFound", "fail", FAILED_TEST),
                                            case("io.A", "run")])
        self.assertEqual(lines[0], "2 tests: 1 passed, 1 failed, 0 skipped")
        self.assertIn("apps.Depth.IsFound failed:", lines)
        self.assertIn("  tests/apps/test_depth.cpp:249: Failure", lines)
        self.assertEqual(lines[-1], "  alone: build/release/tests/apps/test_apps --gtest_filter=Depth.IsFound")

    def test_a_program_that_is_not_there_is_a_failure(self):
        lines = progress.report("release", [not_run("io.A", "Unable to find executable")])
        self.assertEqual(lines[0], "1 tests: 0 passed, 1 failed, 0 skipped")
        self.assertIn("  Unable to find executable", lines)

    def test_of_a_program_that_is_one_entry_it_names_each_test(self):
        other = FAILED_TEST.replace("Depth.IsFound", "Made/Info.Says/0").replace(":249", ":17")
        lines = progress.report("sanitize", [case("apps.2", "fail", other + FAILED_TEST)])
        self.assertEqual(lines[0], "2 tests: 0 passed, 2 failed, 0 skipped")
        self.assertIn("apps.Made/Info.Says/0 failed:", lines)
        self.assertIn("  tests/apps/test_depth.cpp:17: Failure", lines)
        self.assertIn("apps.Depth.IsFound failed:", lines)
        self.assertEqual(
            lines[-1],
            "  alone: build/sanitize/tests/apps/test_apps --gtest_filter=Depth.IsFound")

    def test_each_test_of_an_entry_counts(self):
        output = ("[ RUN      ] A.B\n[       OK ] A.B (3 ms)\n"
                  "[ RUN      ] A.C/0\n[  SKIPPED ] A.C/0 (0 ms)\n")
        lines = progress.report("release", [case("io.A", "run", output), case("house.D", "run")])
        self.assertEqual(lines, ["3 tests: 2 passed, 0 failed, 1 skipped"])

    def test_the_test_that_ended_its_program_is_named(self):
        output = ("[ RUN      ] A.B\n[       OK ] A.B (3 ms)\n"
                  "[ RUN      ] A.C\n==7==ERROR: AddressSanitizer: heap-buffer-overflow\n")
        lines = progress.report("sanitize", [case("io", "fail", output)])
        self.assertEqual(lines[0], "2 tests: 1 passed, 1 failed, 0 skipped")
        self.assertIn("io.A.C failed:", lines)
        self.assertIn("  ==7==ERROR: AddressSanitizer: heap-buffer-overflow", lines)
        self.assertEqual(lines[-1], "  alone: build/sanitize/tests/io/test_io --gtest_filter=A.C")

    def test_names_are_no_patterns(self):
        lines = progress.report("release", [case("io.A/B.C/0x1 (+)", "fail", "")])
        self.assertEqual(lines[-1],
                         "  alone: ctest --preset release -R '^io\\.A/B\\.C/0x1 \\(\\+\\)$'")

    def test_a_message_begins_with_the_first_complaint(self):
        output = "one\n" * 30 + "==7==ERROR: AddressSanitizer: heap-buffer-overflow\n  #0 f\n"
        self.assertEqual(progress.message_of(output)[0],
                         "==7==ERROR: AddressSanitizer: heap-buffer-overflow")
        self.assertEqual(len(progress.message_of("plain\n" * 30)), progress.LINES_OF_A_MESSAGE)

    def test_durations(self):
        self.assertEqual([progress.duration(s) for s in (0.2, 59, 60, 200)],
                         ["0 s", "59 s", "1 min 00 s", "3 min 20 s"])


if __name__ == "__main__":
    unittest.main()
