# SPDX-License-Identifier: Apache-2.0
"""Runs the vectors through the package: see tests/vectors/protocol.py. Called by its tests."""
import struct
import sys

import numpy as np

import msq
from msq import _abi

NAMES = {value: name for name, value in vars(_abi).items() if name.startswith("MSQ_E_")}

def print_case(text: bytes, points: np.ndarray) -> None:
    try:
        document = msq.Document.from_json(text)
    except msq.Error as error:
        print(f"refused {NAMES[error.status]}: {error}")
        return
    model = document.model
    print("title", document.title)
    try:
        print("hash", model.hash)
    except msq.UnsupportedError:
        print("hash -")
    print("inside", "".join("1" if inside else "0" for inside in model.contains(points)))
    print("distance", *(bits(distance) for distance in model.distance(points)))
    slicer = document.slicer()
    print("plan", slicer.width, slicer.height, len(slicer))
    for layer in slicer:
        print("layer", layer.index, bits(layer.z), layer.rows.tobytes().hex())


def bits(value: float) -> str:
    return struct.pack(">d", value).hex()


def main() -> None:
    sys.stdout.reconfigure(encoding="utf-8")  # type: ignore[union-attr]
    for path, points in zip(sys.argv[1::2], sys.argv[2::2]):
        print("case")
        with open(path, "rb") as file:
            print_case(file.read(), np.fromfile(points).reshape(-1, 3))


if __name__ == "__main__":
    main()
