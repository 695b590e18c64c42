"""A two-case study as a Snakemake workflow on this machine. Argument: softscope."""
import sys
import tempfile
from pathlib import Path

import workflow


def main(softscope):
    workflow.need("snakemake")
    with tempfile.TemporaryDirectory(prefix="softscope_snakemake_") as name:
        folder = Path(name)
        study, out = workflow.make_study(folder), folder / "out"
        ran = workflow.run_snakemake(softscope, study, out, folder, "--cores", "2")
        assert ran.returncode == 0, ran.stdout
        workflow.check(out)
        record = out / "cases/fine/case.json"
        before = record.stat().st_mtime_ns
        study.write_text(study.read_text() + "# a remark\n")  # jobs run again, cases don't
        ran = workflow.run_snakemake(softscope, study, out, folder, "--cores", "2")
        assert ran.returncode == 0, ran.stdout
        assert record.stat().st_mtime_ns == before, "a finished case was run again"
    print("Snakemake ran both cases; the finished one once")


main(sys.argv[1])
