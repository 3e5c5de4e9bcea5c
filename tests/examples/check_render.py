#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""render draws the parts that it is given, in the middle of the picture, the same each time, and
says what is wrong with its options.

usage: check_render.py RENDER
"""
import pathlib
import subprocess
import sys
import tempfile

import png_pixels

program = sys.argv[1]
problems = []


def expect(condition, text):
    if not condition:
        problems.append(text)


with tempfile.TemporaryDirectory() as temporary:
    folder = pathlib.Path(temporary)

    def render(name, *options):
        done = subprocess.run([program, "-o", str(folder / name), "--size", "120,90", *options],
                              capture_output=True, text=True, timeout=240)
        if done.returncode != 0:
            sys.exit(f"{name}: {done.returncode}, {done.stdout}{done.stderr}")
        width, height, rows = png_pixels.read(folder / name)
        expect((width, height) == (120, 90), f"{name}: {width} x {height} pixels")
        return rows

    def expect_refused(text, *options):
        done = subprocess.run([program, "-o", str(folder / "no.png"), *options],
                              capture_output=True, text=True, timeout=240)
        expect(done.returncode in (1, 2) and text in done.stderr and not (folder / "no.png").exists(),
               f"{options}: {done.returncode}, not refused with \"{text}\": {done.stderr}")

    def middle_of(rows):
        """Of what is not background, and how much that is."""
        part = [(x, y) for y, row in enumerate(rows) for x, pixel in enumerate(row)
                if png_pixels.differ(pixel, rows[y][0], 24)]
        count = max(len(part), 1)
        return sum(x for x, _ in part) / count, sum(y for _, y in part) / count, len(part) / 10800

    lattice = ["block:20", "--fill", "cubic:10:1.5", "--samples", "2"]
    plain = render("plain.png", *lattice, "--plain")
    x, y, share = middle_of(plain)
    expect(abs(x - 60) < 4 and abs(y - 45) < 4 and 0.15 < share < 0.7,
           f"plain.png: middle at {x:.0f}, {y:.0f}, {100 * share:.0f} % covered")
    render("again.png", *lattice, "--plain")
    expect((folder / "again.png").read_bytes() == (folder / "plain.png").read_bytes(),
           "the same command gives another picture")
    staged = render("staged.png", *lattice, "--glass")
    expect(middle_of(staged)[2] > share + 0.02, "no shadow on the ground")
    seen = render("perspective.png", *lattice, "--plain", "--perspective", "40")
    expect(seen != plain and abs(middle_of(seen)[0] - 60) < 4, "perspective.png is off")
    near = render("near.png", *lattice, "--plain", "--zoom", "3", "--at", "10,-10,10")
    expect(near != plain, "zoom changes nothing")
    cut = render("cut.png", *lattice, "--plain", "--cut", "y:0")
    expect(cut != plain and middle_of(cut)[2] < share, "the cut takes nothing away")
    nested = render("nested.png", "block:20", "--plain", "--fill", "cubic:10:3+gyroid:2:0.3")
    expect(middle_of(nested)[2] > 0.1, "nothing of nested structures is seen")

    foam = ["block:20", "--plain", "--samples", "1", "--fill", "foam:10:0.6"]
    dense = render("dense.png", *foam, "--density", "8:4+x")
    expect(middle_of(dense)[2] > middle_of(render("foam.png", *foam))[2], "density adds no struts")

    expect_refused("cheese: no structure", "block:20", "--fill", "cheese:4:1")
    expect_refused("a term is NAME:CELL", "block:20", "--fill", "foam")
    expect_refused("a cut is x:MM", "block:20", "--cut", "w:3")
    expect_refused("a density is MOST:EXPRESSION", "block:20", "--density", "4")
    expect_refused("x1: not a value", "block:20", "--zoom", "x1")
    expect_refused("no_such.nrrd", str(folder / "no_such.nrrd"))
    expect_refused("usage", "block:20", "block:20")
    expect_refused("width", "block:20", "--size", "0,90")

if problems:
    sys.exit("\n".join(problems))
print("render draws what it should")
