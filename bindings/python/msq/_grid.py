# SPDX-License-Identifier: Apache-2.0
"""Grids of neighbourhood cells, and images on them, as msq takes them."""
from __future__ import annotations

import ctypes
from typing import Any, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _abi
from ._arrays import address_of, real, vector
from ._given import shown
from ._handle import Handle, lend
from ._library import constant, defaults, lib
from .context import triple, unsigned

Cell = Union[float, Sequence[float]]  #: size of a cell: one number, or one for each axis

#: first (i, j, k) and counts (nx, ny, nz) of a part of a grid
Window = Tuple[Sequence[int], Sequence[int]]

_TYPES = {np.dtype(np.uint8): _abi.MSQ_UINT8, np.dtype(np.int16): _abi.MSQ_INT16,
          np.dtype(np.uint16): _abi.MSQ_UINT16, np.dtype(np.float32): _abi.MSQ_FLOAT32,
          np.dtype(np.float64): _abi.MSQ_FLOAT64}


def set_grid(grid: _abi.msq_neighbourhood, cell_size: Cell, origin: Sequence[float],
             rotation: Any) -> None:
    """Writes a grid; rotation None leaves that of the defaults."""
    grid.cell_size[:] = triple(cell_size, "cell_size")
    grid.origin[:] = triple(origin, "origin")
    if rotation is not None:
        grid.rotation[:] = vector(rotation, np.float64, (3, 3), "rotation").ravel().tolist()


def set_window(definition: _abi.msq_window, window: Optional[Window]) -> None:
    """Writes a window; None: the whole grid."""
    if window is None:
        return
    if len(window) != 2:
        raise ValueError(f"the window has {len(window)} parts; it must have 2: first and counts, of "
                         "three numbers each")
    first, counts = window
    for name, to, numbers in (("first", definition.first, first),
                              ("counts", definition.count, counts)):
        if len(numbers) != 3:
            raise ValueError(f"the window's {name} are {len(numbers)} numbers; they must be 3")
        to[:] = [unsigned(number, 64, "window") for number in numbers]
    if not any(definition.first) and not any(definition.count):
        raise ValueError("the window's counts are 0; they must be at least 1")


class Period(NamedTuple):
    """Cells whose size varies along one axis of the grid: cell_sizes at positions, in model units from
    the grid's origin. The number of cells per unit length is linear between positions, and constant
    beyond them."""

    positions: Any
    cell_sizes: Any
    axis: int = 2

    def __repr__(self) -> str:
        return shown(self)


def set_period(definition: Any, period: Optional[Period]) -> Any:
    """Writes a period; returns what must be kept until the call is made. None: cells of one size."""
    if period is None:
        return None
    if not isinstance(period, tuple):
        raise TypeError(f"period is a {type(period).__name__}; it must be a Period")
    period = Period(*period)
    positions = np.ascontiguousarray(real(period.positions, "positions"), np.float64)
    cell_sizes = np.ascontiguousarray(real(period.cell_sizes, "cell_sizes"), np.float64)
    if positions.ndim != 1 or positions.shape != cell_sizes.shape:
        raise ValueError(f"period has positions of shape {positions.shape} and cell_sizes of shape "
                         f"{cell_sizes.shape}; they must be (n,) both")
    graded = defaults(_abi.msq_period_def)
    graded.axis = unsigned(period.axis, 31, "axis")
    graded.positions = positions.ctypes.data_as(ctypes.POINTER(ctypes.c_double))
    graded.cell_sizes = cell_sizes.ctypes.data_as(ctypes.POINTER(ctypes.c_double))
    graded.count = len(positions)
    definition.period = ctypes.pointer(graded)
    return graded, positions, cell_sizes


class Warp(NamedTuple):
    """Cells around the z axis of the grid; with count_polar around its origin, that many from pole to
    pole. count cells lie around. cell_size is that outwards, from inner_radius on, and that along
    the axis. Outside of the radii there is nothing; outer_radius 0: no limit. Around the axis the
    pattern turns by shear_outwards cells from cell to cell outwards, and by shear_along cells along
    the axis."""

    count: int
    inner_radius: float = 0.0
    outer_radius: float = 0.0
    count_polar: int = 0
    shear_outwards: float = 0.0
    shear_along: float = 0.0

    def __repr__(self) -> str:
        return shown(self)


class SampledWarp(NamedTuple):
    """Cells by a map: fields of samples (Field.grid) on one grid, which give the coordinates of
    cells at a point. cell_size, origin and rotation of the structure are not used."""

    u: Any
    v: Any
    w: Any

    def __repr__(self) -> str:
        return shown(self)


