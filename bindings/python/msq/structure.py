# SPDX-License-Identifier: Apache-2.0
"""Structures: scales 1 and finer of a model. Each fills all space; the model cuts it."""
from __future__ import annotations

import ctypes
import dataclasses
import math
from typing import Any, Callable, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _abi, statistics
from ._arrays import Elements, elements, output, pointer, triples, vector
from ._given import parameter, remembers
from ._grid import AnyWarp, Cell, Period, set_grid, set_period, set_warp
from ._handle import Handle, hash_of, pointers
from ._host import HashKey, HostPoints, create
from ._interrupt import build, interruptible
from ._library import constant, defaults, lib
from .context import Context, Job, MadeIn, context_of, doubles, record, c_text, triple, unsigned
from .field import Param, set_param, set_parameters
from .fill import Fill
from .points import Stratified, definition_of
from .shape import Shape
from .statistics import Calibration
from .strut_graph import StrutGraph
from .unit_cell import UnitCellLike
from .unit_cell import unit_cell as as_unit_cell


class Structure(Handle):
    """A fine-scale structure, on a grid of neighbourhood cells unless it is Beams. Made as one of the
    kinds, or from others: a | b, a & b and a - b hold the points in any, in both, and in a alone.

    Cell (i, j, k) of the grid holds the points origin + rotation @ (((i, j, k) + u) * cell_size),
    0 <= u < 1; rotation is an orthonormal 3 x 3 matrix.
    """

    _kind = "structure"
    context = MadeIn()

    def __init__(self) -> None:
        raise TypeError("structures are made as Lattice, Foam, Functional and the like")

    def _make(self, context: Context, create: Any, definition: ctypes.Structure) -> None:
        self._reference = self._create(create, context._ref, ctypes.byref(definition))
        self.context = context

    @classmethod
    @remembers
    def union(cls, *structures: Structure) -> Structure:
        """Points in any of the structures."""
        return Structure._boolean("union", structures)

    @classmethod
    @remembers
    def intersection(cls, *structures: Structure) -> Structure:
        """Points in all of the structures."""
        return Structure._boolean("intersection", structures)

    @classmethod
    @remembers
    def difference(cls, *structures: Structure) -> Structure:
        """Points of the first structure that are in no other."""
        return Structure._boolean("difference", structures)

    @classmethod
    @remembers
    def blend(cls, a: Structure, b: Structure, fraction: Param) -> Structure:
        """A structure that becomes another one: a where the fraction is 0, b where it is 1. In between
        it holds the points where (1 - f) times the signed distance of a plus f times that of b is
        at most 0."""
        return Structure._of_two(lib.msq_structure_blend, (), a, b, "fraction", fraction)

    @classmethod
    @remembers
    def smooth_union(cls, a: Structure, b: Structure, radius: Param) -> Structure:
        """Points in a or b, and fillets where both surfaces are nearer than the radius."""
        return Structure._smooth("union", a, b, radius)

    @classmethod
    @remembers
    def smooth_intersection(cls, a: Structure, b: Structure, radius: Param) -> Structure:
        """Points in a and b, with edges that are rounded where both surfaces are nearer than the
        radius."""
        return Structure._smooth("intersection", a, b, radius)

    @classmethod
    @remembers
    def smooth_difference(cls, a: Structure, b: Structure, radius: Param) -> Structure:
        """Points of a that are not in b, with edges that are rounded where both surfaces are nearer
        than the radius."""
        return Structure._smooth("difference", a, b, radius)

    @staticmethod
    def _smooth(operation: str, a: Structure, b: Structure, radius: Param) -> Structure:
        return Structure._of_two(lib.msq_structure_smooth_boolean,
                                 (constant("MSQ_BOOLEAN_", operation, "operation"),), a, b,
                                 "radius", radius)

    @staticmethod
    def _of_two(function: Any, first: tuple, a: Structure, b: Structure, name: str,
                param: Param) -> Structure:
        for structure, which in ((a, "a"), (b, "b")):
            if not isinstance(structure, Structure):
                raise TypeError(f"{which} is a {type(structure).__name__}; it must be a Structure")
        value = _abi.msq_param()
        set_param(value, name, param)
        made = Structure._wrap(Structure._create(function, *first, a._ref, b._ref,
                                                 ctypes.byref(value)))
        made.context = a.context
        return made

    def __or__(self, other: Structure) -> Structure:
        return Structure.union(self, other)

    def __and__(self, other: Structure) -> Structure:
        return Structure.intersection(self, other)

    def __sub__(self, other: Structure) -> Structure:
        return Structure.difference(self, other)

    @staticmethod
    def _boolean(operation: str, structures: Sequence[Structure]) -> Structure:
        for structure in structures:
            if not isinstance(structure, Structure):
                raise TypeError(f"a structure is a {type(structure).__name__}; it must be a "
                                "Structure")
        if not structures:
            raise ValueError(f"a {operation} of no structures; there must be at least one")
        made = Structure._wrap(Structure._create(
            lib.msq_structure_boolean, constant("MSQ_BOOLEAN_", operation, "operation"),
            pointers(structures), len(structures)))
        made.context = structures[0].context
        return made

    @property
    def hash(self) -> str:
        """32 hexadecimal digits: equal for equal definitions with equal inputs, on every machine,
        and different otherwise (docs/howto/caching.md)."""
        return hash_of(lib.msq_structure_hash, self)

    def calibrate(self, target: float, *, sample: Optional[Stratified] = None, curve: int = 0,
                  job: Optional[Job] = None) -> Calibration:
        """The parameter (radius of struts, level of a function), everywhere the same, at which the
        structure has a target volume fraction; the one it was built with plays no part.

        curve: number of pairs of parameter and fraction wanted besides, 0 or from 2 on: with them
        Field.map makes a field of radius from one of density. sample: where to measure; None: one
        cell, or 16^3 cells of a foam.
        """
        return statistics.calibrate(self.context._ref, self._ref, target, sample, curve, job)

    def onset(self, points: Any, *, signed: bool = False, gradient: bool = False,
              out: Optional[np.ndarray] = None, job: Optional[Job] = None) -> Any:
        """Of each of the points, an array (..., 3) or a set: the least radius or level at which it
        is inside. Lattices and foams: the distance to the nearest strut axis; functional structures:
        the function, of sheets its magnitude.

        signed: less the radius or level there: at most 0 inside. gradient: returns (onsets,
        gradients), the latter of shape (..., 3). out: float64, contiguous, for the onsets.
        """
        given = definition_of(points)
        onsets = output(out, given.shape, (np.float64,), given.array)
        slopes = np.empty((*given.shape, 3)) if gradient else None
        value = _abi.MSQ_ONSET_SIGNED if signed else _abi.MSQ_ONSET_PLAIN
        context, reference = self.context._ref, self._ref
        interruptible(lambda work: lib.msq_set_onset(
            context, reference, ctypes.byref(given.definition), value,
            pointer(onsets, ctypes.c_double), onsets.size,
            None if slopes is None else pointer(slopes, ctypes.c_double),
            0 if slopes is None else slopes.size, work), job)
        answers = onsets if onsets.shape or out is not None else onsets.item()
        return answers if slopes is None else (answers, slopes)

    def fill_lines(self, polygon: Any, z: float, *, scale: float = 1e-6,
                   origin: Sequence[float] = (0, 0), tolerance: float = 0.0,
                   min_length: float = 0.0, pair_distance: float = 0.0,
                   corner_distance: float = 0.0, job: Optional[Job] = None) -> Fill:
        """The middle lines of thin walls at height z, within a polygon: paths for a nozzle. A union has
        those of all its structures, an intersection or a difference those of the first, bounded.

        polygon: a ring, (n, 2) of whole numbers, or a list of rings, outlines and holes in any order
        and direction. int32 stays int32 in the result; all else is int64. scale: model units per unit
        of these coordinates; origin: where 0, 0 is in the model. tolerance: greatest distance from
        curved walls; 0: 1/200 of a cell. Paths shorter than min_length are dropped. pair_distance: some
        walls become two lines so far apart, if that joins paths. corner_distance: where rounded corners begin.
        """
        return Fill._of(self.context._ref, self._ref, polygon, z, scale, origin, tolerance,
                        min_length, pair_distance, corner_distance, job)

    def fill_cell_size(self, line_width: float, density: float, *,
                       job: Optional[Job] = None) -> Tuple[float, float, float]:
        """The cell sizes at which the structure's fill lines, of this width, cover this share of the
        area on average over all heights. Make the structure anew with them."""
        found = (ctypes.c_double * 3)()
        context, reference = self.context._ref, self._ref
        interruptible(lambda work: lib.msq_fill_calibrate(context, reference, line_width, density,
                                                          found, work), job)
        return found[0], found[1], found[2]

    def strut_graph(self, min: Sequence[float], max: Sequence[float], *, near: bool = False,
                    shape: Optional[Shape] = None, job: Optional[Job] = None) -> StrutGraph:
        """The struts of a lattice, an open foam or beams as arrays, joined at numbered nodes: a beam
        model.

        Struts whose middle is in the half-open box from min to max, so boxes that tile a region
        share none. near: all struts that come near the box. shape: struts are cut to it.
        """
        return StrutGraph._of(self.context._ref, self._ref, min, max, near, shape, job)


