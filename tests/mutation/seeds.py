"""Sound inputs of every form, made by softscope and by a few lines here; all of them are small."""
import gzip
import json
import shutil
import struct
import zlib
from dataclasses import dataclass, field
from pathlib import Path

from network import plane_sweep

SIZE = (12, 10, 8)  # voxels
DRAWN_WEIGHT = 0.05  # a drawing in 3-D takes as long as fifty other runs
SPACING_MM = (2.0, 2.5, 3.0)
ORIGIN_MM = (-12.0, -10.0, -9.0)


@dataclass
class Form:
    """One form of input: which files are damaged, and the command lines that read them."""
    name: str
    folder: str  # within the seeds; it is copied for each run
    damage: list  # patterns of files within it
    commands: list  # words; the first command is drawn half of the time
    weight: float = 1.0
    shared: list = field(default_factory=list)  # other folders that a command needs, undamaged
    sound_code: int = 0  # exit code without damage
    listed: list = field(default_factory=list, repr=False)

    def files(self, home):
        """What is damaged, by its path within `home`; listed once."""
        if not self.listed:
            self.listed = sorted(file.relative_to(home) for pattern in self.damage
                                 for file in home.glob(pattern) if file.is_file())
        return self.listed


def voxels():
    count = SIZE[0] * SIZE[1] * SIZE[2]
    return struct.pack(f"<{count}h", *((i * 7) % 251 - 100 for i in range(count)))


def meta_image(data, compressed):
    packed = zlib.compress(data) if compressed else data
    extra = f"CompressedDataSize = {len(packed)}\n" if compressed else ""
    head = ("ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
            f"CompressedData = {compressed}\n{extra}TransformMatrix = 1 0 0 0 1 0 0 0 1\n"
            f"Offset = {ORIGIN_MM[0]} {ORIGIN_MM[1]} {ORIGIN_MM[2]}\n"
            f"ElementSpacing = {SPACING_MM[0]} {SPACING_MM[1]} {SPACING_MM[2]}\n"
            f"DimSize = {SIZE[0]} {SIZE[1]} {SIZE[2]}\nElementType = MET_SHORT\n"
            "ElementDataFile = LOCAL\n")
    return head.encode() + packed


def nrrd(data, encoding):
    packed = gzip.compress(data, mtime=0) if encoding == "gzip" else data
    x, y, z = SPACING_MM
    head = (f"NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\n"
            f"sizes: {SIZE[0]} {SIZE[1]} {SIZE[2]}\n"
            f"space directions: ({x},0,0) (0,{y},0) (0,0,{z})\nkinds: domain domain domain\n"
            f"endian: little\nencoding: {encoding}\n"
            f"space origin: ({ORIGIN_MM[0]},{ORIGIN_MM[1]},{ORIGIN_MM[2]})\n\n")
    return head.encode() + packed


def nifti(data):
    head = bytearray(348)
    struct.pack_into("<i", head, 0, 348)
    struct.pack_into("<8h", head, 40, 3, *SIZE, 1, 1, 1, 1)
    struct.pack_into("<hh", head, 70, 4, 16)
    struct.pack_into("<8f", head, 76, 1, *SPACING_MM, 0, 0, 0, 0)
    struct.pack_into("<f", head, 108, 352)
    struct.pack_into("<ff", head, 112, 1, 0)
    head[123] = 2
    struct.pack_into("<hh", head, 252, 0, 1)
    for row in range(3):
        line = [0.0, 0.0, 0.0, ORIGIN_MM[row]]
        line[row] = SPACING_MM[row]
        struct.pack_into("<4f", head, 280 + 16 * row, *line)
    head[344:348] = b"n+1\0"
    return bytes(head) + b"\0" * 4 + data


def element(group, number, kind, value):
    if isinstance(value, str):
        value = value.encode() + (b"\0" if kind == b"UI" else b" ") * (len(value) % 2)
    if kind in (b"OW", b"OB"):
        return struct.pack("<HH2sHI", group, number, kind, 0, len(value)) + value
    return struct.pack("<HH2sH", group, number, kind, len(value)) + value


