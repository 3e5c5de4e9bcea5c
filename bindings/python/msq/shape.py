# SPDX-License-Identifier: Apache-2.0
"""Coarse shapes: scale 0 of a model."""
from __future__ import annotations

import ctypes
import dataclasses
import os
from typing import Any, Callable, Optional, Sequence, Tuple, Union

import numpy as np

from . import _abi
from ._arrays import pointer, triples, vector
from ._grid import Cell, set_image
from ._handle import Handle
from ._host import create
from ._interrupt import interruptible
from ._library import constant, defaults, lib, report
from .context import Context, Job, context_of, doubles, record, triple, unsigned


@dataclasses.dataclass(frozen=True)
class ShapeInfo:
    """Bounds, volume, area and the diagnosis of a dirty mesh."""

    is_mesh: bool  #: the counts below are 0 for other shapes
    min: Tuple[float, float, float]
    max: Tuple[float, float, float]
    volume: float  #: meshes: signed sum over triangles, negative if inside out; NaN of host's
    area: float  #: NaN where it is not known
    vertices: int  #: after welding
    triangles: int  #: kept
    degenerate_triangles: int
    duplicate_triangles: int
    open_edges: int  #: with one triangle
    non_manifold_edges: int  #: with three or more
    flipped_edges: int  #: with two triangles that run along it the same way
    closed: bool


