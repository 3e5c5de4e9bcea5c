# SPDX-License-Identifier: Apache-2.0
"""Reads PNG files by Python's zlib alone: 8-bit and 1-bit grey, RGB and RGBA, without interlacing."""
import struct
import zlib


def read(data):
    """The rows of the image, as bytes, and the fields of its header."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, parts, header, names = 8, [], None, []
    while at < len(data):
        (size,) = struct.unpack(">I", data[at:at + 4])
        name, body = data[at + 4:at + 8], data[at + 8:at + 8 + size]
        (crc,) = struct.unpack(">I", data[at + 8 + size:at + 12 + size])
        assert crc == zlib.crc32(name + body), f"checksum of {name}"
        names.append(name)
        if name == b"IHDR":
            header = struct.unpack(">IIBBBBB", body)
        if name == b"IDAT":
            parts.append(body)
        at += 12 + size
    assert names[0] == b"IHDR" and names[-1] == b"IEND"
    width, height, depth, colour, _, _, interlace = header
    assert interlace == 0
    channels = {0: 1, 2: 3, 6: 4}[colour]
    size, step = (width * depth * channels + 7) // 8, max(1, depth * channels // 8)
    raw = zlib.decompress(b"".join(parts))
    assert len(raw) == height * (size + 1)
    rows, above = [], bytes(size)
    for y in range(height):
        line = raw[y * (size + 1):(y + 1) * (size + 1)]
        above = unfiltered(line[0], line[1:], above, step)
        rows.append(above)
    return rows, header


def unfiltered(kind, row, above, step):
    if kind == 0:
        return row
    if kind == 2:  # as msq_io has it, mostly zeros
        return bytes([(a + b) & 255 for a, b in zip(row, above)]) if any(row) else above
    own = bytearray(len(row))
    for x, value in enumerate(row):
        left, up = own[x - step] if x >= step else 0, above[x]
        corner = above[x - step] if x >= step else 0
        if kind == 4:
            guess = left + up - corner
            value += min((abs(guess - v), i, v) for i, v in enumerate((left, up, corner)))[2]
        else:
            value += (0, left, up, (left + up) // 2)[kind]
        own[x] = value & 255
    return bytes(own)
