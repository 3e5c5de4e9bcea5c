# SPDX-License-Identifier: Apache-2.0
"""Models, and sets of points asked of them."""
from __future__ import annotations

import ctypes
import dataclasses
import os
from typing import Any, BinaryIO, Callable, Optional, Sequence, Tuple, Union

import numpy as np

from . import _abi, picture, statistics, surface
from ._arrays import output, pointer, real, triples
from ._given import parameter, remembers, shown
from ._handle import Handle, hash_of, lend, pointers
from ._interrupt import interruptible
from ._library import defaults, lib
from ._signals import held
from .camera import Camera
from .context import Context, Job, MadeIn, context_of, doubles, c_path, c_text, unsigned
from .contours import Contours, Window
from .field import Param, set_param
from .material import Material, encoded, lend_material
from .picture import Picture, RenderPass
from .points import PointSet, Stratified, definition_of, query_of
from .shape import Shape
from .slicer import Output, Slicer
from .statistics import Estimate
from .structure import Structure
from .surface import Box, Mesh

# Sets of fewer points are not worth the thread that makes them interruptible: some 0.1 ms.
_LONG = 1 << 15


@dataclasses.dataclass(frozen=True)
class Scale:
    """A structure, and what it leaves of the coarse shape: skin, the thickness of a solid skin
    under its surface.

    material: None: as the next coarser scale. skin_material: None: as material.
    """

    structure: Structure
    skin: Param = 0.0
    material: Optional[Material] = None
    skin_material: Optional[Material] = None

    def __repr__(self) -> str:
        return shown(self)


Part = Union[Structure, Scale]  #: what a model is filled with


