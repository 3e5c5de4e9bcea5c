#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The shared library exports exactly the functions that its header declares.

usage: check_exports.py [--nm PROGRAM] msq.h libmsq.so
"""
import argparse
import subprocess
import sys

from declared import declared_functions

parser = argparse.ArgumentParser()
parser.add_argument("--nm", default="nm")
parser.add_argument("header")
parser.add_argument("library")
arguments = parser.parse_args()

listing = subprocess.run([arguments.nm, "-D", "--defined-only", arguments.library], check=True,
                         capture_output=True, text=True).stdout
exported = {}
for line in listing.splitlines():
    fields = line.split()
    kind, name = fields[-2], fields[-1].split("@")[0]
    if kind != "A":  # names of symbol versions
        exported[name] = kind

declared = set(declared_functions(arguments.header))
errors = [f"declared but not exported: {name}" for name in sorted(declared - set(exported))]
errors += [f"exported but not declared: {name}" for name in sorted(set(exported) - declared)]
errors += [f"exported, but as {exported[name]}, not as code: {name}"
           for name in sorted(declared & set(exported)) if exported[name] != "T"]
if errors:
    sys.exit("\n".join(errors))
print(f"{len(declared)} functions declared and exported")
