"""One process that runs softscope's commands, in forks of it: softscope_server.cpp."""
import os
import subprocess
from dataclasses import dataclass


@dataclass
class Outcome:
    code: int  # exit code, or minus the signal
    cpu_ms: int
    memory_kb: int
    events: int  # writes, renames and removals
    failed_writes: int  # for a full disk
    out: str = ""
    err: str = ""
    runs_before: int = 0  # in the same process


class Server:
    def __init__(self, program, prefix=()):
        self._program, self._prefix, self._process = program, prefix, None

    def run(self, words, folder, out="out.txt", err="err.txt", seconds=30, fault="none", event=0,
            exits="whole"):
        """Runs one command line in `folder`; `out` and `err` are files there, `pipe` or `closed`.
        `exits`: `whole`, `quick` without static destructors, or `kept`: in a process that runs many."""
        if self._process is None:
            # Symbols are resolved once, and not by each fork for itself.
            self._process = subprocess.Popen([*self._prefix, self._program], text=True,
                                             env={**os.environ, "LD_BIND_NOW": "1"},
                                             stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        fields = [folder, out, err, seconds, fault, event, exits, *words]
        self._process.stdin.write("\x1f".join(map(str, fields)) + "\n")
        self._process.stdin.flush()
        answer = self._process.stdout.readline().split()
        if len(answer) != 6:
            raise RuntimeError(f"{self._program} ended")
        *facts, runs_before = map(int, answer)
        outcome = Outcome(*facts, runs_before=runs_before)
        for name, file in (("out", out), ("err", err)):
            if file not in ("pipe", "closed"):
                with open(f"{folder}/{file}", "rb") as stream:
                    setattr(outcome, name, stream.read().decode("utf-8", "replace"))
        return outcome

    def close(self):
        """Whether the process kept for runs ended soundly: static destructors, a sanitizer's leaks."""
        if self._process is None:
            return True
        self._process.stdin.close()
        code, self._process = self._process.wait(), None
        return code == 0
