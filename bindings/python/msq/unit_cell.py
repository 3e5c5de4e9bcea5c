# SPDX-License-Identifier: Apache-2.0
"""Unit cells of strut lattices."""
from __future__ import annotations

import ctypes
import dataclasses
from typing import Any, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import _abi
from ._arrays import pointer, vector
from ._given import Given, remembers
from ._library import constant, defaults, lib
from .context import record


@dataclasses.dataclass(frozen=True)
class UnitCellInfo:
    """Numbers of a unit cell, and how it meets the next."""

    is_periodic: bool  #: no node on its faces is unmatched
    node_count: int
    strut_count: int
    tiled_strut_count: int  #: struts a cell of the tiling: those whole cells apart count once
    tiled_length: float  #: of these, in a cell of size 1
    low_nodes: Tuple[int, int, int]  #: nodes on the face at 0 of each axis
    high_nodes: Tuple[int, int, int]  #: and on that at 1
    unmatched_nodes: Tuple[int, int, int]  #: of both, without a copy on the opposite face
    unmatched_count: int


class UnitCell:
    """A unit cell: a name, or nodes (n, 3) in [0, 1] of the cell and struts (m, 2) of node indices.

    Names: `cubic`, `bcc`, `octet`, `fcc`, `kelvin`, `diamond`, `rhombic_dodecahedron`, `reentrant`.
    strut_factors: of the radius, one a strut.
    """

    _given: Optional[Given] = None

    @remembers
    def __init__(self, name: Union[str, None] = None, *, nodes: Any = None, struts: Any = None,
                 strut_factors: Any = None) -> None:
        definition = defaults(_abi.msq_unit_cell_def)
        if (name is None) != (nodes is not None and struts is not None):
            raise TypeError("UnitCell takes a name, or nodes and struts")
        self._kept: List[np.ndarray] = []  # what the definition points at
        if name is not None:
            definition.unit_cell = constant("MSQ_UNIT_CELL_", name, "unit_cell")
        else:
            definition.unit_cell = _abi.MSQ_UNIT_CELL_CUSTOM
            self._kept += [vector(nodes, np.float64, (-1, 3), "nodes"),
                           vector(struts, np.uint32, (-1, 2), "struts")]
            definition.nodes = pointer(self._kept[0], ctypes.c_double)
            definition.node_count = len(self._kept[0])
            definition.struts = pointer(self._kept[1], ctypes.c_uint32)
            definition.strut_count = len(self._kept[1])
        if strut_factors is not None:
            factors = vector(strut_factors, np.float64, (-1,), "strut_factors")
            self._kept.append(factors)
            definition.strut_factors = pointer(factors, ctypes.c_double)
            if name is None and len(factors) != definition.strut_count:
                raise ValueError(f"there are {len(factors)} strut_factors and "
                                 f"{definition.strut_count} struts")
            definition.strut_count = len(factors)
        self._definition = definition

    def __repr__(self) -> str:
        return "<msq.UnitCell>" if self._given is None else self._given.text("msq.UnitCell")

    @property
    def info(self) -> UnitCellInfo:
        """Counts of nodes and struts, and which faces meet."""
        filled = self._report(None, 0)
        return record(UnitCellInfo, filled)

    @property
    def unmatched(self) -> np.ndarray:
        """Indices of the nodes on its faces that do not meet one of the next cell."""
        count = self._report(None, 0).unmatched_count
        indices = np.empty(count, np.uint32)
        if count:
            self._report(pointer(indices, ctypes.c_uint32), count)
        return indices

    def _report(self, unmatched: Any, room: int) -> _abi.msq_unit_cell_report:
        filled = _abi.msq_unit_cell_report()
        filled.struct_size = ctypes.sizeof(filled)
        lib.msq_unit_cell_info(ctypes.byref(self._definition), ctypes.byref(filled), unmatched,
                               room)
        return filled

    def geometry(self) -> Tuple[np.ndarray, np.ndarray]:
        """Nodes (n, 3) and struts (m, 2), also of a named cell, to draw or to change."""
        info = self._report(None, 0)
        nodes = np.empty((info.node_count, 3))
        struts = np.empty((info.strut_count, 2), np.uint32)
        lib.msq_unit_cell_geometry(ctypes.byref(self._definition), pointer(nodes, ctypes.c_double),
                                   len(nodes), pointer(struts, ctypes.c_uint32), len(struts))
        return nodes, struts


UnitCellLike = Union[str, UnitCell, Sequence[Any]]  #: a name, a UnitCell, or (nodes, struts)


def unit_cell(value: UnitCellLike) -> UnitCell:
    """What may stand for a unit cell as one."""
    if isinstance(value, UnitCell):
        return value
    if isinstance(value, str):
        return UnitCell(value)
    nodes, struts = value
    return UnitCell(nodes=nodes, struts=struts)
