#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""abidiff finds no change of the ABI but additions between the frozen header and the library.

usage: compare_libraries.py [--compiler PROGRAM] [--keep FOLDER]

Compiles, with debug information, functions that the frozen header declares, and the sources that define those of
the library; abidiff compares the two. Both are compiled by the same compiler, so no file of abidw needs to be kept.
Exit status: 0 no break, 1 a break, 77 no abidiff.
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = ROOT / "tests" / "header"
FROZEN = HERE / "frozen" / "msq_0_2.h"
DECLARED = re.compile(r"^MSQ_API\s+([\w\s*]+?[\s*])(\w+)\s*\(([^)]*)\)\s*;", re.M)


def definitions(header):
    """C++ that defines every function of a header."""
    lines = ["#define MSQ_BUILDING", f'#include "{header}"']
    for result, name, arguments in DECLARED.findall(header.read_text(encoding="utf-8")):
        body = "" if result.strip() == "void" else " return 0; "
        lines.append(f"{result} {name}({arguments}) {{{body}}}")
    return "\n".join(lines) + "\n"


def sources():
    """C++ that includes the sources in which the functions of the library are defined."""
    files = [*sorted((ROOT / "src" / "api").glob("*.cpp")), *sorted((ROOT / "src" / "document").glob("*.cpp"))]
    return "".join(f'#include "{file}"\n' for file in files)


def compiled(compiler, text, path):
    """What a library exports is listed by the linker map; what these sources call may be missing."""
    path.with_suffix(".cpp").write_text(text, encoding="utf-8")
    subprocess.run([compiler, "-std=c++20", "-O0", "-g", "-w", "-fPIC", "-DMSQ_BUILDING", f"-I{ROOT}/src",
                    f"-I{ROOT}/include", "-shared", f"-Wl,--version-script={ROOT}/src/api/msq.map", "-Wl,-z,undefs",
                    str(path.with_suffix(".cpp")), "-o", str(path)], check=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--compiler", default="c++")
    parser.add_argument("--keep", type=pathlib.Path)
    arguments = parser.parse_args()
    if shutil.which("abidiff") is None:
        print("no abidiff; Debian: abigail-tools")
        return 77
    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        old, new = folder / "frozen.so", folder / "library.so"
        compiled(arguments.compiler, definitions(FROZEN), old)
        compiled(arguments.compiler, sources(), new)
        done = subprocess.run(["abidiff", "--no-added-syms", "--fail-no-debug-info", "--suppressions",
                               str(HERE / "additions.abignore"), str(old), str(new)],
                              stdout=subprocess.PIPE, text=True)
    if done.returncode:
        print(done.stdout)
        print(f"abidiff: the ABI is not that of {FROZEN.name} with additions")
        return 1
    count = len(DECLARED.findall(FROZEN.read_text(encoding="utf-8")))
    print(f"abidiff: {count} functions of {FROZEN.name} and their structs are as they were")
    return 0


if __name__ == "__main__":
    sys.exit(main())
