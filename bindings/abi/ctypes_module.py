# SPDX-License-Identifier: Apache-2.0
"""python/msq/_abi.py and _io_abi.py: the declarations in ctypes."""
import re
from typing import List

from header import Function, Header, Struct, Type, constants_of

SCALARS = {"msq_status": "c_int32"}


def _type(kind: Type) -> str:
    """A ctypes expression."""
    pointers = kind.pointers
    if kind.name == "void" and pointers:
        result, pointers = "c_void_p", pointers - 1
    elif kind.name == "char" and pointers:
        result, pointers = "c_char_p", pointers - 1
    elif kind.name == "void":
        result = "None"
    elif kind.name.startswith("msq_"):
        result = SCALARS.get(kind.name, kind.name)
    else:
        result = "c_size_t" if kind.name == "size_t" else "c_" + re.sub(r"_t$", "", kind.name)
    for _ in range(pointers):
        result = f"POINTER({result})"
    return result


def _field(kind: Type) -> str:
    return f"{_type(kind)} * {kind.length}" if kind.length else _type(kind)


def _types(function: Function) -> List[str]:
    return [_type(function.result), *(_type(one.type) for one in function.arguments)]


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


def write(header: Header) -> str:
    declarations = []
    for name in header.handles:
        declarations += ["", "", f"class {name}(Structure):", '    """Opaque."""']
    for one in header.types:
        if isinstance(one, Struct):
            pairs = [f'("{field.name}", {_field(field.type)})' for field in one.fields]
            declarations += ["", "", f"class {one.name}(Structure):",
                             *wrapped("    _fields_ = [", pairs, "]")]
        else:
            declarations += ["", "", *wrapped(f"{one.name} = CFUNCTYPE(", _types(one), ")")]
    declarations += ["", "", "# name: [result, arguments ...]", "FUNCTIONS = {"]
    for function in header.functions:
        declarations += wrapped(f'    "{function.name}": [', _types(function), "],")
    declarations += ["}"]
    used = set(re.findall(r"\b(?:c_\w+|POINTER|Structure|CFUNCTYPE)\b", "\n".join(declarations)))
    imports = sorted(used, key=lambda name: (not name.isupper(), name.startswith("c_"), name))
    file = "msq_io.h" if header.base else "msq.h"
    lines = ["# SPDX-License-Identifier: Apache-2.0",
             f'"""The declarations of {file}. Made from it by make_bindings.py: change those."""',
             *wrapped("from ctypes import (", imports, ")"), ""]
    if header.base:
        names = sorted(name for name in set(re.findall(r"\bmsq_\w+", "\n".join(declarations)))
                       if header.base.has_type(name))
        lines += [*wrapped("from ._abi import (", names, ")"), ""]
    lines += [f"{name} = {value}" for name, value in constants_of(header).items()]
    return "\n".join(lines + declarations) + "\n"
