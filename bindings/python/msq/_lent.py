# SPDX-License-Identifier: Apache-2.0
"""Memory of C as arrays, lent to a function of Python for one call."""
from __future__ import annotations

import ctypes
import traceback
import weakref
from typing import Any, List, Optional, Set

import numpy as np

from ._arrays import start_of


class Lent:
    """The arrays of one call, all read-only. Every view refers to one of them."""

    def __init__(self) -> None:
        self._arrays: List["weakref.ref[np.ndarray]"] = []

    def array(self, pointer: Any, kind: Any, count: int) -> np.ndarray:
        """count numbers of a type of ctypes."""
        array = np.frombuffer((kind * count).from_address(start_of(pointer)), kind)
        array.flags.writeable = False
        self._arrays.append(weakref.ref(array))
        return array

    def are_kept(self) -> bool:
        """Whether there is still a view, of memory that is no longer lent."""
        return any(array() is not None for array in self._arrays)

    def take_back(self, error: BaseException) -> None:
        """Clears the frames that an exception of the call refers to, if views are in them: a debugger
        or a report of errors would read memory that C has freed."""
        seen: Set[int] = set()
        rest: List[Optional[BaseException]] = [error]
        while rest and self.are_kept():
            one = rest.pop()
            if one is None or id(one) in seen:
                continue
            seen.add(id(one))
            traceback.clear_frames(one.__traceback__)
            rest += [one.__cause__, one.__context__]
