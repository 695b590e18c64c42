"""The tables of docs/architecture.md, and the includes that break them."""
import re
from pathlib import Path

SOURCES = {".h", ".hpp", ".cpp", ".cu", ".cuh"}
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')


def table(text, first_heading):
    """The rows of the table whose first column has this heading, as lists of cells."""
    rows = []
    inside = False
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if line.startswith("|") and cells[0] == first_heading:
            inside = True
        elif inside and not line.startswith("|"):
            break
        elif inside and not re.fullmatch(r"[|: -]+", line):
            rows.append(cells)
    if not rows:
        raise ValueError(f"docs/architecture.md has no table whose first column is '{first_heading}'")
    return rows


def names(cell):
    return re.findall(r"`([^`]+)`", cell)


def lies_in(path, home):
    return path == home or path.startswith(home + "/")


class Rules:
    def __init__(self, text):
        self.allowed = {}  # folder: the folders it may include, None = everything
        for folder, _, may_include in table(text, "Folder"):
            everything = may_include == "everything"
            self.allowed[names(folder)[0]] = None if everything else set(names(may_include))
        self.rooms = {}  # room, as a path from the root: the rooms of its library it may include
        for room, _, may_include in table(text, "Inside a library"):
            place = names(room)[0]
            library = self.library_of(place)
            self.rooms[place] = {f"{library}/{name}" for name in names(may_include)}
        self.homes = {}  # beginning of a header's name: the places it may be included, None = all
        self.free = []  # places that may include every library
        for _, headers, home in table(text, "Library"):
            places = None if home == "everywhere" else names(home)
            if not names(headers):
                self.free += places
            for beginning in names(headers):
                self.homes[beginning] = places

    def folder_of(self, path):
        """"src/core" of "src/core/camera.h"; None where no row speaks of it."""
        return next((folder for folder in self.allowed if lies_in(path, folder)), None)

    def library_of(self, room):
        """The library of a room. Its own folder, without the others, may be a room too."""
        return room if room in self.allowed else room.rpartition("/")[0]

    def check(self, path, line):
        """What is wrong with this line of this file; None where nothing is."""
        found = INCLUDE.match(line)
        if not found:
            return None
        own, library = found.groups()
        return self.check_own(path, own) if own else self.check_library(path, library)

    def check_own(self, path, header):
        folder = self.folder_of(path)
        if "/" not in header and folder != "tests":
            return f'"{header}" is not written from the root of src or of the repository'
        target = header.split("/")[0]
        allowed = self.allowed[folder]
        if target == folder.split("/")[-1]:
            return self.check_room(path, folder, header)
        if allowed is None or target in allowed:
            return None
        return f'"{header}": {folder} may include {", ".join(sorted(allowed)) or "nothing else"}'

    def room_of(self, path):
        """"src/io/files" of "src/io/files/folder.h"; None in a library without rooms."""
        return max((room for room in self.rooms if lies_in(path, room)), key=len, default=None)

    def check_room(self, path, folder, header):
        room, target = self.room_of(path), self.room_of(folder + header[header.index("/"):])
        if room is None or target is None or target == room or target in self.rooms[room]:
            return None
        allowed = sorted(name.rpartition("/")[2] for name in self.rooms[room])
        return f'"{header}": {room} may include {", ".join(allowed) or "no other room"}'

    def check_library(self, path, header):
        beginnings = [b for b in self.homes if header.startswith(b)]
        if not beginnings:
            is_standard = "/" not in header and "." not in header
            return None if is_standard else f"<{header}> has no home in docs/architecture.md"
        places = self.homes[max(beginnings, key=len)]
        if places is None or any(lies_in(path, place) for place in places + self.free):
            return None
        return f"<{header}> has its home in {', '.join(places) or 'no file'}"


def source_files(root, folders):
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in SOURCES:
                yield path


def violations(root):
    """One line for each include that breaks a rule: file:line, what, what the rule is."""
    rules = Rules((root / "docs/architecture.md").read_text(encoding="utf-8"))
    found = []
    for path in source_files(root, rules.allowed):
        name = path.relative_to(root).as_posix()
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
            wrong = rules.check(name, line)
            if wrong:
                found.append(f"{name}:{number}: {wrong}")
    return found


def folders_without_row(root):
    """Folders of sources that the table leaves out."""
    text = (root / "docs/architecture.md").read_text(encoding="utf-8")
    there = {f"src/{path.name}" for path in (root / "src").iterdir() if path.is_dir()}
    there |= {path.name for path in root.iterdir() if (path / "CMakeLists.txt").is_file()}
    return sorted(there - {"src"} - set(Rules(text).allowed))


def sources_without_room(root):
    """Sources of a library with rooms that lie in none of them."""
    rules = Rules((root / "docs/architecture.md").read_text(encoding="utf-8"))
    libraries = sorted({rules.library_of(room) for room in rules.rooms})
    paths = [path.relative_to(root).as_posix() for path in source_files(root, libraries)]
    return [path for path in paths if rules.room_of(path) is None]
