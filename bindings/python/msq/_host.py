# SPDX-License-Identifier: Apache-2.0
"""Functions of Python that msq calls for as long as an object lives: of Field.host and the like.

C gets a few trampolines, which are never freed, and a number by which they find the function; so no
trampoline is freed while it runs, as it would be if each object had its own and let go of it when C
releases it.
"""
from __future__ import annotations

import ctypes
import hashlib
import itertools
import operator
import sys
from typing import Any, Callable, Dict, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _abi
from ._arrays import start_of
from ._lent import Lent
from ._library import keep_exception
from ._signals import expect_callbacks

# Of each object: the functions by the names that the definition has for them.
_functions: Dict[int, Dict[str, Callable[..., Any]]] = {}
_numbers = itertools.count(1)


class HostPoints(NamedTuple):
    """Points as a structure of Python sees them: arrays, valid until its function returns."""

    points: np.ndarray  #: (n, 3), in model coordinates
    positions: np.ndarray  #: (n, 3), from the corner of the point's cell, along the grid's axes
    cells: np.ndarray  #: (n, 3), int32: the cell that each point lies in


def _lend(function: Callable[..., Any], count: int, given: Sequence[Tuple[Any, Any]], out: Any,
          kind: Any, call: Callable[..., Any]) -> int:
    """Lends triples in C's memory to call(function, arrays ...), and writes what it answers."""
    lent = Lent()
    try:
        _ask(function, count, given, out, kind, call, lent)
        if lent.are_kept():
            raise BufferError(f"the points that {_name(function)} was called with are kept beyond "
                              "the call, and their memory is not: keep a copy")
        return 0
    except BaseException as error:  # none may pass through C
        lent.take_back(error)
        return keep_exception(error)


def _ask(function: Callable[..., Any], count: int, given: Sequence[Tuple[Any, Any]], out: Any,
         kind: Any, call: Callable[..., Any], lent: Lent) -> None:
    answers = np.asarray(call(function, *(lent.array(pointer, element, 3 * count).reshape(count, 3)
                                          for pointer, element in given)))
    if answers.shape != (count,):
        raise ValueError(f"{_name(function)} answered {count} points by an array of shape "
                         f"{answers.shape}; it must be ({count},)")
    if answers.dtype.kind not in "biuf":
        raise TypeError(f"{_name(function)} answered by values of dtype {answers.dtype}; they must be "
                        "bools or real numbers")
    values = np.frombuffer((kind * count).from_address(start_of(out)), kind)
    if kind is not ctypes.c_uint8:
        values[:] = answers
        return
    if not np.isfinite(answers).all():
        raise ValueError(f"{_name(function)} answered by values that are not finite; they must be bools "
                         "or finite numbers")
    values[:] = answers != 0


def _name(function: Callable[..., Any]) -> str:
    return getattr(function, "__qualname__", repr(function))


def _answer(name: str, user: int, points: Any, count: int, out: Any, kind: Any) -> int:
    return _lend(_functions[user][name], count, [(points, ctypes.c_double)], out, kind,
                 lambda function, triples: function(triples))


def _answer_points(name: str, user: int, given: Any, out: Any, kind: Any, *first: Any) -> int:
    of = given.contents
    lent = [(of.points, ctypes.c_double), (of.positions, ctypes.c_double),
            (of.cells, ctypes.c_int32)]
    return _lend(_functions[user][name], of.count, lent, out, kind,
                 lambda function, *triples: function(*first, HostPoints(*triples)))


def _values_of(name: str) -> Any:
    def call(user: int, points: Any, count: int, values: Any) -> int:
        return _answer(name, user, points, count, values, ctypes.c_double)
    return _abi.msq_values_fn(call)


def _call_inside(user: int, points: Any, count: int, inside: Any) -> int:
    return _answer("inside", user, points, count, inside, ctypes.c_uint8)


def _call_range(user: int, low: Any, high: Any, least: Any, most: Any) -> int:
    try:
        least[0], most[0] = _functions[user]["range"](tuple(low[0:3]), tuple(high[0:3]))
        return 0
    except BaseException as error:
        return keep_exception(error)


def _call_points_inside(user: int, points: Any, inside: Any) -> int:
    return _answer_points("inside", user, points, inside, ctypes.c_uint8)


def _call_points_distance(user: int, points: Any, distances: Any) -> int:
    return _answer_points("distance", user, points, distances, ctypes.c_double)


