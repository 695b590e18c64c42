"""The same study as Slurm jobs, on a real Slurm of one node that is started and ended here.
Argument: softscope."""
import os
import pwd
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import workflow

CONFIG = """ClusterName=softscope
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CryptoType=crypto/munge
SlurmctldPort={port}
SlurmdPort={node_port}
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
SchedulerParameters=sched_interval=1,bf_interval=1
JobCompType=jobcomp/none
MpiDefault=none
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory={memory_mb} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=10 State=UP
"""


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Cluster:
    """munged, slurmctld and slurmd in a folder; ended by their own process ids."""

    def __init__(self, folder):
        self.folder = folder
        self.daemons = []
        self.environment = dict(os.environ, SLURM_CONF=str(folder / "slurm.conf"))

    def start(self, *words):
        with open(self.folder / "daemons.log", "ab") as log:
            self.daemons.append(subprocess.Popen(list(map(str, words)), stdout=log, stderr=log,
                                                 env=self.environment))

    def __enter__(self):
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o600)
        memory_mb = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") >> 20
        (self.folder / "slurm.conf").write_text(CONFIG.format(
            host=socket.gethostname().split(".")[0], user=pwd.getpwuid(os.getuid()).pw_name,
            folder=self.folder, port=free_port(), node_port=free_port(),
            cpus=os.cpu_count(), memory_mb=int(0.9 * memory_mb)))
        self.start("munged", "--foreground", "--force", "--key-file", key,
                   "--socket", self.folder / "munge.socket",
                   "--pid-file", self.folder / "munged.pid",
                   "--seed-file", self.folder / "munge.seed",
                   "--log-file", self.folder / "munged.log", "--num-threads", "2")
        self.wait_for(lambda: (self.folder / "munge.socket").exists(), "munged")
        self.start("slurmctld", "-D")
        self.start("slurmd", "-D")
        self.wait_for(self.node_is_idle, "slurmctld and slurmd")
        return self

    def node_is_idle(self):
        told = subprocess.run(["sinfo", "--noheader", "--format=%T"], env=self.environment,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        return told.stdout.strip() == "idle"

    def wait_for(self, ready, what, limit_s=40):
        end = time.monotonic() + limit_s
        while not ready():
            died = [d for d in self.daemons if d.poll() is not None]
            if died or time.monotonic() > end:
                self.__exit__()
                logs = "\n".join(p.read_text(errors="replace")[-1500:]
                                 for p in self.folder.glob("*.log"))
                print(f"skipped: {what} did not start on this machine\n{logs}")
                sys.exit(workflow.SKIPPED)
            time.sleep(0.2)

    def __exit__(self, *_):
        for daemon in reversed(self.daemons):
            daemon.send_signal(signal.SIGTERM)
            try:
                daemon.wait(timeout=10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()


def main(softscope):
    workflow.need("snakemake", "slurmctld", "slurmd", "munged", "sbatch", "scancel")
    folder = Path(tempfile.mkdtemp(prefix="softscope_slurm_"))
    try:
        study, out = workflow.make_study(folder), folder / "out"
        with Cluster(folder) as cluster:
            os.environ["SLURM_CONF"] = cluster.environment["SLURM_CONF"]
            ran = workflow.run_snakemake(
                softscope, study, out, folder, "--profile",
                workflow.ROOT / "data/studies/slurm", "--latency-wait", "10")
            assert ran.returncode == 0, ran.stdout
            workflow.check(out)
            logs = list(folder.glob("slurm-*.log"))
            assert len(logs) >= 3, "two cases and the table were jobs of Slurm"
        print(f"Slurm ran {len(logs)} jobs")
    finally:
        shutil.rmtree(folder, ignore_errors=True)


main(sys.argv[1])
