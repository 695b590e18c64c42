"""Damaged inputs of every form through every command that reads them.

A run's number and the seed decide it wholly: `--only N` repeats one and keeps its folder. 19 of 20
runs share a process that is kept; a finding there is tried again in a process of its own, and told
as one behind other runs where it does not come back. Counts crashes, hangs (20 s of processor time),
more than 4 GB, exit 70, and exit 0 with a number that isn't finite, an invented geometry or a
half-written file. Exit code 1: there was a finding.
"""
import argparse
import collections
import json
import os
import random
import shlex
import shutil
import signal
import sys
import tempfile
import threading
import time
from pathlib import Path

from damage import damaged
from judge import judge
from seeds import make_seeds
from server import Server

FIRST_COMMAND_SHARE = 0.5
WHOLE_EXIT_EVERY = 20  # runs: these have a process of their own, which ends with its destructors
SECONDS_BETWEEN_TALLIES = 60
KEPT_END = "end of a kept process: its static destructors crash, or a sanitizer found a leak"


def tree(folder, inner=""):
    """Each file and folder below `folder`, by its path within it, as an os.DirEntry."""
    for entry in os.scandir(f"{folder}/{inner}"):
        yield inner + entry.name, entry
        if entry.is_dir(follow_symlinks=False):
            yield from tree(folder, f"{inner}{entry.name}/")


def state_of(entry):
    """Equal where a file was neither written nor replaced."""
    status = entry.stat(follow_symlinks=False)
    return (status.st_ino, status.st_size, status.st_mtime_ns)


class Place:
    """A copy of a form's seeds, kept from run to run. Its files are links to the seeds: softscope
    never writes into its inputs, damage replaces a whole file."""

    def __init__(self, form, root, folder):
        self.form, self.root, self.folder = form, root, folder
        self.make()

    def make(self):
        shutil.rmtree(self.folder, ignore_errors=True)
        for source in (self.form.folder, *self.form.shared):
            target = self.folder if source == self.form.folder else self.folder / source
            shutil.copytree(self.root / source, target, copy_function=os.link, dirs_exist_ok=True)
        self.seeds = {path: None if entry.is_dir() else state_of(entry)
                      for path, entry in tree(self.folder)}

    def damage(self, file, data):
        os.unlink(self.folder / file)
        (self.folder / file).write_bytes(data)

    def restore(self, damaged_file):
        """Removes what a run made. Returns the seeds that it wrote into: there must be none."""
        seen, new, replaced, written = set(), [], [], []
        for path, entry in tree(self.folder):
            if path not in self.seeds:
                new.append((path, entry.is_dir(follow_symlinks=False)))
                continue
            seen.add(path)
            if path == damaged_file or self.seeds[path] is None:
                continue
            state = state_of(entry)
            if state != self.seeds[path]:
                (written if state[0] == self.seeds[path][0] else replaced).append(path)
        if replaced or written or len(seen) < len(self.seeds):
            self.make()
            return written
        for path, is_folder in reversed(new):
            (os.rmdir if is_folder else os.unlink)(self.folder / path)
        if os.path.lexists(self.folder / damaged_file):
            os.unlink(self.folder / damaged_file)
        os.link(self.root / self.form.folder / damaged_file, self.folder / damaged_file)
        return []


class Trial:
    """One run: a form, a file, its damage, a command line."""

    def __init__(self, forms, root, seed, number):
        rng = random.Random(f"{seed}:{number}")
        self.number = number
        self.form = rng.choices(forms, [form.weight for form in forms])[0]
        rest = self.form.commands[1:]
        first = not rest or rng.random() < FIRST_COMMAND_SHARE
        self.words = self.form.commands[0] if first else rng.choice(rest)
        home = root / self.form.folder
        self.file = rng.choice(self.form.files(home))
        self.bytes = damaged((home / self.file).read_bytes(), rng)

    def run(self, server, place, hang_seconds, alone=False):
        """`alone`: in a process of its own."""
        place.damage(self.file, self.bytes)
        whole = self.number % WHOLE_EXIT_EVERY == 0
        exits = "whole" if whole else "quick" if alone else "kept"
        outcome = server.run([*self.words, "--threads", "1"], place.folder,
                             seconds=hang_seconds + 5, exits=exits)
        return outcome, judge(outcome, self.words, place.folder, 1000 * hang_seconds)