@dataclasses.dataclass(frozen=True)
class LatticeFaces:
    """Faces between neighbouring cells of a lattice that have different unit cells."""

    axis: int  #: of the first unmatched face, normal to x, y or z of the grid; -1: there is none
    cells: int  #: looked at
    faces: int  #: between two with different unit cells
    unmatched: int  #: of these, with a node on one side that has no copy on the other
    cell: Tuple[int, int, int]  #: index of the cell below the first unmatched face
    types: Tuple[int, int]  #: what stands in the two cells beside it
    point: Tuple[float, float, float]  #: its centre


class Lattice(Structure):
    """Periodic strut lattice: the points within radius of a unit cell's struts.

    unit_cell: a name (`cubic`, `bcc`, `octet`, ...: see UnitCell), a UnitCell, or a pair of nodes
    (n, 3) and struts (m, 2); or with cell_choice a list of those, of which the choice, rounded to
    an index, names the one that stands in each cell. period: a Period, for cells whose size varies
    along an axis; cell_size along it is ignored. warp: a Warp (around an axis or a point) or a SampledWarp.
    """

    unit_cell: parameter[Any] = parameter("As given.")
    radius: parameter[Param] = parameter("Of the struts.")
    cell_choice: parameter[Optional[Param]] = parameter("Which of the unit cells stands in a cell.")
    cell_size: parameter[Cell] = parameter("As given: one number, or three.")
    clusters: parameter[int] = parameter("As given.")
    origin: parameter[Sequence[float]] = parameter("Of the grid.")
    rotation: parameter[Any] = parameter("Of the grid; None: the identity.")
    period: parameter[Optional[Period]] = parameter("Cells of varying size; None: all alike.")
    warp: parameter[Optional[AnyWarp]] = parameter("Cells that are bent; None: boxes.")

    @remembers
    def __init__(self, unit_cell: Union[UnitCellLike, Sequence[UnitCellLike]] = "bcc", *,
                 radius: Param, cell_choice: Optional[Param] = None, cell_size: Cell = 1.0,
                 clusters: int = 0, origin: Sequence[float] = (0, 0, 0), rotation: Any = None,
                 period: Optional[Period] = None, warp: Optional[AnyWarp] = None,
                 context: Optional[Context] = None) -> None:
        definition = defaults(_abi.msq_lattice_def)
        set_grid(definition.grid, cell_size, origin, rotation)
        cells_kept = set_period(definition, period), set_warp(definition, warp)
        set_param(definition.radius, "radius", radius)
        definition.clusters = unsigned(clusters, 32, "clusters")
        if cell_choice is None:
            kept = [as_unit_cell(unit_cell)]
            for label in ("unit_cell", "nodes", "node_count", "struts", "strut_count",
                          "strut_factors"):
                setattr(definition, label, getattr(kept[0]._definition, label))
        else:
            kept = [as_unit_cell(cell) for cell in unit_cell]
            definition.cells = (_abi.msq_unit_cell_def * len(kept))(
                *(cell._definition for cell in kept))
            definition.cell_count = len(kept)
            set_param(definition.cell_choice, "cell_choice", cell_choice)
        self._make(context_of(context, radius, cell_choice), lib.msq_structure_lattice, definition)
        del cells_kept  # the call copies them

    def faces(self, min: Sequence[float], max: Sequence[float], *,
              job: Optional[Job] = None) -> LatticeFaces:
        """Says whether the unit cells of neighbours meet, in the box from min to max."""
        filled = _abi.msq_lattice_faces_report()
        filled.struct_size = ctypes.sizeof(filled)
        reference, low, high = self._ref, doubles(min, "min"), doubles(max, "max")
        interruptible(lambda work: lib.msq_lattice_faces(reference, low, high, ctypes.byref(filled),
                                                         work), job)
        return record(LatticeFaces, filled)


