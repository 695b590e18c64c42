"""Faults of the machine at each write, rename and removal of softscope's commands.

A run of `reconstruct` is killed, meets a full disk, a failing disk or a stop signal at its n-th event,
for every n; each is resumed to the same bytes, with nothing left behind. The other commands meet a
full and a failing disk at every event: the exit code says so, and no part of a result stays. A closed
pipe, and closed streams, lose no file. Exit code 1: there was a finding.
"""
import argparse
import collections
import json
import random
import shutil
import signal
import sys
import tempfile
import time
from pathlib import Path

from seeds import write_meshes, write_volumes
from server import Server

RUN = ["reconstruct", "clip", "--out", "out", "--save-every", "1", "--checkpoint-every", "2", "--track",
       "clip/track_points.csv", "--quiet", "--threads", "1", "--set", "stereo.disparity_max_px=63"]
OTHERS = {
    "depth": ["depth", "clip", "--out", "out"],
    "evaluate": ["evaluate", "run", "--reference", "clip", "--out", "out"],
    "compare": ["compare", "--reference", "good/m.stl", "--test", "obj/m.obj", "--out", "out"],
    "simulate": ["simulate", "--out", "out", "--frames", "2", "--size", "96x80", "--set",
                 "organ.cells_per_side=16"],
    "slice": ["slice", "mha/v.mha", "--out", "out/a.png", "--out", "out/a.pdf", "--out", "out/a.svg"],
    "figure": ["figure", "run", "--kind", "frames", "--out", "out/a.svg", "--out", "out/b.svg"],
    "report": ["report", "ev", "--out", "out/r.html"],
    "export": ["export", "run", "--out", "out/m.obj"],
    "export series": ["export", "run", "--out", "out/m.pvd"],
    "movie": ["view", "run", "--movie", "out/m.mp4", "--size", "320x240", "--seconds", "0.2"],
}
FOLDERS = {"depth", "evaluate", "compare", "simulate"}  # cleaned of what a killed process left
STOP_SIGNALS = 60  # 5 ms apart
TIMES = ("_ms", "_s", "resumed_at_frame")


def without_times(name, data):
    """Bytes that a run repeats: clocks aren't among them."""
    if name.endswith("frames.csv"):
        rows = [line.split(",") for line in data.decode().splitlines()]
        keep = [i for i, title in enumerate(rows[0]) if not title.endswith("_ms")]
        return [[row[i] for i in keep if i < len(row)] for row in rows]
    if name.endswith(".mp4"):  # its encoder shares work among threads
        return len(data) > 0
    if not name.endswith(".json"):
        return data

    def strip(part):
        if isinstance(part, dict):
            return {k: strip(v) for k, v in part.items() if not k.endswith(TIMES)}
        return [strip(p) for p in part] if isinstance(part, list) else part
    return strip(json.loads(data))


def content(folder):
    return {str(file.relative_to(folder)): without_times(file.name, file.read_bytes())
            for file in sorted(folder.rglob("*")) if file.is_file()}


def difference(found, wanted):
    extra, missing = sorted(found.keys() - wanted.keys()), sorted(wanted.keys() - found.keys())
    changed = sorted(name for name in found.keys() & wanted.keys() if found[name] != wanted[name])
    parts = [f"{what} {', '.join(names[:3])}" for what, names in
             (("left behind", extra), ("missing", missing), ("other bytes", changed)) if names]
    return "; ".join(parts)


