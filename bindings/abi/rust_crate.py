# SPDX-License-Identifier: Apache-2.0
"""rust/msq-sys/src/lib.rs: the declarations in Rust."""
from typing import List

from header import Function, Header, Member, Struct, Type

SCALARS = {"char": "c_char", "int8_t": "i8", "uint8_t": "u8", "int16_t": "i16", "uint16_t": "u16",
           "int32_t": "i32", "uint32_t": "u32", "int64_t": "i64", "uint64_t": "u64",
           "size_t": "usize", "float": "f32", "double": "f64", "void": "c_void"}
KEYWORDS = {"type", "fn", "in", "box", "final", "ref", "match", "move", "loop"}


def _name(name: str) -> str:
    return f"r#{name}" if name in KEYWORDS else name


def _type(kind: Type) -> str:
    result = SCALARS.get(kind.name, kind.name)
    for depth in range(kind.pointers):
        # The inner pointers of `const T* const*` are as constant as the outer.
        result = f"*{'const' if kind.is_const else 'mut'} {result}"
    return result


def _field(kind: Type) -> str:
    return f"[{_type(kind)}; {kind.length}]" if kind.length else _type(kind)


def _doc(text: str, indent: str = "") -> List[str]:
    return [f"{indent}/// {line}".rstrip() for line in text.splitlines()]


def _arguments(arguments: List[Member]) -> str:
    return ", ".join(f"{_name(one.name)}: {_type(one.type)}" for one in arguments)


def _result(function: Function) -> str:
    if function.result.name == "void" and not function.result.pointers:
        return ""
    return f" -> {_type(function.result)}"


def write(header: Header) -> str:
    lines = ["// SPDX-License-Identifier: Apache-2.0",
             "// Made from msq.h by bindings/make_bindings.py: change those.",
             "//! The C ABI of msq. The crate `msq` wraps it safely.",
             "#![allow(non_camel_case_types)]",
             "// The comments are those of the C header.",
             "#![allow(rustdoc::all)]", "",
             "use std::os::raw::{c_char, c_void};", "", "pub type msq_status = i32;"]
    for name, value in header.versions.items():
        lines += ["", f"pub const {name}: u32 = {value};"]
    for enum in header.enums:
        for name, value in enum.values.items():
            lines += ["", *_doc(enum.docs[name]), f"pub const {name}: i32 = {value};"]
    for name, doc in header.handles.items():
        lines += ["", *_doc(doc), "#[repr(C)]", f"pub struct {name} {{", "    _opaque: [u8; 0],",
                  "}"]
    for one in header.types:
        lines += ["", *_doc(one.doc)]
        if isinstance(one, Struct):
            lines += ["#[repr(C)]", "#[derive(Clone, Copy)]", f"pub struct {one.name} {{"]
            for field in one.fields:
                lines += [*_doc(field.doc, "    "),
                          f"    pub {_name(field.name)}: {_field(field.type)},"]
            lines += ["}"]
        else:
            lines += [f"pub type {one.name} = Option<",
                      f'    unsafe extern "C" fn({_arguments(one.arguments)}){_result(one)},', ">;"]
    lines += ["", 'extern "C" {']
    for function in header.functions:
        lines += [*_doc(function.doc, "    "),
                  f"    pub fn {function.name}({_arguments(function.arguments)})"
                  f"{_result(function)};"]
    lines += ["}", "", '#[cfg(all(test, target_pointer_width = "64"))]', "#[test]",
              "fn structs_have_the_sizes_of_c() {"]
    lines += [f"    assert_eq!(std::mem::size_of::<{one.name}>(), {one.size});"
              for one in header.structs]
    return "\n".join(lines + ["}"]) + "\n"