class PlateLattice(Structure):
    """Periodic lattice of plates: the points within half of thickness of a plate cell's triangles,
    and, with a radius, of the struts of a unit cell.

    plate_cell: a name (`cubic`, `bcc`, `fcc`, `cubic_octet`, `kelvin`), or a pair of nodes (n, 3) in
    [0, 1] and faces (m, 3) of node indices. face_factors: of the thickness, one per face. unit_cell:
    as in Lattice. radius 0: no struts.
    """

    plate_cell: parameter[Any] = parameter("As given.")
    thickness: parameter[Param] = parameter("Of the plates.")
    face_factors: parameter[Any] = parameter("Of the thickness, one per face; None: all 1.")
    radius: parameter[Param] = parameter("Of the struts.")
    unit_cell: parameter[Any] = parameter("Of the struts, as given.")
    cell_size: parameter[Cell] = parameter("As given: one number, or three.")
    origin: parameter[Sequence[float]] = parameter("Of the grid.")
    rotation: parameter[Any] = parameter("Of the grid; None: the identity.")

    @remembers
    def __init__(self, plate_cell: Union[str, Sequence[Any]] = "cubic", *, thickness: Param,
                 face_factors: Any = None, radius: Param = 0.0, unit_cell: UnitCellLike = "cubic",
                 cell_size: Cell = 1.0, origin: Sequence[float] = (0, 0, 0), rotation: Any = None,
                 context: Optional[Context] = None) -> None:
        definition = defaults(_abi.msq_plate_lattice_def)
        set_grid(definition.grid, cell_size, origin, rotation)
        set_param(definition.thickness, "thickness", thickness)
        set_param(definition.radius, "radius", radius)
        struts = as_unit_cell(unit_cell)
        has_struts = definition.radius.field or definition.radius.value != 0
        if has_struts:
            for label in ("unit_cell", "nodes", "node_count", "struts", "strut_count",
                          "strut_factors"):
                setattr(definition, label, getattr(struts._definition, label))
        kept = []
        if isinstance(plate_cell, str):
            definition.plate_cell = constant("MSQ_PLATE_CELL_", plate_cell, "plate_cell")
        else:
            definition.plate_cell = _abi.MSQ_PLATE_CELL_CUSTOM
            nodes, faces = (vector(plate_cell[0], np.float64, (-1, 3), "nodes"),
                            vector(plate_cell[1], np.uint32, (-1, 3), "faces"))
            kept += [nodes, faces]
            if has_struts and struts._definition.unit_cell == _abi.MSQ_UNIT_CELL_CUSTOM:
                # One list of nodes, first the plates', then the struts'.
                own, pairs = struts.geometry()
                pairs = np.ascontiguousarray(pairs + np.uint32(len(nodes)))
                nodes = np.concatenate([nodes, own])
                kept += [nodes, pairs]
                definition.struts = pointer(pairs, ctypes.c_uint32)
            definition.nodes = pointer(nodes, ctypes.c_double)
            definition.node_count = len(nodes)
            definition.faces = pointer(faces, ctypes.c_uint32)
            definition.face_count = len(faces)
        if face_factors is not None:
            factors = vector(face_factors, np.float64, (-1,), "face_factors")
            kept.append(factors)
            if not isinstance(plate_cell, str) and len(factors) != definition.face_count:
                raise ValueError(f"there are {len(factors)} face_factors and "
                                 f"{definition.face_count} faces")
            definition.face_factors = pointer(factors, ctypes.c_double)
            definition.face_count = len(factors)
        self._make(context_of(context, thickness, radius), lib.msq_structure_plate_lattice,
                   definition)
        del kept, struts  # the call copies them


