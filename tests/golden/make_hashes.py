#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Hashes of some definitions, from the bytes that src/base/hash_input.h describes and another binding of
XXH3 (Debian: python3-xxhash). tests/api/test_msq_*_hash.c hold what this prints.

usage: make_hashes.py
"""
import struct

import xxhash

IDENTITY = (1, 0, 0, 0, 1, 0, 0, 0, 1)
MASK = (1 << 64) - 1


def integer(value):
    return struct.pack("<Q", value)


def numbers(*values):
    return struct.pack(f"<{len(values)}d", *values)


def text(value):
    return integer(len(value)) + value.encode()


def digest(description):
    version = integer(1)
    return xxhash.xxh3_128(version + description).digest()


def finalise(x):
    """Of SplitMix64."""
    x = ((x ^ (x >> 30)) * 0xbf58476d1ce4e5b9) & MASK
    x = ((x ^ (x >> 27)) * 0x94d049bb133111eb) & MASK
    return x ^ (x >> 31)


def cube():
    """The mesh of make_cube_mesh() of tests/api/fixtures.h, welded in the order of its triangles."""
    triangles = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4),
                 (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)]
    order = []
    for triangle in triangles:
        order += [corner for corner in triangle if corner not in order]
    vertices = [4.0 * (corner >> axis & 1) for corner in order for axis in range(3)]
    indices = [order.index(corner) for triangle in triangles for corner in triangle]
    nonzero = integer(0)
    return digest(text("shape: mesh") + nonzero + integer(len(vertices)) + numbers(*vertices)
                  + integer(len(indices)) + struct.pack(f"<{len(indices)}I", *indices))


def expression():
    """(x + 2) * x, from 0 to 1."""
    nodes = [text("x"), text("constant") + numbers(2), text("+") + integer(0) + integer(1),
             text("*") + integer(0) + integer(2)]
    return digest(text("field: expression") + integer(len(nodes)) + b"".join(nodes) + numbers(0, 1))


no, yes = integer(0), integer(1)
box = digest(text("shape: box") + numbers(0, 0, 0, 4, 4, 4))
foam = digest(text("structure: foam of struts") + numbers(0, 0, 0, 1, 1, 1, *IDENTITY)
              + integer(finalise(0 + 1)) + integer(1 << 31)  # seed and jitter
              + no + no + numbers(0.15))  # not graded; the radius is no field
material = digest(text("material") + integer(7) + integer(1) + text("density") + no + numbers(2.5))
PRINTED = {
    "sphere": digest(text("shape: sphere") + numbers(1, -2, 0.5, 0.75)),
    "cube": cube(),
    "all space": digest(text("shape: all space")),
    "gradient": digest(text("field: gradient") + numbers(0, 0, 0, 0, 0, 10, 0.5, 2)),
    "expression": expression(),
    "foam": foam,
    "material": material,
    "model": digest(text("model") + box + yes + material + integer(1)
                    + foam + no + numbers(0.25) + no + no),
}
for name, value in PRINTED.items():
    print(f"{name}: {value.hex()}")
