# SPDX-License-Identifier: Apache-2.0
"""node/abi.js and node/abi.d.ts: the declarations for koffi, and their types for TypeScript."""
from typing import List

from header import Function, Header, Member, Struct, Type, constants_of

WIDE = ("int64_t", "uint64_t", "size_t")


def _element(kind: Type, header: Header) -> str:
    """An expression of koffi's type of one element."""
    if kind.name == "char" and kind.is_const and kind.pointers == 1:
        return "'str'"
    if kind.pointers:
        return "'void *'"
    if header.struct(kind.name):
        return f"T.{kind.name}"
    if header.has_type(kind.name):
        return f"koffi.pointer(T.{kind.name})"
    return f"'{'int32_t' if kind.name == 'msq_status' else kind.name}'"


def _field(kind: Type, header: Header) -> str:
    element = _element(kind, header)
    return f"koffi.array({element}, {kind.length})" if kind.length else element


def _is_struct(one: Member, header: Header) -> bool:
    """Whether an argument is one struct, which koffi converts from and to an object."""
    is_array = one.count and one.count != "size"  # that of a struct, which an _init takes
    return one.type.pointers == 1 and bool(header.struct(one.type.name)) and not is_array


def _argument(one: Member, header: Header) -> str:
    kind = one.type
    if kind.name in header.handles and one.direction == "out":
        return "koffi.out(koffi.pointer('void *'))"
    if _is_struct(one, header):
        pointer = f"koffi.pointer(T.{kind.name})"
        return pointer if one.direction == "in" else f"koffi.{one.direction}({pointer})"
    return _element(kind, header)


def _result(kind: Type) -> str:
    return "'void'" if kind.name == "void" and not kind.pointers else _element(kind, Header())


def write(header: Header) -> str:
    lines = ["// SPDX-License-Identifier: Apache-2.0",
             "// Made from msq.h by bindings/make_bindings.py: change those."]
    lines += [f"export const {name} = {value};" for name, value in constants_of(header).items()]
    lines += ["", "// Structs and callbacks as types of koffi.", "export function types(koffi) {",
              "  const T = {};"]
    for one in header.types:
        if isinstance(one, Struct):
            lines.append(f"  T.{one.name} = koffi.struct('{one.name}', {{")
            lines += [f"    {field.name}: {_field(field.type, header)}," for field in one.fields]
            lines.append("  });")
        else:  # structs that a callback gets are decoded by it
            arguments = ", ".join(_element(argument.type, header) for argument in one.arguments)
            lines.append(f"  T.{one.name} = koffi.proto('{one.name}', {_result(one.result)}, "
                         f"[{arguments}]);")
    lines += ["  return T;", "}", "", "// Functions of a library that koffi has loaded.",
              "export function functions(koffi, library, T) {", "  return {"]
    for function in header.functions:
        arguments = ", ".join(_argument(one, header) for one in function.arguments)
        lines.append(f"    {function.name}: library.func('{function.name}', "
                     f"{_result(function.result)}, [{arguments}]),")
    return "\n".join([*lines, "  };", "}"]) + "\n"


def _ts_element(kind: Type, header: Header, is_argument: bool = False) -> str:
    if kind.name == "char" and kind.is_const and kind.pointers == 1:
        return "string | null"
    if kind.pointers:
        return "Memory"
    if header.has_type(kind.name) and not header.struct(kind.name):
        return f"{kind.name} | bigint | null"
    if header.struct(kind.name):
        return kind.name
    return "number | bigint" if kind.name in WIDE else "number"


def _ts_field(kind: Type, header: Header) -> str:
    element = _ts_element(kind, header)
    return f"ArrayLike<{element}>" if kind.length else element


def _ts_argument(one: Member, header: Header) -> str:
    if one.type.name in header.handles and one.direction == "out":
        return "[Pointer]"
    if _is_struct(one, header):
        name = one.type.name if one.direction == "in" else f"Partial<{one.type.name}>"
        return f"{name} | null" if one.nullable or one.direction == "in" else name
    return _ts_element(one.type, header)


def _doc(text: str, indent: str = "") -> List[str]:
    if not text:
        return []
    lines = text.replace("*/", "* /").splitlines()
    if len(lines) == 1:
        return [f"{indent}/** {lines[0]} */"]
    return [f"{indent}/**", *(f"{indent} * {line}".rstrip() for line in lines), f"{indent} */"]


def _signature(function: Function, header: Header, in_callback: bool) -> str:
    made = []
    for one in function.arguments:
        kind = _ts_element(one.type, header) if in_callback else _ts_argument(one, header)
        made.append(f"{one.name}: {'bigint | null' if in_callback and one.type.pointers else kind}")
    result = function.result
    if result.name == "void" and not result.pointers:
        returned = "void"
    else:
        returned = "string" if result.name == "char" else "number"
    return f"({', '.join(made)})" + (" => " if in_callback else ": ") + returned


def write_types(header: Header) -> str:
    lines = ["// SPDX-License-Identifier: Apache-2.0",
             "// Made from msq.h by bindings/make_bindings.py: change those.",
             "", "/** An address, or null. */", "export type Pointer = bigint | null;",
             "/** An address, or memory of JavaScript that C reads or writes during the call. */",
             "export type Memory = Pointer | NodeJS.TypedArray | ArrayBuffer;"]
    docs = {name: text for enum in header.enums for name, text in enum.docs.items()}
    for name, value in constants_of(header).items():
        lines += [*_doc(docs.get(name, "")), f"export declare const {name} = {value};"]
    for one in header.types:
        lines += ["", *_doc(one.doc)]
        if isinstance(one, Struct):
            lines.append(f"export interface {one.name} {{")
            for field in one.fields:
                lines += [*_doc(field.doc, "  "),
                          f"  {field.name}: {_ts_field(field.type, header)};"]
            lines.append("}")
        else:
            lines.append(f"export type {one.name} = {_signature(one, header, True)};")
    lines += ["", "/** The functions of msq.h. */", "export interface Functions {"]
    for function in header.functions:
        lines += [*_doc(function.doc, "  "),
                  f"  {function.name}{_signature(function, header, False)};"]
    definitions = [one.name[4:] for one in header.structs
                   if any(function.name == f"{one.name}_init" for function in header.functions)]
    reports = [one.name[4:] for one in header.structs if one.name.endswith("_report")]
    lines += ["}", "", "/** Structs with defaults, by their names without msq_. */",
              "export interface Definitions {",
              *(f"  {name}: msq_{name};" for name in definitions), "}",
              "", "/** Structs that msq fills in. */", "export interface Reports {",
              *(f"  {name}: msq_{name};" for name in reports), "}"]
    return "\n".join(lines) + "\n"