def dicom_slice(index, pixels):
    """Explicit VR, little endian."""
    instance = f"1.2.826.0.1.3680043.2.1125.9.{index + 1}"
    series, study = "1.2.826.0.1.3680043.2.1125.7", "1.2.826.0.1.3680043.2.1125.8"
    short = lambda value: struct.pack("<H", value)
    meta = b"".join([element(2, 1, b"OB", b"\0\1"),
                     element(2, 2, b"UI", "1.2.840.10008.5.1.4.1.1.2"), element(2, 3, b"UI", instance),
                     element(2, 0x10, b"UI", "1.2.840.10008.1.2.1"),
                     element(2, 0x12, b"UI", "1.2.826.0.1.3680043.2.1125.1")])
    z = ORIGIN_MM[2] + index * SPACING_MM[2]
    body = b"".join([
        element(8, 5, b"CS", "ISO_IR 100"), element(8, 8, b"CS", "ORIGINAL\\PRIMARY\\AXIAL"),
        element(8, 0x16, b"UI", "1.2.840.10008.5.1.4.1.1.2"), element(8, 0x18, b"UI", instance),
        element(8, 0x60, b"CS", "CT"), element(8, 0x103e, b"LO", "made"),
        element(0x10, 0x10, b"PN", "Nobody"), element(0x18, 0x50, b"DS", str(SPACING_MM[2])),
        element(0x18, 0x5100, b"CS", "HFS"), element(0x20, 0xd, b"UI", study),
        element(0x20, 0xe, b"UI", series), element(0x20, 0x11, b"IS", "1"),
        element(0x20, 0x13, b"IS", str(index + 1)),
        element(0x20, 0x32, b"DS", f"{ORIGIN_MM[0]}\\{ORIGIN_MM[1]}\\{z}"),
        element(0x20, 0x37, b"DS", "1\\0\\0\\0\\1\\0"),
        element(0x20, 0x52, b"UI", "1.2.826.0.1.3680043.2.1125.6"),
        element(0x28, 2, b"US", short(1)), element(0x28, 4, b"CS", "MONOCHROME2"),
        element(0x28, 0x10, b"US", short(SIZE[1])), element(0x28, 0x11, b"US", short(SIZE[0])),
        element(0x28, 0x30, b"DS", f"{SPACING_MM[1]}\\{SPACING_MM[0]}"),
        element(0x28, 0x100, b"US", short(16)), element(0x28, 0x101, b"US", short(16)),
        element(0x28, 0x102, b"US", short(15)), element(0x28, 0x103, b"US", short(1)),
        element(0x28, 0x1052, b"DS", "0"), element(0x28, 0x1053, b"DS", "1"),
        element(0x7fe0, 0x10, b"OW", pixels)])
    length = element(2, 0, b"UL", struct.pack("<I", len(meta)))
    return b"\0" * 128 + b"DICM" + length + meta + body


def write_volumes(root):
    data = voxels()
    files = {"mha/v.mha": meta_image(data, False), "mhaz/v.mha": meta_image(data, True),
             "nrrd/v.nrrd": nrrd(data, "raw"), "nrrdz/v.nrrd": nrrd(data, "gzip"),
             "nii/v.nii": nifti(data), "niigz/v.nii.gz": gzip.compress(nifti(data), mtime=0)}
    slice_bytes = 2 * SIZE[0] * SIZE[1]
    for i in range(SIZE[2]):
        files[f"dicom/v/{i:02}.dcm"] = dicom_slice(i, data[i * slice_bytes:(i + 1) * slice_bytes])
    head = meta_image(data, False).split(b"LOCAL\n")[0]
    files["mhd/v.mhd"] = head + b"v.raw\n"
    files["mhd/v.raw"] = data
    for name, content in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_bytes(content)


SPHERE_RINGS = 6


