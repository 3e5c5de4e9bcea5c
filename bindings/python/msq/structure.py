# SPDX-License-Identifier: Apache-2.0
"""Structures: scales 1 and finer of a model. Each fills all space; the model cuts it."""
from __future__ import annotations

import ctypes
import dataclasses
import math
from typing import Any, Callable, Mapping, Optional, Sequence, Tuple, Union

from . import _abi, statistics
from ._grid import Cell, set_grid
from ._handle import Handle
from ._host import HostPoints, create
from ._interrupt import interruptible
from ._library import constant, defaults, lib
from .context import Context, Job, context_of, doubles, record, unsigned
from .field import Param, set_param, set_parameters
from .points import Stratified
from .statistics import Calibration
from .unit_cell import UnitCellLike
from .unit_cell import unit_cell as as_unit_cell


class Structure(Handle):
    """A fine-scale structure on a grid of neighbourhood cells. Made as one of the kinds.

    Cell (i, j, k) of the grid holds the points origin + rotation @ (((i, j, k) + u) * cell_size),
    0 <= u < 1; rotation is an orthonormal 3 x 3 matrix.
    """

    _kind = "structure"
    context: Context

    def __init__(self) -> None:
        raise TypeError("structures are made as Lattice, Foam, Functional and the like")

    def _make(self, context: Context, create: Any, definition: ctypes.Structure) -> None:
        self._reference = self._create(create, context._ref, ctypes.byref(definition))
        self.context = context

    def calibrate(self, target: float, *, sample: Optional[Stratified] = None, curve: int = 0,
                  job: Optional[Job] = None) -> Calibration:
        """The parameter (radius of struts, level of a function), everywhere the same, at which the
        structure has a target volume fraction; the one it was built with plays no part.

        curve: number of pairs of parameter and fraction wanted besides, 0 or from 2 on: with them
        Field.map makes a field of radius from one of density. sample: where to measure; None: one
        cell, or 16^3 cells of a foam.
        """
        return statistics.calibrate(self.context._ref, self._ref, target, sample, curve, job)


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
    an index, names the one that stands in each cell.
    """

    def __init__(self, unit_cell: Union[UnitCellLike, Sequence[UnitCellLike]] = "bcc", *,
                 radius: Param, cell_choice: Optional[Param] = None, cell_size: Cell = 1.0,
                 clusters: int = 0, origin: Sequence[float] = (0, 0, 0), rotation: Any = None,
                 context: Optional[Context] = None) -> None:
        definition = defaults(_abi.msq_lattice_def)
        set_grid(definition.grid, cell_size, origin, rotation)
        set_param(definition.radius, radius)
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
            set_param(definition.cell_choice, cell_choice)
        self._make(context_of(context, radius, cell_choice), lib.msq_structure_lattice, definition)

    def faces(self, min: Sequence[float], max: Sequence[float], *,
              job: Optional[Job] = None) -> LatticeFaces:
        """Says whether the unit cells of neighbours meet, in the box from min to max."""
        filled = _abi.msq_lattice_faces_report()
        filled.struct_size = ctypes.sizeof(filled)
        reference, low, high = self._ref, doubles(min, "min"), doubles(max, "max")
        interruptible(lambda work: lib.msq_lattice_faces(reference, low, high, ctypes.byref(filled),
                                                         work), job)
        return record(LatticeFaces, filled)


class Foam(Structure):
    """Open-cell Voronoi foam: the points within radius of the edges of the Voronoi diagram of one
    jittered seed per cell.

    jitter: 0, seeds at cell centres, to 1, anywhere in their cells. density: seeds in a cell's
    volume. method: how sets and slices are answered, `auto` the fastest.
    """

    def __init__(self, *, radius: Param, cell_size: Cell = 1.0, jitter: float = 1.0, seed: int = 0,
                 density: Param = 1.0, method: str = "auto", origin: Sequence[float] = (0, 0, 0),
                 rotation: Any = None, context: Optional[Context] = None) -> None:
        definition = defaults(_abi.msq_foam_def)
        set_grid(definition.grid, cell_size, origin, rotation)
        set_param(definition.radius, radius)
        set_param(definition.density, density)
        definition.jitter = jitter
        definition.seed = unsigned(seed, 64, "seed")
        definition.method = constant("MSQ_FOAM_", method, "method")
        self._make(context_of(context, radius, density), lib.msq_structure_foam, definition)


class Functional(Structure):
    """The points where a function of the position within the cell is at most the level (`network`),
    or its magnitude is (`sheet`).

    function: a name (`gyroid`, `schwarz_p`, `diamond`, `i_wp`, `neovius`, `f_rd`, `lidinoid`,
    `split_p`); or give an expression in x, y, z (angles, 0 to 2 pi) with the values of its
    parameters. Of sheets thickness, the mean one of the walls, may be given instead of level.
    """

    def __init__(self, function: Optional[str] = None, *, expression: Optional[str] = None,
                 parameters: Optional[Mapping[str, float]] = None, kind: str = "network",
                 level: Param = 0.0, thickness: Param = 0.0, cell_size: Cell = 1.0,
                 clusters: int = 0, origin: Sequence[float] = (0, 0, 0), rotation: Any = None,
                 context: Optional[Context] = None) -> None:
        if (function is None) == (expression is None):
            raise TypeError("Functional takes a function's name or an expression, one of the two")
        definition = defaults(_abi.msq_functional_def)
        set_grid(definition.grid, cell_size, origin, rotation)
        set_param(definition.level, level)
        set_param(definition.thickness, thickness)
        definition.kind = constant("MSQ_FUNCTIONAL_", kind, "kind")
        definition.clusters = unsigned(clusters, 32, "clusters")
        if expression is None:
            definition.function = constant("MSQ_FUNCTION_", function or "", "function")
        else:
            definition.function = _abi.MSQ_FUNCTION_EXPRESSION
            definition.expression = expression.encode()
        set_parameters(definition, parameters)
        self._make(context_of(context, level, thickness), lib.msq_structure_functional, definition)


class HostStructure(Structure):
    """A structure that functions of Python compute.

    inside(points) answers HostPoints by n bools, and is enough. For sets build_cell(cell) may make
    what is to be known of a cell (i, j, k), kept in the context's cache, which evaluate_cell(data,
    points) gets with points that all lie in it. box(min, max): True, False or None, whether a box
    is inside, outside or neither as a whole. distance(points): n numbers, at most the distance to
    the boundary. Arrays are valid until the function returns; calls and concurrent are as for
    Field.host.
    """

    def __init__(self, inside: Optional[Callable[[HostPoints], Any]] = None, *,
                 build_cell: Optional[Callable[[Tuple[int, int, int]], Any]] = None,
                 evaluate_cell: Optional[Callable[[Any, HostPoints], Any]] = None,
                 box: Optional[Callable[[Any, Any], Optional[bool]]] = None,
                 distance: Optional[Callable[[HostPoints], Any]] = None, cell_size: Cell = 1.0,
                 origin: Sequence[float] = (0, 0, 0), rotation: Any = None,
                 concurrent: bool = False, context: Optional[Context] = None) -> None:
        definition = defaults(_abi.msq_host_structure_def)
        set_grid(definition.grid, cell_size, origin, rotation)
        create(lambda: self._make(context_of(context), lib.msq_structure_host, definition),
               definition, concurrent, inside=inside, build_cell=build_cell,
               evaluate_cell=evaluate_cell, box=box, distance=distance)


class HostFunctional(Structure):
    """As Functional, of a function of Python: evaluate(angles) answers angles (n, 3), 0 to 2 pi, by
    n numbers. lipschitz or range(min, max) make it fast, as for Field.host."""

    def __init__(self, evaluate: Callable[[Any], Any], *, lipschitz: float = math.inf,
                 range: Optional[Callable[[Any, Any], Any]] = None, kind: str = "network",
                 level: Param = 0.0, cell_size: Cell = 1.0, clusters: int = 0,
                 origin: Sequence[float] = (0, 0, 0), rotation: Any = None,
                 concurrent: bool = False, context: Optional[Context] = None) -> None:
        definition = defaults(_abi.msq_host_function_def)
        set_grid(definition.grid, cell_size, origin, rotation)
        set_param(definition.level, level)
        definition.kind = constant("MSQ_FUNCTIONAL_", kind, "kind")
        definition.clusters = unsigned(clusters, 32, "clusters")
        definition.lipschitz = lipschitz
        create(lambda: self._make(context_of(context, level), lib.msq_structure_host_function,
                                  definition),
               definition, concurrent, evaluate=evaluate, range=range)
