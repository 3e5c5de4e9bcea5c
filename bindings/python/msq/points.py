# SPDX-License-Identifier: Apache-2.0
"""Sets of points: arrays, regular grids, stratified samples."""
from __future__ import annotations

import ctypes
import dataclasses
import operator
from typing import Any, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _abi
from ._arrays import output, pointer, triples, vector
from ._given import plain, shown
from ._grid import Window, set_window
from ._library import constant, defaults, lib
from .context import triple, unsigned


class PointSet:
    """Points that are never stored: a PointGrid or a Stratified."""

    @property
    def shape(self) -> Tuple[int, ...]:
        """Of the answers."""
        raise NotImplementedError

    def coordinates(self, first: int = 0, count: Optional[int] = None, *,
                    out: Optional[np.ndarray] = None) -> np.ndarray:
        """Points first .. first + count - 1, by default all, as an array (count, 3): the very
        numbers that queries see."""
        if count is None:
            whole = int(np.prod(self.shape, dtype=object))
            count = whole - operator.index(first)
            if count < 0:
                raise ValueError(f"first is {first}; there are {whole} points")
        answers = output(out, (operator.index(count), 3), (np.float64,))
        lib.msq_points_generate(ctypes.byref(definition_of(self).definition),
                                unsigned(first, 64, "first"), len(answers),
                                pointer(answers, ctypes.c_double))
        return answers

    def _define(self, definition: _abi.msq_points_def) -> None:
        raise NotImplementedError


@dataclasses.dataclass(frozen=True)
class PointGrid(PointSet):
    """A regular grid of points: point (i, j, k) is origin + (i, j, k) * spacing.

    counts: nx, ny, nz. Answers have shape (nz, ny, nx), as a stack of images with x fastest; `.T`
    gives them by [i, j, k].

    window: ((i, j, k), (nx, ny, nz)), the first point and the numbers of points of a part of the
    grid, whose answers are, to the last bit, those of the whole grid there.
    """

    origin: Sequence[float]
    spacing: Union[float, Sequence[float]]
    counts: Tuple[int, int, int]
    window: Optional[Window] = None

    def __post_init__(self) -> None:
        for name in ("origin", "spacing", "counts", "window"):
            object.__setattr__(self, name, plain(getattr(self, name)))

    def __repr__(self) -> str:
        return shown(self)

    @property
    def shape(self) -> Tuple[int, ...]:
        """Of the answers: (nz, ny, nx), of the window where there is one."""
        return _counts(self.counts if self.window is None else self.window[1])[::-1]

    def _define(self, definition: _abi.msq_points_def) -> None:
        definition.kind = _abi.MSQ_POINTS_GRID
        set_window(definition.window, self.window)
        definition.origin[:] = triple(self.origin, "origin")
        definition.spacing[:] = triple(self.spacing, "spacing")
        definition.counts[:] = _counts(self.counts)


@dataclasses.dataclass(frozen=True)
class Stratified(PointSet):
    """per_cell random points, uniform, in each cell of a box of nx * ny * nz cells.

    Cell (i, j, k) has its corner at origin + rotation @ ((i, j, k) * spacing) and measures spacing.
    The points follow from seed and index alone, on every machine alike. Answers have shape
    (nz, ny, nx, per_cell).
    """

    origin: Sequence[float]
    spacing: Union[float, Sequence[float]]
    counts: Tuple[int, int, int]
    per_cell: int = 1
    seed: int = 0
    rotation: Any = None

    def __post_init__(self) -> None:
        for name in ("origin", "spacing", "counts", "rotation"):
            object.__setattr__(self, name, plain(getattr(self, name)))

    def __repr__(self) -> str:
        return shown(self)

    @property
    def shape(self) -> Tuple[int, ...]:
        """Of the answers: (nz, ny, nx, per_cell)."""
        return (*_counts(self.counts)[::-1], operator.index(self.per_cell))

    def _define(self, definition: _abi.msq_points_def) -> None:
        PointGrid(self.origin, self.spacing, self.counts)._define(definition)
        definition.kind = _abi.MSQ_POINTS_STRATIFIED
        definition.seed = unsigned(self.seed, 64, "seed")
        definition.per_cell = unsigned(self.per_cell, 32, "per_cell")
        if self.rotation is not None:
            matrix = vector(self.rotation, np.float64, (3, 3), "rotation")
            definition.rotation[:] = matrix.ravel().tolist()


def _counts(counts: Sequence[int]) -> Tuple[int, int, int]:
    if len(counts) != 3:
        raise ValueError(f"counts has {len(counts)} numbers; it must have 3")
    nx, ny, nz = (unsigned(count, 64, "counts") for count in counts)
    return (nx, ny, nz)


class Points(NamedTuple):
    """Points as msq takes them."""

    definition: _abi.msq_points_def
    shape: Tuple[int, ...]  # of the answers
    array: Optional[np.ndarray]  # to be kept for as long as the definition is used


def definition_of(points: Any) -> Points:
    """The definition of an array or a set of points."""
    definition = defaults(_abi.msq_points_def)
    if isinstance(points, PointSet):
        points._define(definition)
        return Points(definition, points.shape, None)
    array = triples(points)
    definition.kind = _abi.MSQ_POINTS_ARRAY
    definition.coordinates = array.address
    definition.count = array.count
    definition.stride = array.stride
    definition.coordinate_type = array.coordinate_type
    return Points(definition, array.shape, array.array)


def query_of(length_scale: float, method: str = "auto", critical_count: int = 0,
             group_parts: int = 0) -> Any:
    """A query as calls take it; None for the defaults."""
    if (length_scale, method, critical_count, group_parts) == (0, "auto", 0, 0):
        return None
    query = defaults(_abi.msq_query_def)
    query.length_scale = length_scale
    query.method = constant("MSQ_QUERY_", method, "method")
    query.critical_count = unsigned(critical_count, 64, "critical_count")
    query.group_parts = unsigned(group_parts, 32, "group_parts")
    return ctypes.byref(query)
