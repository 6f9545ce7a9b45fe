"""Writes the type stubs of the compiled module from what it says of itself.

    python3 stubs.py FOLDER       FOLDER holds the package `seam`; writes FOLDER/seam/_seam.pyi
"""

import inspect
import re
import sys
import textwrap
from pathlib import Path

HEAD = '''"""The compiled part of seam. Made by stubs.py."""

import os
import typing

import numpy
import numpy.typing

from ._columns import Columns

'''
NUMBER = r"numpy\.ndarray\[numpy\.(float64|int32)(?:\[[^\]]*\])?\]"


def result_type(text):
    """Of what comes back, as type checkers know it."""
    text = re.sub(NUMBER, r"numpy.typing.NDArray[numpy.\1]", text)
    text = re.sub(r"\bseam\.", "", text)
    text = re.sub(r"(?<![\w.])(Union|Optional|List|Tuple|Dict|Any)\b", r"typing.\1", text)
    text = re.sub(r"(?<![\w.])(list|tuple|dict)\[", lambda m: f"typing.{m.group(1).capitalize()}[", text)
    text = re.sub(r"(?<![\w.])dict\b", "typing.Dict[str, typing.Any]", text)
    text = re.sub(r"(?<![\w.])tuple\b", "typing.Tuple[typing.Any, ...]", text)
    text = re.sub(r"numpy\.ndarray$", "numpy.typing.NDArray[numpy.float64]", text)
    return re.sub(r"(?<![\w.])(object|handle)\b", "typing.Any", text)


def argument_type(text):
    """Of what goes in: whatever numpy makes an array of is taken for one, and a tuple for a list."""
    text = re.sub(NUMBER, "ArrayLike", text)
    text = re.sub(r"Tuple\[([^\[\]]+), \.\.\.\]", r"SequenceOf[\1]", text)
    text = re.sub(r"\b(List|list)\[", "SequenceOf[", text)
    text = result_type(text)
    text = re.sub(r"\bColumns\b", "ArrayLike", text)
    text = text.replace("SequenceOf", "typing.Sequence")
    return re.sub(r"(?<![\w.])ArrayLike\b", "numpy.typing.ArrayLike", text)


def split(text):
    """At the commas that are in no bracket."""
    parts, depth, part = [], 0, ""
    for character in text:
        depth += character in "([{"
        depth -= character in ")]}"
        if character == "," and depth == 0:
            parts.append(part.strip())
            part = ""
        else:
            part += character
    return parts + [part.strip()] if part.strip() else parts


def argument(text):
    if text in ("*", "*args", "**kwargs") or ":" not in text:
        return {"*args": "*args: typing.Any", "**kwargs": "**kwargs: typing.Any"}.get(text, text)
    name, kind = text.split(":", 1)
    kind, _, default = kind.strip().partition(" = ")
    if name == "self":
        return "self"
    kind = argument_type(kind)
    if kind == "os.PathLike":
        kind = "typing.Union[str, os.PathLike[str]]"
    if default == "None" and not kind.startswith("typing.Optional"):
        kind = f"typing.Optional[{kind}]"
    return f"{name}: {kind}" + (" = ..." if default else "")


SIGNATURE = re.compile(r"^(?:\d+\. )?(\w*)\((.*)\) -> (.*)$")


def signatures(doc):
    """All signatures of a function, each with the text below it."""
    found = []
    for line in (doc or "").splitlines():
        match = SIGNATURE.match(line)
        if match and (not found or line[0].isdigit()):
            found.append((match.group(2), match.group(3), []))
        elif found and line != "Overloaded function.":
            found[-1][2].append(line)
    return [(arguments, result, "\n".join(text).strip()) for arguments, result, text in found]


def quoted(text, indent):
    if not text:
        return indent + "...\n"
    text = text.replace("\\", "\\\\").replace('"""', "'''")
    return textwrap.indent(f'"""{text}"""', indent).rstrip() + "\n" + indent + "...\n"


def function(name, thing, indent="", static=False):
    found = signatures(thing.__doc__)
    text = ""
    for arguments, result, doc in found:
        if len(found) > 1:
            text += indent + "@typing.overload\n"
        if static:
            text += indent + "@staticmethod\n"
        listed = ", ".join(argument(part) for part in split(arguments))
        result = "None" if name in ("__init__", "__setstate__") else result_type(result)
        text += f"{indent}def {name}({listed}) -> {result}:\n{quoted(doc, indent + '    ')}"
    return text


