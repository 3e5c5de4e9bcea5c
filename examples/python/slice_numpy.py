#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fills a part with a graded foam and writes its layers as PNGs, with the package, NumPy and zlib.

    python3 examples/python/slice_numpy.py examples/parts/bracket.stl -o out

With --layers it writes a range of them, so that several processes, on one machine or many, make the same
files as one: docs/howto/scale_out.md.

The package is found if it is installed or bindings/python is on PYTHONPATH; MSQ_LIBRARY may name
the shared library's file.
"""
import argparse
import pathlib
import struct
import sys
import time
import zlib

import numpy as np

import msq


def write_png(path, rows, width, depth):
    """A greyscale PNG of rows (height, bytes) with `depth` bits a pixel, row 0 on top."""
    def chunk(kind, body):
        named = kind + body
        return struct.pack(">I", len(body)) + named + struct.pack(">I", zlib.crc32(named))

    height, row_bytes = rows.shape
    filtered = np.zeros((height, 1 + row_bytes), np.uint8)  # filter 0 before each row
    filtered[:, 1:] = rows
    whole = path.with_suffix(".part")  # renamed at the end: no file is incomplete
    whole.write_bytes(b"\x89PNG\r\n\x1a\n"
                      + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, 0, 0, 0, 0))
                      + chunk(b"IDAT", zlib.compress(filtered.tobytes(), 1)) + chunk(b"IEND", b""))
    whole.replace(path)


def layer_range(text):
    """FIRST:END, of which either may be left out, as a slice."""
    first, colon, end = text.partition(":")
    if not colon:
        raise ValueError(text)
    return slice(int(first) if first else 0, int(end) if end else None)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", type=pathlib.Path, help="STL, OBJ, PLY, OFF, 3MF, AMF or glTF")
    parser.add_argument("-o", "--out", type=pathlib.Path, default=pathlib.Path("out"))
    parser.add_argument("--cell", type=float, default=4, help="size of the cells (default 4 mm)")
    parser.add_argument("--radius", type=float, nargs=2, default=(0.25, 0.6),
                        metavar=("BOTTOM", "TOP"), help="of its struts (default 0.25 0.6 mm)")
    parser.add_argument("--layer", type=float, default=0.5, help="layer height (default 0.5 mm)")
    parser.add_argument("--pitch", type=float, default=0.1, help="pixel size (default 0.1 mm)")
    parser.add_argument("--layers", type=layer_range, default=slice(0, None), metavar="FIRST:END",
                        help="only these, from 0, without END (default all)")
    parser.add_argument("--threads", type=int, default=0, help="of this process (default one per core)")
    options = parser.parse_args()

    context = msq.Context(threads=options.threads)
    part = msq.Shape.from_file(options.file, context=context)
    low, high = part.info.min, part.info.max
    bottom, top = options.radius
    radius = msq.Field.gradient((0, 0, low[2]), bottom, (0, 0, high[2]), top, context=context)
    model = msq.Model(part, [msq.Foam(cell_size=options.cell, radius=radius)])
    slicer = model.slicer(layer_height=options.layer, pitch=options.pitch)

    options.out.mkdir(parents=True, exist_ok=True)
    shadow = np.zeros((slicer.height, slicer.width), np.uint32)  # number of solid layers
    start, inside = time.perf_counter(), 0
    numbers = range(len(slicer))[options.layers]
    for layer in slicer.layers(numbers.start, len(numbers)):
        path = options.out / f"layer_{layer.index:05}.png"
        write_png(path, layer.data[::-1], layer.width, depth=1)
        shadow += layer.pixels
        inside += layer.inside_count
    if len(numbers) < len(slicer):
        print(f"{len(numbers)} of {len(slicer)} layers in {time.perf_counter() - start:.2f} s")
        return 0
    grey = (shadow * (255 / max(shadow.max(), 1))).astype(np.uint8)
    write_png(options.out / "shadow.png", grey[::-1], slicer.width, depth=8)

    # The part's own volume, by the same samples, to say how much of it is filled.
    grid = msq.PointGrid((*slicer.origin, slicer.z(0)), (*slicer.pitch, options.layer),
                         (slicer.width, slicer.height, len(slicer)))
    whole = np.count_nonzero(model.contains(grid, length_scale=float("inf")))
    print(f"{len(slicer)} layers of {slicer.width} x {slicer.height} pixels in "
          f"{time.perf_counter() - start:.2f} s; "
          f"{100 * inside / max(whole, 1):.1f} % of the part is filled")
    return 0 if 0 < inside < whole else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except msq.Error as error:
        sys.exit(f"slice_numpy: {error}")