def sphere():
    """Points [mm] and triangles."""
    import math
    points, faces = [], []
    for i in range(SPHERE_RINGS + 1):
        for j in range(2 * SPHERE_RINGS):
            a, b = math.pi * i / SPHERE_RINGS, math.pi * j / SPHERE_RINGS
            points.append((20 * math.sin(a) * math.cos(b), 20 * math.sin(a) * math.sin(b),
                           60 + 20 * math.cos(a)))
    ring = 2 * SPHERE_RINGS
    for i in range(SPHERE_RINGS):
        for j in range(ring):
            a, b = i * ring + j, i * ring + (j + 1) % ring
            faces += [(a, a + ring, b), (b, a + ring, b + ring)]
    return points, [f for f in faces if len(set(f)) == 3]


def write_meshes(root):
    points, faces = sphere()
    lines = lambda rows: "\n".join(" ".join(f"{v:g}" for v in row) for row in rows) + "\n"
    triangles = lines([(3, *f) for f in faces])
    texts = {
        "obj/m.obj": "".join("v %g %g %g\n" % p for p in points)
                     + "".join("f %d %d %d\n" % tuple(i + 1 for i in f) for f in faces),
        "ply/m.ply": f"ply\nformat ascii 1.0\ncomment made\nelement vertex {len(points)}\n"
                     "property float x\nproperty float y\nproperty float z\n"
                     f"element face {len(faces)}\nproperty list uchar int vertex_indices\n"
                     "end_header\n" + lines(points) + triangles,
        "vtk/m.vtk": "# vtk DataFile Version 4.2\nmade\nASCII\nDATASET POLYDATA\n"
                     f"POINTS {len(points)} float\n{lines(points)}"
                     f"POLYGONS {len(faces)} {4 * len(faces)}\n{triangles}",
        "vtp/m.vtp": '<?xml version="1.0"?>\n<VTKFile type="PolyData" version="0.1" '
                     'byte_order="LittleEndian">\n<PolyData><Piece '
                     f'NumberOfPoints="{len(points)}" NumberOfVerts="0" NumberOfLines="0" '
                     f'NumberOfStrips="0" NumberOfPolys="{len(faces)}">\n<Points><DataArray '
                     'type="Float32" NumberOfComponents="3" format="ascii">\n' + lines(points)
                     + '</DataArray></Points>\n<Polys><DataArray type="Int64" Name="connectivity" '
                     'format="ascii">\n' + lines(faces) + '</DataArray><DataArray type="Int64" '
                     'Name="offsets" format="ascii">\n'
                     + " ".join(str(3 * (i + 1)) for i in range(len(faces)))
                     + "\n</DataArray></Polys>\n</Piece></PolyData></VTKFile>\n",
    }
    for name, text in texts.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)
    (root / "stl").mkdir(exist_ok=True)
    stl = b"made".ljust(80) + struct.pack("<I", len(faces))
    for face in faces:
        stl += struct.pack("<3f", 0, 0, 0)
        stl += b"".join(struct.pack("<3f", *points[i]) for i in face) + b"\0\0"
    (root / "stl/m.stl").write_bytes(stl)
    plyb = ((f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\n"
             f"property float y\nproperty float z\nelement face {len(faces)}\n"
             "property list uchar int vertex_indices\nend_header\n").encode()
            + b"".join(struct.pack("<3f", *p) for p in points)
            + b"".join(struct.pack("<B3i", 3, *f) for f in faces))
    (root / "plyb").mkdir(exist_ok=True)
    (root / "plyb/m.ply").write_bytes(plyb)
    (root / "good").mkdir(exist_ok=True)
    (root / "good/m.stl").write_bytes(stl)