class Faults:
    def __init__(self, server, root):
        self.server, self.root, self.out = server, root, root / "out"
        self.done, self.findings = collections.Counter(), []

    def fresh(self):
        shutil.rmtree(self.out, ignore_errors=True)

    def softscope(self, words, **more):
        return self.server.run(words, self.root, seconds=60, **more)

    def wrong(self, what, text):
        self.findings.append(what)
        print(f"{what}: {text}", flush=True)

    def reference(self, words):
        """What the command leaves undisturbed, and how many events it has."""
        self.fresh()
        if "/" in words[words.index("--out" if "--out" in words else "--movie") + 1]:
            self.out.mkdir()
        outcome = self.softscope(words)
        if outcome.code != 0:
            raise RuntimeError(f"softscope {' '.join(words)} ended with {outcome.code}: {outcome.err}")
        return content(self.out), outcome.events

    # --- a run -----------------------------------------------------------------------------------

    def resume(self, what, wanted):
        """Goes on with what is there; the result must be that of the undisturbed run."""
        again = [*RUN, "--resume"] if self.out.exists() else RUN
        outcome = self.softscope(again)
        complete = outcome.code == 2 and "no interrupted run" in outcome.err
        if outcome.code != 0 and not complete:
            return self.wrong(what, f"--resume ended with {outcome.code}: {outcome.err.strip()}")
        if problem := difference(content(self.out), wanted):
            self.wrong(what, problem)

    def disturb_run(self, kind, event, wanted):
        self.fresh()
        outcome = self.softscope(RUN, fault=kind, event=event)
        what = f"run, {kind} at event {event}"
        self.done[kind] += 1
        if kind == "kill" and outcome.code != -signal.SIGKILL:
            self.wrong(what, f"ended with {outcome.code}")
        if kind in ("full", "error") and outcome.code not in (0, 3):
            self.wrong(what, f"ended with {outcome.code}: {outcome.err.strip()}")
        if kind == "term" and outcome.code not in (0, 130):
            self.wrong(what, f"ended with {outcome.code}: {outcome.err.strip()}")
        if outcome.code == 0 and outcome.failed_writes > 0:
            self.wrong(what, "ended with 0")
        self.resume(what, wanted)

    def stop_at(self, milliseconds, wanted):
        """A stop signal at any time, also before the first line of the command."""
        self.fresh()
        outcome = self.softscope(RUN, fault="timer", event=max(1, int(1000 * milliseconds)))
        what = f"run, SIGTERM after {milliseconds} ms"
        self.done["stop signal"] += 1
        if outcome.code not in (0, 130, -signal.SIGTERM):
            self.wrong(what, f"ended with {outcome.code}: {outcome.err.strip()}")
        if outcome.code == -signal.SIGTERM and (self.out / "writing.lock").exists():
            self.wrong(what, "was killed while it wrote")
        self.resume(what, wanted)

    def close_streams(self, wanted):
        for out, err in (("pipe", "pipe"), ("closed", "closed"), ("out.txt", "closed"),
                         ("closed", "err.txt"), ("out.txt", "pipe")):
            self.fresh()
            outcome = self.softscope(RUN, out=out, err=err)
            what = f"run, stdout {out}, stderr {err}"
            self.done["closed stream"] += 1
            if outcome.code not in (0, 3):
                self.wrong(what, f"ended with {outcome.code}")
            if problem := difference(content(self.out), wanted):
                self.wrong(what, problem)

    # --- the other commands ----------------------------------------------------------------------

    def disturb_other(self, name, words, kind, event, wanted):
        self.fresh()
        target = words[words.index("--out" if "--out" in words else "--movie") + 1]
        if "/" in target:
            self.out.mkdir()
        outcome = self.softscope(words, fault=kind, event=event)
        what = f"{name}, {kind} at event {event}"
        self.done[kind] += 1
        left = content_names(self.out)
        if kind == "kill":
            return self.repeat(what, words, wanted)
        if outcome.code not in (0, 1, 3):
            self.wrong(what, f"ended with {outcome.code}: {outcome.err.strip()}")
        if outcome.code != 0 and "error: " not in outcome.err:
            self.wrong(what, "no error line")
        if outcome.code == 0 and outcome.failed_writes > 0:
            self.wrong(what, "ended with 0")
        if outcome.code == 0 and (problem := difference(content(self.out), wanted)):
            self.wrong(what, f"ended with 0, but: {problem}")
        if parts := [file for file in left if ".part" in file]:
            self.wrong(what, f"left behind {', '.join(parts[:3])}")
        if outcome.code != 0 and left:
            self.wrong(what, f"left behind {', '.join(sorted(left)[:3])}")
        self.repeat(what, words, wanted)

    def repeat(self, what, words, wanted):
        again = self.softscope([*words, "--force"])
        if again.code != 0:
            self.wrong(what, f"--force ended with {again.code}: {again.err.strip()}")
        elif problem := difference(content(self.out), wanted):
            self.wrong(what, f"after --force: {problem}")


def content_names(folder):
    return {str(file.relative_to(folder)) for file in folder.rglob("*") if file.is_file()}


def make_seeds(server, root):
    small = ["--size", "96x80", "--set", "organ.cells_per_side=16", "--quiet"]
    for words in (["simulate", "--out", "clip", "--frames", "4", *small],
                  ["reconstruct", "clip", "--out", "run", "--save-every", "1", "--quiet"],
                  ["evaluate", "run", "--reference", "clip", "--out", "ev", "--quiet"]):
        outcome = server.run(words, root, seconds=120)
        if outcome.code != 0:
            raise RuntimeError(f"softscope {' '.join(words)} ended with {outcome.code}: {outcome.err}")
    write_volumes(root)
    write_meshes(root)


def plan(faults, only, rng):
    """What is to be done, as calls; in an order that spreads a bounded run over all of it."""
    calls = []
    if only in (None, "run"):
        wanted, events = faults.reference(RUN)
        print(f"run: {events} events", flush=True)
        faults.close_streams(wanted)
        calls += [(faults.stop_at, 5 * i, wanted) for i in range(STOP_SIGNALS)]
        for kind in ("kill", "full", "error", "term"):
            calls += [(faults.disturb_run, kind, event, wanted) for event in range(1, events + 1)]
    for name, words in OTHERS.items():
        if only not in (None, name):
            continue
        words = [*words, "--quiet", "--threads", "1"]
        try:
            wanted, events = faults.reference(words)
        except RuntimeError as error:  # a machine that can't draw
            print(f"{name} is left out: {error}")
            continue
        print(f"{name}: {events} events", flush=True)
        for kind in ("kill", "full", "error") if name in FOLDERS else ("full", "error"):
            calls += [(faults.disturb_other, name, words, kind, event, wanted)
                      for event in range(1, events + 1)]
    rng.shuffle(calls)
    return calls


def main(words):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--server", required=True, help="the program softscope_server of a build")
    parser.add_argument("--seconds", type=float, help="ends earlier; the order is then the seed's")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", help="`run`, or the name of another command")
    options = parser.parse_args(words)
    with tempfile.TemporaryDirectory(prefix="softscope_faults_") as scratch:
        server = Server(str(Path(options.server).resolve()))
        make_seeds(server, Path(scratch))
        faults = Faults(server, Path(scratch))
        calls = plan(faults, options.only, random.Random(options.seed))
        deadline = time.monotonic() + (options.seconds or 1e9)
        done = 0
        for call, *arguments in calls:
            if time.monotonic() > deadline:
                break
            call(*arguments)
            done += 1
        server.close()
    kinds = ", ".join(f"{count} {kind}" for kind, count in sorted(faults.done.items()))
    print(f"{done} of {len(calls)} faults: {kinds}; findings: {len(faults.findings)}")
    return 1 if faults.findings or done == 0 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
