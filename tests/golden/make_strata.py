#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Points of a stratified sample, from docs/seeds.md alone: tests/api/test_msq_points_generate.c holds
what this prints. Seed 42, 2 points in each of 1000^3 unit cells."""
from make_seeds import Sample

sample = Sample(42, 2, (1000, 1000, 1000))
for number in (0, 1, 2000, 1999999999):
    print("{%s}," % ", ".join("%.17g" % c for c in sample.point(number)))
