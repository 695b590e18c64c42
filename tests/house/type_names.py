"""Types at namespace scope, and those whose name the program has twice."""
import re
from collections import defaultdict
from pathlib import Path
from typing import NamedTuple

import include_rules

HEADERS = {".h", ".hpp", ".cuh"}
ANONYMOUS = "(anonymous)"

# Comments, texts and preprocessor lines, in the order in which the compiler meets them.
NOT_CODE = re.compile(
    r'//[^\n]*|/\*.*?\*/'
    r'|(?:u8|[LuU])?R"(?P<mark>[^\s()\\]{0,16})\(.*?\)(?P=mark)"'
    r'|"(?:\\.|[^"\\\n])*"'
    r"|(?<!\w)'(?:\\.|[^'\\\n])+'"
    r'|^[ \t]*#(?:\\\n|[^\n])*',
    re.DOTALL | re.MULTILINE)
TOKEN = re.compile(r'[A-Za-z_]\w*|::|\[\[|\]\]|[^\s\w]')
OPENING, CLOSING = {"<", "(", "[["}, {">", ")", "]]"}


class Definition(NamedTuple):
    namespace: tuple  # ("softscope", "test"); an anonymous one is ANONYMOUS
    name: str
    path: str
    line: int

    @property
    def is_local(self):
        return ANONYMOUS in self.namespace

    @property
    def visible_as(self):
        """The namespaces and the name by which the rest of its file says it."""
        return tuple(part for part in self.namespace if part != ANONYMOUS) + (self.name,)


def code_only(text):
    """The text with everything that isn't code blank, line by line as it was."""
    return NOT_CODE.sub(lambda found: re.sub(r"[^\n]", " ", found.group()), text)


def without_brackets(tokens):
    """Without template parameters, attributes, alignas(…): what stands in brackets, and those."""
    kept, depth = [], 0
    for token in tokens:
        if token in OPENING:
            depth += 1
        elif token in CLOSING:
            depth -= 1
        elif depth == 0:
            kept.append(token)
    return kept


def namespaces_opened(head):
    """["a", "b"] of `namespace a::b`; None where this opens none."""
    words = [word for word in head if word != "inline"]
    if words[:1] == ["extern"]:
        return []
    if words[:1] != ["namespace"]:
        return None
    return [word for word in words[1:] if word != "::"] or [ANONYMOUS]


def type_defined(head):
    """The name of the struct, class, union or enum that these words define; None for others."""
    words = [word for word in without_brackets(head) if word not in ("template", "alignas")]
    if words[:1] not in (["struct"], ["class"], ["union"], ["enum"]):
        return None
    start = 2 if words[1:2] in (["class"], ["struct"]) else 1
    name = words[start] if len(words) > start else ""
    # What follows a name that is defined here: nothing, `final`, the bases, an enum's type.
    is_definition = words[start + 1:start + 2] in ([], ["final"], [":"])
    if not name.isidentifier() or not is_definition:
        return None
    # A specialisation has its arguments behind the name, and is no new name.
    return None if head[head.index(name) + 1:][:1] == ["<"] else name


def definitions(path, text):
    """Every type that the file defines at namespace scope."""
    found = []
    scopes = []  # of each open brace the namespaces it opened; None for any other
    head = []
    line, seen = 1, 0
    code = code_only(text)
    for match in TOKEN.finditer(code):
        token = match.group()
        line += code.count("\n", seen, match.start())
        seen = match.start()
        if token == "{":
            opened = namespaces_opened(head)
            name = type_defined(head)
            if name and None not in scopes:
                namespace = tuple(part for scope in scopes for part in scope)
                found.append(Definition(namespace, name, path, line))
            scopes.append(opened)
        elif token == "}" and scopes:
            scopes.pop()
        if token in "{};":
            head = []
        else:
            head.append(token)
    return found


def program_of(path):
    """Each folder of tests is a program of its own, with the tests' support; the rest is one."""
    parts = Path(path).parts
    return "/".join(parts[:2]) if parts[0] == "tests" else "softscope"


def meet(one, other):
    """Whether two files may be linked into one program, or included into one file."""
    shared = {"softscope", "tests/support"}
    programs = {program_of(one.path), program_of(other.path)}
    return len(programs) == 1 or bool(programs & shared)


def clash(one, other):
    """Two types of one program under one name. What is local to two files stays so."""
    if not meet(one, other):
        return False
    if not one.is_local and not other.is_local:
        return True
    if one.is_local and other.is_local:
        return False
    shared = other if one.is_local else one
    return Path(shared.path).suffix in HEADERS


def doubled(found):
    """One line for each pair of types that share a name."""
    by_name = defaultdict(list)
    for definition in found:
        by_name[definition.visible_as].append(definition)
    return [f"{one.path}:{one.line} and {other.path}:{other.line}: {'::'.join(name)}"
            for name, same in sorted(by_name.items())
            for i, one in enumerate(same) for other in same[i + 1:]
            if one.path != other.path and clash(one, other)]


def definitions_of_tree(root):
    text = (root / "docs/architecture.md").read_text(encoding="utf-8")
    found = []
    for path in include_rules.source_files(root, include_rules.Rules(text).allowed):
        name = path.relative_to(root).as_posix()
        found += definitions(name, path.read_text(encoding="utf-8"))
    return found
