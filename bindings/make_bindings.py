#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes what bindings are made from: the declarations of msq.h in other languages, and those of
msq_io.h in Python.

    python3 bindings/make_bindings.py [--check] [--header msq.h] [--output folder]

With --header msq_io.h is left out.

--check writes nothing, and fails where a file is not what the header makes.
"""
import argparse
import difflib
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE / "abi"))
import csharp_module  # noqa: E402
import ctypes_module  # noqa: E402
import json_file  # noqa: E402
import julia_module  # noqa: E402
import lua_module  # noqa: E402
import node_module  # noqa: E402
import rust_crate  # noqa: E402
from header import HeaderError, read_header  # noqa: E402

WRITERS = {
    "abi.json": json_file.write,
    "csharp/Msq/Abi.cs": csharp_module.write,
    "julia/abi.jl": julia_module.write,
    "luajit/msq_cdef.lua": lua_module.write,
    "node/abi.d.ts": node_module.write_types,
    "node/abi.js": node_module.write,
    "python/msq/_abi.py": ctypes_module.write,
    "rust/msq-sys/src/lib.rs": rust_crate.write,
}


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--header", type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path, default=HERE)
    arguments = parser.parse_args()
    include = HERE.parent / "include"
    path = arguments.header or include / "msq.h"
    try:
        header = read_header(path)
        texts = {name: write(header) for name, write in WRITERS.items()}
        if not arguments.header:
            path = include / "msq_io.h"
            texts["python/msq/_io_abi.py"] = ctypes_module.write(read_header(path, header))
    except HeaderError as error:
        sys.exit(f"{path}: make_bindings.py does not read this: {error}")
    stale = 0
    for name, text in texts.items():
        path = arguments.output / name
        if not arguments.check:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
            continue
        committed = path.read_text(encoding="utf-8") if path.exists() else ""
        if committed != text:
            stale += 1
            sys.stdout.writelines(difflib.unified_diff(
                committed.splitlines(True), text.splitlines(True), str(path), "of the header"))
            print(f"{name} is not what the header declares; run: python3 bindings/make_bindings.py")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
