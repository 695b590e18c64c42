#!/usr/bin/env python3
"""Draws every kind of figure from made-up data and writes docs/gallery.md.

    docs/make_gallery.py build/release/apps/softscope [WORK_FOLDER]

The CT is a phantom: a body, a spine, an organ with a vein; the clip is softscope's own simulation.
A second call with the same work folder keeps the simulated clip and its run.
"""
import math
import shlex
import struct
import subprocess
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parent
PICTURES = DOCS / "images"
SIZE, SPACING_MM = (110, 90, 70), 3.0
ORIGIN_MM = (-165.0, -135.0, 900.0)  # LPS
ORGAN_MM, ORGAN_RADII_MM = (-55.0, -15.0, 1005.0), (62.0, 55.0, 48.0)


def in_ellipsoid(p, centre, radii):
    return sum(((a - c) / r) ** 2 for a, c, r in zip(p, centre, radii)) < 1


def hounsfield(p):
    """Of the phantom at a point in LPS."""
    if not in_ellipsoid((p[0], p[1], 0), (0, 0, 0), (155, 115, 1)):
        return -1000
    if not in_ellipsoid((p[0], p[1], 0), (0, 0, 0), (140, 100, 1)):
        return -100  # fat
    if in_ellipsoid((p[0], p[1], 0), (0, 70, 0), (20, 18, 1)):
        return 350  # spine
    if in_ellipsoid(p, (-40, -20, 1010), (30, 8, 9)):
        return 160  # vein
    if in_ellipsoid(p, ORGAN_MM, ORGAN_RADII_MM):
        return 105
    return 40 if in_ellipsoid(p, (70, -10, 1000), (45, 45, 70)) else 10


def write_phantom(path):
    voxels = []
    for k in range(SIZE[2]):
        for j in range(SIZE[1]):
            for i in range(SIZE[0]):
                p = [o + SPACING_MM * n for o, n in zip(ORIGIN_MM, (i, j, k))]
                voxels.append(hounsfield(p))
    header = ("ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
              f"Offset = {' '.join(map(str, ORIGIN_MM))}\nElementSpacing = {SPACING_MM} "
              f"{SPACING_MM} {SPACING_MM}\nDimSize = {' '.join(map(str, SIZE))}\n"
              "ElementType = MET_SHORT\nElementDataFile = LOCAL\n")
    path.write_bytes(header.encode() + struct.pack(f"<{len(voxels)}h", *voxels))


def write_organ(path, bump_mm, part=False):
    """The organ's surface, with waves of `bump_mm`; a part of it as a scope might have seen it."""
    turns, rings = 96, 48
    lines = ["# SPACE=LPS"]
    for j in range(rings + 1):
        for i in range(turns):
            polar, turn = math.pi * j / rings, 2 * math.pi * i / turns
            unit = (math.sin(polar) * math.cos(turn), math.sin(polar) * math.sin(turn),
                    math.cos(polar))
            wave = bump_mm * math.sin(3 * turn) * math.sin(2 * polar)
            lines.append("v " + " ".join(
                f"{c + u * (r + wave):.4f}" for c, u, r in zip(ORGAN_MM, unit, ORGAN_RADII_MM)))
    for j in range(rings):
        for i in range(turns):
            a, b = j * turns + i, j * turns + (i + 1) % turns
            if part and not (8 < j < 30 and 50 < i < 92):
                continue
            lines.append(f"f {a + 1} {a + turns + 1} {b + turns + 1} {b + 1}")
    path.write_text("\n".join(lines) + "\n")


def run(softscope, *words):
    subprocess.run([softscope, *map(str, words)], check=True, stdout=subprocess.DEVNULL)


def prepare(softscope, work):
    work.mkdir(parents=True, exist_ok=True)
    write_phantom(work / "ct.mha")
    write_organ(work / "organ.obj", 0)
    write_organ(work / "model.obj", 1.5, part=True)
    # The scope looks at the organ from the patient's front.
    (work / "ct_from_run.txt").write_text("1 0 0 -55\n0 0 1 -125\n0 -1 0 1005\n0 0 0 1\n")
    if not (work / "run" / "run.json").exists():
        run(softscope, "simulate", "--out", work / "clip", "--frames", 21, "--size", "320x240",
            "--force", "--quiet")
        for name, more in (("run", []), ("no_matches", ["--no-correspondence"])):
            run(softscope, "reconstruct", work / "clip", "--out", work / name, "--save-every", 5,
                "--force", "--quiet", *more)


