#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes a CT-like image of the upper end of a thigh bone, for
examples/c/slice_voxels.c and examples/models/bone.json.

    python3 examples/parts/make_bone.py bone.nrrd            header and values in one file
    python3 examples/parts/make_bone.py bone.nhdr            values beside it, in bone.raw
    python3 examples/parts/make_bone.py bone.nrrd --step 0.7  finer than 1 mm

Hounsfield units as 16-bit integers: muscle at 50, a dense shell at 1500, spongy bone from 700 under it
to 350 inside, a little noise. The bone is a signed distance of rounded cones and balls, joined
smoothly. Python's standard library only, and no randomness: the same bytes on every machine.
"""
import argparse
import math
import pathlib
import struct

SIZE = (56.0, 36.0, 68.0)   # mm, x, y, z
ORIGIN = (-20.0, -18.0, -2.0)
NOISE = 25                  # Hounsfield units, at most


def cone(p, a, b, radius_a, radius_b):
    """Distance to a rounded cone about the segment a-b, nearly."""
    ab = [v - u for u, v in zip(a, b)]
    ap = [v - u for u, v in zip(a, p)]
    t = sum(u * v for u, v in zip(ap, ab)) / sum(u * u for u in ab)
    t = min(max(t, 0.0), 1.0)
    off = math.sqrt(sum((u - t * v) ** 2 for u, v in zip(ap, ab)))
    return off - (radius_a + t * (radius_b - radius_a))


def join(a, b, blend):
    """The lesser of two distances, with a fillet of about that size."""
    h = max(blend - abs(a - b), 0.0) / blend
    return min(a, b) - h * h * blend / 4


def bone(p):
    x, y, z = p
    shaft = cone(p, (0, 0, -10), (0, 0, 38), 7.5, 9.5)
    neck = cone(p, (0, 0, 36), (19, 2, 50), 9.0, 7.0)
    head = math.sqrt((x - 21) ** 2 + (y - 2) ** 2 + (z - 51) ** 2) - 11.5
    trochanter = cone(p, (-6, -1, 38), (-8, -3, 49), 8.0, 5.5)
    lesser = math.sqrt((x - 7) ** 2 + (y + 7) ** 2 + (z - 24) ** 2) - 4.0
    return join(join(join(shaft, neck, 6), join(head, trochanter, 1), 4), lesser, 4)


def hounsfield(distance):
    """Across the surface, blurred over a millimetre as a scanner does."""
    depth = -distance
    shell = min(max(depth + 0.5, 0.0), 1.0)
    inner = min(max((depth - 1.8) / 1.2, 0.0), 1.0)
    spongy = 700 - 350 * min(max((depth - 3.0) / 6.0, 0.0), 1.0)
    dense = 50 + (1500 - 50) * shell
    return dense + (spongy - dense) * inner


def noise(i, j, k):
    h = (i * 73856093 ^ j * 19349663 ^ k * 83492791) & 0xffffffff
    h = (h ^ h >> 15) * 0x2c1b3c6d & 0xffffffff
    return ((h ^ h >> 12) % (2 * NOISE + 1)) - NOISE


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--step", type=float, default=1.0, help="spacing of the voxels, mm")
    arguments = parser.parse_args()
    step = arguments.step
    sizes = [int(extent / step) + 1 for extent in SIZE]
    values = bytearray()
    for k in range(sizes[2]):
        for j in range(sizes[1]):
            row = []
            for i in range(sizes[0]):
                p = [o + step * n for o, n in zip(ORIGIN, (i, j, k))]
                row.append(round(hounsfield(bone(p))) + noise(i, j, k))
            values += struct.pack(f"<{len(row)}h", *row)

    is_detached = arguments.out.suffix == ".nhdr"
    data = arguments.out.with_suffix(".raw")
    header = ["NRRD0004", "# CT-like test image, made by make_bone.py", "type: short",
              "dimension: 3", "sizes: " + " ".join(map(str, sizes)),
              "space dimension: 3",
              f"space directions: ({step},0,0) (0,{step},0) (0,0,{step})",
              "space origin: ({},{},{})".format(*ORIGIN), "endian: little", "encoding: raw"]
    if is_detached:
        header.append(f"data file: {data.name}")
    text = ("\n".join(header) + "\n\n").encode()
    arguments.out.write_bytes(text if is_detached else text + bytes(values))
    if is_detached:
        data.write_bytes(values)
    print(f"{arguments.out}: {sizes[0]} x {sizes[1]} x {sizes[2]} voxels of {step} mm")


if __name__ == "__main__":
    main()