def write_calibrations(root, clip):
    k = [[84, 0, 47.5], [0, 84, 39.5], [0, 0, 1]]
    identity = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    flat = {"image_width": 96, "image_height": 80, "unit": "mm", "rectified": 1, "M1": k,
            "D1": [0] * 5, "M2": k, "D2": [0] * 5, "R": identity, "T": [-5.2, 0, 0]}
    (root / "json").mkdir()
    (root / "json/c.json").write_text(json.dumps(flat, indent=2))
    (root / "yaml").mkdir()
    shutil.copy(clip / "calibration.yaml", root / "yaml/c.yaml")
    for name in ("json", "yaml"):
        shutil.copy(clip / "left/000000.png", root / name / "l.png")
        shutil.copy(clip / "right/000000.png", root / name / "r.png")


def write_texts(root, clip):
    (root / "toml").mkdir()
    (root / "toml/s.toml").write_text("# settings\n[stereo]\ndisparity_max_px = 63\nmethod = \"elas\"\n"
                                      "[sequence]\nright_first = true\n")
    (root / "study").mkdir()
    (root / "study/study.toml").write_text(
        'title = "a study"\n[simulate]\nframes = 2\nscope.width_px = 96\nscope.height_px = 80\n'
        '[reconstruct]\nstereo.disparity_max_px = 63\n[[case]]\nname = "a"\n'
        '[[case]]\nname = "b"\nsimulate.seed = 3\n[[sweep]]\nname = "noise"\n'
        'label = "noise"\nlevels = [1, 2]\nsimulate.sensor.noise = [0.01, 0.02]\n')
    (root / "marks").mkdir()
    (root / "marks/p.csv").write_text("test_x_mm,test_y_mm,test_z_mm,reference_x_mm,reference_y_mm,"
                                      "reference_z_mm\n20,0,60,20,0,60\n0,20,60,0,20,60\n"
                                      "0,0,80,0,0,80\n-20,0,60,-20,0,60\n")
    (root / "pixels").mkdir()
    (root / "pixels/track.csv").write_text("id,u_px,v_px\n0,40,40\n1,50,30\n2,60,50\n")


RECONSTRUCT = ["reconstruct", "clip", "--save-every", "1", "--set", "stereo.disparity_max_px=63", "--out",
               "out", "--quiet"]


def make_seeds(root, server):
    """Fills `root` and returns the forms. Raises RuntimeError where softscope can't make them."""
    def softscope(*words):
        outcome = server.run(words, root, seconds=120)
        if outcome.code != 0:
            raise RuntimeError(f"softscope {' '.join(words)} ended with {outcome.code}: {outcome.err}")
    small = ["--size", "96x80", "--set", "organ.cells_per_side=16", "--quiet"]
    softscope("simulate", "--out", "clip", "--frames", "3", *small)
    softscope("reconstruct", "clip", "--out", "run", "--save-every", "1", "--track",
              "clip/track_points.csv", "--quiet")
    softscope("evaluate", "run", "--reference", "clip", "--out", "ev", "--quiet")
    (root / "case").mkdir()
    for part in ("clip", "run", "ev"):
        shutil.copytree(root / part, root / "case" / part)
    softscope("depth", "clip", "--frames", "0:1", "--out", "maps", "--quiet")
    write_volumes(root)
    write_meshes(root)
    write_calibrations(root, root / "clip")
    write_texts(root, root / "clip")
    pictures = root / "picture"
    pictures.mkdir()
    for view in ("left", "right"):
        shutil.copy(root / "clip" / view / "000000.png", pictures / f"{view}.png")
    (root / "network").mkdir()
    (root / "network/n.onnx").write_bytes(plane_sweep())
    make_study_record(root)
    make_stopped_run(root, server)
    return forms(video=make_video(root, softscope))


