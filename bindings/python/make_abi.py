#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes msq/_abi.py, the declarations of msq.h in ctypes, from the header.

    python3 bindings/python/make_abi.py [--check] [--header msq.h] [--output _abi.py]

--check writes nothing, and fails where the file is not what the header makes. Reads the C that
msq.h is written in, and no other: enums without names, structs and callbacks by typedef, functions
that begin with MSQ_API. Whatever it does not understand is an error.
"""
import argparse
import difflib
import pathlib
import re
import sys
from dataclasses import dataclass, field
from typing import Dict, List, Tuple

HERE = pathlib.Path(__file__).resolve().parent

SCALARS = {
    "char": "c_char", "int8_t": "c_int8", "uint8_t": "c_uint8", "int16_t": "c_int16",
    "uint16_t": "c_uint16", "int32_t": "c_int32", "uint32_t": "c_uint32", "int64_t": "c_int64",
    "uint64_t": "c_uint64", "size_t": "c_size_t", "float": "c_float", "double": "c_double",
    "msq_status": "c_int32",
}


@dataclass
class Header:
    """What the header declares, in its order. Types are Python expressions over ctypes."""
    constants: Dict[str, int] = field(default_factory=dict)
    opaque: List[str] = field(default_factory=list)
    structs: Dict[str, List[Tuple[str, str]]] = field(default_factory=dict)
    callbacks: Dict[str, List[str]] = field(default_factory=dict)  # result, arguments
    functions: Dict[str, List[str]] = field(default_factory=dict)  # result, arguments
    order: List[str] = field(default_factory=list)  # of structs and callbacks


class HeaderError(Exception):
    """The header has C that this does not read."""


def type_of(c: str, header: Header) -> str:
    """The ctypes expression of a C type such as `const double *`."""
    stars = c.count("*")
    words = [word for word in c.replace("*", " ").split() if word not in ("const", "struct")]
    if len(words) != 1:
        raise HeaderError(f"type {c!r}")
    name = words[0]
    if name in ("void", "char") and stars:
        result, stars = ("c_void_p" if name == "void" else "c_char_p"), stars - 1
    elif name == "void":
        result = "None"
    elif name in SCALARS:
        result = SCALARS[name]
    elif name in header.opaque or name in header.structs or name in header.callbacks:
        result = name
        if name in header.opaque and not stars:
            raise HeaderError(f"{name} by value")
    else:
        raise HeaderError(f"unknown type {name}")
    for _ in range(stars):
        result = f"POINTER({result})"
    return result


def declarators(text: str) -> List[Tuple[str, str, str]]:
    """(type, name, length or "") of each name in `const double *a, *b` or `double min[3]`."""
    first, *others = [part.strip() for part in text.split(",")]
    match = re.fullmatch(r"(.*?[\s*])(\w+)\s*(?:\[(\d*)\])?", first, flags=re.S)
    if match is None:
        raise HeaderError(f"declaration {text!r}")
    base = match.group(1)
    found = [(base, match.group(2), match.group(3) if "[" in first else "")]
    for other in others:
        match = re.fullmatch(r"(\**)\s*(\w+)\s*(?:\[(\d+)\])?", other)
        if match is None:
            raise HeaderError(f"declaration {text!r}")
        found.append((base.replace("*", "") + match.group(1), match.group(2), match.group(3) or ""))
    return found


def read_arguments(text: str, header: Header) -> List[str]:
    if text.strip() == "void":
        return []
    types = []
    for argument in text.split(","):
        argument = " ".join(argument.split())
        array = re.fullmatch(r"(.*\w)\s*\[\d*\]", argument)
        if array:  # an array argument is a pointer
            argument = re.sub(r"(\w+)$", r"*\1", array.group(1))
        (c, _, _), = declarators(argument)
        types.append(type_of(c, header))
    return types


def read_enum(body: str, header: Header) -> None:
    value = -1
    for entry in filter(None, (part.strip() for part in body.split(","))):
        name, _, number = (part.strip() for part in entry.partition("="))
        if not re.fullmatch(r"MSQ_\w+", name) or (number and not re.fullmatch(r"-?\d+", number)):
            raise HeaderError(f"enumerator {entry!r}")
        value = int(number) if number else value + 1
        header.constants[name] = value


def read_struct(name: str, body: str, header: Header) -> None:
    fields = []
    for member in filter(None, (part.strip() for part in body.split(";"))):
        for c, label, length in declarators(member):
            ctype = type_of(c, header)
            fields.append((label, f"{ctype} * {length}" if length else ctype))
    header.structs[name] = fields
    header.order.append(name)


def read_header(path: pathlib.Path) -> Header:
    header = Header()
    text = re.sub(r"/\*.*?\*/", " ", path.read_text(encoding="utf-8"), flags=re.S)
    for name, number in re.findall(r"^#define (MSQ_VERSION\w*) (\d+)\s*$", text, flags=re.M):
        header.constants[name] = int(number)
    text = re.sub(r"^[ \t]*#(?:.*\\\n)*.*$", "", text, flags=re.M)
    text = text.replace('extern "C" {', "").strip()
    if text.endswith("}"):  # of extern "C"
        text = text[:-1]
    statement = re.compile(r"""\s*(?:
        (?:typedef\s+)?enum\s*(?:\w+\s*)?\{(?P<enum>[^}]*)\}\s*
      | typedef\s+struct\s+(?P<struct>\w+)\s*\{(?P<body>[^}]*)\}\s*(?P=struct)\s*
      | typedef\s+struct\s+(?P<opaque>\w+)\s+(?P=opaque)\s*
      | typedef\s+(?P<result>[\w\s*]+?)\(\s*\*\s*(?P<callback>\w+)\s*\)
                 \s*\((?P<arguments>[^)]*)\)\s*
      | typedef\s+int32_t\s+msq_status\s*
      | MSQ_API\s+(?P<returned>[\w\s*]+?[\s*])(?P<function>\w+)\s*\((?P<parameters>[^)]*)\)\s*
    );""", re.X)
    at = 0
    while text[at:].strip():
        match = statement.match(text, at)
        if match is None:
            raise HeaderError(f"statement {' '.join(text[at:at + 120].split())!r}")
        at = match.end()
        found = match.groupdict()
        if found["enum"] is not None:
            read_enum(found["enum"], header)
        elif found["struct"]:
            read_struct(found["struct"], found["body"], header)
        elif found["opaque"]:
            header.opaque.append(found["opaque"])
        elif found["callback"]:
            header.callbacks[found["callback"]] = [type_of(found["result"], header),
                                                   *read_arguments(found["arguments"], header)]
            header.order.append(found["callback"])
        elif found["function"]:
            header.functions[found["function"]] = [type_of(found["returned"], header),
                                                   *read_arguments(found["parameters"], header)]
    if not header.functions:
        raise HeaderError("no functions")
    return header


def wrapped(opening: str, parts: List[str], closing: str) -> List[str]:
    """Lines of at most 100 characters, the parts after the opening, aligned with it."""
    lines, line = [], opening
    for index, part in enumerate(parts):
        part += closing if index == len(parts) - 1 else ","
        if len(line) > len(opening) and len(line) + 1 + len(part) > 100:
            lines.append(line)
            line = " " * len(opening) + part
        else:
            line += part if line == opening else " " + part
    return lines + [line]


def write_module(header: Header) -> str:
    declarations = []
    for name in header.opaque:
        declarations += ["", "", f"class {name}(Structure):", '    """Opaque."""']
    for name in header.order:
        if name in header.structs:
            pairs = [f'("{label}", {ctype})' for label, ctype in header.structs[name]]
            declarations += ["", "", f"class {name}(Structure):",
                             *wrapped("    _fields_ = [", pairs, "]")]
        else:
            declarations += ["", "", *wrapped(f"{name} = CFUNCTYPE(", header.callbacks[name], ")")]
    declarations += ["", "", "# name: [result, arguments ...]", "FUNCTIONS = {"]
    for name, types in header.functions.items():
        declarations += wrapped(f'    "{name}": [', types, "],")
    declarations += ["}"]
    used = set(re.findall(r"\b(?:c_\w+|POINTER|Structure|CFUNCTYPE)\b", "\n".join(declarations)))
    imports = sorted(used, key=lambda name: (not name.isupper(), name.startswith("c_"), name))
    lines = ["# SPDX-License-Identifier: Apache-2.0",
             '"""The declarations of msq.h. Made from it by make_abi.py: change those."""',
             *wrapped("from ctypes import (", imports, ")"), ""]
    lines += [f"{name} = {value}" for name, value in header.constants.items()]
    return "\n".join(lines + declarations) + "\n"


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--header", type=pathlib.Path,
                        default=HERE.parent.parent / "include" / "msq.h")
    parser.add_argument("--output", type=pathlib.Path, default=HERE / "msq" / "_abi.py")
    arguments = parser.parse_args()
    try:
        text = write_module(read_header(arguments.header))
    except HeaderError as error:
        sys.exit(f"{arguments.header}: make_abi.py does not read this: {error}")
    if not arguments.check:
        arguments.output.write_text(text, encoding="utf-8")
        return 0
    committed = arguments.output.read_text(encoding="utf-8")
    if committed == text:
        return 0
    sys.stdout.writelines(difflib.unified_diff(
        committed.splitlines(True), text.splitlines(True), str(arguments.output), "of the header"))
    print("msq/_abi.py is not what msq.h declares; run: python3 bindings/python/make_abi.py")
    return 1


if __name__ == "__main__":
    sys.exit(main())
