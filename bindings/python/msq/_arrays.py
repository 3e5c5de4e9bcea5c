# SPDX-License-Identifier: Apache-2.0
"""NumPy arrays as msq takes them: pointer, count and stride.

Arrays of points are not copied, and lists and tuples are converted. An array of points whose
layout C cannot be told is refused, so that what is slow, a copy, is written where it happens.
Smaller definitions (`vector`) are copied where their type or layout is another.
"""
from __future__ import annotations

import ctypes
from typing import Any, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from . import _abi

_COORDINATES = {np.dtype(np.float32): _abi.MSQ_FLOAT32, np.dtype(np.float64): _abi.MSQ_FLOAT64}


class Triples(NamedTuple):
    """Rows of x, y, z in memory. The array is kept for as long as its address is used."""

    array: np.ndarray
    address: int
    count: int
    stride: int  # bytes
    coordinate_type: int
    shape: Tuple[int, ...]  # of the array without its last axis


def address_of(array: np.ndarray) -> int:
    return array.__array_interface__["data"][0]


def _constant_stride(array: np.ndarray) -> Optional[int]:
    """Bytes from each row to the next in C order, or None where they vary."""
    stride = expected = None
    for length, step in reversed(list(zip(array.shape[:-1], array.strides[:-1]))):
        if length == 1:
            continue
        if stride is None:
            stride = step
        elif step != expected:
            return None
        expected = step * length
    return stride if stride is not None else 3 * array.itemsize


def triples(points: Any, name: str = "points") -> Triples:
    """An array of shape (..., 3), float32 or float64, its rows at a constant distance in memory."""
    if isinstance(points, (list, tuple)):
        points = np.asarray(points, dtype=np.float64)
    array = np.asarray(points)
    if array.dtype not in _COORDINATES:  # nor in the other byte order
        raise TypeError(f"{name} are of dtype {array.dtype}; they must be float32 or float64, in "
                        "native byte order")
    if array.ndim < 1 or array.shape[-1] != 3:
        raise ValueError(f"{name} have shape {array.shape}; the last axis must be x, y, z")
    shape = array.shape[:-1]
    count = array.size // 3
    packed = 3 * array.itemsize
    stride = packed
    if count > 0:
        found = _constant_stride(array)
        if array.strides[-1] != array.itemsize or found is None or found < packed:
            raise ValueError(
                f"{name} of shape {array.shape} with strides {array.strides} cannot be passed "
                "without a copy: x, y, z must lie side by side, and the points at a constant "
                f"distance of at least {packed} bytes, forwards; numpy.ascontiguousarray makes one")
        stride = found
    return Triples(array, address_of(array), count, stride, _COORDINATES[array.dtype], shape)


def output(out: Optional[np.ndarray], shape: Sequence[int], dtypes: Sequence[Any],
           inputs: Optional[np.ndarray] = None) -> np.ndarray:
    """The array that answers are written to: `out` if it can take them, else a new one."""
    shape = tuple(shape)
    if out is None:
        return np.empty(shape, dtypes[0])
    if not isinstance(out, np.ndarray):
        raise TypeError(f"out is a {type(out).__name__}; it must be a numpy.ndarray")
    names = " or ".join(np.dtype(dtype).name for dtype in dtypes)
    if out.dtype not in [np.dtype(dtype) for dtype in dtypes]:
        raise TypeError(f"out is of dtype {out.dtype}; it must be {names}")
    if out.shape != shape:
        raise ValueError(f"out has shape {out.shape}; it must have {shape}")
    if not out.flags.c_contiguous or not out.flags.writeable:
        raise ValueError("out must be contiguous in C order and writeable; it has strides "
                         f"{out.strides}" + ("" if out.flags.writeable else " and is read-only"))
    if inputs is not None and np.may_share_memory(out, inputs):
        raise ValueError("out lies in the memory of the points")
    return out


def pointer(array: np.ndarray, kind: Any) -> Any:
    """The array's memory as a pointer of ctypes. The caller keeps the array."""
    return ctypes.cast(address_of(array), ctypes.POINTER(kind))


def start_of(pointer: Any) -> int:
    """The address in a pointer that C has written. ctypes.cast makes cyclic garbage."""
    return pointer if isinstance(pointer, int) else ctypes.addressof(pointer.contents)


class _Memory:
    """Memory of an object, which an array keeps as long as it refers to it."""

    def __init__(self, owner: Any, address: int, shape: Sequence[int], kind: str) -> None:
        self._owner = owner
        self.__array_interface__ = {"version": 3, "typestr": kind, "shape": tuple(shape),
                                    "data": (address, True)}


def view(owner: Any, pointer: Any, shape: Sequence[int], kind: str) -> np.ndarray:
    """A read-only array of memory that belongs to an object, which it keeps. kind: as "<f8"."""
    if 0 in shape:
        return np.empty(shape, kind)
    return np.asarray(_Memory(owner, start_of(pointer), shape, kind))


def real(values: Any, name: str) -> np.ndarray:
    """An array that is not complex: NumPy would drop the imaginary part with no more than a warning."""
    array = np.asarray(values)
    if array.dtype.kind == "c":
        raise TypeError(f"{name} is complex; it must be real")
    return array


def vector(values: Any, dtype: Any, shape: Sequence[int], name: str) -> np.ndarray:
    """A contiguous array of small definitions, copied if need be; -1 in shape is any length."""
    array = np.ascontiguousarray(real(values, name))
    wanted = np.dtype(dtype)
    if array.dtype != wanted:
        safe = array.astype(wanted)
        if wanted.kind in "iu" and array.size and not np.array_equal(safe, array):
            raise ValueError(f"{name} must be whole numbers that fit {wanted}")
        array = safe
    if array.ndim != len(shape) or any(want not in (-1, have)
                                       for want, have in zip(shape, array.shape)):
        wanted_shape = tuple("n" if length == -1 else length for length in shape)
        raise ValueError(f"{name} have shape {array.shape}; it must be {wanted_shape}"
                         .replace("'", ""))
    return array


class Elements(NamedTuple):
    """Elements of one or more numbers in memory. The array is kept for as long as its address is
    used."""

    array: np.ndarray
    address: int
    count: int
    stride: int  # bytes


def elements(values: Any, dtype: Any, width: int, name: str) -> Elements:
    """`width` numbers for each element, (n, width), or (n,) where it is 1: read where they lie if
    they are of this type and side by side, else a copy."""
    wanted = np.dtype(dtype)
    array = np.asarray(values)
    packed = width * wanted.itemsize
    if (array.dtype != wanted or array.ndim == 0 or array.strides[0] < packed
            or (width > 1 and array.strides[-1] != wanted.itemsize)):
        array = array.reshape((0, width)) if width > 1 and array.size == 0 else array
        array = vector(array, wanted, (-1,) if width == 1 else (-1, width), name)
    if array.shape[1:] != ((width,) if width > 1 else ()):
        wanted_shape = "(n,)" if width == 1 else f"(n, {width})"
        raise ValueError(f"{name} have shape {array.shape}; it must be {wanted_shape}")
    return Elements(array, address_of(array), len(array), max(array.strides[0], packed))