class Shape(Handle):
    """A coarse solid. Made by the class methods."""

    _kind = "shape"
    context: Context

    def __init__(self) -> None:
        raise TypeError("shapes are made by Shape.from_file, from_mesh, box and the like")

    @classmethod
    def _make(cls, context: Context, create: Any, *arguments: Any) -> Shape:
        made = cls._wrap(cls._create(create, context._ref, *arguments))
        made.context = context
        return made

    @classmethod
    def from_file(cls, path: Union[str, "os.PathLike[str]"], *, format: str = "auto",
                  unit_mm: float = 1.0, winding: str = "nonzero", max_bytes: int = 0,
                  max_triangles: int = 0, context: Optional[Context] = None) -> Shape:
        """Reads STL, OBJ, PLY, OFF, 3MF or AMF, in millimetres.

        unit_mm: length of the file's unit, for formats that name none. winding: `nonzero`,
        `even_odd` or `positive`. Larger files than max_bytes and max_triangles are refused; 0:
        4 GiB, 200 million.
        """
        context = context_of(context)
        definition = cls._file(format, unit_mm, winding, max_bytes, max_triangles)
        return cls._make(context, lib.msq_shape_from_file, os.fsencode(path),
                         ctypes.byref(definition))

    @classmethod
    def from_memory(cls, data: Any, format: str, *, unit_mm: float = 1.0, winding: str = "nonzero",
                    max_bytes: int = 0, max_triangles: int = 0,
                    context: Optional[Context] = None) -> Shape:
        """The same from a file's bytes, or any contiguous buffer of them."""
        context = context_of(context)
        definition = cls._file(format, unit_mm, winding, max_bytes, max_triangles)
        view = np.frombuffer(data, np.uint8)  # without a copy
        return cls._make(context, lib.msq_shape_from_memory, view.ctypes.data, view.size,
                         ctypes.byref(definition))

    @staticmethod
    def _file(format: str, unit_mm: float, winding: str, max_bytes: int,
              max_triangles: int) -> _abi.msq_file_def:
        definition = defaults(_abi.msq_file_def)
        definition.format = constant("MSQ_FORMAT_", format, "format")
        definition.unit_mm = unit_mm
        definition.winding_rule = constant("MSQ_WINDING_", winding, "winding")
        definition.max_bytes = unsigned(max_bytes, 64, "max_bytes")
        definition.max_triangles = unsigned(max_triangles, 64, "max_triangles")
        return definition

    @classmethod
    def from_mesh(cls, vertices: Any, triangles: Any, *, winding: str = "nonzero",
                  context: Optional[Context] = None) -> Shape:
        """A triangle mesh in arrays: vertices (n, 3), float32 or float64; triangles (m, 3), indices
        counter-clockwise from outside. Open, self-intersecting and flipped meshes are taken."""
        context = context_of(context)
        points = triples(vertices, "vertices")
        indices = vector(triangles, np.uint32, (-1, 3), "triangles")
        definition = defaults(_abi.msq_mesh_def)
        definition.coordinate_type = points.coordinate_type
        definition.winding_rule = constant("MSQ_WINDING_", winding, "winding")
        definition.vertices = points.address
        definition.vertex_count = points.count
        definition.vertex_stride = points.stride
        definition.triangles = pointer(indices, ctypes.c_uint32)
        definition.triangle_count = len(indices)
        return cls._make(context, lib.msq_shape_from_mesh, ctypes.byref(definition))

    @classmethod
    def box(cls, min: Sequence[float], max: Sequence[float], *,
            context: Optional[Context] = None) -> Shape:
        """Axis-aligned box, boundary included."""
        return cls._make(context_of(context), lib.msq_shape_from_box, doubles(min, "min"),
                         doubles(max, "max"))

    @classmethod
    def sphere(cls, center: Sequence[float], radius: float, *,
               context: Optional[Context] = None) -> Shape:
        """Ball, boundary included."""
        return cls._make(context_of(context), lib.msq_shape_from_sphere, doubles(center, "center"),
                         radius)

    @classmethod
    def cylinder(cls, start: Sequence[float], end: Sequence[float], radius: float, *,
                 context: Optional[Context] = None) -> Shape:
        """Flat-ended round cylinder between two points, boundary included."""
        return cls._make(context_of(context), lib.msq_shape_from_cylinder, doubles(start, "start"),
                         doubles(end, "end"), radius)

    @classmethod
    def voxels(cls, values: Any, threshold: float, *, spacing: Cell = 1.0,
               origin: Sequence[float] = (0, 0, 0), rotation: Any = None, solid: str = "above",
               context: Optional[Context] = None) -> Shape:
        """A voxel image (nz, ny, nx), such as a CT scan: where the trilinear function between its
        values is on the solid side of the threshold, `above` or `below`.

        values[k, j, i] stands at origin + rotation @ ((i, j, k) * spacing); uint8, int16, uint16,
        float32 or float64.
        """
        definition = defaults(_abi.msq_voxels_def)
        _kept = set_image(definition.image, values, spacing, origin, rotation)
        definition.threshold = threshold
        definition.solid = constant("MSQ_SOLID_", solid, "solid")
        return cls._make(context_of(context), lib.msq_shape_from_voxels, ctypes.byref(definition))

    @classmethod
    def host(cls, inside: Callable[[np.ndarray], Any], min: Sequence[float],
             max: Sequence[float], *, distance: Optional[Callable[[np.ndarray], Any]] = None,
             concurrent: bool = False, context: Optional[Context] = None) -> Shape:
        """A function of Python: inside(points) answers points (n, 3), all in the box from min to
        max, by n bools; nothing is inside beyond the box.

        distance(points): n numbers, each at most the distance to the boundary, on either side. The
        rest is as for Field.host.
        """
        definition = defaults(_abi.msq_host_shape_def)
        definition.min[:] = triple(min, "min")
        definition.max[:] = triple(max, "max")
        context = context_of(context)
        return create(lambda: cls._make(context, lib.msq_shape_from_host, ctypes.byref(definition)),
                      definition, concurrent, inside=inside, distance=distance)

    @property
    def info(self) -> ShapeInfo:
        """Bounds, volume, area and the diagnosis of a dirty mesh; found when it was made."""
        return record(ShapeInfo, report(_abi.msq_shape_report, lib.msq_shape_info, self._ref))

    def self_intersections(self, *, job: Optional[Job] = None) -> int:
        """Pairs of triangles in which a mesh intersects itself; about a second for 270,000."""
        pairs = ctypes.c_uint64()
        reference = self._ref
        interruptible(lambda work: lib.msq_shape_self_intersections(reference, ctypes.byref(pairs),
                                                                    work), job)
        return pairs.value