def make_study_record(root):
    """A case that was run, as `study --table` finds it."""
    case = root / "studied/out/cases/a"
    case.mkdir(parents=True)
    (case.parent / ".softscope_study").write_text("A folder of softscope study.\n")
    run, evaluation = (json.loads((root / file).read_text())
                       for file in ("run/run.json", "ev/evaluation.json"))
    record = {"schema_version": 1, "softscope": run["softscope"], "name": "a", "case": "a",
              "variant": "", "sweep": "", "level": None, "status": "done", "reason": "", "notes": "",
              "digest": "0" * 64, "run": run, "evaluation": evaluation}
    (case / "case.json").write_text(json.dumps(record, indent=2))
    shutil.copytree(root / "clip", root / "studied/clip")
    (root / "studied/study.toml").write_text('title = "one"\n[[case]]\nname = "a"\nsequence = "clip"\n')


def make_stopped_run(root, server):
    """A run that was killed behind its first checkpoint."""
    (root / "stopped").mkdir()
    shutil.copytree(root / "clip", root / "stopped/clip")
    words = [*RECONSTRUCT, "--checkpoint-every", "1", "--threads", "1"]
    events = server.run(words, root / "stopped", seconds=120).events
    shutil.rmtree(root / "stopped/out")
    server.run(words, root / "stopped", seconds=120, fault="kill", event=2 * events // 3)
    for file in [root / "stopped/out.txt", root / "stopped/err.txt",
                 *(root / "stopped/out").rglob(".*.part")]:
        file.unlink()


def make_video(root, softscope):
    """Whether this machine can draw one."""
    (root / "video").mkdir()
    calibration = (root / "clip/calibration.yaml").read_text()
    for small, large in (("image_width: 96", "image_width: 320"), ("84", "280"), ("47.5", "159.5"),
                         ("image_height: 80", "image_height: 240"), ("39.5", "119.5")):
        calibration = calibration.replace(small, large)
    (root / "video/calibration.yaml").write_text(calibration)
    try:
        for view, turn in ("left", "30"), ("right", "60"):
            softscope("view", "run", "--movie", f"video/{view}.mp4", "--size", "320x240", "--seconds",
                      "0.2", "--turn", turn, "--quiet")
    except RuntimeError:
        return False
    return True


def volume_form(folder, file, damage):
    return Form(folder, folder, damage, [
        ["info", file, "--json", "--quiet"], ["slice", file, "--out", "o.svg", "--quiet"],
        ["figure", "--ct", file, "--out", "o.svg", "--quiet"]], weight=2)


def mesh_form(folder, file):
    info = [] if folder in ("vtk", "vtp") else [["info", file, "--json", "--quiet"]]
    return Form(folder, folder, [file], [
        *info,
        ["compare", "--reference", "good/m.stl", "--test", file, "--json", "--quiet"],
        ["compare", "--reference", file, "--test", "good/m.stl", "--json", "--quiet"],
        ["export", file, "--out", "o.obj", "--quiet"], ["export", file, "--out", "o.glb", "--quiet"],
        ["slice", "--surface", file, "--out", "o.svg", "--quiet"]], shared=["good"])


def forms(video):
    depth = ["--set", "stereo.disparity_max_px=63", "--out", "o", "--quiet"]
    run_files = ["run/*.*", "run/models/*", "run/nodes/*"]
    evaluation_files = ["ev/*.json", "ev/*.csv", "ev/errors/*", "ev/*.pvd"]
    all_forms = [
        volume_form("mha", "v.mha", ["v.mha"]), volume_form("mhaz", "v.mha", ["v.mha"]),
        volume_form("mhd", "v.mhd", ["v.mhd", "v.raw"]), volume_form("nrrd", "v.nrrd", ["v.nrrd"]),
        volume_form("nrrdz", "v.nrrd", ["v.nrrd"]), volume_form("nii", "v.nii", ["v.nii"]),
        volume_form("niigz", "v.nii.gz", ["v.nii.gz"]), volume_form("dicom", "v", ["v/*.dcm"]),
        *(mesh_form(name, file) for name, file in [
            ("obj", "m.obj"), ("ply", "m.ply"), ("plyb", "m.ply"), ("stl", "m.stl"),
            ("vtk", "m.vtk"), ("vtp", "m.vtp")]),
        *(Form(name, name, [f"c.{name}"], [
            ["info", f"c.{name}", "--json", "--quiet"],
            ["depth", "l.png", "r.png", "--calibration", f"c.{name}", *depth]], weight=2)
          for name in ("json", "yaml")),
        Form("picture", "picture", ["*.png"], [
            ["info", "left.png", "--json", "--quiet"],
            ["depth", "left.png", "right.png", "--calibration", "clip/calibration.yaml", *depth]],
            weight=2, shared=["clip"]),
        Form("maps", "maps", ["*.pfm", "*depth.png"], [
            ["info", "000000_depth.pfm", "--json", "--quiet"],
            ["info", "000000_disparity.pfm", "--json", "--quiet"],
            ["info", "000000_depth.png", "--json", "--quiet"]]),
        Form("settings", "toml", ["s.toml"], [
            ["info", "s.toml", "--json", "--quiet"],
            ["depth", "clip", "--frames", "0:1", "--config", "s.toml", "--out", "o", "--quiet"]],
            shared=["clip"]),
        Form("study", "study", ["study.toml"], [["study", "study.toml", "--list", "--quiet"]]),
        Form("sequence", "case", ["clip/*.*", "clip/left/*", "clip/right/*"], [
            ["info", "clip", "--check", "--json", "--quiet"], ["depth", "clip", *depth],
            ["reconstruct", "clip", "--track", "clip/track_points.csv", *depth],
            ["figure", "run", "--reference", "clip", "--kind", "matches", "--out", "o.svg",
             "--quiet"]], weight=0.7),
        Form("truth", "case", ["clip/groundtruth/*.*", "clip/groundtruth/*/*"], [
            ["evaluate", "run", "--reference", "clip", "--json", "--quiet"]], weight=0.7),
        Form("run", "case", run_files, [
            ["evaluate", "run", "--reference", "clip", "--json", "--quiet"],
            ["export", "run", "--out", "o.obj", "--quiet"],
            ["figure", "run", "--kind", "frames", "--out", "o.svg", "--quiet"]], weight=0.7),
        Form("run drawn", "case", run_files, [
            ["view", "run", "--screenshot", "o.png", "--size", "320x240", "--quiet"],
            ["figure", "run", "--reference", "clip", "--out", "o.svg", "--quiet"]],
            weight=DRAWN_WEIGHT),
        Form("stopped run", "stopped", ["out/*.*", "out/models/*"], [
            [*RECONSTRUCT, "--checkpoint-every", "1", "--resume"]], weight=0.3),
        Form("study record", "studied", ["out/cases/a/case.json", "study.toml"], [
            ["study", "study.toml", "--out", "out", "--table", "--quiet"]],
            sound_code=1),  # its digest is another's: the case is outdated
        Form("evaluation", "case", evaluation_files, [
            ["report", "ev", "--out", "o.html", "--quiet"]], weight=0.5),
        Form("evaluation drawn", "case", evaluation_files, [
            ["view", "run", "--evaluation", "ev", "--screenshot", "o.png", "--size", "320x240",
             "--quiet"]], weight=DRAWN_WEIGHT),
        Form("landmarks", "marks", ["p.csv"], [
            ["compare", "--reference", "good/m.stl", "--test", "good/m.stl", "--landmarks", "p.csv",
             "--json", "--quiet"]], shared=["good"]),
        Form("pixels", "pixels", ["track.csv"], [
            ["reconstruct", "clip", "--frames", "0:1", "--track", "track.csv", *depth]],
            weight=0.3, shared=["clip"]),
        Form("network", "network", ["n.onnx"], [
            ["depth", "clip", "--frames", "0:1", "--set", "stereo.method=onnx", "--set",
             "stereo.model=n.onnx", *depth]], weight=0.5, shared=["clip"]),
    ]
    if video:
        all_forms.append(Form("video", "video", ["left.mp4"], [
            ["info", "left.mp4", "--json", "--quiet"],
            ["info", ".", "--check", "--json", "--quiet"]]))
    return all_forms
