#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""slice_stl writes a PNG file per layer, right side up, and says what it cannot read or write.

usage: check_slice_stl.py SLICE_STL PART
"""
import pathlib
import subprocess
import sys
import tempfile

import png_pixels

program, part = sys.argv[1:]
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)

    def run(*arguments):
        return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, timeout=240)

    done = run(part, folder / "layers")
    files = sorted(path.name for path in folder.glob("layers/*"))
    if done.returncode != 0 or f"{len(files)} files" not in done.stdout:
        sys.exit(f"{done.returncode}: {done.stdout}{done.stderr}")
    if files != [f"layer{i:05}.png" for i in range(400)]:
        sys.exit(f"{len(files)} files, {files[:3]}")
    width, height, rows = png_pixels.read(folder / "layers/layer00020.png")
    share = sum(pixel[0] > 0 for row in rows for pixel in row) / (width * height)
    if (width, height) != (640, 400) or not 0.02 < share < 0.3:
        sys.exit(f"layer 20 has {width} x {height} pixels, {100 * share:.1f} % solid")

    for arguments, text in (((folder / "none.stl", folder / "a"), "none.stl"),
                            ((part, folder / "none" / "a"), "none/")):
        done = run(*arguments)
        if done.returncode != 1 or text not in done.stderr or (folder / "a").exists():
            sys.exit(f"{arguments}: {done.returncode}, {done.stderr}")
    if run(part).returncode != 2:
        sys.exit("takes one argument")
print("slice_stl writes what it should")
