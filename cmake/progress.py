"""Builds and tests with a count, the time and how long it still takes; ends with what failed.

usage: progress.py build PRESET [TARGET…]
       progress.py test PRESET [OPTION OF CTEST…]
"""
import os
import re
import resource
import shlex
import subprocess
import sys
import time
import xml.etree.ElementTree as xml
from pathlib import Path

INDENT = " " * 6
SECONDS_BETWEEN_LINES = 15  # where the output is no terminal
LINES_OF_A_MESSAGE = 15

BUILD_STATUS = re.compile(r"^\[(\d+)/(\d+)\] ")
TEST_STATUS = re.compile(
    r"^\s*(\d+)/(\d+) Test\s+#\d+: (.+?) \.*\s*(Passed|\*\*\*\S.*?)\s+([\d.]+) sec")
# Where the message of a failed test begins: GoogleTest, sanitizers, Python, softscope itself.
MESSAGE = re.compile(r": Failure$|runtime error: |ERROR: |^Traceback |^(?:FAIL|ERROR): |^error: |"
                     r"terminate called|: Assertion `")
FAILED_WITHIN = re.compile(r"^\[  FAILED  \] ([\w./]+)(?:, where .*)? \(\d+ ms\)$", re.MULTILINE)
BEGUN_WITHIN = re.compile(r"^\[ RUN      \] ([\w./]+)$", re.MULTILINE)
DONE_WITHIN = re.compile(r"^\[(       OK|  SKIPPED |  FAILED  ) ?\] .* \(\d+ ms\)$", re.MULTILINE)
OUTPUT_BYTES = 10_000_000  # of an entry: ctest would cut what tells the tests within


def duration(seconds):
    """45 s, 3 min 20 s."""
    seconds = int(seconds + 0.5)
    return f"{seconds} s" if seconds < 60 else f"{seconds // 60} min {seconds % 60:02} s"


class Progress:
    """One line that is written over on a terminal; elsewhere a line now and then."""

    def __init__(self, out=sys.stdout, clock=time.monotonic):
        self.out, self.clock = out, clock
        self.started = self.told = clock()
        self.is_open = False  # a line on the terminal waits to be written over

    def elapsed(self):
        return self.clock() - self.started

    def tell(self, done, total, share):
        """`share` of the work is done, which may be another than done / total."""
        now = self.clock()
        is_last = done == total
        if not self.out.isatty() and not is_last and now - self.told < SECONDS_BETWEEN_LINES:
            return
        self.told = now
        text = f"{INDENT}[{done}/{total}, {duration(self.elapsed())}"
        if 0 < share and not is_last:
            text += f", about {duration(self.elapsed() * (1 - share) / share)} left"
        if self.out.isatty():
            self.out.write(f"\r{text}]\033[K")
            self.is_open = True
        else:
            self.out.write(f"{text}]\n")
        self.out.flush()

    def say(self, text):
        """A line that stays."""
        self.close()
        self.out.write(f"{text}\n")
        self.out.flush()

    def close(self):
        if self.is_open:
            self.out.write("\n")
        self.is_open = False


def lines_of(command, environment=None):
    """The command's lines, errors among them, as they come; returns its exit status."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               env={**os.environ, **(environment or {})}, text=True,
                               encoding="utf-8", errors="replace")
    try:
        for line in process.stdout:
            yield line.rstrip("\n")
    finally:
        process.stdout.close()
        status = process.wait()
    return status


def for_each(lines, show):
    """Shows each line; returns the exit status that the lines end with."""
    while True:
        try:
            line = next(lines)
        except StopIteration as end:
            return end.value
        show(line)


def processor_time():
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


# --- build ----------------------------------------------------------------------------------------

def follow_build(lines, progress):
    """Ninja's lines become a count; what compilers say stays. Returns the exit status."""
    def show(line):
        found = BUILD_STATUS.match(line)
        if found:
            done, total = int(found[1]), int(found[2])
            progress.tell(done, total, done / total)
        elif line:
            progress.say(f"{INDENT}{line}")
    return for_each(lines, show)


def build(preset, targets):
    progress = Progress()
    command = ["cmake", "--build", "--preset", preset]
    command += ["--target", *targets] if targets else []
    status = follow_build(lines_of(command, {"NINJA_STATUS": "[%f/%t] "}), progress)
    progress.close()
    if status == 0:
        progress.say(f"{INDENT}{duration(processor_time())} of processor time")
    return status


# --- tests ----------------------------------------------------------------------------------------

class TestWeights:
    """How long each test took the last time, where ctest knows it; else what others take."""

    def __init__(self, cost_file):
        self.seconds = {}
        if cost_file.exists():
            for line in cost_file.read_text(encoding="utf-8").partition("\n---")[0].splitlines():
                name, runs, seconds = line.rsplit(" ", 2)
                if int(runs) > 0:
                    self.seconds[name] = float(seconds)
        known = self.seconds.values()
        self.usual = sum(known) / len(known) if known else 1
        self.weight_done = 0

    def share(self, name, done, total):
        """The share of the work that is done, now that this test is over as well."""
        self.weight_done += self.seconds.get(name, self.usual)
        weight = max(self.weight_done, self.usual * total) if done < total else self.weight_done
        return self.weight_done / weight