class Foam(Structure):
    """Voronoi foam of one jittered seed per cell: the points within radius of the edges of the
    Voronoi diagram (struts), and those within half of wall_thickness of its faces (walls).

    radius may be 0 where wall_thickness is not. vent_radius: of a hole through each wall. jitter: 0,
    seeds at cell centres, to 1, anywhere. weight: the greatest radius of the seeds' spheres. period,
    warp: cells that vary in size, lie around an axis or follow a map. method: `auto` is fastest.
    """

    radius: parameter[Param] = parameter("Of the struts.")
    cell_size: parameter[Cell] = parameter("As given: one number, or three.")
    jitter: parameter[float] = parameter("0 to 1.")
    seed: parameter[int] = parameter("As given.")
    density: parameter[Param] = parameter("Seeds in the volume of a cell.")
    method: parameter[str] = parameter("As given.")
    origin: parameter[Sequence[float]] = parameter("Of the grid.")
    rotation: parameter[Any] = parameter("Of the grid; None: the identity.")
    wall_thickness: parameter[Param] = parameter("0: no walls.")
    vent_radius: parameter[Param] = parameter("Of a hole in each wall; 0: none.")
    stretch: parameter[Sequence[float]] = parameter("Of the cells along the grid's axes.")
    weight: parameter[float] = parameter("Of the seeds; 0: a Voronoi diagram.")
    period: parameter[Optional[Period]] = parameter("Cells of varying size; None: all alike.")
    warp: parameter[Optional[AnyWarp]] = parameter("Cells that are bent; None: boxes.")

    @remembers
    def __init__(self, *, radius: Param = 0.0, cell_size: Cell = 1.0, jitter: float = 1.0,
                 seed: int = 0, density: Param = 1.0, method: str = "auto",
                 origin: Sequence[float] = (0, 0, 0), rotation: Any = None,
                 wall_thickness: Param = 0.0, vent_radius: Param = 0.0, weight: float = 0.0,
                 stretch: Sequence[float] = (1, 1, 1), period: Optional[Period] = None,
                 warp: Optional[AnyWarp] = None, context: Optional[Context] = None) -> None:
        definition = defaults(_abi.msq_foam_def)
        set_grid(definition.grid, cell_size, origin, rotation)
        set_param(definition.radius, "radius", radius)
        set_param(definition.density, "density", density)
        set_param(definition.wall_thickness, "wall_thickness", wall_thickness)
        set_param(definition.vent_radius, "vent_radius", vent_radius)
        definition.stretch[:], definition.weight = triple(stretch, "stretch"), weight
        definition.jitter, definition.seed = jitter, unsigned(seed, 64, "seed")
        definition.method = constant("MSQ_FOAM_", method, "method")
        kept = set_period(definition, period), set_warp(definition, warp)  # until the call is over
        self._make(context_of(context, radius, density, wall_thickness, vent_radius),
                   lib.msq_structure_foam, definition)
        del kept


