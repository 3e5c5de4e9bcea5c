# SPDX-License-Identifier: Apache-2.0
"""Reads the PNG files that the examples and msq write: grey of 1 or 8 bits, RGB, not interlaced."""
import pathlib
import struct
import zlib


def read(path):
    """Width, height, and rows of tuples."""
    data = pathlib.Path(path).read_bytes()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError(f"{path} is no PNG")
    at, packed, header = 8, b"", None
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0] != zlib.crc32(kind + body):
            raise ValueError(f"{path}: checksum of {kind}")
        if kind == b"IHDR":
            header = struct.unpack(">IIBBBBB", body)
        if kind == b"IDAT":
            packed += body
        at += 12 + size
    width, height, depth, colour, _, _, interlace = header
    if (depth, colour) not in ((1, 0), (8, 0), (8, 2), (8, 6)) or interlace:
        raise ValueError(f"{path}: depth {depth}, colour {colour}, interlace {interlace}")
    step = {0: 1, 2: 3, 6: 4}[colour]
    raw = zlib.decompress(packed)
    size = (width * step * depth + 7) // 8
    before = bytearray(size)
    rows = []
    for y in range(height):
        start = y * (size + 1)
        row = bytearray(raw[start + 1:start + 1 + size])
        unfilter(raw[start], row, before, step)
        if depth == 1:
            rows.append([(row[x // 8] >> (7 - x % 8) & 1,) for x in range(width)])
        else:
            rows.append([tuple(row[x:x + step]) for x in range(0, len(row), step)])
        before = row
    return width, height, rows


def unfilter(kind, row, above, step):
    for i in range(len(row)):
        left = row[i - step] if i >= step else 0
        corner = above[i - step] if i >= step else 0
        up = above[i]
        if kind == 1:
            add = left
        elif kind == 2:
            add = up
        elif kind == 3:
            add = (left + up) // 2
        elif kind == 4:
            p = left + up - corner
            distances = abs(p - left), abs(p - up), abs(p - corner)
            add = (left, up, corner)[distances.index(min(distances))]
        else:
            add = 0
        row[i] = (row[i] + add) & 255


def differ(a, b, by=12):
    """Whether two pixels are of visibly different colours."""
    return max(abs(u - v) for u, v in zip(a, b)) > by