def one_trial(trial, server, place, hang_seconds):
    """Its outcome and findings; the place is as before."""
    def restored(found):
        written = place.restore(str(trial.file))
        return one_of_each_kind(found) + [f"input written: {file}" for file in written]
    outcome, found = trial.run(server, place, hang_seconds)
    found = restored(found)
    if not found or outcome.runs_before == 0:
        return outcome, found
    outcome_alone, found_alone = trial.run(server, place, hang_seconds, alone=True)
    found_alone = restored(found_alone)
    if found_alone:
        return outcome_alone, found_alone
    return outcome, [f"behind {outcome.runs_before} other runs: {what}" for what in found]


class Tally:
    def __init__(self):
        self.runs, self.findings, self.started = 0, [], time.monotonic()
        self.codes, self.of_form, self.slowest_ms = collections.Counter(), collections.Counter(), 0
        self.lock = threading.Lock()

    def add(self, trial, outcome, found):
        found = [f"run {trial.number}: {what}" for what in found]
        with self.lock:
            self.runs += 1
            self.codes[outcome.code] += 1
            self.of_form[trial.form.name] += 1
            self.slowest_ms = max(self.slowest_ms, outcome.cpu_ms)
            self.findings += found

    def line(self):
        """What an interrupted run has done: all of its counts."""
        seconds = time.monotonic() - self.started
        return (f"{self.runs} runs in {seconds:.0f} s, {self.runs / seconds:.0f} per second; "
                f"{self.exit_codes()}; findings: {len(self.findings)}")

    def exit_codes(self):
        return "exit codes: " + ", ".join(f"{count} with {code}"
                                          for code, count in sorted(self.codes.items()))

    def save(self, file):
        if file is None:
            return
        with self.lock:
            record = {"runs": self.runs, "seconds": round(time.monotonic() - self.started),
                      "exit_codes": self.codes, "forms": self.of_form, "findings": self.findings,
                      "largest_processor_time_ms": self.slowest_ms}
            text = json.dumps(record, indent=2)
        part = Path(f"{file}.part")
        part.write_text(text + "\n")
        part.replace(file)

    def text(self):
        kinds = collections.Counter(what.split(": ")[1] for what in self.findings)
        lines = [f"{self.runs} runs in {time.monotonic() - self.started:.0f} s; {self.exit_codes()}",
                 "forms: " + ", ".join(f"{name} {n}" for name, n in sorted(self.of_form.items())),
                 f"largest processor time of one run: {self.slowest_ms / 1000:.1f} s",
                 "findings: " + (", ".join(f"{n} {kind}" for kind, n in kinds.items()) or "none")]
        return "\n".join(lines)


def repeat_line(options, trial):
    words = [sys.executable, "-B", Path(__file__).name, "--server", options.server,
             *(["--form", options.form] if options.form else []), "--seed", str(options.seed),
             "--only", str(trial.number)]
    return shlex.join(words)


def one_of_each_kind(found):
    """A damaged length can make a hundred numbers absurd: the first tells."""
    kinds = {}
    for what in found:
        kinds.setdefault(what.split(":")[0], what)
    return list(kinds.values())


def unsound_seeds(options, forms, root, folder):
    """A line for each command that fails on an input without damage: it would judge nothing."""
    server, wrong = Server(options.server), []
    for form in forms:
        place = Place(form, root, folder)
        file = str(form.files(root / form.folder)[0])
        for words in form.commands:
            outcome = server.run([*words, "--threads", "1"], folder, seconds=options.hang_seconds,
                                 exits="kept")
            found = judge(outcome, words, folder, 1000 * options.hang_seconds)
            if outcome.code != form.sound_code or found:
                wrong.append(f"{form.name}: softscope {' '.join(words)} ended with {outcome.code} "
                             f"without damage: {outcome.err.strip()} {', '.join(found)}")
            place.restore(file)
    if not server.close():
        wrong.append(KEPT_END)
    return wrong