class Beams(Structure):
    """The points in at least one beam or ball of a list, such as other software designs.

    nodes (n, 3), float32 or float64; beams (m, 2) and balls (k,) of node indices. radius: a number,
    or (m, 2), at the first and at the second node, between which it is linear. cap: `sphere`,
    `hemisphere` or `butt`, or (m, 2) numbers of msq_cap, 0 to 2 in this order. ball_radius: a
    number or (k,). Beams shorter than min_length are dropped. length_scale: characteristic length
    of the scale; 0: the longest beam, or the largest diameter if that is more.

    Arrays of the nodes' type, of uint32 (indices) and of uint8 (caps) are read where they lie;
    others are copied. The structure keeps its own.
    """

    min_length: parameter[float] = parameter("Shorter beams were dropped.")

    @remembers
    def __init__(self, nodes: Any, beams: Any = None, *, radius: Any = 0.0, cap: Any = "sphere",
                 balls: Any = None, ball_radius: Any = 0.0, min_length: float = 0.0,
                 length_scale: float = 0.0, context: Optional[Context] = None,
                 job: Optional[Job] = None) -> None:
        definition = defaults(_abi.msq_beams_def)
        points = triples(nodes, "nodes")
        definition.coordinate_type = points.coordinate_type
        definition.nodes = points.address
        definition.node_count = points.count
        definition.node_stride = points.stride
        pairs = elements(_or_none(beams), np.uint32, 2, "beams")
        definition.beams = ctypes.cast(pairs.address, ctypes.POINTER(ctypes.c_uint32))
        definition.beam_count = pairs.count
        definition.beam_stride = pairs.stride
        single = elements(_or_none(balls), np.uint32, 1, "balls")
        definition.balls = ctypes.cast(single.address, ctypes.POINTER(ctypes.c_uint32))
        definition.ball_count = single.count
        definition.ball_stride = single.stride
        kept: List[Any] = [points, pairs, single]  # what the call reads
        if np.ndim(radius) == 0:
            definition.radius = radius
        else:
            kept.append(_of_each(radius, points.array.dtype, 2, "radius", pairs, "beams"))
            definition.radii, definition.radius_stride = kept[-1].address, kept[-1].stride
        if np.ndim(ball_radius) == 0:
            definition.ball_radius = ball_radius
        else:
            kept.append(_of_each(ball_radius, points.array.dtype, 1, "ball_radius", single,
                                 "balls"))
            definition.ball_radii, definition.ball_radius_stride = kept[-1].address, kept[-1].stride
        if isinstance(cap, str):
            definition.cap = constant("MSQ_CAP_", cap, "cap")
        else:
            kept.append(_of_each(cap, np.uint8, 2, "cap", pairs, "beams"))
            definition.caps = ctypes.cast(kept[-1].address, ctypes.POINTER(ctypes.c_uint8))
            definition.cap_stride = kept[-1].stride
        definition.min_length = min_length
        definition.length_scale = length_scale
        context = context_of(context)

        def make(create: Any) -> Any:
            self._make(context, create, definition)
            return kept  # to this end: a call that was interrupted may still read them

        build(make, lib.msq_structure_beams, job)


