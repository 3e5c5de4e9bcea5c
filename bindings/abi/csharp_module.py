# SPDX-License-Identifier: Apache-2.0
"""csharp/Msq/Abi.cs: the declarations in C#.

All arguments and members are numbers and pointers, which no run time marshals. So DllImport (Mono, .NET
Framework, Unity) and LibraryImport (.NET 7 and later) pass them as they are.
"""
import os
from typing import List
from xml.sax.saxutils import escape

from header import Enum, Function, Header, Member, Struct, Type

SCALARS = {"char": "byte", "int8_t": "sbyte", "uint8_t": "byte", "int16_t": "short", "uint16_t": "ushort",
           "int32_t": "int", "uint32_t": "uint", "int64_t": "long", "uint64_t": "ulong", "size_t": "UIntPtr",
           "float": "float", "double": "double", "void": "void", "msq_status": "int"}
KEYWORDS = {"base", "checked", "event", "fixed", "in", "is", "lock", "object", "operator", "out", "params",
            "ref", "string", "this"}


def _name(name: str) -> str:
    return f"@{name}" if name in KEYWORDS else name


def _type(kind: Type, header: Header) -> str:
    if any(kind.name == call.name for call in header.callbacks):
        return "IntPtr"
    return SCALARS.get(kind.name, kind.name) + "*" * kind.pointers


def _field(one: Member, header: Header) -> str:
    kind = _type(one.type, header)
    if one.type.length:
        return f"public fixed {kind} {_name(one.name)}[{one.type.length}];"
    return f"public {kind} {_name(one.name)};"


def _doc(text: str, indent: str) -> List[str]:
    if not text:
        return []
    lines = escape(text).split("\n\n")
    if len(lines) == 1:
        return [f"{indent}/// <summary>{lines[0]}</summary>"]
    return [f"{indent}/// <summary>{lines[0]}</summary>", f"{indent}/// <remarks>",
            *(f"{indent}/// <para>{line}</para>" for line in lines[1:]), f"{indent}/// </remarks>"]


def _arguments(function: Function, header: Header) -> str:
    return ", ".join(f"{_type(one.type, header)} {_name(one.name)}" for one in function.arguments)


def _words(name: str) -> str:
    return "".join(part.capitalize() for part in name.split("_") if part)


def _prefix(enum: Enum) -> str:
    """What the names of an enum begin with: MSQ_LAYER_. Of one with a single value: the words of its
    own name."""
    names = [*enum.values, enum.name.upper()] if len(enum.values) == 1 else list(enum.values)
    return os.path.commonprefix(names).rpartition("_")[0] + "_"


def enum_names(enum: Enum) -> List[str]:
    """The names that values have in C#: MSQ_LAYER_MIRROR_X is MirrorX."""
    prefix = _prefix(enum)
    found = []
    for name in enum.values:
        words = name[len(prefix):]
        if enum.name == "msq_status_code" and words.startswith("E_"):
            words = words[2:]
        if words[0].isdigit():  # MSQ_FORMAT_3MF
            words = f"{prefix.split('_')[-2]}_{words}"
        found.append(_words(words))
    return found


def _enum(enum: Enum) -> List[str]:
    lines = ["", *_doc(enum.doc, "    "), f"    public enum {_words(enum.name[4:])}", "    {"]
    for (label, value), name in zip(enum.values.items(), enum_names(enum)):
        lines += [*_doc(enum.docs[label], "        "), f"        {name} = {value},"]
    return lines + ["    }"]


def _struct(one: Struct, header: Header) -> List[str]:
    lines = ["", *_doc(one.doc, "    "), "    [StructLayout(LayoutKind.Sequential)]",
             f"    public unsafe struct {one.name}", "    {"]
    for field in one.fields:
        lines += [*_doc(field.doc, "        "), f"        {_field(field, header)}"]
    if any(function.name == f"{one.name}_init" for function in header.functions):
        lines += ["", "        /// <summary>One with the defaults of msq.</summary>",
                  f"        public static {one.name} Defaults()", "        {",
                  f"            {one.name} made;",
                  f"            MsqException.Check(Abi.{one.name}_init(&made, (UIntPtr)sizeof({one.name})));",
                  "            return made;", "        }"]
    return lines + ["    }"]


def _callback(one: Function, header: Header) -> List[str]:
    return ["", *_doc(one.doc, "    "), "    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]",
            f"    public unsafe delegate {_type(one.result, header)} {one.name}({_arguments(one, header)});"]


def _function(one: Function, header: Header) -> List[str]:
    return ["", *_doc(one.doc, "        "), "#if NET7_0_OR_GREATER",
            "        [LibraryImport(Library), UnmanagedCallConv(CallConvs = new[] { typeof(CallConvCdecl) })]",
            "        public static partial", "#else",
            "        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]",
            "        public static extern", "#endif",
            f"        {_type(one.result, header)} {one.name}({_arguments(one, header)});"]


def write(header: Header) -> str:
    lines = ["// SPDX-License-Identifier: Apache-2.0",
             "// Made from msq.h by bindings/make_bindings.py: change those.",
             "using System;", "using System.Runtime.CompilerServices;",
             "using System.Runtime.InteropServices;", "", "namespace Msq", "{"]
    for index, enum in enumerate(header.enums):
        lines += _enum(enum)[index == 0:]
    lines += ["}", "", "namespace Msq.Interop", "{"]
    for index, (name, doc) in enumerate(header.handles.items()):
        lines += ["", *_doc(doc, "    "), f"    public struct {name}", "    {", "    }"][index == 0:]
    for one in header.types:
        lines += _struct(one, header) if isinstance(one, Struct) else _callback(one, header)
    lines += ["", "    /// <summary>The functions and constants of msq.h.</summary>",
              "    public static unsafe partial class Abi", "    {"]
    for name, number in header.versions.items():
        lines.append(f"        public const uint {name} = {number};")
    for enum in header.enums:
        lines += [f"        public const int {name} = {value};" for name, value in enum.values.items()]
    for function in header.functions:
        lines += _function(function, header)
    return "\n".join([*lines, "    }", "}"]) + "\n"