def work(options, forms, root, folder, numbers, tally, is_over):
    server, places = Server(options.server), {}
    for number in numbers:
        if is_over():
            break
        trial = Trial(forms, root, options.seed, number)
        name = trial.form.name
        if name not in places:
            places[name] = Place(trial.form, root, folder / name.replace(" ", "_"))
        outcome, found = one_trial(trial, server, places[name], options.hang_seconds)
        tally.add(trial, outcome, found)
        for what in found:
            print(f"run {number}: {what}: {trial.form.name}, {trial.file}: softscope "
                  f"{' '.join(trial.words)}\n  again: {repeat_line(options, trial)}", flush=True)
    if not server.close():
        print(KEPT_END, flush=True)
        tally.findings.append(f"last run: {KEPT_END}")


def run_all(options, forms, root, scratch):
    numbers = iter(range(options.first, options.first + options.runs))
    tally, stopped = Tally(), threading.Event()
    deadline = time.monotonic() + (options.seconds or 1e9)
    for end in (signal.SIGTERM, signal.SIGINT):
        signal.signal(end, lambda *_: stopped.set())

    def is_over():
        return stopped.is_set() or time.monotonic() > deadline
    threads = [threading.Thread(target=work, args=(options, forms, root, scratch / f"job{job}",
                                                   numbers, tally, is_over))
               for job in range(options.jobs)]
    for thread in threads:
        thread.start()
    for thread in threads:
        while thread.is_alive():
            thread.join(SECONDS_BETWEEN_TALLIES)
            if thread.is_alive():
                tally.save(options.counts)
                print(tally.line(), flush=True)
    tally.save(options.counts)
    print(tally.text())
    return 1 if tally.findings or tally.runs == 0 else 0


def run_one(options, forms, root):
    """Repeats a run; its folder stays."""
    trial = Trial(forms, root, options.seed, options.only)
    folder = Path(tempfile.mkdtemp(prefix=f"softscope_run_{options.only}_"))
    server = Server(options.server)
    outcome, found = trial.run(server, Place(trial.form, root, folder), options.hang_seconds,
                               alone=True)
    server.close()
    print(f"{trial.form.name}: {trial.file} is damaged\ncd {folder}; softscope {' '.join(trial.words)}")
    print(f"exit {outcome.code}, {outcome.cpu_ms} ms, {outcome.memory_kb >> 10} MB\n{outcome.err}", end="")
    print("\n".join(found) or "no finding")
    return 1 if found else 0


def options_of(words):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--server", required=True, help="the program softscope_server of a build")
    parser.add_argument("--runs", type=int, default=1000)
    parser.add_argument("--first", type=int, default=0, help="number of the first run")
    parser.add_argument("--seconds", type=float, help="ends earlier")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--hang-seconds", type=int, default=20,
                        help="of processor time; more under sanitizers")
    parser.add_argument("--form", help="damages this form alone")
    parser.add_argument("--check-seeds", action="store_true",
                        help="runs each command once, without damage")
    parser.add_argument("--counts", help="a JSON file that keeps the counts, once a minute")
    parser.add_argument("--only", type=int, help="repeats one run, keeps its folder")
    return parser.parse_args(words)


def main(words):
    options = options_of(words)
    options.server = str(Path(options.server).resolve())
    with tempfile.TemporaryDirectory(prefix="softscope_mutation_") as scratch:
        root = Path(scratch, "seeds")
        root.mkdir()
        server = Server(options.server)
        forms = make_seeds(root, server)
        server.close()
        if options.form:
            forms = [form for form in forms if form.name == options.form]
        if options.only is not None:
            return run_one(options, forms, root)
        if options.check_seeds:
            wrong = unsound_seeds(options, forms, root, Path(scratch, "sound"))
            print("\n".join(wrong) or f"{len(forms)} forms: every command reads its seeds")
            return 1 if wrong else 0
        return run_all(options, forms, root, Path(scratch))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
