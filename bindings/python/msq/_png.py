# SPDX-License-Identifier: Apache-2.0
"""PNG of arrays, for notebooks: 8 bits, grey or with colours and opacity, by zlib of Python."""
import struct
import zlib

import numpy as np


def encoded(pixels: np.ndarray) -> bytes:
    """uint8, (height, width) grey or (height, width, 4) RGBA, row 0 on top."""
    height, width = pixels.shape[:2]
    colour = 0 if pixels.ndim == 2 else 6
    rows = np.zeros((height, 1 + pixels.itemsize * pixels[0].size), np.uint8)  # filter 0 first
    rows[:, 1:] = pixels.reshape(height, -1)
    header = struct.pack(">IIBBBBB", width, height, 8, colour, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        for kind, data in ((b"IHDR", header), (b"IDAT", zlib.compress(rows.tobytes(), 6)),
                           (b"IEND", b"")))