def figures(work):
    """Title, picture, words of the command."""
    ct, organ, model = work / "ct.mha", work / "organ.obj", work / "model.obj"
    clip, first, second = work / "clip", work / "run", work / "no_matches"
    on_ct = ["figure", "--ct", ct, "--reference", organ, "--test", model]
    return [
        ("CT, reference and model, with the error map", "four", on_ct + ["--width-mm", 183]),
        ("The same in one column, signed", "four_signed", on_ct + ["--errors", "signed"]),
        ("Slices at several places", "slices",
         ["slice", ct, "--reference", organ, "--surface", model, "--plane", "axial", "--positions",
          "970:1030:20", "--width-mm", 183]),
        ("An oblique slice, neurological", "oblique",
         ["slice", ct, "--surface", organ, "--plane", "oblique", "--normal", "0.3,0.5,0.8",
          "--plane", "coronal", "--neurological"]),
        ("A run beside its truth", "run",
         ["figure", first, "--reference", clip, "--width-mm", 183]),
        ("The same, points that the scope sees now", "run_observed",
         ["figure", first, "--reference", clip, "--observed", "--errors", "signed"]),
        ("A model at frames", "frames",
         ["figure", first, "--kind", "frames", "--width-mm", 183]),
        ("Errors over time", "series",
         ["figure", first, "--kind", "series", "--reference", clip, "--observed", "--width-mm",
          183]),
        ("Two runs: with and without matches", "two_runs",
         ["figure", first, "--kind", "compare", "--other", second, "--name", "with matches",
          "--name", "without", "--reference", clip, "--width-mm", 183]),
        ("Matches of the model in a new picture", "matches",
         ["figure", first, "--kind", "matches", "--reference", clip, "--frame", 16]),
        ("The viewer: errors, the scope and its path", "view",
         ["view", first, "--reference", clip, "--colour", "errors"]),
        ("The viewer: nodes of the warp and how they moved", "view_nodes",
         ["view", first, "--nodes", "--arrows"]),
        ("The viewer: a model before its CT", "view_ct",
         ["view", first, "--ct", ct, "--ct-from-run", work / "ct_from_run.txt"]),
    ]


def surface_section(softscope, work):
    """A run's model as a surface, and the map that `compare` draws on it."""
    words = [["export", work / "run", "--frame", 20, "--out", work / "surface.ply"],
             ["compare", "--reference", work / "clip/groundtruth/mesh/000020.ply", "--test",
              work / "surface.ply", "--align", "icp", "--out", work / "comparison"]]
    for command in words:
        run(softscope, *command, "--force")
    picture = work / "comparison/error_map.png"
    (PICTURES / "gallery_surface.png").write_bytes(picture.read_bytes())
    lines = ["softscope " + " ".join(shown(word, work) for word in command) for command in words]
    return ["## A model as a surface, compared", "```", *lines, "```",
            "![A model as a surface, compared](images/gallery_surface.png)", ""]


def shown(word, work):
    return shlex.quote(str(word).replace(str(work) + "/", ""))


def main():
    softscope = sys.argv[1]
    work = Path(sys.argv[2] if len(sys.argv) > 2 else "out/gallery").resolve()
    prepare(softscope, work)
    page = ["# Gallery", "Every kind of figure, from made-up data, by `docs/make_gallery.py` "
            "([how to draw them](figures.md)). The CT is a phantom of ellipsoids; the clip is "
            "softscope's own simulation. Research use only.", ""]
    for title, name, words in figures(work):
        picture = PICTURES / f"gallery_{name}.png"
        drawn = ["--screenshot"] if words[0] == "view" else ["--dpi", 130, "--out"]
        run(softscope, *words, *drawn, work / f"{name}.png", "--force")
        picture.write_bytes((work / f"{name}.png").read_bytes())
        command = " ".join(shown(word, work) for word in words)
        page += [f"## {title}", "```", f"softscope {command} {drawn[-1]} {name}.png", "```",
                 f"![{title}](images/gallery_{name}.png)", ""]
    page += surface_section(softscope, work)
    (DOCS / "gallery.md").write_text("\n".join(page))


if __name__ == "__main__":
    main()
