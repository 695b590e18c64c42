"""What an outcome must not be, and whether a geometry that was told stands in the input."""
import gzip
import json
import math
import os
import re
import struct
from pathlib import Path

MOST_MS = 20_000  # of processor time
MOST_KB = 4 << 20
KNOWN_CODES = {0, 1, 2, 3, 4, 130}
OUR_LINES = ("error: ", "warning: ")
LARGEST = 1e9  # mm, px or degrees: beyond any instrument
NOT_FINITE = re.compile(r"(?<![\w.])[-+]?(?:nan|inf(?:inity)?)(?![\w.])", re.IGNORECASE)
TEXTS = {".obj", ".svg", ".txt", ".yaml"}
NUMBER = re.compile(rb"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def close(a, b):
    return math.isclose(a, b, rel_tol=1e-4, abs_tol=1e-6)


def numbers_of(part, path=""):
    """Each number of a JSON document with its path; None is a number that isn't known."""
    if isinstance(part, dict):
        for key, value in part.items():
            yield from numbers_of(value, f"{path}.{key}")
    elif isinstance(part, list):
        for value in part:
            yield from numbers_of(value, path)
    elif part is None or (isinstance(part, (int, float)) and not isinstance(part, bool)):
        yield path, part


def reject(word):
    raise ValueError(f"holds {word}")


def judge_json(text, is_info):
    """`info` tells what a file holds: there a number that isn't known is one that isn't finite."""
    try:
        record = json.loads(text, parse_constant=reject)
    except ValueError as error:
        return [f"stdout is no JSON: {error}"], None
    found = []
    for path, value in numbers_of(record):
        if value is None and is_info:
            found.append(f"number that is not finite: {path}")
        lengths = path.rsplit("_", 1)[-1] in ("mm", "px", "deg")
        if value is not None and lengths and abs(value) > LARGEST:
            found.append(f"absurd number: {path} is {value:g}")
    return found, record


# --- the geometry that the input states, read without softscope ---------------------------------


def header_value(data, key):
    """The last line `key = value` of a MetaImage header."""
    lines = data.split(b"ElementDataFile")[0].split(b"\n")
    for line in reversed(lines):
        name, equals, value = line.partition(b"=")
        if equals and name.strip().lower() == key.lower():
            return [float(n) for n in NUMBER.findall(value)]
    return None


def meta_spacing(data):
    return header_value(data, b"ElementSpacing") or header_value(data, b"ElementSize")


def nrrd_spacing(data):
    head = re.split(rb"\r?\n\r?\n", data)[0].lower()  # names of fields may be in capitals
    scale = [{b"m": 1000.0, b"cm": 10.0, b"um": 0.001}.get(unit, 1.0)
             for unit in re.findall(rb'"(\w*)"', head.partition(b"space units:")[2].split(b"\n")[0])]
    for line in head.split(b"\n"):
        if line.startswith(b"space directions:"):
            groups = [[float(n) for n in NUMBER.findall(g)] for g in re.findall(rb"\(([^)]*)\)", line)]
            return [math.hypot(*g) * (scale[i] if i < len(scale) else 1)
                    for i, g in enumerate(groups)]
        if line.startswith(b"spacings:"):
            return [float(n) for n in NUMBER.findall(line)]
    return None


def nifti_spacing(data):
    """All that the header can mean: in either byte order, columns of the sform and pixdim, in the
    units that its field names."""
    if len(data) < 352:
        return None
    lists = []
    for order in "<>":
        rows = [struct.unpack_from(order + "4f", data, 280 + 16 * i) for i in range(3)]
        columns = [math.sqrt(sum(rows[i][j] ** 2 for i in range(3))) for j in range(3)]
        for scale in (1, 1000, 0.001):
            lists.append([c * scale for c in columns])
            lists.append([abs(p) * scale for p in struct.unpack_from(order + "3f", data, 80)])
    return lists


def dicom_spacing(folder):
    """All values of PixelSpacing in the series."""
    lists = []
    for file in sorted(folder.glob("*.dcm")):
        data = file.read_bytes()
        for tag in re.finditer(rb"\x28\x00\x30\x00DS", data):
            length = struct.unpack_from("<H", data, tag.end())[0] if tag.end() + 2 <= len(data) else 0
            value = data[tag.end() + 2:tag.end() + 2 + length]
            lists.append([float(n) for n in NUMBER.findall(value)][::-1])
    return lists


def stated_spacings(path):
    """Every spacing [mm] that the file can be taken to state; None where it has none."""
    if path.is_dir():
        return dicom_spacing(path)
    data = path.read_bytes()
    if path.name.endswith(".gz"):
        try:
            data = gzip.decompress(data)
        except (OSError, EOFError, ValueError, Exception):  # noqa: zlib.error has no common base
            return None
    reader = {".mha": meta_spacing, ".mhd": meta_spacing, ".nrrd": nrrd_spacing,
              ".nii": nifti_spacing, ".gz": nifti_spacing}[path.suffix]
    found = reader(data)
    if found and not isinstance(found[0], list):
        found = [found]
    return found


def judge_volume(record, path):
    told = record.get("spacing_mm")
    if told is None:
        return []
    axes = 2 if path.is_dir() else 3  # the third of a DICOM series comes from its positions
    for stated in stated_spacings(path) or []:
        if len(stated) >= axes and all(close(told[i], stated[i]) for i in range(axes)):
            return []
    return [f"invented geometry: spacing {told} mm"]


def judge_camera(record, path):
    """Each focal length and centre is a number of the file."""
    stated = [float(n) for n in NUMBER.findall(path.read_bytes())]
    return [f"invented geometry: {side}.{key} is {record[side][key]}"
            for side in ("left", "right") for key in ("fx_px", "fy_px", "cx_px", "cy_px")
            if side in record and not any(close(record[side][key], n) for n in stated)]


def judge_geometry(words, record, folder):
    path = Path(folder, words[1])
    if record.get("kind") == "volume" or "spacing_mm" in record:
        return judge_volume(record, path)
    if record.get("kind") == "calibration":
        return judge_camera(record, path)
    return []


# --- the outcome --------------------------------------------------------------------------------


def files_below(folder):
    for entry in os.scandir(folder):
        if entry.is_dir(follow_symlinks=False):
            yield from files_below(entry.path)
        else:
            yield entry


def judge_files(folder, words, code):
    """What is left beside the inputs: nothing half-written, and nothing at all of a drawing that
    failed."""
    found = [f"left behind: {os.path.relpath(file.path, folder)}" for file in files_below(folder)
             if file.name.startswith(".") and ".part" in file.name]
    results = [entry for entry in os.scandir(folder) if entry.name.startswith("o")]
    if code != 0:
        return found + [f"left behind: {one.name}" for one in results if one.name.startswith("o.")]
    for result in results:
        for one in files_below(result.path) if result.is_dir() else [result]:
            if os.path.splitext(one.name)[1] in TEXTS and NOT_FINITE.search(text_of(one.path)):
                found.append(f"number that is not finite: {one.name}")
    return found


def text_of(path):
    """Without images, whose base64 can spell anything."""
    with open(path, "rb") as file:
        return re.sub(r"base64,[\w+/=]*", "", file.read().decode("utf-8", "replace"))


def judge(outcome, words, folder, most_ms=MOST_MS):
    """A line for each thing that must not be."""
    found = []
    if outcome.code < 0:
        hung = -outcome.code in (14, 24)  # SIGALRM, SIGXCPU
        found.append("hang" if hung else f"crash: signal {-outcome.code}")
    elif outcome.code == 70:
        found.append("exit 70")
    elif outcome.code not in KNOWN_CODES:
        found.append(f"crash: exit {outcome.code}")
    if outcome.cpu_ms > most_ms and "hang" not in found:
        found.append("hang")
    if outcome.memory_kb > MOST_KB:
        found.append(f"memory: {outcome.memory_kb >> 10} MB")
    lines = outcome.err.splitlines()
    found += [f"foreign line: {line[:80]!r}" for line in lines if not line.startswith(OUR_LINES)]
    errors = sum(line.startswith("error: ") for line in lines)
    if outcome.code in (2, 3) and errors == 0 and '"problems"' not in outcome.out:
        found.append("no error line")
    if outcome.code == 0 and "--json" in words:
        wrong, record = judge_json(outcome.out, words[0] == "info")
        found += wrong
        if record is not None and words[0] == "info":
            found += judge_geometry(words, record, folder)
    return found + judge_files(folder, words, outcome.code)
