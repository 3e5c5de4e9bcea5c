# SPDX-License-Identifier: Apache-2.0
"""The struts of a structure, as arrays."""
from __future__ import annotations

import ctypes
from typing import Any, Optional, Sequence

import numpy as np

from . import _abi
from ._arrays import view
from ._handle import Handle, lend
from ._interrupt import build
from ._library import defaults, lib
from .context import Job, triple
from .shape import Shape


class StrutGraph(Handle):
    """Struts, joined at numbered nodes. Made by Structure.strut_graph.

    The arrays are views of the library's memory, which they keep, and are read-only.
    """

    _kind = "strut_graph"

    def __init__(self) -> None:
        raise TypeError("graphs of struts are made by Structure.strut_graph")

    @classmethod
    def _of(cls, context: Any, structure: Any, min: Sequence[float], max: Sequence[float],
            near: bool, shape: Optional[Shape], job: Optional[Job]) -> StrutGraph:
        definition = defaults(_abi.msq_struts_def)
        definition.selection = _abi.MSQ_STRUTS_NEAR if near else _abi.MSQ_STRUTS_OWNED
        definition.min[:] = triple(min, "min")
        definition.max[:] = triple(max, "max")
        if shape is not None:
            if not isinstance(shape, Shape):
                raise TypeError(f"shape is a {type(shape).__name__}; it must be a Shape")
            lend(definition, "shape", shape)
        graph = cls._wrap(build(
            lambda create: cls._create(create, context, structure, ctypes.byref(definition)),
            lib.msq_structure_strut_graph, job))
        graph._read()
        return graph

    def _read(self) -> None:
        report = _abi.msq_strut_graph_report()
        report.struct_size = ctypes.sizeof(report)
        reference = self._ref
        lib.msq_strut_graph_info(reference, ctypes.byref(report))
        nodes, struts = report.node_count, report.strut_count

        self.nodes = view(reference, report.nodes, (nodes, 3), "<f8")  #: positions
        self.node_ids = view(reference, report.node_ids, (nodes, 2), "<u8")  #: equal in every box
        self.struts = view(reference, report.struts, (struts, 2), "<u4")  #: indices of nodes
        self.radii = view(reference, report.radii, (struts, 2), "<f8")  #: at the first and the second node
        self.strut_ids = view(reference, report.strut_ids, (struts, 2), "<u8")
        self.cells = view(reference, report.cells, (struts, 3), "<i4")  #: that own the struts; beams: 0
        self.caps = view(reference, report.caps, (struts, 2), "|u1")  #: as MSQ_CAP_*
        self.cuts = view(reference, report.cuts, (struts, 2), "|b1")  #: does it leave the shape at that end

    @property
    def vtk_lines(self) -> np.ndarray:
        """(3 * n,) int64: 2 and two nodes for each strut, as vtkCellArray and
        pyvista.PolyData(graph.nodes, lines=graph.vtk_lines) take them."""
        cells = np.empty((len(self.struts), 3), np.int64)
        cells[:, 0] = 2
        cells[:, 1:] = self.struts
        return cells.ravel()

    def __len__(self) -> int:
        """The number of struts."""
        return len(self.struts)

    def __repr__(self) -> str:
        return f"<msq.StrutGraph of {len(self)} struts, {len(self.nodes)} nodes>"
