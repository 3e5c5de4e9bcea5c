# SPDX-License-Identifier: Apache-2.0
"""abi.json: the description of msq.h for makers of bindings in other languages."""
import json
from typing import Any, Dict

from header import Function, Header, Member, Type


def _type(kind: Type) -> Dict[str, Any]:
    made: Dict[str, Any] = {"name": kind.name}
    if kind.is_const:
        made["const"] = True
    if kind.pointers:
        made["pointers"] = kind.pointers
    if kind.length:
        made["length"] = kind.length
    return made


def _member(one: Member) -> Dict[str, Any]:
    made: Dict[str, Any] = {"name": one.name, "type": _type(one.type)}
    for key in ("direction", "nullable", "count", "doc"):
        if getattr(one, key):
            made[key] = getattr(one, key)
    return made


def _function(one: Function) -> Dict[str, Any]:
    made = {"name": one.name, "doc": one.doc, "result": _type(one.result),
            "arguments": [_member(argument) for argument in one.arguments]}
    if one.errors:
        made["errors"] = one.errors
    return made


def write(header: Header) -> str:
    return json.dumps({
        "about": "The C ABI of msq, made from include/msq.h by bindings/make_bindings.py.",
        "versions": header.versions,
        "enums": [{"name": enum.name, "doc": enum.doc, "values": [
            {"name": name, "value": value, "doc": enum.docs[name]}
            for name, value in enum.values.items()]} for enum in header.enums],
        "handles": [{"name": name, "doc": doc} for name, doc in header.handles.items()],
        # Sizes and offsets are those of 64-bit machines.
        "structs": [{"name": one.name, "doc": one.doc, "size": one.size,
                     "fields": [{**_member(field), "offset": offset}
                                for field, offset in zip(one.fields, one.offsets)]}
                    for one in header.structs],
        "callbacks": [_function(one) for one in header.callbacks],
        "functions": [_function(one) for one in header.functions],
    }, indent=1, ensure_ascii=False) + "\n"
