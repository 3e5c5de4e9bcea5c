#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""abi.json has the sizes, offsets and values that a C compiler gives to msq.h.

usage: check_layout.py COMPILER ABI_JSON INCLUDE_FOLDER
"""
import json
import pathlib
import subprocess
import sys
import tempfile


def main():
    compiler, description, include = sys.argv[1:]
    abi = json.loads(pathlib.Path(description).read_text(encoding="utf-8"))
    lines = ["#include <msq.h>", "#include <stddef.h>"]
    checks = []  # what is compared on each line

    def check(expression, expected):
        checks.append((len(lines) + 1, f"{expression} == {expected}"))
        lines.append(f"typedef char check_{len(checks)}[({expression}) == ({expected}) ? 1 : -1];")

    for struct in abi["structs"]:
        name = struct["name"]
        check(f"sizeof({name})", struct["size"])
        for field in struct["fields"]:
            check(f"offsetof({name}, {field['name']})", field["offset"])
            length = field["type"].get("length")
            if length:
                member = f"(({name}*)0)->{field['name']}"
                check(f"sizeof({member}) / sizeof({member}[0])", length)
    for enum in abi["enums"]:
        for value in enum["values"]:
            check(value["name"], value["value"])
    for name, value in abi["versions"].items():
        check(name, value)
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder, "layout.c")
        source.write_text("\n".join(lines) + "\n", encoding="utf-8")
        done = subprocess.run([compiler, "-std=c99", "-w", "-fsyntax-only", f"-I{include}", str(source)],
                              stderr=subprocess.PIPE, text=True)
    wrong = [text for line, text in checks if f"layout.c:{line}:" in done.stderr]
    if done.returncode != 0 or len(checks) < 300:
        print("\n".join(f"not so: {text}" for text in wrong) or done.stderr)
        return 1
    print(f"{len(checks)} sizes, offsets and values agree")
    return 0


if __name__ == "__main__":
    sys.exit(main())
