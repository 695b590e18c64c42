"""What the tests of workflows share: a two-case study, and its run by Snakemake."""
import json
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SKIPPED = 77  # ctest's SKIP_RETURN_CODE

STUDY = """title = "Two cases"
[simulate]
frames = 2
scope.width_px = 160
scope.height_px = 120
organ.cells_per_side = 20
[reconstruct]
stereo.disparity_max_px = 63
[[case]]
name = "fine"
[[case]]
name = "broken"
sequence = "no_pictures"
"""


def need(*programs):
    """Ends the test as skipped, saying why, where one of these isn't installed."""
    for program in programs:
        if shutil.which(program) is None:
            print(f"skipped: {program} is not installed")
            sys.exit(SKIPPED)


def make_study(folder):
    """One case that can be run and one that fails."""
    (folder / "no_pictures" / "left").mkdir(parents=True)
    file = folder / "study.toml"
    file.write_text(STUDY, encoding="utf-8")
    return file


def run_snakemake(softscope, study, out, folder, *options):
    line = ["snakemake", "--snakefile", ROOT / "data/studies/Snakefile", *options,
            "--config", f"study={study}", f"out={out}", f"softscope={softscope}"]
    return subprocess.run(list(map(str, line)), cwd=folder, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, timeout=300)


def check(out):
    """The failed case didn't stop the study, and both are told."""
    result = json.loads((out / "study.json").read_text(encoding="utf-8"))
    status = {case["name"]: case["status"] for case in result["cases"]}
    assert status == {"fine": "done", "broken": "failed"}, status
    fine = next(case for case in result["cases"] if case["name"] == "fine")
    assert fine["evaluation"]["tracks"]["n"] > 0
    assert "broken: reconstruct: " in (out / "table.md").read_text(encoding="utf-8")
    assert (out / "report.html").stat().st_size > 1000