def follow_tests(lines, progress, weights):
    """ctest's lines become a count; a failed test is named at once. Returns the exit status."""
    def show(line):
        found = TEST_STATUS.match(line)
        if found:
            done, total, name, outcome = int(found[1]), int(found[2]), found[3], found[4]
            if outcome not in ("Passed", "***Skipped"):
                progress.say(f"{INDENT}{name}: {outcome.strip('*')}")
            progress.tell(done, total, weights.share(name, done, total))
        elif line.startswith(("CMake Error", "Unable to find", "No tests were found")):
            progress.say(f"{INDENT}{line}")
    return for_each(lines, show)


def message_of(output):
    """The lines that tell what went wrong: from the first complaint on, else the last ones."""
    lines = [line for line in output.splitlines() if line.strip()]
    first = next((i for i, line in enumerate(lines) if MESSAGE.search(line)), None)
    if first is None:
        return lines[-LINES_OF_A_MESSAGE:]
    rest = lines[first:]
    end = next((i for i, line in enumerate(rest) if line.startswith("[  FAILED  ]")), len(rest))
    return rest[:min(end, LINES_OF_A_MESSAGE)]


def failed_within(output):
    """Names of the tests that failed inside an entry, the one that ended the program among them."""
    names = FAILED_WITHIN.findall(output)
    begun = BEGUN_WITHIN.findall(output)
    if len(begun) > len(DONE_WITHIN.findall(output)):
        names.append(begun[-1])
    return names


def failures(preset, name, output):
    """Of a failed entry each test that failed: its name, its message, the command that runs it alone."""
    within = failed_within(output)
    if not within:
        entry = re.sub(r"([][.^$*+?()|\\])", r"\\\1", name)
        alone = f"ctest --preset {preset} -R {shlex.quote(f'^{entry}$')}"
        return [(name, message_of(output), alone)]
    found = []
    folder = name.partition(".")[0]
    for inner in within:
        begin = output.find(f"[ RUN      ] {inner}\n")
        alone = f"build/{preset}/tests/{folder}/test_{folder} --gtest_filter={inner}"
        found.append((f"{folder}.{inner}", message_of(output[max(begin, 0):]), alone))
    return found


def counts(case):
    """How many tests of this entry passed, failed and were skipped."""
    why = why_not_run(case)
    output = case.findtext("system-out") or ""
    if why is not None:
        return (0, 0, 1) if why.startswith("SKIP_") else (0, 1, 0)
    outcomes = DONE_WITHIN.findall(output)
    failed = len(failed_within(output))
    if case.get("status") == "fail":
        failed = max(failed, 1)
    elif not outcomes:
        return (1, 0, 0)
    return (outcomes.count("       OK"), failed, outcomes.count("  SKIPPED "))


def why_not_run(case):
    """SKIP_… where the test itself said so; other reasons are failures. None where it ran."""
    skipped = case.find("skipped")
    return None if skipped is None else skipped.get("message", "")


def report(preset, cases):
    """The last lines of a run: what failed, what it said, how to run it alone."""
    passed, not_passed, skipped = (
        sum(column) for column in zip((0, 0, 0), *map(counts, cases)))
    failed = [case for case in cases if counts(case)[1] > 0]
    lines = [f"{passed + not_passed + skipped} tests: {passed} passed, {not_passed} failed, "
             f"{skipped} skipped"]
    for case in failed:
        output = why_not_run(case) or case.findtext("system-out") or ""
        for name, message, alone in failures(preset, case.get("name"), output):
            lines += ["", f"{name} failed:"] + ["  " + line for line in message]
            lines += [f"  alone: {alone}"]
    return lines


def test(preset, options):
    folder = Path("build", preset)
    results = folder / "Testing" / "results.xml"
    results.unlink(missing_ok=True)
    command = ["ctest", "--preset", preset, "--parallel", str(len(os.sched_getaffinity(0))),
               "--no-label-summary", "--test-output-size-passed", str(OUTPUT_BYTES),
               "--test-output-size-failed", str(OUTPUT_BYTES), "--output-junit", str(results.absolute()), *options]
    progress = Progress()
    weights = TestWeights(folder / "Testing" / "Temporary" / "CTestCostData.txt")
    status = follow_tests(lines_of(command), progress, weights)
    progress.close()
    if not results.exists():
        progress.say(f"error: ctest ended with {status} and no results; run it alone: "
                     + shlex.join(command))
        return status or 1
    progress.say(f"{INDENT}{duration(processor_time())} of processor time")
    for line in report(preset, xml.parse(results).getroot().findall("testcase")):
        progress.say(f"{INDENT}{line}".rstrip())
    return status


def main(words):
    if len(words) < 2 or words[0] not in ("build", "test"):
        print(__doc__.rstrip(), file=sys.stderr)
        return 2
    try:
        return (build if words[0] == "build" else test)(words[1], words[2:])
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