def _or_none(indices: Any) -> Any:
    return () if indices is None else indices


def _of_each(values: Any, dtype: Any, width: int, name: str, owners: Elements,
             owners_name: str) -> Elements:
    """Numbers of each beam or ball, of which C cannot see how many there are."""
    if isinstance(values, np.ndarray) and values.dtype.kind == "f" and \
            values.dtype.itemsize > np.dtype(dtype).itemsize:
        raise TypeError(f"{name} are of dtype {values.dtype}; with nodes of {np.dtype(dtype)} they "
                        "must be of that, or numbers would be rounded")
    found = elements(values, dtype, width, name)
    if found.count != owners.count:
        raise ValueError(f"there are {found.count} {name} and {owners.count} {owners_name}")
    return found


class Functional(Structure):
    """The points where a function of the position within the cell is at most the level (`network`),
    or its magnitude is (`sheet`).

    function: a name (`gyroid`, `schwarz_p`, `diamond`, `i_wp`, `neovius`, `f_rd`, `lidinoid`,
    `split_p`, `fischer_koch_s`, `c_y`, `c_plus_minus_y`, `karcher_k`, `g_prime`, `double_gyroid`,
    `double_diamond`, `double_p`, `honeycomb`, `rods`); or give an expression in x, y, z (angles, 0 to 2 pi) with the values of its
    parameters. Of sheets thickness, the mean one of the walls, may be given instead of level.
    period: a Period, for cells whose size varies along an axis; cell_size along it is ignored.
    warp: a Warp, for cells around an axis or a point, or a SampledWarp, for a map.
    """

    function: parameter[Optional[str]] = parameter("Its name; None: an expression.")
    expression: parameter[Optional[str]] = parameter("None: a named function.")
    parameters: parameter[Optional[Mapping[str, float]]] = parameter("Of the expression.")
    kind: parameter[str] = parameter("`network` or `sheet`.")
    level: parameter[Param] = parameter("As given.")
    thickness: parameter[Param] = parameter("Of the walls; 0: by the level.")
    cell_size: parameter[Cell] = parameter("As given: one number, or three.")
    clusters: parameter[int] = parameter("As given.")
    origin: parameter[Sequence[float]] = parameter("Of the grid.")
    rotation: parameter[Any] = parameter("Of the grid; None: the identity.")
    period: parameter[Optional[Period]] = parameter("Cells of varying size; None: all alike.")
    warp: parameter[Optional[AnyWarp]] = parameter("Cells that are bent; None: boxes.")

    @remembers
    def __init__(self, function: Optional[str] = None, *, expression: Optional[str] = None,
                 parameters: Optional[Mapping[str, float]] = None, kind: str = "network",
                 level: Param = 0.0, thickness: Param = 0.0, cell_size: Cell = 1.0,
                 clusters: int = 0, origin: Sequence[float] = (0, 0, 0), rotation: Any = None,
                 period: Optional[Period] = None, warp: Optional[AnyWarp] = None,
                 context: Optional[Context] = None) -> None:
        if (function is None) == (expression is None):
            raise TypeError("Functional takes a function's name or an expression, one of the two")
        definition = defaults(_abi.msq_functional_def)
        set_grid(definition.grid, cell_size, origin, rotation)
        set_param(definition.level, "level", level)
        set_param(definition.thickness, "thickness", thickness)
        definition.kind = constant("MSQ_FUNCTIONAL_", kind, "kind")
        definition.clusters = unsigned(clusters, 32, "clusters")
        if expression is None:
            definition.function = constant("MSQ_FUNCTION_", function or "", "function")
        else:
            definition.function = _abi.MSQ_FUNCTION_EXPRESSION
            definition.expression = c_text(expression, "expression")
        set_parameters(definition, parameters)
        kept = set_period(definition, period), set_warp(definition, warp)
        self._make(context_of(context, level, thickness), lib.msq_structure_functional, definition)
        del kept  # the call copies it


