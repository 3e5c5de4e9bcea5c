#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A build without an optional library reaches none of its headers and links none of its libraries.

Headers are read from what the compiler recorded for each object of the library, so headers that
come in through others count too.

usage: check_absent.py cgal|assimp|xxhash|json|tiff --source DIR --build DIR --library FILE [--objdump PROGRAM]
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys

HEADERS = {"cgal": r"/(CGAL|boost)/|/(gmp|gmpxx|mpfr)\.h$",
           "assimp": r"/assimp/|/pugixml\.hpp$|/minizip/|/zlib\.h$",
           "xxhash": r"/xxh\w*\.h$",
           "json": r"/nlohmann/",
           "tiff": r"/tiff\w*\.h$"}
LIBRARIES = {"cgal": r"lib(CGAL|gmp|mpfr|boost)", "assimp": r"lib(assimp|pugixml|minizip|z\.so)",
             "xxhash": r"libxxhash", "json": r"libnlohmann", "tiff": r"libtiff"}


def recorded_headers(build, entry):
    """Headers that the compiler read for one entry of compile_commands.json."""
    output = re.search(r"\s-o (\S+)", entry["command"]).group(1)
    target = pathlib.Path(entry["directory"]) / output
    depfile = target.with_name(target.name + ".d")
    if depfile.is_file():  # Makefiles
        return depfile.read_text(encoding="utf-8").replace("\\\n", " ").split()[1:]
    listing = subprocess.run(["ninja", "-C", str(build), "-t", "deps", output], check=True,
                             capture_output=True, text=True).stdout
    return [line.strip() for line in listing.splitlines() if line.startswith("    ")]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("part", choices=sorted(HEADERS))
    parser.add_argument("--source", type=pathlib.Path, required=True)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--library", type=pathlib.Path, required=True)
    parser.add_argument("--objdump", default="objdump")
    arguments = parser.parse_args()

    commands = json.loads((arguments.build / "compile_commands.json").read_text(encoding="utf-8"))
    sources = (arguments.source / "src").resolve()
    errors, objects = [], 0
    for entry in commands:
        file = pathlib.Path(entry["file"]).resolve()
        if sources not in file.parents:
            continue
        headers = recorded_headers(arguments.build, entry)
        if not headers:
            errors.append(f"{file}: the build recorded no headers")
        objects += 1
        errors += [f"{file} reaches {header}" for header in headers
                   if re.search(HEADERS[arguments.part], header)]
    if objects == 0:
        errors.append(f"{arguments.build}: no objects of the library")

    if ".so" in arguments.library.name:
        listing = subprocess.run([arguments.objdump, "-p", str(arguments.library)], check=True,
                                 capture_output=True, text=True).stdout
        needed = re.findall(r"NEEDED\s+(\S+)", listing)
        if not needed:
            errors.append(f"{arguments.library}: no needed libraries listed")
        errors += [f"{arguments.library} needs {name}" for name in needed
                   if re.match(LIBRARIES[arguments.part], name)]
    if errors:
        sys.exit("\n".join(errors))
    print(f"{objects} objects, none of which reaches {arguments.part}")


main()
