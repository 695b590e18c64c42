#!/usr/bin/env python3
"""Draws every kind of figure from made-up data and writes docs/gallery.md.

    docs/make_gallery.py build/release/apps/softscope [WORK_FOLDER]

The CT is a phantom: a body, a spine, an organ with a vein; the clip is softscope's own simulation.
A second call with the same work folder keeps the simulated clip and its run.
"""
import math
import shlex
import shutil
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
    numbers, vertices, faces = {}, [], []

    def vertex(j, i):
        place = (j, i % turns if 0 < j < rings else 0)  # one at each pole
        if place not in numbers:
            polar, turn = math.pi * place[0] / rings, 2 * math.pi * place[1] / turns
            unit = (math.sin(polar) * math.cos(turn), math.sin(polar) * math.sin(turn),
                    math.cos(polar))
            wave = bump_mm * math.sin(3 * turn) * math.sin(2 * polar)
            vertices.append("v " + " ".join(
                f"{c + u * (r + wave):.4f}" for c, u, r in zip(ORGAN_MM, unit, ORGAN_RADII_MM)))
            numbers[place] = len(vertices)
        return numbers[place]

    for j in range(rings):
        for i in range(turns):
            if part and not (8 < j < 30 and 50 < i < 92):
                continue
            corners = dict.fromkeys(
                [vertex(j, i), vertex(j + 1, i), vertex(j + 1, i + 1), vertex(j, i + 1)])
            faces.append("f " + " ".join(map(str, corners)))
    path.write_text("\n".join(["# SPACE=LPS", *vertices, *faces]) + "\n")


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
        ("The same in one column, with signed errors", "four_signed",
         on_ct + ["--errors", "signed"]),
        ("Slices at several positions", "slices",
         ["slice", ct, "--reference", organ, "--surface", model, "--plane", "axial", "--positions",
          "970:1030:20", "--width-mm", 183]),
        ("An oblique slice in neurological convention", "oblique",
         ["slice", ct, "--surface", organ, "--plane", "oblique", "--normal", "0.3,0.5,0.8",
          "--plane", "coronal", "--neurological"]),
        ("A run with its ground truth", "run",
         ["figure", first, "--reference", clip, "--width-mm", 183]),
        ("The same, visible points only", "run_observed",
         ["figure", first, "--reference", clip, "--observed", "--errors", "signed"]),
        ("A model at several frames", "frames",
         ["figure", first, "--kind", "frames", "--width-mm", 183]),
        ("Errors over time", "series",
         ["figure", first, "--kind", "series", "--reference", clip, "--observed", "--width-mm",
          183]),
        ("Two runs: with and without matches", "two_runs",
         ["figure", first, "--kind", "compare", "--other", second, "--name", "with matches",
          "--name", "without", "--reference", clip, "--width-mm", 183]),
        ("Matches between the model and a new image", "matches",
         ["figure", first, "--kind", "matches", "--reference", clip, "--frame", 16]),
        ("The viewer: errors, the scope and its path", "view",
         ["view", first, "--reference", clip, "--colour", "errors"]),
        ("The viewer: nodes of the warp and their motion", "view_nodes",
         ["view", first, "--nodes", "--arrows"]),
        ("The viewer: a model in front of its CT", "view_ct",
         ["view", first, "--ct", ct, "--ct-from-run", work / "ct_from_run.txt"]),
    ]


def surface_section(softscope, work):
    """A run's model as a surface, and the map that `compare` draws on it."""
    words = [["export", work / "run", "--frame", 20, "--out", work / "surface.ply"],
             ["compare", "--reference", work / "clip/groundtruth/mesh/000020.ply", "--test",
              work / "surface.ply", "--align", "icp", "--out", work / "comparison"]]
    return section(softscope, work, "A model as a surface: error map of the comparison", words,
                   [("surface", "comparison/error_map.png")])


def comparison_section(softscope, work):
    words = [["compare", "--reference", work / "organ.obj", "--test", work / "model.obj",
              "--errors", "signed", "--out", work / "pair"]]
    return section(softscope, work,
                   "Comparison of two surfaces: signed errors and their distribution",
                   words, [("pair", "pair/error_map.png"),
                           ("pair_histogram", "pair/error_histogram.png")])


def evaluation_section(softscope, work):
    words = [["evaluate", work / "run", "--reference", work / "clip", "--out", work / "error"]]
    return section(softscope, work,
                   "Evaluation of a run: errors over time, distribution, worst frames", words,
                   [("error_series", "error/error_series.png"),
                    ("error_histogram", "error/error_histogram.png"),
                    ("worst_frames", "error/worst_frames.png")])


def truthless_section(softscope, work):
    """Of a copy of the clip without its truth."""
    shutil.copytree(work / "clip", work / "real", dirs_exist_ok=True,
                    ignore=shutil.ignore_patterns("groundtruth"))
    words = [["evaluate", work / "run", "--reference", work / "real", "--out", work / "quality"]]
    return section(softscope, work, "Evaluation of a run without ground truth", words,
                   [("quality", "quality/quality_series.png")])


def depth_section(softscope, work):
    clip = work / "clip"
    words = [["depth", clip / "left/000000.png", clip / "right/000000.png", "--calibration",
              clip / "calibration.yaml", "--out", work / "depth"]]
    return section(softscope, work, "The depth of one pair", words,
                   [("depth", "depth/picture.png")])


def depth_error_section(softscope, work):
    words = [["evaluate", work / "depth/depth.pfm", "--reference",
              work / "clip/groundtruth/depth/000000.png", "--out", work / "depth_error"]]
    return section(softscope, work, "Evaluation of a depth map per pixel", words,
                   [("depth_error", "depth_error/error_map.png")])


def section(softscope, work, title, commands, pictures):
    """Runs commands that leave folders of files, and shows some of their pictures."""
    for command in commands:
        run(softscope, *command, "--force", "--quiet")
    lines = ["softscope " + " ".join(shown(word, work) for word in command) for command in commands]
    shows = []
    for name, file in pictures:
        (PICTURES / f"gallery_{name}.png").write_bytes((work / file).read_bytes())
        shows.append(f"![{title}: {Path(file).stem}](images/gallery_{name}.png)")
    return [f"## {title}", "```", *lines, "```", *shows, ""]


def shown(word, work):
    return shlex.quote(str(word).replace(str(work) + "/", ""))


def main():
    softscope = sys.argv[1]
    work = Path(sys.argv[2] if len(sys.argv) > 2 else "out/gallery").resolve()
    prepare(softscope, work)
    page = ["# Gallery", "Every kind of figure, from synthetic data, by `docs/make_gallery.py` "
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
    for made in (surface_section, comparison_section, evaluation_section, truthless_section,
                 depth_section, depth_error_section):
        page += made(softscope, work)
    page += ["## A report", "`softscope report error --out report.html` writes a page with a "
             "rotatable error map ([reports](report.md)).", "![A report](images/report.png)", ""]
    (DOCS / "gallery.md").write_text("\n".join(page))


if __name__ == "__main__":
    main()