class Waves(Structure):
    """A spinodal structure: the points where a sum of waves with random directions and phases is at
    most the level (`network`), or its magnitude is (`sheet`).

    wavelength: a number, or one for each axis. volume_fraction: in place of a level, the fraction of
    the volume. cone_angles: half-angles of cones about the axes, in degrees, in which the waves'
    directions are; one small cone makes layers, two make columns, three a cubic structure. tile:
    wavelengths along each axis after which the structure repeats; 0: it need not.
    """

    @remembers
    def __init__(self, wavelength: Cell = 1.0, *, count: int = 256, seed: int = 0,
                 kind: str = "network", level: Param = 0.0, volume_fraction: float = 0.0,
                 cone_angles: Sequence[float] = (90, 0, 0), tile: Sequence[int] = (0, 0, 0),
                 origin: Sequence[float] = (0, 0, 0), rotation: Any = None,
                 context: Optional[Context] = None) -> None:
        definition = defaults(_abi.msq_waves_def)
        set_grid(definition.grid, wavelength, origin, rotation)
        set_param(definition.level, "level", level)
        definition.kind = constant("MSQ_FUNCTIONAL_", kind, "kind")
        definition.count = unsigned(count, 32, "count")
        definition.seed = unsigned(seed, 64, "seed")
        if len(cone_angles) != 3 or len(tile) != 3:
            raise ValueError("cone_angles and tile have three numbers each")
        for axis in range(3):
            definition.cone_angles[axis] = cone_angles[axis]
            definition.tile[axis] = unsigned(tile[axis], 32, "tile")
        definition.volume_fraction = volume_fraction
        self._make(context_of(context, level), lib.msq_structure_waves, definition)