class Model(Handle):
    """A coarse shape and the structures that fill it: the solid is their intersection.

    structures: coarsest first, a Structure or a Scale or a sequence of them; none for the shape
    alone. material: of the coarse shape, and so of scales that have none of their own.
    """

    _kind = "model"
    context = MadeIn()
    shape: parameter[Shape] = parameter("The coarse shape. Not of models of regions and documents.")
    structures: parameter[Union[Part, Sequence[Part]]] = parameter(
        "As given. Not of models of regions and documents.")

    @remembers
    def __init__(self, shape: Shape, structures: Union[Part, Sequence[Part]] = (), *,
                 material: Optional[Material] = None, context: Optional[Context] = None) -> None:
        if not isinstance(shape, Shape):
            raise TypeError(f"shape is a {type(shape).__name__}; it must be a Shape")
        given = (structures,) if isinstance(structures, (Structure, Scale)) else tuple(structures)
        parts = [Scale(part) if isinstance(part, Structure) else part for part in given]
        for part in parts:
            if not isinstance(part, Scale) or not isinstance(part.structure, Structure):
                raise TypeError(f"structures have a {type(part).__name__}; it must be a Structure "
                                "or a Scale of one")
        scales = (_abi.msq_scale_def * (1 + len(parts)))()
        lend(scales[0], "shape", shape)
        lend_material(scales[0], "material", material)
        for scale, part in zip(list(scales)[1:], parts):
            lend(scale, "structure", part.structure)
            set_param(scale.skin, "skin", part.skin)
            lend_material(scale, "material", part.material)
            lend_material(scale, "skin_material", part.skin_material)
        definition = defaults(_abi.msq_model_def)
        definition.scales = scales
        definition.scale_count = len(scales)
        definition.scale_size = ctypes.sizeof(_abi.msq_scale_def)
        context = context_of(context, shape)
        self._reference = self._create(lib.msq_model_create, context._ref, ctypes.byref(definition))
        self.context = context

    @classmethod
    @remembers
    def regions(cls, *models: Model, context: Optional[Context] = None) -> Model:
        """A model of regions, such as the parts of a plate and modifier volumes in them: a point
        belongs to the first whose shape contains it, and is inside where that model is."""
        for model in models:
            if not isinstance(model, Model):
                raise TypeError(f"a region is a {type(model).__name__}; it must be a Model")
        if not models:
            raise ValueError("a model of no regions; there must be at least one")
        context = context_of(context, models[0])
        made = cls._wrap(cls._create(lib.msq_model_regions, context._ref, pointers(models),
                                     len(models)))
        made.context = context
        return made

    @classmethod
    def from_json(cls, text: Union[str, bytes], *,
                  base_directory: Union[None, str, "os.PathLike[str]"] = None, files: str = "below",
                  context: Optional[Context] = None, job: Optional[Job] = None) -> Model:
        """The model of a text in JSON (docs/model_file.md). base_directory: where the paths in it
        start; files: which it may name: `below` that directory, `none` or `any`. See Document for
        files, settings and limits."""
        from .document import Document
        return Document.from_json(text, base_directory=base_directory, files=files, context=context,
                                  job=job).model

    def to_json(self, *, title: Optional[str] = None,
                base_directory: Union[None, str, "os.PathLike[str]"] = None,
                max_numbers: int = 0) -> str:
        """The model as a text in JSON, from which from_json makes one with the same hash. Paths of
        files below base_directory become relative to it. Longer arrays than max_numbers are refused;
        0: a million."""
        definition = defaults(_abi.msq_json_def)
        if title is not None:
            definition.title = c_text(title, "title")
        if base_directory is not None:
            definition.base_directory = c_path(base_directory)
        definition.max_numbers = unsigned(max_numbers, 64, "max_numbers")
        size = ctypes.c_uint64()
        given = ctypes.byref(definition)
        lib.msq_model_to_json(self._ref, given, None, 0, ctypes.byref(size))
        written = ctypes.create_string_buffer(size.value + 1)
        lib.msq_model_to_json(self._ref, given, written, len(written), ctypes.byref(size))
        return written.value.decode()

    @property
    def hash(self) -> str:
        """32 hexadecimal digits: equal for equal definitions with equal inputs, on every machine,
        and different otherwise (docs/howto/caching.md)."""
        return hash_of(lib.msq_model_hash, self)

    @property
    def bounds(self) -> Tuple[Tuple[float, ...], Tuple[float, ...]]:
        """Smallest and largest corner of the coarse shape's bounding box."""
        low, high = (ctypes.c_double * 3)(), (ctypes.c_double * 3)()
        lib.msq_model_bounds(self._ref, low, high)
        return tuple(low), tuple(high)

    def scale_length(self, scale: int) -> float:
        """Characteristic length of a scale: its largest cell size; infinite for scale 0."""
        length = ctypes.c_double()
        lib.msq_model_scale_length(self._ref, unsigned(scale, 32, "scale"),
                                   ctypes.byref(length))
        return length.value

    def structure(self, scale: int = 1, *, region: int = 0) -> Structure:
        """The structure of a scale, of a region if the model has several."""
        if scale == 0:
            raise ValueError("scale is 0, which has a shape and no structure")
        return self._part(Structure, scale, region)

    def region_shape(self, region: int = 0) -> Shape:
        """The coarse shape, of a region if the model has several."""
        return self._part(Shape, 0, region)

    def _part(self, kind: Any, scale: int, region: int) -> Any:
        numbers = unsigned(region, 32, "region"), unsigned(scale, 32, "scale")

        def create(reference: Any, made: Any) -> None:
            lib.msq_model_scale(reference, *numbers, *((made, None) if kind is Shape else
                                                       (None, made)))

        part = kind._wrap(kind._create(create, self._ref))
        part.context = self.context
        return part

    def contains(self, points: Any, *, out: Optional[np.ndarray] = None, length_scale: float = 0.0,
                 method: str = "auto", critical_count: int = 0, group_parts: int = 0,
                 job: Optional[Job] = None) -> Any:
        """Whether points are in the model or on its boundary.

        points: an array (..., 3) of float32 or float64, read where it lies, or a PointGrid or
        Stratified. Returns bools of shape (...); a single point, (3,), gives one bool. out: an
        array of that shape, contiguous, of bool or uint8, to write to instead. Only scales whose
        characteristic length is at least length_scale are resolved: 0 all, infinity the coarse
        shape alone. method (`auto`, `point`, `set`), critical_count and group_parts: how sets are
        asked, with the same answers; Job.info says what came of it.
        """
        return self._ask(lib.msq_set_membership, points, out, (np.bool_, np.uint8), ctypes.c_uint8,
                         query_of(length_scale, method, critical_count, group_parts), job,
                         self._contains_point)

    def region(self, points: Any, *, out: Optional[np.ndarray] = None,
               job: Optional[Job] = None) -> Any:
        """Numbers of the regions that points belong to, -1 where none has them; 0 in a model that is
        not made of regions. points and job are as in contains; out is of int32."""

        def ask(model: Any, given: Any, _query: Any, values: Any, count: int, work: Any) -> None:
            lib.msq_set_region(model, given, values, count, work)

        return self._ask(ask, points, out, (np.int32,), ctypes.c_int32, None, job,
                         self._point_region)

    def distance(self, points: Any, *, out: Optional[np.ndarray] = None, length_scale: float = 0.0,
                 job: Optional[Job] = None) -> Any:
        """Signed distances to the model's boundary: positive outside, never too large in magnitude.

        points, length_scale and job are as in contains; out is of float64.
        """
        return self._ask(lib.msq_set_distance, points, out, (np.float64,), ctypes.c_double,
                         query_of(length_scale), job, self._point_distance)

    def material(self, points: Any, *, channels: Sequence[str] = (),
                 out: Optional[Tuple[Optional[np.ndarray], Optional[np.ndarray]]] = None,
                 length_scale: float = 0.0, job: Optional[Job] = None) -> Tuple[Any, np.ndarray]:
        """Ids of the materials at points, 0 outside the model, and values of channels there.

        Returns ids (...), uint32, and values (..., number of channels), float64, in the order of
        the names; values are 0 outside, and where the material has no such channel. A single point
        gives an int and its values. The material is that of the finest resolved scale that has one,
        or of its skin. out: a pair of arrays, either may be None, to write to instead. points,
        length_scale and job are as in contains.
        """
        ids_out, values_out = (None, None) if out is None else out
        names = encoded(channels)
        named = (ctypes.c_char_p * len(names))(*names)
        query = query_of(length_scale)
        given = definition_of(points)
        values = output(values_out, (*given.shape, len(names)), (np.float64,), given.array)
        reference = self._ref
        if ids_out is None and job is None and given.shape == ():
            found = ctypes.c_uint32()
            with held():
                lib.msq_point_material(reference, doubles(given.array, "point"), query, named,
                                       len(names), ctypes.byref(found),
                                       pointer(values, ctypes.c_double))
            return found.value, values
        ids = output(ids_out, given.shape, (np.uint32,), given.array)
        if np.may_share_memory(ids, values):
            raise ValueError("out has ids and values that lie in the same memory")

        def call(work: Any) -> None:
            # Holds all arrays for as long as the call, whatever becomes of the caller.
            lib.msq_set_material(reference, ctypes.byref(given.definition), query, named,
                                 len(names), pointer(ids, ctypes.c_uint32), ids.size,
                                 pointer(values, ctypes.c_double), values.size, work)

        interruptible(call, job, ids.size >= _LONG)
        return (ids if ids.shape or ids_out is not None else ids.item()), values

    def cast(self, origins: Any, directions: Any, *, t_min: Any = None, t_max: Any = None,
             length_scale: float = 0.0, job: Optional[Job] = None) -> np.recarray:
        """Where rays, origins + t * directions, first are in the solid at t_min <= t <= t_max.

        origins, directions: arrays (..., 3) of one dtype, float32 or float64, read where they lie.
        t_min, t_max: numbers or arrays of shape (...), copied unless they are contiguous float64 of
        that shape; None: 0 and infinity. Returns a record array of shape (...): t (infinity in a
        miss), normal, scale (-1 in a miss), starts_inside, cell and material (its id, 0 where there
        is none).
        """
        starts, ways = triples(origins, "origins"), triples(directions, "directions")
        if starts.shape != ways.shape or starts.coordinate_type != ways.coordinate_type:
            raise ValueError(f"origins of shape {starts.shape} and directions of shape "
                             f"{ways.shape} must be of one shape and dtype")
        definition = defaults(_abi.msq_rays_def)
        definition.coordinate_type = starts.coordinate_type
        definition.count = starts.count
        definition.origins, definition.origin_stride = starts.address, starts.stride
        definition.directions, definition.direction_stride = ways.address, ways.stride
        limits = [None if limit is None else
                  np.ascontiguousarray(np.broadcast_to(real(limit, name), starts.shape), np.float64)
                  for limit, name in ((t_min, "t_min"), (t_max, "t_max"))]
        to_double = ctypes.POINTER(ctypes.c_double)
        if limits[0] is not None:
            definition.t_min = limits[0].ctypes.data_as(to_double)
        if limits[1] is not None:
            definition.t_max = limits[1].ctypes.data_as(to_double)
        hits = np.zeros(starts.shape, dtype=np.dtype(_abi.msq_ray_hit))
        query, reference, lent = query_of(length_scale), self._ref, (starts, ways, limits)

        def call(work: Any) -> None:
            # Holds all arrays for as long as the call, whatever becomes of the caller.
            lib.msq_ray_cast(reference, ctypes.byref(definition), query,
                             pointer(hits, _abi.msq_ray_hit), lent[0].count, work)

        interruptible(call, job, starts.count >= _LONG)
        return hits.view(np.recarray)

    def render(self, camera: Optional[Camera] = None, width: int = 800, height: int = 600, *,
               outputs: Sequence[str] = ("rgba",), tile: Optional[Sequence[int]] = None,
               samples: int = 1, first_step: int = 1, colour_by: str = "plain",
               colours: Any = None, background: Sequence[float] = (0, 0, 0, 0), light: Any = None,
               ambient: Optional[float] = None, shadows: bool = False, occlusion_rays: int = 0,
               occlusion_distance: float = 0.0, length_scale: float = 0.0,
               on_pass: Optional[Callable[[Picture, RenderPass], Any]] = None,
               out: Optional[Picture] = None, job: Optional[Job] = None) -> Picture:
        """What a camera sees of the model, in a picture of width x height pixels.

            picture = model.render(width=1024, height=1024, samples=3, occlusion_rays=16)

        camera: None: Camera.fit(model, width, height). outputs: `depth`, `normal`, `scale`,
        `material` and `rgba`. They are those of the ray through the middle of each pixel; rgba is the
        mean of samples x samples rays. tile: (x, y, width, height) of a part of the picture to render.
        It equals that part of the whole picture. colour_by: `plain`, `scale`, `material` or `normal`.
        colours: (n, 3), linear, 0 to 1. background: red, green, blue, linear, and opacity. light: the
        direction to the light: right, up, towards the eye. None: msq's default. ambient: the part of
        the light that comes from all sides; None: msq's default. occlusion_rays rays, of length
        occlusion_distance, reduce it where they meet the model. shadows: whether the model keeps the
        rest of the light off. on_pass(picture, pass): msq calls it after each pass. The first pass has
        one ray per block of first_step x first_step pixels (64, 32 .. 1), later ones are finer. It
        stops the call by returning False. out: a picture whose arrays are written.
        length_scale and job are as in contains.
        """
        definition, keep = picture.make_definition(
            width, height, tile, samples, first_step, colour_by, colours, background, light,
            ambient, shadows, occlusion_rays, occlusion_distance)
        return picture.render(self, camera, definition, keep, outputs, length_scale, on_pass, out,
                              job)

    def volume_fraction(self, sample: Stratified, *, phase: str = "solid",
                        length_scale: float = 0.0, job: Optional[Job] = None) -> Estimate:
        """Volume fraction of a phase, `solid` or `void`, in the sample's box. The sample has at
        least two points a cell, here and below."""
        return statistics.volume_fraction(self._ref, sample, phase, length_scale, job)

    def two_point_correlation(self, sample: Stratified, lengths: Any, *,
                              direction: Optional[Sequence[float]] = None, phase: str = "solid",
                              length_scale: float = 0.0, job: Optional[Job] = None) -> np.recarray:
        """Probability that both ends of segments of the lengths are in the phase, in a direction or
        in all: arrays value, standard_error, low and high."""
        return statistics.along_segments(lib.msq_two_point_correlation, self._ref, sample, lengths,
                                         direction, phase, 0, length_scale, job)

    def lineal_path(self, sample: Stratified, lengths: Any, *,
                    direction: Optional[Sequence[float]] = None, phase: str = "solid",
                    step: float = 0.0, length_scale: float = 0.0,
                    job: Optional[Job] = None) -> np.recarray:
        """Probability that segments of the lengths lie wholly in the phase; gaps shorter than step
        may be missed, 0: as msq chooses it."""
        return statistics.along_segments(lib.msq_lineal_path, self._ref, sample, lengths, direction,
                                         phase, step, length_scale, job)

    def slicer(self, *, layer_height: Optional[float] = None, pitch: Any = None,
               resolution: Any = None, layer_count: int = 0, region: Any = None,
               layer_z: Any = None, output: Union[str, Sequence[Output]] = "bits",
               slab_layers: int = 0,
               length_scale: float = 0.0, window: Any = None, grey_samples: int = 4,
               grey_gamma: float = 1.0, grey_threshold: int = 0, mirror: str = "",
               transpose: bool = False, axis: int = 2, frame: Any = None) -> Slicer:
        """Plans layers normal to an axis, or in a frame: see Slicer."""
        return Slicer(self, layer_height=layer_height, pitch=pitch, resolution=resolution,
                      layer_count=layer_count, region=region, layer_z=layer_z, output=output,
                      slab_layers=slab_layers, length_scale=length_scale, window=window,
                      grey_samples=grey_samples, grey_gamma=grey_gamma,
                      grey_threshold=grey_threshold, mirror=mirror, transpose=transpose,
                      axis=axis, frame=frame)

    def contours(self, height: float, tolerance: float, *, axis: int = 2,
                 window: Optional[Window] = None, pitch: float = 0.0, type: str = "float64",
                 units: float = 1.0, length_scale: float = 0.0, topology_samples: int = 0,
                 job: Optional[Job] = None) -> Contours:
        """The section with a plane normal to the axis, as rings: see Contours."""
        return Contours(self, height, tolerance, axis=axis, window=window, pitch=pitch, type=type,
                        units=units, length_scale=length_scale,
                        topology_samples=topology_samples, job=job)

    def mesh(self, pitch: float, *, box: Optional[Box] = None, length_scale: float = 0.0,
             slab_layers: int = 0, job: Optional[Job] = None) -> Mesh:
        """The boundary of the model within a box as triangles: (vertices, normals, triangles).

        The mesh is closed and a manifold, also where the box cuts the model. pitch: the distance of
        the nodes at which the model is sampled. box: (min, max), else the model's bounds.
        """
        return surface.mesh(self, surface.definition_of(pitch, box, length_scale, slab_layers), job)

    def save_mesh(self, file: Union[str, "os.PathLike[str]", BinaryIO], pitch: float, *,
                  format: Optional[str] = None, box: Optional[Box] = None,
                  length_scale: float = 0.0, slab_layers: int = 0,
                  job: Optional[Job] = None) -> None:
        """Writes the mesh of mesh() to a path or a binary file, without holding it whole.

        format: `stl` or `ply`; None: by the path's ending. A file for `ply` must be able to seek. The
        file of a path gets its name when it is complete, and replaces an existing one then.
        """
        surface.save_mesh(self, file, format,
                          surface.definition_of(pitch, box, length_scale, slab_layers), job)

    def _contains_point(self, point: Any, query: Any) -> bool:
        inside = ctypes.c_int32()
        lib.msq_point_membership(self._ref, point, query, ctypes.byref(inside))
        return inside.value == 1

    def _point_region(self, point: Any, _query: Any) -> int:
        region = ctypes.c_int32()
        lib.msq_point_region(self._ref, point, ctypes.byref(region))
        return region.value

    def _point_distance(self, point: Any, query: Any) -> float:
        distance = ctypes.c_double()
        lib.msq_point_distance(self._ref, point, query, ctypes.byref(distance))
        return distance.value

    def _ask(self, ask: Any, points: Any, out: Optional[np.ndarray], dtypes: Sequence[Any],
             kind: Any, query: Any, job: Optional[Job],
             ask_one: Callable[[Any, Any], Any]) -> Any:
        if out is None and job is None and not isinstance(points, PointSet):
            array = triples(points)
            if array.shape == ():
                with held():
                    return ask_one(doubles(array.array, "point"), query)
        given = definition_of(points)
        answers = output(out, given.shape, dtypes, given.array)
        reference = self._ref

        def call(work: Any) -> None:
            # Holds both arrays for as long as the call, whatever becomes of the caller.
            ask(reference, ctypes.byref(given.definition), query, pointer(answers, kind),
                answers.size, work)

        interruptible(call, job, answers.size >= _LONG)
        return answers if answers.shape or out is not None else answers.item()
