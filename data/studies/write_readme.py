#!/usr/bin/env python3
"""Writes the numbers of README.md from docs/results.md, which write_results.py writes.

usage: data/studies/write_readme.py [--check]
Replaces the lines between the two markers of README.md. --check writes nothing: exit code 1 where
the lines differ from what docs/results.md gives."""
import argparse
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
README, RESULTS = ROOT / "README.md", ROOT / "docs/results.md"
BEGIN, END = "<!-- numbers of docs/results.md: begin -->", "<!-- end -->"

POINTS, SURFACE = "material points mean [mm]", "surface mean [mm]"
WRONG = "silently wrong [frames]"
PAPER, PARTS, HIDDEN, STRESS, REAL = ("The paper's simulation", "What each part is worth",
                                      "Out of sight", "Stress", "Real clips")
# What was measured, the numbers, what to compare them with. {title/case/heading} is one cell.
ROWS = [
    ("the paper's simulation: OpenHELP heart, liver, kidney, from rendered stereo",
     f"material points {{{PAPER}/heart-stereo/{POINTS}}}, {{{PAPER}/liver-stereo/{POINTS}}}, "
     f"{{{PAPER}/kidney-stereo/{POINTS}}} mm",
     f"the paper, from ideal depth: {{{PAPER}/heart-stereo/paper [mm]}}, "
     f"{{{PAPER}/liver-stereo/paper [mm]}}, {{{PAPER}/kidney-stereo/paper [mm]}} mm"),
    ("the same from ideal depth",
     f"{{{PAPER}/heart-ideal-depth/{POINTS}}}, {{{PAPER}/liver-ideal-depth/{POINTS}}}, "
     f"{{{PAPER}/kidney-ideal-depth/{POINTS}}} mm", "the same"),
    ("rendered heart that breathes, beats and is pushed, 360 × 288",
     f"material points {{{PARTS}/default/{POINTS}}} mm, surface {{{PARTS}/default/{SURFACE}}} mm, "
     f"P95 {{{PARTS}/default/surface P95 [mm]}} mm",
     f"points with SGBM's depth {{{PARTS}/sgbm/{POINTS}}} mm, points that don't move "
     f"{{{PARTS}/default/had nothing been tracked [mm]}} mm"),
    ("scope at 100 and 150 mm/s, shutter open half of the time",
     f"material points {{{STRESS}/speed-100/{POINTS}}}, {{{STRESS}/speed-150/{POINTS}}} mm; "
     f"silently wrong frames {{{STRESS}/speed-100/{WRONG}}}, {{{STRESS}/speed-150/{WRONG}}} of 24",
     "0 wanted"),
    ("tissue out of sight for 2 s: scope withdrawn, covered, wiped",
     f"material points {{{HIDDEN}/withdraw/{POINTS}}}, {{{HIDDEN}/cover/{POINTS}}}, "
     f"{{{HIDDEN}/wipe/{POINTS}}} mm",
     f"points that don't move: {{{HIDDEN}/withdraw/had nothing been tracked [mm]}} mm"),
    ("real da Vinci clip, tissue pulled, scope static",
     f"back-projection {{{REAL}/endonerf_pulling/back-projection [mm]}} mm "
     f"({{{REAL}/endonerf_pulling/before fusion [mm]}} mm before fusion), scope found within "
     f"{{{REAL}/endonerf_pulling/scope, first to last frame [mm]}} mm",
     "the paper on its clips: 0.08 to 0.21 mm"),
    ("real porcine tissue against CT (OpenCAS), after rigid alignment",
     f"{{{REAL}/opencas_ct/{SURFACE}}} mm, P95 {{{REAL}/opencas_ct/surface P95 [mm]}} mm",
     "one pixel is 1 to 2 mm"),
]


def cells_of(line):
    return [cell.strip().replace("\\|", "|")
            for cell in re.split(r"(?<!\\)\|", line.strip().strip("|"))]


def tables_of(page):
    """Per title, per case, per heading: a cell's text."""
    tables = {}
    for section in page.split("\n## ")[1:]:
        title, *lines = section.splitlines()
        rows = [cells_of(line) for line in lines if line.startswith("| ")]
        if rows:
            tables[title] = {row[0]: dict(zip(rows[0], row)) for row in rows[1:]}
    return tables


def filled(text, tables):
    def number(place):
        title, case, heading = place.group(1).split("/", 2)
        try:
            value = tables[title][case][heading]
        except KeyError as missing:
            raise SystemExit(f"write_readme.py: docs/results.md has no {missing} of {place.group(1)}")
        return value or "–"
    return re.sub(r"\{([^{}]+)\}", number, text)


def block(page):
    tables = tables_of(page)
    lines = ["| | measured | for comparison |", "|---|---|---|"]
    lines += ["| " + " | ".join(filled(part, tables) for part in row) + " |" for row in ROWS]
    return "\n".join(lines)


def renewed(readme, page):
    """`readme` with the numbers of `page` between its markers."""
    if readme.count(BEGIN) != 1 or readme.count(END) != 1:
        raise SystemExit("write_readme.py: README.md has not one pair of markers")
    before, rest = readme.split(BEGIN)
    return f"{before}{BEGIN}\n{block(page)}\n{END}{rest.split(END)[1]}"


def renew():
    text = renewed(README.read_text(encoding="utf-8"), RESULTS.read_text(encoding="utf-8"))
    README.write_text(text, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="write nothing; exit 1 where it differs")
    options = parser.parse_args()
    before = README.read_text(encoding="utf-8")
    if not options.check:
        renew()
    elif renewed(before, RESULTS.read_text(encoding="utf-8")) != before:
        sys.exit("README.md: its numbers differ from docs/results.md; "
                 "run data/studies/write_readme.py")


if __name__ == "__main__":
    main()
