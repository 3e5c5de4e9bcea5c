#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The shared library takes next to nothing of the stacks of the host's threads (TLS), and has no
thread_local object with a destructor, at whose first touch the process would end where memory fails.

usage: check_tls.py [--nm PROGRAM] libmsq.so
"""
import argparse
import struct
import subprocess
import sys

MOST_BYTES = 1024
PT_TLS = 7


def tls_bytes(path):
    """Size of the TLS segment of a 64-bit ELF file."""
    with open(path, "rb") as file:
        data = file.read()
    if data[:4] != b"\x7fELF" or data[4] != 2:
        sys.exit(f"{path}: not a 64-bit ELF file")
    order = "<" if data[5] == 1 else ">"
    (first,) = struct.unpack_from(order + "Q", data, 32)
    size, count = struct.unpack_from(order + "HH", data, 54)
    total = 0
    for i in range(count):
        kind = struct.unpack_from(order + "I", data, first + i * size)[0]
        if kind == PT_TLS:
            total += struct.unpack_from(order + "Q", data, first + i * size + 40)[0]
    return total


parser = argparse.ArgumentParser()
parser.add_argument("--nm", default="nm")
parser.add_argument("library")
arguments = parser.parse_args()

found = tls_bytes(arguments.library)
errors = []
if found > MOST_BYTES:
    errors.append(f"{found} bytes of TLS; the limit is {MOST_BYTES}")
needed = subprocess.run([arguments.nm, "-D", "--undefined-only", arguments.library], check=True,
                        capture_output=True, text=True).stdout
if "__cxa_thread_atexit" in needed:
    errors.append("a thread_local object has a destructor")
if errors:
    sys.exit("\n".join(errors))
print(f"{found} bytes of TLS")
