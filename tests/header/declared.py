#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Lists the functions that msq.h declares, or writes a C program that takes all their addresses.

usage: declared.py msq.h [--program all_functions.c]
"""
import re
import sys


def declared_functions(header):
    """Names of the functions declared in the header, in order. Fails on one without MSQ_API."""
    with open(header, encoding="utf-8") as file:
        text = file.read()
    text = re.sub(r"/\*.*?\*/", " ", text, flags=re.S)
    text = re.sub(r"^[ \t]*#(?:.*\\\n)*.*$", "", text, flags=re.M)
    names, bare = [], []
    for statement in re.split(r"[;{}]", text):
        if "typedef" in statement:
            continue
        match = re.search(r"\b(\w+)\s*\(", statement)
        if match is None:
            continue
        (names if re.match(r"\s*MSQ_(IO_)?API\b", statement) else bare).append(match.group(1))
    if bare:
        sys.exit(f"{header}: declared without MSQ_API: {', '.join(bare)}")
    if not names:
        sys.exit(f"{header}: declares no function")
    if len(set(names)) != len(names):
        sys.exit(f"{header}: declares a function twice")
    return names


def write_program(names, path):
    lines = ["/* Made from msq.h by declared.py. */", '#include "msq.h"', "",
             "typedef void (*function)(void);", "", "static function volatile functions[] = {"]
    lines += [f"    (function){name}," for name in names]
    lines += ["};", "", "int main(void) {", "  size_t i;",
              "  for (i = 0; i < sizeof functions / sizeof *functions; ++i) {",
              "    if (functions[i] == NULL) return 1;", "  }",
              "  return msq_version() == MSQ_VERSION ? 0 : 1;", "}", ""]
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines))


if __name__ == "__main__":
    found = declared_functions(sys.argv[1])
    if len(sys.argv) == 4 and sys.argv[2] == "--program":
        write_program(found, sys.argv[3])
    elif len(sys.argv) == 2:
        print("\n".join(found))
    else:
        sys.exit(__doc__)
