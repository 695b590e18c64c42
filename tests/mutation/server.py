"""One process that runs softscope's commands, each in a fork of it: softscope_server.cpp."""
import subprocess
from dataclasses import dataclass
from pathlib import Path


@dataclass
class Outcome:
    code: int  # exit code, or minus the signal
    cpu_ms: int
    memory_kb: int
    events: int  # writes, renames and removals
    failed_writes: int  # for a full disk
    out: str = ""
    err: str = ""


class Server:
    def __init__(self, program, prefix=()):
        self._program, self._prefix, self._process = program, prefix, None

    def run(self, words, folder, out="out.txt", err="err.txt", seconds=30, fault="none", event=0):
        """Runs one command line in `folder`; `out` and `err` are files there, `pipe` or `closed`."""
        if self._process is None:
            self._process = subprocess.Popen([*self._prefix, self._program], text=True,
                                             stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        fields = [folder, out, err, seconds, fault, event, *words]
        self._process.stdin.write("\x1f".join(map(str, fields)) + "\n")
        self._process.stdin.flush()
        answer = self._process.stdout.readline().split()
        if len(answer) != 5:
            raise RuntimeError(f"{self._program} ended")
        outcome = Outcome(*map(int, answer))
        for name, file in (("out", out), ("err", err)):
            if file not in ("pipe", "closed"):
                text = Path(folder, file).read_bytes().decode("utf-8", "replace")
                setattr(outcome, name, text)
        return outcome

    def close(self):
        if self._process is not None:
            self._process.stdin.close()
            self._process.wait()
            self._process = None
