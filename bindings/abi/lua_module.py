# SPDX-License-Identifier: Apache-2.0
"""luajit/msq_cdef.lua: the declarations for the FFI of LuaJIT."""
from header import Function, Header, Member, Struct, Type


def _declaration(one: Member) -> str:
    kind = one.type
    stars = "*" * kind.pointers
    length = f"[{kind.length}]" if kind.length and not kind.pointers else ""
    return f"{'const ' if kind.is_const else ''}{kind.name}{stars} {one.name}{length}"


def _arguments(function: Function) -> str:
    return ", ".join(_declaration(one) for one in function.arguments) or "void"


def _result(kind: Type) -> str:
    return f"{'const ' if kind.is_const else ''}{kind.name}{'*' * kind.pointers}"


def write(header: Header) -> str:
    lines = ["-- SPDX-License-Identifier: Apache-2.0",
             "-- Made from msq.h by bindings/make_bindings.py: change those.",
             'local ffi = require("ffi")', "", "ffi.cdef [[", "typedef int32_t msq_status;"]
    for enum in header.enums:
        values = ", ".join(f"{name} = {value}" for name, value in enum.values.items())
        lines.append(f"enum {enum.name} {{ {values} }};")
    for name in header.handles:
        lines.append(f"typedef struct {name} {name};")
    for one in header.types:
        if isinstance(one, Struct):
            fields = " ".join(f"{_declaration(field)};" for field in one.fields)
            lines.append(f"typedef struct {one.name} {{ {fields} }} {one.name};")
        else:
            lines.append(f"typedef {_result(one.result)} (*{one.name})({_arguments(one)});")
    for function in header.functions:
        lines.append(f"{_result(function.result)} {function.name}({_arguments(function)});")
    return "\n".join(lines + ["]]"]) + "\n"
