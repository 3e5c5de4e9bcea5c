# SPDX-License-Identifier: Apache-2.0
"""Structures: scales 1 and finer of a model. Each fills all space; the model cuts it."""
from __future__ import annotations

import ctypes
from typing import Any, Mapping, Optional, Sequence, Union

import numpy as np

from . import _abi
from ._arrays import pointer, vector
from ._handle import Handle
from ._library import constant, defaults, lib
from .context import Context, context_of, triple, unsigned
from .field import Param, set_param

Cell = Union[float, Sequence[float]]  #: size of a cell: one number, or one for each axis


class Structure(Handle):
    """A fine-scale structure on a grid of neighbourhood cells. Made as one of the kinds.

    Cell (i, j, k) of the grid holds the points origin + rotation @ (((i, j, k) + u) * cell_size),
    0 <= u < 1; rotation is an orthonormal 3 x 3 matrix.
    """

    _kind = "structure"
    context: Context

    def __init__(self) -> None:
        raise TypeError("structures are made as Lattice, Foam or Functional")

    def _make(self, context: Context, create: Any, definition: ctypes.Structure) -> None:
        self._reference = self._create(create, context._ref, ctypes.byref(definition))
        self.context = context


def _set_grid(grid: _abi.msq_neighbourhood, cell_size: Cell, origin: Sequence[float],
              rotation: Any) -> None:
    grid.cell_size[:] = triple(cell_size, "cell_size")
    grid.origin[:] = triple(origin, "origin")
    if rotation is not None:
        grid.rotation[:] = vector(rotation, np.float64, (3, 3), "rotation").ravel().tolist()


class Lattice(Structure):
    """Periodic strut lattice: the points within radius of a unit cell's struts.

    unit_cell: a name (`cubic`, `bcc`, `octet`), or a pair of nodes (n, 3) in [0, 1] of the cell and
    struts (m, 2) of node indices.
    """

    def __init__(self, unit_cell: Union[str, Sequence[Any]] = "bcc", *, radius: Param,
                 cell_size: Cell = 1.0, origin: Sequence[float] = (0, 0, 0), rotation: Any = None,
                 context: Optional[Context] = None) -> None:
        definition = defaults(_abi.msq_lattice_def)
        _set_grid(definition.grid, cell_size, origin, rotation)
        set_param(definition.radius, radius)
        if isinstance(unit_cell, str):
            definition.unit_cell = constant("MSQ_UNIT_CELL_", unit_cell, "unit_cell")
        else:
            nodes = vector(unit_cell[0], np.float64, (-1, 3), "nodes")
            struts = vector(unit_cell[1], np.uint32, (-1, 2), "struts")
            definition.unit_cell = _abi.MSQ_UNIT_CELL_CUSTOM
            definition.nodes = pointer(nodes, ctypes.c_double)
            definition.node_count = len(nodes)
            definition.struts = pointer(struts, ctypes.c_uint32)
            definition.strut_count = len(struts)
        self._make(context_of(context, radius), lib.msq_structure_lattice, definition)


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
        _set_grid(definition.grid, cell_size, origin, rotation)
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
    parameters.
    """

    def __init__(self, function: Optional[str] = None, *, expression: Optional[str] = None,
                 parameters: Optional[Mapping[str, float]] = None, kind: str = "network",
                 level: Param = 0.0, cell_size: Cell = 1.0, clusters: int = 0,
                 origin: Sequence[float] = (0, 0, 0), rotation: Any = None,
                 context: Optional[Context] = None) -> None:
        if (function is None) == (expression is None):
            raise TypeError("Functional takes a function's name or an expression, one of the two")
        definition = defaults(_abi.msq_functional_def)
        _set_grid(definition.grid, cell_size, origin, rotation)
        set_param(definition.level, level)
        definition.kind = constant("MSQ_FUNCTIONAL_", kind, "kind")
        definition.clusters = unsigned(clusters, 32, "clusters")
        if expression is None:
            definition.function = constant("MSQ_FUNCTION_", function or "", "function")
        else:
            definition.function = _abi.MSQ_FUNCTION_EXPRESSION
            definition.expression = expression.encode()
        named = parameters or {}
        values = (_abi.msq_named_value * len(named))(
            *(_abi.msq_named_value(name.encode(), value) for name, value in named.items()))
        definition.parameters = values if named else None
        definition.parameter_count = len(named)
        self._make(context_of(context, level), lib.msq_structure_functional, definition)
