#!/usr/bin/env python3
"""Writes docs/results.md, its pictures and README's numbers from what studies left; nothing in them
is typed by hand.

usage: data/studies/write_results.py --softscope build/release/apps/softscope DIR...
Each DIR is the folder of a finished study; sections of studies that are not named stay. --softscope names the program that ran them, more than
once where several did; the commit that is written is that of the checkout it lies in. Refuses a
checkout that differs from its commit, and cases that none of these programs ran."""
import argparse
import hashlib
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import write_readme

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/results.md"
PICTURES = ROOT / "docs/images/results"

HEAD = """# Results
Every number on this page was measured by `softscope study` ([studies](studies.md)) and written by `data/studies/write_results.py` from the studies' `study.json`; nothing is typed by hand. What each column means: [evaluation](evaluation.md). Research use only, not for diagnosis.
"""


def git(folder, *words):
    return subprocess.run(["git", "-C", str(folder), *words], check=True, text=True,
                          stdout=subprocess.PIPE).stdout.strip()


def commit_of(program):
    """Of the checkout that a program was built in."""
    folder = program.resolve().parent
    changed = [line for line in git(folder, "status", "--porcelain",
                                    "--untracked-files=no").splitlines() if "docs/" not in line]
    if changed:
        fail(f"the checkout of {program} differs from its commit: {changed[0]}")
    return git(folder, "rev-parse", "--short", "HEAD")


def fail(text):
    sys.exit(f"write_results.py: {text}")


def read_study(folder):
    file = folder / "study.json"
    if not file.is_file():
        fail(f"{file} is missing; run the study first")
    study = json.loads(file.read_text(encoding="utf-8"))
    study["folder"] = folder
    return study


def commits_of(study, builds):
    """"5faef8c", or "5faef8c (occlusion-2, occlusion-4: 1234567)" where several builds ran it."""
    cases = {}
    for case in study["cases"]:
        if case["status"] == "not run":
            fail(f"{study['folder']}: case {case['name']} has not been run")
        if "executable_sha256" not in case:
            continue
        if case["executable_sha256"] not in builds:
            fail(f"{study['folder']}: case {case['name']} was run by another build; name it by "
                 "--softscope, or run the study again with --force")
        cases.setdefault(builds[case["executable_sha256"]], []).append(case["name"])
    commits = sorted(cases, key=lambda commit: -len(cases[commit]))
    others = "; ".join(f"{', '.join(cases[c])}: {c}" for c in commits[1:])
    return commits[0] + (f" ({others})" if others else "")


def cell(text):
    return text.replace("|", "\\|")


def table_of(study):
    table = study["table"]
    lines = ["| " + " | ".join(map(cell, table["headings"])) + " |",
             "|" + "---|" * len(table["headings"])]
    lines += ["| " + " | ".join(map(cell, row)) + " |" for row in table["rows"]]
    return "\n".join(lines)


def copy_pictures(study, name):
    """The plots of the first metric, and how the page shows them."""
    shown = []
    PICTURES.mkdir(parents=True, exist_ok=True)
    for old in PICTURES.glob(f"{name}_*"):
        old.unlink()
    for plot in sorted((study["folder"] / "plots").glob("*.svg")):
        if study["sweeps"] and not plot.stem.endswith("_points"):
            continue
        target = PICTURES / f"{name}_{plot.name}"
        shutil.copyfile(plot, target)
        shown.append(f"![{plot.stem.replace('_', ', ')}](images/results/{target.name})")
    return " ".join(shown)


def seconds_of(study):
    return sum(sum(case.get("seconds", {}).values()) for case in study["cases"])


def section(study, commit):
    name = re.sub(r"\W+", "_", Path(study["command"].split()[2]).stem)
    parts = [f"## {study['title']}", study["about"], table_of(study)]
    notes = study["table"]["notes"]
    if notes:
        parts.append("\n".join(f"- {cell(note)}" for note in notes))
    pictures = copy_pictures(study, name)
    if pictures:
        parts.append(pictures)
    machine = study["machine"]
    parts.append(f"`{study['command']}`, softscope {study['softscope']} ({study['compiler']}) at "
                 f"commit {commit}, {machine['processor']}, {machine['cores']} cores; "
                 f"{seconds_of(study):.0f} s of all cases together.")
    return "\n\n".join(part for part in parts if part)


def with_section(page, section):
    """`page` with this section in the place of the one of its title, or at the end."""
    head, *sections = page.rstrip("\n").split("\n\n## ")
    section = section.removeprefix("## ")
    titles = [old.splitlines()[0] for old in sections]
    title = section.splitlines()[0]
    if title in titles:
        sections[titles.index(title)] = section
    else:
        sections.append(section)
    return "\n\n## ".join([head, *sections]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--softscope", required=True, type=Path, action="append",
                        help="the program that ran them; repeatable")
    parser.add_argument("folders", nargs="+", type=Path, metavar="DIR")
    options = parser.parse_args()
    builds = {hashlib.sha256(program.read_bytes()).hexdigest(): commit_of(program)
              for program in options.softscope}
    studies = [read_study(folder) for folder in options.folders]
    commits = [commits_of(study, builds) for study in studies]
    page = PAGE.read_text(encoding="utf-8") if PAGE.exists() else HEAD
    for study, commit in zip(studies, commits):
        page = with_section(page, section(study, commit))
    PAGE.write_text(page, encoding="utf-8")
    write_readme.renew()
    print(f"wrote {PAGE.relative_to(ROOT)}, {len(list(PICTURES.iterdir()))} pictures beside it, "
          "README.md")


if __name__ == "__main__":
    main()
