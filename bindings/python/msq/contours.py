# SPDX-License-Identifier: Apache-2.0
"""Contours of a layer as arrays."""
from __future__ import annotations

import ctypes
import operator
from typing import Any, Iterator, List, Optional, Sequence, Tuple, Union, overload

import numpy as np

from . import _abi
from ._arrays import view
from ._handle import Handle, Reference
from ._interrupt import interruptible
from ._library import defaults, lib, report
from .context import Job, unsigned

Window = Tuple[Sequence[float], Sequence[float]]  #: (min, max), each u, v

_TYPES = {"int32": _abi.MSQ_INT32, "int64": _abi.MSQ_INT64, "float64": _abi.MSQ_FLOAT64}
_KINDS = {_abi.MSQ_INT32: "=i4", _abi.MSQ_INT64: "=i8", _abi.MSQ_FLOAT64: "=f8"}


def contours_definition(tolerance: float, *, axis: int, window: Optional[Window], pitch: float,
                        type: str, units: float, length_scale: float,
                        topology_samples: int = 0) -> Any:
    """An msq_contours_def."""
    definition = defaults(_abi.msq_contours_def)
    if type not in _TYPES:
        raise ValueError(f"type is {type!r}; it must be one of {', '.join(map(repr, _TYPES))}")
    definition.type = _TYPES[type]
    definition.axis = unsigned(axis, 31, "axis")
    if window is not None:
        low, high = (tuple(map(float, corner)) for corner in window)
        if len(low) != 2 or len(high) != 2:
            raise ValueError(f"window is {window!r}; it must be two pairs of numbers")
        definition.has_window = 1
        definition.window_min[:] = low
        definition.window_max[:] = high
    definition.tolerance = tolerance
    definition.pitch = pitch
    definition.units = units
    definition.length_scale = length_scale
    definition.topology_samples = unsigned(topology_samples, 32, "topology_samples")
    return definition


class Contours(Handle):
    """The section of a model with a plane: closed rings, the inside on their left.

        for ring in model.contours(z, tolerance=0.01):
            draw(ring)                                   # (n, 2); outer rings counter-clockwise

    Made by Model.contours, Slicer.contours and Layer.contours. tolerance: the greatest distance between boundary and
    rings, where features are wider than the pitch. pitch 0: the tolerance. axis: the plane's normal;
    its coordinates are the other two axes, in order. window: (min, max), else the model's bounds.
    type: `int32`, `int64` or `float64`; coordinates are the model's times units, rounded for integers.
    topology_samples: 2, 4, 8 or 16: compares the rings with a mask of so many samples to a pitch, for
    topology_count.

    Contours are sequences of rings: len(contours), contours[i] and iteration. Arrays are read-only
    views of msq's memory, which they keep.
    """

    _kind = "contours"

    def __init__(self, subject: Any, place: Any, tolerance: float, *, axis: int,
                 window: Optional[Window], pitch: float, type: str, units: float,
                 length_scale: float, topology_samples: int, job: Optional[Job]) -> None:
        definition = contours_definition(tolerance, axis=axis, window=window, pitch=pitch, type=type,
                                         units=units, length_scale=length_scale,
                                         topology_samples=topology_samples)
        function = (lib.msq_slicer_contours if subject._kind == "slicer"
                    else lib.msq_layer_contours)
        made = ctypes.POINTER(_abi.msq_contours)()
        reference = subject._ref

        def call(work: Any) -> None:
            function(reference, place, ctypes.byref(definition), ctypes.byref(made), work)

        interruptible(call, job)
        self._reference = Reference(made, lib.msq_contours_release)
        self._read()

    @classmethod
    def _of_layer(cls, pointer: Any) -> Contours:
        """Those of a layer that a callback has: another reference to them."""
        lib.msq_contours_retain(pointer)
        made = cls._wrap(Reference(pointer, lib.msq_contours_release))
        made._read()
        return made

    def _read(self) -> None:
        held = report(_abi.msq_contours_report, lib.msq_contours_info, self._ref)
        owner, count = self._ref, held.ring_count
        self.unresolved_count: int = held.unresolved_count  #: see msq_contours_report
        self.pitch: float = held.pitch  #: distance of the nodes
        #: parts that appear, vanish, are cut or joined in the mask of topology_samples, at most; None
        #: without topology_samples
        self.topology_count: Optional[int] = (held.topology_count if held.topology_samples
                                              else None)
        #: (n, 2): u, v of all rings, one after the other
        self.points = view(owner, held.points, (held.point_count, 2), _KINDS[held.type])
        #: ring i has points starts[i] to starts[i + 1] - 1
        self.starts = view(owner, held.starts, (count + 1,), "=u8")
        self.parents = view(owner, held.parents, (count,), "=i8")  #: the ring around it, -1: none
        self.holes = view(owner, held.holes, (count,), "|b1")

    def __len__(self) -> int:
        return len(self.parents)

    @overload
    def __getitem__(self, index: int) -> np.ndarray: ...

    @overload
    def __getitem__(self, index: slice) -> List[np.ndarray]: ...

    def __getitem__(self, index: Union[int, slice]) -> Union[np.ndarray, List[np.ndarray]]:
        if isinstance(index, slice):
            return [self[one] for one in range(len(self))[index]]
        index = operator.index(index)
        if index < 0:
            index += len(self)
        if not 0 <= index < len(self):
            raise IndexError(f"ring {index} does not exist; there are {len(self)}")
        return self.points[int(self.starts[index]):int(self.starts[index + 1])]

    def __iter__(self) -> Iterator[np.ndarray]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        return f"<msq.Contours: {len(self)} rings of {len(self.points)} points>"
