# SPDX-License-Identifier: Apache-2.0
"""Lines that fill a polygon, as arrays."""
from __future__ import annotations

import ctypes
from typing import Any, List, Optional, Sequence

import numpy as np

from . import _abi
from ._arrays import address_of, vector, view
from ._handle import Handle
from ._interrupt import build
from ._library import defaults, lib
from .context import Job

_TYPES = {np.dtype(np.int32): _abi.MSQ_INT32, np.dtype(np.int64): _abi.MSQ_INT64}


class Fill(Handle):
    """Paths that fill a polygon, in the order in which they are best printed. Made by
    Structure.fill_lines.

    The arrays are views of the library's memory, which they keep, and are read-only.
    """

    _kind = "fill"

    def __init__(self) -> None:
        raise TypeError("fills are made by Structure.fill_lines")

    @classmethod
    def _of(cls, context: Any, structure: Any, polygon: Any, z: float, scale: float,
            origin: Sequence[float], tolerance: float, min_length: float,
            pair_distance: float, corner_distance: float, job: Optional[Job]) -> Fill:
        rings = _rings_of(polygon)
        given = (_abi.msq_ring * max(len(rings), 1))()
        for ring, known in zip(rings, given):
            known.points = address_of(ring)
            known.count = len(ring)
        definition = defaults(_abi.msq_fill_def)
        definition.coordinate_type = _TYPES[rings[0].dtype] if rings else _abi.MSQ_INT64
        definition.rings = given
        definition.ring_count = len(rings)
        definition.point_stride = 0  # rings are contiguous
        definition.scale = scale
        place = [float(c) for c in origin]
        if len(place) != 2:
            raise ValueError(f"origin has {len(place)} numbers; it must have 2")
        definition.origin[:] = place
        definition.z = z
        definition.tolerance = tolerance
        definition.min_length = min_length
        definition.pair_distance = pair_distance
        definition.corner_distance = corner_distance
        fill = cls._wrap(build(
            lambda create: cls._create(create, context, structure, ctypes.byref(definition)),
            lib.msq_fill_lines, job))
        fill._read()
        return fill

    def _read(self) -> None:
        report = _abi.msq_fill_report()
        report.struct_size = ctypes.sizeof(report)
        reference = self._ref
        lib.msq_fill_info(reference, ctypes.byref(report))
        kind = "<i4" if report.coordinate_type == _abi.MSQ_INT32 else "<i8"
        points, paths = report.point_count, report.path_count

        self.points = view(reference, report.points, (points, 2), kind)  #: of all paths, (n, 2)
        #: path i has points[starts[i]:starts[i + 1]]
        self.starts = view(reference, report.path_starts, (paths + 1,), "<u8")
        #: (n,) of bool: is the last point of path i joined to its first
        self.is_closed = view(reference, report.closed, (paths,), "|b1")
        self.length = report.length  #: of all paths, in model units
        self.travel = report.travel  #: between the paths, in model units

    @property
    def paths(self) -> List[np.ndarray]:
        """The points of each path, as views of `points`."""
        ends = self.starts.tolist()
        return [self.points[begin:end] for begin, end in zip(ends, ends[1:])]

    def __len__(self) -> int:
        """The number of paths."""
        return len(self.is_closed)

    def __repr__(self) -> str:
        return f"<msq.Fill of {len(self)} paths, length {self.length:g}>"


def _rings_of(polygon: Any) -> List[np.ndarray]:
    """Contiguous arrays (n, 2), all int32 or all int64."""
    if isinstance(polygon, np.ndarray) and polygon.ndim == 2:
        polygon = [polygon]
    elif not isinstance(polygon, np.ndarray) and len(polygon) and np.ndim(polygon[0]) == 1:
        polygon = [np.asarray(polygon)]
    arrays = [np.asarray(ring) for ring in polygon]
    is_small = bool(arrays) and all(ring.dtype == np.int32 for ring in arrays)
    dtype = np.int32 if is_small else np.int64
    return [vector(ring, dtype, (-1, 2), "rings of a polygon") for ring in arrays]
