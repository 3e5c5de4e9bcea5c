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
from ._given import remembers
from ._grid import Cell, affine, set_image
from ._handle import Handle, hash_of, pointers
from ._host import HashKey, create
from ._interrupt import build, interruptible
from ._library import constant, defaults, lib, report
from .context import (Context, Job, MadeIn, context_of, doubles, c_path, record, triple,
                      unsigned)
from .errors import naming


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
    context = MadeIn()

    def __init__(self) -> None:
        raise TypeError("shapes are made by Shape.from_file, from_mesh, box and the like")

    @classmethod
    def _make(cls, context: Context, create: Any, *arguments: Any) -> Shape:
        made = cls._wrap(cls._create(create, context._ref, *arguments))
        made.context = context
        return made

    @classmethod
    @remembers
    def from_file(cls, path: Union[str, "os.PathLike[str]"], *, format: str = "auto",
                  unit_mm: float = 1.0, winding: str = "auto", max_bytes: int = 0,
                  max_triangles: int = 0, context: Optional[Context] = None,
                  job: Optional[Job] = None) -> Shape:
        """Reads STL, OBJ, PLY, OFF, 3MF, AMF or glTF, in millimetres.

        unit_mm: length of the file's unit, for formats that name none. winding: `auto`, `nonzero`,
        `even_odd` or `positive`. Larger files than max_bytes and max_triangles are refused; 0:
        4 GiB, 200 million. job: progress, and cancelling from another thread. A missing file is a
        FileNotFoundError.
        """
        context = context_of(context)
        definition = cls._file(format, unit_mm, winding, max_bytes, max_triangles)
        name = c_path(path)
        with naming(path):
            return build(lambda new: cls._make(context, new, name, ctypes.byref(definition)),
                         lib.msq_shape_from_file, job)

    @classmethod
    @remembers
    def from_memory(cls, data: Any, format: str, *, unit_mm: float = 1.0, winding: str = "auto",
                    max_bytes: int = 0, max_triangles: int = 0,
                    context: Optional[Context] = None, job: Optional[Job] = None) -> Shape:
        """The same from a file's bytes, or any contiguous buffer of them."""
        context = context_of(context)
        definition = cls._file(format, unit_mm, winding, max_bytes, max_triangles)
        view = np.frombuffer(data, np.uint8)  # without a copy
        return build(lambda new: cls._make(context, new, view.ctypes.data, view.size,
                                              ctypes.byref(definition)),
                     lib.msq_shape_from_memory, job)

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
    @remembers
    def from_mesh(cls, vertices: Any, triangles: Any, *, winding: str = "auto",
                  context: Optional[Context] = None) -> Shape:
        """A triangle mesh in arrays: vertices (n, 3), float32 or float64; triangles (m, 3), indices
        counter-clockwise from outside: contiguous uint32 is passed as it is, other whole numbers are
        converted. Open, self-intersecting and flipped meshes are taken."""
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
    @remembers
    def box(cls, min: Sequence[float], max: Sequence[float], *,
            context: Optional[Context] = None) -> Shape:
        """Axis-aligned box, boundary included."""
        return cls._make(context_of(context), lib.msq_shape_from_box, doubles(min, "min"),
                         doubles(max, "max"))

    @classmethod
    @remembers
    def sphere(cls, center: Sequence[float], radius: float, *,
               context: Optional[Context] = None) -> Shape:
        """Ball, boundary included."""
        return cls._make(context_of(context), lib.msq_shape_from_sphere, doubles(center, "center"),
                         radius)

    @classmethod
    @remembers
    def cylinder(cls, start: Sequence[float], end: Sequence[float], radius: float, *,
                 context: Optional[Context] = None) -> Shape:
        """Flat-ended round cylinder between two points, boundary included."""
        return cls._make(context_of(context), lib.msq_shape_from_cylinder, doubles(start, "start"),
                         doubles(end, "end"), radius)

    @classmethod
    @remembers
    def all_space(cls, *, context: Optional[Context] = None) -> Shape:
        """Every point, for models of structures alone: see msq_shape_all_space in msq.h. Slicers of
        such models need a region, rays a finite t_max, pictures a finite clip_far."""
        return cls._make(context_of(context), lib.msq_shape_all_space)

    @classmethod
    @remembers
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
    @remembers
    def host(cls, inside: Callable[[np.ndarray], Any], min: Sequence[float],
             max: Sequence[float], *, distance: Optional[Callable[[np.ndarray], Any]] = None,
             concurrent: bool = False, hash_key: HashKey = None,
             context: Optional[Context] = None) -> Shape:
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
                      definition, concurrent, hash_key, inside=inside, distance=distance)

    @remembers
    def placed(self, matrix: Any) -> Shape:
        """An instance of the shape, turned, scaled, mirrored, sheared and moved: its point q is at
        matrix @ (q, 1). matrix: (3, 4), or (4, 4) with the last row 0, 0, 0, 1. It shares mesh and
        trees with this one."""
        return self._made_of(lib.msq_shape_placed, self._ref, affine(matrix))

    @remembers
    def offset(self, distance: float) -> Shape:
        """The shape with its surface moved by a distance, outwards or, if negative, inwards."""
        return self._made_of(lib.msq_shape_offset, self._ref, distance)

    @classmethod
    @remembers
    def union(cls, *shapes: Shape) -> Shape:
        """Points in any of the shapes."""
        return cls._boolean("union", shapes)

    @classmethod
    @remembers
    def intersection(cls, *shapes: Shape) -> Shape:
        """Points in all of the shapes."""
        return cls._boolean("intersection", shapes)

    @classmethod
    @remembers
    def difference(cls, *shapes: Shape) -> Shape:
        """Points of the first shape that are in no other."""
        return cls._boolean("difference", shapes)

    def __or__(self, other: Shape) -> Shape:
        return Shape.union(self, other)

    def __and__(self, other: Shape) -> Shape:
        return Shape.intersection(self, other)

    def __sub__(self, other: Shape) -> Shape:
        return Shape.difference(self, other)

    @classmethod
    def _boolean(cls, operation: str, shapes: Sequence[Shape]) -> Shape:
        for shape in shapes:
            if not isinstance(shape, Shape):
                raise TypeError(f"a shape is a {type(shape).__name__}; it must be a Shape")
        if not shapes:
            raise ValueError(f"a {operation} of no shapes; there must be at least one")
        return shapes[0]._made_of(lib.msq_shape_boolean,
                                  constant("MSQ_BOOLEAN_", operation, "operation"),
                                  pointers(shapes), len(shapes))

    def _made_of(self, create: Any, *arguments: Any) -> Shape:
        made = self._wrap(self._create(create, *arguments))
        made.context = self.context
        return made

    @property
    def hash(self) -> str:
        """32 hexadecimal digits: equal for equal definitions with equal inputs, on every machine,
        and different otherwise (docs/howto/caching.md)."""
        return hash_of(lib.msq_shape_hash, self)

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