class HostStructure(Structure):
    """A structure that functions of Python compute.

    inside(points) answers HostPoints by n bools, and is enough. For sets build_cell(cell) may make
    what is to be known of a cell (i, j, k), kept in the context's cache, which evaluate_cell(data,
    points) gets with points that all lie in it. box(min, max): True, False or None, whether a box
    is inside, outside or neither as a whole. distance(points): n numbers, at most the distance to
    the boundary. Arrays are valid until the function returns; calls and concurrent are as for
    Field.host.
    """

    @remembers
    def __init__(self, inside: Optional[Callable[[HostPoints], Any]] = None, *,
                 build_cell: Optional[Callable[[Tuple[int, int, int]], Any]] = None,
                 evaluate_cell: Optional[Callable[[Any, HostPoints], Any]] = None,
                 box: Optional[Callable[[Any, Any], Optional[bool]]] = None,
                 distance: Optional[Callable[[HostPoints], Any]] = None, cell_size: Cell = 1.0,
                 origin: Sequence[float] = (0, 0, 0), rotation: Any = None,
                 concurrent: bool = False, hash_key: HashKey = None,
                 context: Optional[Context] = None) -> None:
        definition = defaults(_abi.msq_host_structure_def)
        set_grid(definition.grid, cell_size, origin, rotation)
        create(lambda: self._make(context_of(context), lib.msq_structure_host, definition),
               definition, concurrent, hash_key, inside=inside, build_cell=build_cell,
               evaluate_cell=evaluate_cell, box=box, distance=distance)


class HostFunctional(Structure):
    """As Functional, of a function of Python: evaluate(angles) answers angles (n, 3), 0 to 2 pi, by
    n numbers. lipschitz or range(min, max) make it fast, as for Field.host."""

    @remembers
    def __init__(self, evaluate: Callable[[Any], Any], *, lipschitz: float = math.inf,
                 range: Optional[Callable[[Any, Any], Any]] = None, kind: str = "network",
                 level: Param = 0.0, cell_size: Cell = 1.0, clusters: int = 0,
                 origin: Sequence[float] = (0, 0, 0), rotation: Any = None,
                 concurrent: bool = False, hash_key: HashKey = None,
                 context: Optional[Context] = None) -> None:
        definition = defaults(_abi.msq_host_function_def)
        set_grid(definition.grid, cell_size, origin, rotation)
        set_param(definition.level, "level", level)
        definition.kind = constant("MSQ_FUNCTIONAL_", kind, "kind")
        definition.clusters = unsigned(clusters, 32, "clusters")
        definition.lipschitz = lipschitz
        create(lambda: self._make(context_of(context, level), lib.msq_structure_host_function,
                                  definition),
               definition, concurrent, hash_key, evaluate=evaluate, range=range)
