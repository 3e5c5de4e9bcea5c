#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Headers only add to what they declared when their version was frozen (docs/abi.md).

usage: check_abi.py frozen.h HEADER [frozen_base.h BASE_HEADER]
       check_abi.py --freeze HEADER frozen.h

Compares functions, callbacks, structs with the offsets of their fields, and constants. The base of msq_io.h is
msq.h. --freeze writes the frozen copy of a header: its C without the comments.
"""
import pathlib
import re
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bindings" / "abi"))
from header import SIZES, constants_of, read_header  # noqa: E402

# Elements of arrays that have the size of an element beside them.
SIZED_ELEMENTS = {"msq_scale_def"}


def text_of(kind):
    length = f"[{kind.length}]" if kind.length else ""
    return ("const " if kind.is_const else "") + kind.name + "*" * kind.pointers + length


def signature(function):
    arguments = ", ".join(text_of(one.type) for one in function.arguments) or "void"
    return f"{text_of(function.result)} {function.name}({arguments})"


def bytes_of(member, header):
    kind = member.type
    inner = None if kind.pointers else header.struct(kind.name)
    size = inner.size if inner else 8 if kind.pointers else SIZES.get(kind.name, 8)
    return size * max(kind.length, 1)


def struct_errors(old, new, old_header):
    """What a program that was compiled with `old` would find elsewhere in `new`."""
    name = old.name
    now = {one.name: (offset, text_of(one.type)) for one, offset in zip(new.fields, new.offsets)}
    free = set()  # bytes of reserved fields, which may get a meaning
    for one, offset in zip(old.fields, old.offsets):
        if one.name.startswith("reserved"):
            free |= set(range(offset, offset + bytes_of(one, old_header)))
            continue
        before = (offset, text_of(one.type))
        after = now.get(one.name)
        if after is None:
            yield f"{name}.{one.name} is gone"
        elif after != before:
            yield f"{name}.{one.name} was {before[1]} at byte {before[0]}, is {after[1]} at byte {after[0]}"
    known = {one.name for one in old.fields if not one.name.startswith("reserved")}
    for one, offset in zip(new.fields, new.offsets):
        if one.name in known or offset >= old.size:
            continue
        used = set(range(offset, offset + bytes_of(one, old_header)))
        if not used <= free:
            yield f"{name}.{one.name} is new at byte {offset}, which is not of a reserved field nor at the end"
    may_grow = old.fields[0].name == "struct_size" or name in SIZED_ELEMENTS
    if new.size < old.size:
        yield f"{name} had {old.size} bytes, has {new.size}"
    elif new.size > old.size and not may_grow:
        yield f"{name} has no size of its own; it had {old.size} bytes, has {new.size}"


def errors(old, new):
    values = constants_of(new)
    for enum in old.enums:
        for label, value in enum.values.items():
            if label not in values:
                yield f"{label} is gone"
            elif values[label] != value:
                yield f"{label} was {value}, is {values[label]}"
    for handle in old.handles:
        if handle not in new.handles:
            yield f"{handle} is gone"
    for what in ("callbacks", "functions"):
        now = {one.name: signature(one) for one in getattr(new, what)}
        for one in getattr(old, what):
            if one.name not in now:
                yield f"{one.name} is gone"
            elif now[one.name] != signature(one):
                yield f"was {signature(one)}, is {now[one.name]}"
    for one in old.structs:
        after = next((other for other in new.structs if other.name == one.name), None)
        if after is None:
            yield f"{one.name} is gone"
        else:
            yield from struct_errors(one, after, old)


def frozen(header, path):
    """The C of a header, a line per line, for the file at `path`."""
    text = re.sub(r"/\*.*?\*/", "", header.read_text(encoding="utf-8"), flags=re.S)
    text = re.sub(r"[ \t]+$", "", text, flags=re.M)
    text = re.sub(r"\n{2,}(?=[ }])", "\n", text)
    text = re.sub(r"\n{3,}", "\n\n", text).strip()
    suffix = re.sub(r"^msq(_io)?", "", path.stem)
    text = text.replace('#include "msq.h"', f'#include "msq{suffix}.h"')
    return ("/* SPDX-License-Identifier: Apache-2.0\n"
            f" * What {header.name} declared when its version was frozen, without the comments. Written by\n"
            " * tests/header/check_abi.py --freeze, and not edited: programs were compiled with this. */\n"
            f"/* clang-format off */\n{text}\n")


def main():
    arguments = [pathlib.Path(one) for one in sys.argv[1:] if one != "--freeze"]
    if "--freeze" in sys.argv and len(arguments) == 2:
        arguments[1].write_text(frozen(*arguments), encoding="utf-8")
        return 0
    if "--freeze" in sys.argv or len(arguments) not in (2, 4):
        sys.exit(__doc__)
    bases = [read_header(one) for one in arguments[2:]] or [None, None]
    old, new = (read_header(one, base) for one, base in zip(arguments, bases))
    found = list(errors(old, new))
    if found:
        print(f"{arguments[1].name} differs from {arguments[0].name}. Programs that were compiled with it would fail:")
        print("\n".join(found))
        return 1
    count = len(old.functions) + len(old.types) + sum(len(one.values) for one in old.enums)
    more = len(new.functions) + len(new.types) + sum(len(one.values) for one in new.enums) - count
    print(f"{count} functions, structs, callbacks and constants are as they were; {more} are new")
    return 0


if __name__ == "__main__":
    sys.exit(main())
