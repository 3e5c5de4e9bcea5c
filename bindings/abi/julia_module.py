# SPDX-License-Identifier: Apache-2.0
"""julia/abi.jl: the declarations for Julia's ccall."""
from header import Function, Header, Struct, Type, constants_of

SCALARS = {"void": "Cvoid", "char": "Cchar", "int8_t": "Int8", "uint8_t": "UInt8", "int16_t": "Int16",
           "uint16_t": "UInt16", "int32_t": "Int32", "uint32_t": "UInt32", "int64_t": "Int64", "uint64_t": "UInt64",
           "size_t": "Csize_t", "float": "Cfloat", "double": "Cdouble", "msq_status": "Int32"}
KEYWORDS = set("begin const do else end export false for function global if import let local macro module quote return "
               "struct true try using while".split())


def _name(name: str) -> str:
    return f'var"{name}"' if name in KEYWORDS else name


def _type(kind: Type, callbacks) -> str:
    pointers = kind.pointers
    if kind.name in callbacks:
        result = "Ptr{Cvoid}"
    elif kind.name == "char" and pointers:
        result, pointers = "Cstring", pointers - 1
    else:
        result = SCALARS.get(kind.name, kind.name)
    for _ in range(pointers):
        result = f"Ptr{{{result}}}"
    return f"NTuple{{{kind.length},{result}}}" if kind.length and not kind.pointers else result


def write(header: Header) -> str:
    callbacks = {one.name for one in header.types if isinstance(one, Function)}
    lines = ["# SPDX-License-Identifier: Apache-2.0",
             "# The declarations of msq.h. Made from it by bindings/make_bindings.py: change those.", ""]
    lines += [f"const {name} = {value}" for name, value in constants_of(header).items()]
    lines += ["", *(f"mutable struct {name} end" for name in header.handles), ""]
    for one in header.types:
        if isinstance(one, Struct):
            fields = "; ".join(f"{_name(field.name)}::{_type(field.type, callbacks)}" for field in one.fields)
            lines.append(f"struct {one.name}; {fields}; end")
    lines.append("")
    for function in header.functions:
        names = [_name(one.name) for one in function.arguments]
        types = [_type(one.type, callbacks) for one in function.arguments]
        listed = ", ".join(types) + ("," if len(types) == 1 else "")
        lines.append(f"{function.name}({', '.join(names)}) = ccall((:{function.name}, library), "
                     f"{_type(function.result, callbacks)}, ({listed}){''.join(', ' + name for name in names)})")
    return "\n".join(lines) + "\n"