AnyWarp = Union[Warp, SampledWarp]


def set_warp(definition: Any, warp: Optional[AnyWarp]) -> Any:
    """Writes a warp; returns what must be kept until the call is made. None: cells are boxes."""
    if warp is None:
        return None
    warped = defaults(_abi.msq_warp_def)
    if isinstance(warp, SampledWarp):
        warped.kind = _abi.MSQ_WARP_SAMPLED
        for name, field in zip("uvw", warp):
            if not isinstance(field, Handle) or field._kind != "field":
                raise TypeError(f"{name} of the warp is a {type(field).__name__}; it must be a Field")
        lend(warped, "u", warp.u)
        lend(warped, "v", warp.v)
        lend(warped, "w", warp.w)
        definition.warp = ctypes.pointer(warped)
        return warped, warp
    if not isinstance(warp, tuple):
        raise TypeError(f"warp is a {type(warp).__name__}; it must be a Warp or a SampledWarp")
    warp = Warp(*warp)
    warped.kind = _abi.MSQ_WARP_SPHERICAL if warp.count_polar else _abi.MSQ_WARP_CYLINDRICAL
    warped.count = unsigned(warp.count, 32, "count")
    warped.count_polar = unsigned(warp.count_polar, 32, "count_polar")
    warped.inner_radius = warp.inner_radius
    warped.outer_radius = warp.outer_radius
    warped.shear_outwards = warp.shear_outwards
    warped.shear_along = warp.shear_along
    definition.warp = ctypes.pointer(warped)
    return warped


class Grid(NamedTuple):
    """A grid of cells, as structures take it: `msq.Foam(radius=0.2, **grid._asdict())`."""

    cell_size: Any
    origin: Any = (0, 0, 0)
    rotation: Any = None

    def __repr__(self) -> str:
        return shown(self)

    def placed(self, matrix: Any) -> "Grid":
        """The grid moved along with a part that Shape.placed(matrix) moves: turned, moved and
        scaled uniformly. A structure on it is the same one at another place, if its radius is
        scaled as lengths are."""
        grid = _abi.msq_neighbourhood()
        grid.rotation[:] = (1, 0, 0, 0, 1, 0, 0, 0, 1)
        set_grid(grid, self.cell_size, self.origin, self.rotation)
        result = _abi.msq_neighbourhood()
        lib.msq_neighbourhood_placed(ctypes.byref(grid), affine(matrix), ctypes.byref(result))
        return Grid(tuple(result.cell_size), tuple(result.origin),
                    np.array(result.rotation[:]).reshape(3, 3))


def affine(matrix: Any) -> Any:
    """(3, 4), or (4, 4) with the last row 0, 0, 0, 1."""
    rows = np.asarray(real(matrix, "matrix"), np.float64)
    if rows.shape == (4, 4) and tuple(rows[3]) == (0, 0, 0, 1):
        rows = rows[:3]
    if rows.shape != (3, 4):
        raise ValueError(f"matrix has shape {rows.shape}; it must be (3, 4), or (4, 4) with the last "
                         "row 0, 0, 0, 1")
    return (ctypes.c_double * 12)(*rows.ravel().tolist())


def set_image(image: _abi.msq_image, values: Any, spacing: Cell, origin: Sequence[float],
              rotation: Any) -> np.ndarray:
    """Writes an image; returns the array, which the caller keeps until msq has copied it."""
    array = np.asarray(values)
    if array.ndim != 3:
        raise ValueError(f"values have shape {array.shape}; it must be (nz, ny, nx)")
    if array.dtype not in _TYPES:
        names = ", ".join(dtype.name for dtype in _TYPES)
        raise TypeError(f"values are of dtype {array.dtype}; they must be one of {names}, in "
                        "native byte order")
    depth, height, width = array.shape
    layer, row, step = array.strides
    packed = width * array.itemsize
    row = row if height > 1 else packed
    layer = layer if depth > 1 else row * height
    is_along_x = width <= 1 or step == array.itemsize
    if array.size and (not is_along_x or row < packed or layer < row * height):
        raise ValueError(
            f"values of shape {array.shape} with strides {array.strides} cannot be passed without "
            "a copy: they must go along x in memory, rows along y and layers along z; "
            "numpy.ascontiguousarray makes one, and `.T` turns [i, j, k] into [k, j, i]")
    image.values = address_of(array)
    image.value_type = _TYPES[array.dtype]
    image.size[:] = (width, height, depth)
    image.row_stride = row
    image.layer_stride = layer
    set_grid(image.grid, spacing, origin, rotation)
    return array