# Data of cells of structures of Python, by the numbers that C holds for them.
_cells: Dict[int, Any] = {}


def _call_build_cell(user: int, cell: Any, data: Any, size: Any) -> int:
    try:
        built = _functions[user]["build_cell"](tuple(cell[0:3]))
        number = next(_numbers)
        _cells[number] = built
        data[0] = number
        size[0] = getattr(built, "nbytes", None) or sys.getsizeof(built)
        return 0
    except BaseException as error:
        return keep_exception(error)


def _call_evaluate_cell(user: int, data: int, points: Any, inside: Any) -> int:
    return _answer_points("evaluate_cell", user, points, inside, ctypes.c_uint8, _cells[data])


def _call_free_cell(_user: int, data: int) -> None:
    del _cells[data]


_BOXES = {None: _abi.MSQ_BOX_MIXED, False: _abi.MSQ_BOX_OUTSIDE, True: _abi.MSQ_BOX_INSIDE}


def _call_box(user: int, low: Any, high: Any, answer: Any) -> int:
    try:
        answer[0] = _BOXES[_functions[user]["box"](tuple(low[0:3]), tuple(high[0:3]))]
        return 0
    except BaseException as error:
        return keep_exception(error)


def _call_release(user: int) -> None:
    del _functions[user]


# By the type that the definition's field has, and the field's name.
_TRAMPOLINES = {
    (_abi.msq_values_fn, "evaluate"): _values_of("evaluate"),
    (_abi.msq_values_fn, "distance"): _values_of("distance"),
    (_abi.msq_inside_fn, "inside"): _abi.msq_inside_fn(_call_inside),
    (_abi.msq_range_fn, "range"): _abi.msq_range_fn(_call_range),
    (_abi.msq_points_inside_fn, "inside"): _abi.msq_points_inside_fn(_call_points_inside),
    (_abi.msq_points_distance_fn, "distance"): _abi.msq_points_distance_fn(_call_points_distance),
    (_abi.msq_build_cell_fn, "build_cell"): _abi.msq_build_cell_fn(_call_build_cell),
    (_abi.msq_evaluate_cell_fn, "evaluate_cell"): _abi.msq_evaluate_cell_fn(_call_evaluate_cell),
    (_abi.msq_free_cell_fn, "free_cell"): _abi.msq_free_cell_fn(_call_free_cell),
    (_abi.msq_box_fn, "box"): _abi.msq_box_fn(_call_box),
}
_RELEASE = _abi.msq_release_fn(_call_release)


def _trampoline(definition: Any, name: str) -> Any:
    return _TRAMPOLINES[dict(definition._fields_)[name], name]


HashKey = Union[int, str, bytes, None]


def _set_key(definition: Any, key: HashKey) -> None:
    """Writes what stands for the functions in hashes: 128 bits, or the BLAKE2b hash of a text."""
    if key is None:
        return
    if isinstance(key, (str, bytes)):
        text = key.encode() if isinstance(key, str) else key
        key = int.from_bytes(hashlib.blake2b(text, digest_size=16).digest(), "little")
    number = operator.index(key)
    if not 0 < number < 1 << 128:
        raise ValueError(f"hash_key is {number}; it must be from 1 to 2**128 - 1")
    definition.hash_key[:] = number & (1 << 64) - 1, number >> 64


def create(make: Callable[[], Any], definition: Any, concurrent: bool, hash_key: HashKey = None,
           **functions: Optional[Callable[..., Any]]) -> Any:
    """Sets the callbacks of a definition and calls make(), which passes it to msq."""
    _set_key(definition, hash_key)
    given = {name: function for name, function in functions.items() if function is not None}
    for name, function in given.items():
        if not callable(function):
            raise TypeError(f"{name} is a {type(function).__name__}; it must be callable")
        setattr(definition, name, _trampoline(definition, name))
    if "build_cell" in given:
        definition.free_cell = _trampoline(definition, "free_cell")
    number = next(_numbers)
    definition.user = number
    definition.release = _RELEASE
    definition.concurrent = int(concurrent)
    _functions[number] = given
    expect_callbacks()
    try:
        return make()
    except BaseException:
        _functions.pop(number, None)  # where the constructor fails, release is not called
        raise


def count() -> int:
    """Objects whose functions msq may call, and cells that they have built."""
    return len(_functions) + len(_cells)
