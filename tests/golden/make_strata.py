#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Points of a stratified sample, from their definition alone: tests/api/test_msq_points_generate.c
holds what this prints. Seed 42, 2 points in each of 1000^3 unit cells."""

MASK = (1 << 64) - 1


def finalise(x):
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9 & MASK
    x = (x ^ (x >> 27)) * 0x94D049BB133111EB & MASK
    return x ^ (x >> 31)


def fraction(key, n):
    return (finalise((key + n * 0x9E3779B97F4A7C15) & MASK) >> 11) / 2.0**53


def point(seed, per_cell, side, number):
    key = finalise(finalise((seed + 1) & MASK) ^ 0x73747261746966)
    cell = number // per_cell
    corner = (cell % side, cell // side % side, cell // side // side)
    return [corner[axis] + fraction(key, 3 * number + axis) for axis in range(3)]


for number in (0, 1, 2000, 1999999999):
    print("{%s}," % ", ".join("%.17g" % c for c in point(42, 2, 1000, number)))
