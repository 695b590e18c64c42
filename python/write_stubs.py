"""write_stubs.py FILE: types of the module `softscope`, read off it, as a stub for type checkers."""
import ast
import inspect
import re
import sys

import softscope

HEAD = '''"""{doc}"""
from typing import Any, Callable, Dict, Iterator, List, Optional, overload

import numpy
import numpy.typing

'''

# How pybind11 writes a type, and how a type checker wants it.
TYPES = [
    (r"\bsoftscope\.(?=[A-Z])", ""),
    (r"numpy\.ndarray\[", "numpy.typing.NDArray["),
    (r"\bfunction\b", "Callable[[int, int], Optional[bool]]"),
    (r"\bdict\b", "Dict[str, Any]"),
    (r"\bobject\b", "Any"),
]
SETTING_TYPES = {"true/false": "bool", "whole number": "int", "number": "float"}
# Functions that take settings as keywords, and whose settings those are.
KEYWORDS = {"Sequence": "reconstruct", "Reconstructor": "reconstruct",
            "DepthEstimator": "depth", "simulate": "simulate"}


def typed(signature):
    for pattern, better in TYPES:
        signature = re.sub(pattern, better, signature)
    return signature


def setting_arguments(command):
    for key, setting in softscope.settings(command).items():
        kind = SETTING_TYPES.get(setting["type"], "str")
        yield ast.arg(key.replace(".", "_"), ast.Name(kind))


def definition(signature, command=None):
    """`def name(…) -> type: ...`, defaults as `...`, settings as keywords."""
    function = ast.parse(f"def {typed(signature)}: ...").body[0]
    arguments = function.args
    if arguments.args and arguments.args[0].arg in ("self", "arg0"):
        arguments.args[0] = ast.arg("self")
    arguments.defaults = [ast.Constant(...) for _ in arguments.defaults]
    if arguments.kwarg:
        arguments.kwarg = None
        arguments.kwonlyargs = list(setting_arguments(command))
        arguments.kw_defaults = [ast.Constant(...) for _ in arguments.kwonlyargs]
    return function


def overloads(doc):
    """(signature, text) of each overload that pybind11 lists in a docstring."""
    lines = inspect.cleandoc(doc).split("\n")
    numbered = [i for i, line in enumerate(lines) if re.match(r"\d+\. \w+\(", line)]
    starts = numbered or [0]
    for start, end in zip(starts, starts[1:] + [len(lines)]):
        text = "\n".join(lines[start + 1:end]).strip()
        yield re.sub(r"^\d+\. ", "", lines[start]), text


def indented(text, by):
    return "\n".join(by + line if line else "" for line in text.split("\n"))


def function_lines(doc, command, by):
    found = list(overloads(doc))
    for signature, text in found:
        function = definition(signature, command)
        if text:
            function.body.insert(0, ast.Expr(ast.Constant(text)))
        if len(found) > 1:
            function.decorator_list = [ast.Name("overload")]
        yield indented(ast.unparse(ast.fix_missing_locations(function)), by)


def property_lines(name, value):
    signature = (value.fget.__doc__ or "").strip().split("\n")[0]
    yield "    @property"
    function = definition(name + (signature or "(self) -> object"))
    if value.__doc__ and value.__doc__ != value.fget.__doc__:
        function.body.insert(0, ast.Expr(ast.Constant(value.__doc__.strip())))
    yield indented(ast.unparse(ast.fix_missing_locations(function)), "    ")


def class_lines(cls):
    base = cls.__bases__[0].__name__
    if issubclass(cls, Exception):
        yield f"class {cls.__name__}({base}): ..."
        return
    yield f"class {cls.__name__}:"
    if cls.__doc__:
        yield indented(f'"""{cls.__doc__.strip()}"""', "    ")
    for name, value in vars(cls).items():
        if isinstance(value, property):
            yield from property_lines(name, value)
        elif isinstance(value, staticmethod):
            for line in function_lines(value.__func__.__doc__, None, "    "):
                yield "    @staticmethod\n" + line
        elif name == "__iter__":
            item = typed(cls.__next__.__doc__.split("->")[1].split()[0])
            yield f"    def __iter__(self) -> Iterator[{item}]: ..."
        elif "->" in (value.__doc__ or "") and re.search(r"\((self|arg0): softscope", value.__doc__):
            yield from function_lines(value.__doc__, KEYWORDS.get(cls.__name__), "    ")


def stub():
    parts = [HEAD.format(doc=softscope.__doc__)]
    for name, value in vars(softscope).items():
        if isinstance(value, type):
            parts.append("\n".join(class_lines(value)) + "\n")
        elif callable(value):
            parts.append("\n".join(function_lines(value.__doc__, KEYWORDS.get(name), "")) + "\n")
    return "\n".join(parts)


if __name__ == "__main__":
    text = stub()
    ast.parse(text)
    with open(sys.argv[1], "w", encoding="utf-8") as out:
        out.write(text)
