#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""librsvg draws the contours that msq_io wrote as the bits of the same layers.

A pixel that librsvg covers by more than a half is inside at its centre, except where the boundary
passes near: there the contours are within their tolerance, a tenth of a pixel, and coverage differs
from the sample. Pixels whose neighbours are all alike must agree.

usage: check_svg.py write_samples rsvg-convert
"""
import pathlib
import re
import subprocess
import sys
import tempfile

import png_rows


def draw(program, path, width, height, channel, *more):
    """Rows of one of the channels red, green, blue and opacity."""
    said = subprocess.run([program, "-w", str(width), "-h", str(height), "-f", "png", *more,
                           str(path)], check=True, capture_output=True).stdout
    rows, header = png_rows.read(said)
    assert header[:2] == (width, height)
    channels = len(rows[0]) // width
    return [row[channel % channels::channels] for row in rows]


def compare(cover, inside, name):
    """Fails if they differ away from the boundary, or by more than a few pixels along it."""
    wrong = edge = 0
    for y in range(1, len(inside) - 1):
        for x in range(1, len(inside[0]) - 1):
            own = inside[y][x]
            near = (inside[y - 1][x], inside[y + 1][x], inside[y][x - 1], inside[y][x + 1])
            at_edge, differs = any(other != own for other in near), (cover[y][x] > 127) != own
            assert at_edge or not differs, f"{name}: pixel {x}, {y}"
            edge += at_edge
            wrong += differs
    # A straight boundary splits coverage at the centre; bends and the rim of the tolerance remain.
    assert wrong < 0.03 * edge, f"{name}: {wrong} of {edge} at the boundary"
    return wrong, edge


def bits(raw, width, height):
    """Rows of a layer of 1-bit pixels, y upwards."""
    size = (width + 7) // 8
    rows = [raw[y * size:(y + 1) * size] for y in range(height)]
    return [[row[x // 8] >> (7 - x % 8) & 1 == 1 for x in range(width)] for row in rows[::-1]]


def main():
    program, converter = sys.argv[1:]
    if converter.endswith("NOTFOUND"):
        print("skipped: no rsvg-convert (Debian: librsvg2-bin)")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        said = subprocess.run([program, "svg", folder], check=True, capture_output=True, text=True).stdout
        width, height, count = map(int, said.split())
        assert (width, height, count) == (200, 125, 4)
        folder = pathlib.Path(folder)
        raw = (folder / "layers.raw").read_bytes()
        size = len(raw) // count
        layers = [bits(raw[k * size:(k + 1) * size], width, height) for k in range(count)]
        stack = (folder / "sample.svg").read_text(encoding="utf-8")
        groups = re.findall(r'<g id="layer(\d+)" slic3r:z="([\d.]+)">\n(.*?)</g>', stack, flags=re.S)
        assert [int(g[0]) for g in groups] == list(range(count))
        assert [float(g[1]) for g in groups] == [3.25, 3.75, 4.25, 4.75]
        assert stack.startswith("<?xml") and 'width="8mm" height="5mm" viewBox="0 0 8 5"' in stack
        wrong = edge = 0
        for k in range(count):
            cover = draw(converter, folder / f"files/layer{k:05d}.svg", width, height, 3)
            a, b = compare(cover, layers[k], f"layer {k}")
            wrong, edge = wrong + a, edge + b
            # The polygons of the stack, in their order.
            head = stack[:stack.index("<g id")]
            (folder / "group.svg").write_text(f"{head}{groups[k][2]}</svg>\n", encoding="utf-8")
            image = draw(converter, folder / "group.svg", width, height, 0,
                         "--background-color=black")
            compare(image, layers[k], f"group {k}")
            assert len(re.findall('slic3r:type="contour"', groups[k][2])) > 0
    print(f"{count} layers, {wrong} of {edge} pixels at the boundary differ")
    return 0


sys.exit(main())
