# SPDX-License-Identifier: Apache-2.0
"""Functions of Python that msq calls for as long as an object lives: of Field.host and the like.

C gets three trampolines, which are never freed, and a number by which they find the function; so no
trampoline is freed while it runs, as it would be if each object had its own and let go of it when C
releases it.
"""
from __future__ import annotations

import ctypes
import itertools
import weakref
from typing import Any, Callable, Dict, Optional

import numpy as np

from . import _abi
from ._library import keep_exception
from ._signals import expect_callbacks

# Of each object: the functions by the names that the definition has for them.
_functions: Dict[int, Dict[str, Callable[..., Any]]] = {}
_numbers = itertools.count(1)


def _view(pointer: Any, kind: Any, count: int) -> np.ndarray:
    address = ctypes.cast(pointer, ctypes.c_void_p).value
    return np.frombuffer((kind * count).from_address(address), kind)


def _answer(name: str, user: int, points: Any, count: int, out: Any, kind: Any) -> int:
    """Asks the function about a batch of points and writes what it answers."""
    try:
        memory = _view(points, ctypes.c_double, 3 * count)
        memory.flags.writeable = False
        is_kept = weakref.ref(memory)
        triples = memory.reshape(count, 3)
        del memory
        answers = np.asarray(_functions[user][name](triples))
        if answers.shape != (count,):
            raise ValueError(f"{name} answered {count} points by an array of shape "
                             f"{answers.shape}; it must be ({count},)")
        _view(out, kind, count)[:] = answers != 0 if kind is ctypes.c_uint8 else answers
        del answers, triples
        if is_kept() is not None:
            raise BufferError(f"the points that {name} was called with are kept beyond the call, "
                              "and their memory is not: keep a copy")
        return 0
    except BaseException as error:  # none may pass through C
        return keep_exception(error)


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


def _call_release(user: int) -> None:
    del _functions[user]


TRAMPOLINES = {"evaluate": _values_of("evaluate"), "distance": _values_of("distance"),
               "inside": _abi.msq_inside_fn(_call_inside), "range": _abi.msq_range_fn(_call_range)}
_RELEASE = _abi.msq_release_fn(_call_release)


def create(make: Callable[[], Any], definition: Any, concurrent: bool,
           **functions: Optional[Callable[..., Any]]) -> Any:
    """Sets the callbacks of a definition and calls make(), which passes it to msq."""
    given = {name: function for name, function in functions.items() if function is not None}
    for name, function in given.items():
        if not callable(function):
            raise TypeError(f"{name} is a {type(function).__name__}; it must be callable")
        setattr(definition, name, TRAMPOLINES[name])
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
    """Objects whose functions msq may call."""
    return len(_functions)
