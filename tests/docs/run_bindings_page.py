#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Builds and runs the program in bindings/README.md that is in one of the languages.

    python3 tests/docs/run_bindings_page.py LIBRARY LANGUAGE TOOL...

LIBRARY: the shared library. LANGUAGE: cpp, csharp, js or rust. TOOL: the C++ compiler; mcs, mono and Msq.dll; node;
cargo.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BINDINGS = ROOT / "bindings"
MANIFEST = f"""[package]
name = "page"
version = "0.0.0"
edition = "2021"
[dependencies]
msq = {{ path = "{BINDINGS / 'rust' / 'msq'}" }}
[workspace]
"""


def cpp(folder, library, compiler):
    return "main.cpp", [[compiler, "-std=c++17", f"-I{ROOT / 'include'}", f"-I{BINDINGS / 'cpp'}", "main.cpp", "-o",
                         "main", library], ["./main"]]


def csharp(folder, library, mcs, mono, assembly):
    return "Main.cs", [[mcs, "-langversion:7.2", "-warnaserror+", f"-r:{assembly}", "Main.cs", "-out:Main.exe"],
                       [mono, "Main.exe"]]


def js(folder, library, node):
    (folder / "node_modules").mkdir()
    (folder / "node_modules" / "msq").symlink_to(BINDINGS / "node")
    return "main.mjs", [[node, "main.mjs"]]


def rust(folder, library, cargo):
    (folder / "src").mkdir()
    (folder / "Cargo.toml").write_text(MANIFEST, encoding="utf-8")
    return "src/main.rs", [[cargo, "run", "--offline", "--quiet"]]


def main() -> int:
    library, language, *tools = sys.argv[1:]
    library = str(pathlib.Path(library).resolve())
    page = (BINDINGS / "README.md").read_text(encoding="utf-8")
    block, = re.findall(rf"^```{language}\n(.*?)^```$", page, flags=re.S | re.M)
    where = str(pathlib.Path(library).parent)
    environment = {**os.environ, "MSQ_LIBRARY": library, "MSQ_LIB_DIR": where, "LD_LIBRARY_PATH": where,
                   "MONO_PATH": str(pathlib.Path(tools[-1]).parent)}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        file, commands = {"cpp": cpp, "csharp": csharp, "js": js, "rust": rust}[language](folder, library, *tools)
        (folder / file).write_text(block, encoding="utf-8")
        for command in commands:
            done = subprocess.run(command, cwd=folder, env=environment, stdout=subprocess.PIPE, text=True, check=False)
            if done.returncode != 0:
                print(f"{' '.join(command)} ended with {done.returncode}")
                return 1
    # Each program prints the heights of the 20 layers of its part, one in a line.
    heights = re.findall(r"(?:^|= )(\d+\.\d+)", done.stdout, flags=re.M)
    print(done.stdout, end="")
    return 0 if [float(z) for z in heights] == [0.25 + 0.5 * k for k in range(20)] else 1


if __name__ == "__main__":
    sys.exit(main())
