# SPDX-License-Identifier: Apache-2.0
"""A program of a user, for test_types.py: mypy --strict has nothing to say of it."""
from __future__ import annotations

from typing import List, Optional, Tuple

import numpy as np

import msq


def graded(low: float, high: float) -> msq.Foam:
    radius = msq.Field.gradient((0, 0, 0), low, (0, 0, 10), high)
    return msq.Foam(cell_size=2, radius=radius, seed=1)


def areas(model: msq.Model, pitch: float) -> List[float]:
    slicer = model.slicer(layer_height=1, pitch=pitch)
    found = [layer.inside_count * pitch**2 for layer in slicer]
    first: msq.Layer = slicer[0]
    some: List[msq.Layer] = slicer[2:4]
    return found[first.index:] + [float(layer.z) for layer in some]


def solids(path: str) -> List[msq.Model]:
    return [part.model() for part in msq.read_3mf_implicit(path) if part.box_only]


def main(path: Optional[str] = None) -> Tuple[int, float]:
    part = msq.Shape.box((0, 0, 0), (10, 10, 10)) if path is None else msq.Shape.from_file(path)
    foam = graded(0.1, 0.4)
    size: object = foam.cell_size
    seed: int = foam.seed
    model = msq.Model(part, [msq.Scale(foam, skin=0.2)], material=msq.Material(1, density=2.0))
    points = np.zeros((3, 3))
    inside: np.ndarray[object, np.dtype[np.bool_]] = model.contains(points)
    job = msq.Job()
    mesh = model.mesh(1.0, job=job)
    try:
        msq.Shape.sphere((0, 0, 0), -1)
    except msq.ArgumentError as error:
        print(error.status, size, seed)
    picture = model.render(width=20, height=20)
    assert picture.rgba is not None
    return len(mesh.triangles) + int(inside.sum()), sum(areas(model, 0.5))


if __name__ == "__main__":
    print(main())