def property_type(thing):
    found = signatures(thing.fget.__doc__)
    return found[0][1] if found else "object"


def settable(kind, is_enum):
    kind = argument_type(kind)
    return f"typing.Union[{kind}, str]" if is_enum else kind


def is_enum(cls, kind):
    for part in kind.replace("seam.", "").split("."):
        cls = getattr(MODULE if cls is None else cls, part, None)
    return hasattr(cls, "__members__")


def attribute(name, thing, indent):
    kind = property_type(thing)
    text = f"{indent}@property\n{indent}def {name}(self) -> {result_type(kind)}:\n{quoted(thing.__doc__, indent + '    ')}"
    if thing.fset:
        wanted = settable(kind, is_enum(None, kind))
        text += f"{indent}@{name}.setter\n{indent}def {name}(self, value: {wanted}) -> None: ...\n"
    return text


def made_of_fields(cls, indent):
    """`__init__` of a class that is made of its attributes."""
    arguments = ["self"]
    for name in cls._fields:
        kind = property_type(vars(cls)[name])
        kind = "typing.Mapping[str, typing.Any]" if kind == "dict" else settable(kind, is_enum(None, kind))
        arguments.append(f"{name}: {kind} = ...")
    doc = "From the attributes, in their order or by name; what is not given has its default."
    return f"{indent}def __init__({', '.join(arguments)}) -> None:\n{quoted(doc, indent + '    ')}"


def enumeration(name, cls, indent):
    inner = indent + "    "
    text = f"{indent}class {name}:\n{inner}{docstring(cls, inner)}"
    for value in cls.__members__:
        text += f"{inner}{value}: typing.ClassVar[{cls.__qualname__}]\n"
    text += f"{inner}__members__: typing.ClassVar[typing.Dict[str, {cls.__qualname__}]]\n"
    text += f"{inner}def __init__(self, value: typing.Union[int, str]) -> None: ...\n"
    text += f"{inner}def __int__(self) -> int: ...\n{inner}def __index__(self) -> int: ...\n"
    text += f"{inner}@property\n{inner}def name(self) -> str: ...\n"
    return text + f"{inner}@property\n{inner}def value(self) -> int: ...\n"


def docstring(cls, indent):
    doc = inspect.cleandoc(cls.__doc__ or "").split("\n\nMembers:")[0]
    return quoted(doc, "").strip()[:-3].rstrip().replace("\n", "\n" + indent).replace(indent + "\n", "\n") + "\n" if doc else "\n"


SHOWN = ("__init__", "__len__", "__add__", "__repr__")


def one_class(name, cls, indent=""):
    if hasattr(cls, "__members__"):
        return enumeration(name, cls, indent)
    inner = indent + "    "
    text = f"{indent}class {name}:\n{inner}{docstring(cls, inner)}"
    for key, thing in vars(cls).items():
        if isinstance(thing, type):
            text += one_class(key, thing, inner)
    if "_fields" in vars(cls):
        text += made_of_fields(cls, inner)
    for key, thing in vars(cls).items():
        if isinstance(thing, type) or (key.startswith("_") and key not in SHOWN):
            continue
        if isinstance(thing, property):
            text += attribute(key, thing, inner)
        elif isinstance(thing, staticmethod):
            text += function(key, thing.__func__, inner, static=True)
        elif inspect.isroutine(thing):
            if key == "__init__" and "_fields" in vars(cls):
                continue
            text += function(key, thing, inner)
        else:
            text += f"{inner}{key}: typing.ClassVar[{type(thing).__name__}]\n"
    return text + f"{inner}...\n"


def stub(module):
    text = HEAD
    for name, thing in sorted(vars(module).items()):
        if isinstance(thing, type) and issubclass(thing, Exception):
            text += f"class {name}(ValueError):\n    {docstring(thing, '    ')}    ...\n\n"
        elif isinstance(thing, type):
            text += one_class(name, thing) + "\n"
        elif inspect.isroutine(thing):
            text += function(name, thing) + "\n"
        elif name == "__version__" or not name.startswith("_"):
            kind = "typing.Tuple[Join, ...]" if isinstance(thing, tuple) else type(thing).__name__
            text += f"{name}: {kind}\n"
    return text


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    sys.path.insert(0, str(folder))
    import seam._seam as MODULE

    (folder / "seam" / "_seam.pyi").write_text(stub(MODULE))
