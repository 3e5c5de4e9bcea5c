# SPDX-License-Identifier: Apache-2.0
"""Fields: a number at every point of space. They stand where a parameter is a Param."""
from __future__ import annotations

import ctypes
import math
from typing import Any, Callable, Mapping, Optional, Sequence, Union

import numpy as np

from . import _abi
from ._arrays import output, pointer, vector
from ._given import remembers
from ._grid import Cell, set_image
from ._handle import Handle, hash_of, lend
from ._host import HashKey, create
from ._interrupt import build, interruptible
from ._library import defaults, lib
from .context import Context, Job, MadeIn, context_of, doubles, c_text, triple
from .points import definition_of
from .shape import Shape


class Field(Handle):
    """A number at every point of space, of known range. Made by the class methods."""

    _kind = "field"
    context = MadeIn()

    def __init__(self) -> None:
        raise TypeError("fields are made by Field.gradient and the like")

    @classmethod
    def _make(cls, context: Context, create: Any, *arguments: Any) -> Field:
        made = cls._wrap(cls._create(create, context._ref, *arguments))
        made.context = context
        return made

    @classmethod
    @remembers
    def gradient(cls, start: Sequence[float], start_value: float, end: Sequence[float],
                 end_value: float, *, context: Optional[Context] = None) -> Field:
        """Linear from start_value in the plane through start, normal to end - start, to end_value
        in that through end; constant beyond both."""
        return cls._make(context_of(context), lib.msq_field_gradient, doubles(start, "start"),
                         start_value, doubles(end, "end"), end_value)

    @classmethod
    @remembers
    def radial(cls, center: Sequence[float], start_radius: float, start_value: float,
               end_radius: float, end_value: float, *, axis: Optional[Sequence[float]] = None,
               context: Optional[Context] = None) -> Field:
        """Linear with the distance from center, or with axis from the line along it through center:
        start_value up to start_radius, end_value from end_radius on."""
        definition = defaults(_abi.msq_radial_field_def)
        definition.center[:] = triple(center, "center")
        if axis is not None:
            definition.axis[:] = triple(axis, "axis")
        definition.from_radius, definition.from_value = start_radius, start_value
        definition.to_radius, definition.to_value = end_radius, end_value
        return cls._make(context_of(context), lib.msq_field_radial, ctypes.byref(definition))

    @classmethod
    @remembers
    def grid(cls, values: Any, *, spacing: Cell = 1.0, origin: Sequence[float] = (0, 0, 0),
             rotation: Any = None, context: Optional[Context] = None) -> Field:
        """Trilinear between values (nz, ny, nx), constant beyond them. values[k, j, i] stands at
        origin + rotation @ ((i, j, k) * spacing)."""
        definition = defaults(_abi.msq_grid_field_def)
        _kept = set_image(definition.image, values, spacing, origin, rotation)
        return cls._make(context_of(context), lib.msq_field_grid, ctypes.byref(definition))

    @classmethod
    @remembers
    def host(cls, evaluate: Callable[[np.ndarray], Any], low: float, high: float, *,
             lipschitz: float = math.inf, range: Optional[Callable[[Any, Any], Any]] = None,
             concurrent: bool = False, hash_key: HashKey = None,
             context: Optional[Context] = None) -> Field:
        """A function of Python: evaluate(points) answers points (n, 3) by n values, low to high.

        The same point must always have the same value. The array of points is valid until evaluate
        returns. lipschitz: no two values differ by more than this times the distance of their
        points; or range(min, max) gives bounds of the values in a box: without either, slices are
        slow. Long calls from the main thread call it on another thread, one at a time, and on
        several with concurrent=True.

        hash_key: stands for the function in hashes, a number or a text; to be changed whenever the
        values change. None: what has the field in it has no hash.
        """
        definition = defaults(_abi.msq_host_field_def)
        definition.low, definition.high, definition.lipschitz = low, high, lipschitz
        context = context_of(context)
        return create(lambda: cls._make(context, lib.msq_field_host, ctypes.byref(definition)),
                      definition, concurrent, hash_key, evaluate=evaluate, range=range)

    @classmethod
    @remembers
    def expression(cls, expression: str, low: float, high: float, *,
                   parameters: Optional[Mapping[str, float]] = None,
                   context: Optional[Context] = None) -> Field:
        """An expression in x, y, z, the point's coordinates, cut to low and high."""
        definition = defaults(_abi.msq_expression_field_def)
        definition.expression = c_text(expression, "expression")
        set_parameters(definition, parameters)
        definition.low, definition.high = low, high
        return cls._make(context_of(context), lib.msq_field_expression, ctypes.byref(definition))

    @classmethod
    @remembers
    def shape_distance(cls, shape: Shape, curve: Any, *, step: float = 0.0,
                       context: Optional[Context] = None, job: Optional[Job] = None) -> Field:
        """A piecewise linear curve over the signed distance to a shape, negative inside: pairs
        (n, 2) of distance, strictly ascending, and value. step > 0: from samples of it so far
        apart, whose progress the job reports."""
        pairs = vector(curve, np.float64, (-1, 2), "curve")
        definition = defaults(_abi.msq_shape_distance_field_def)
        if not isinstance(shape, Shape):
            raise TypeError(f"shape is a {type(shape).__name__}; it must be a Shape")
        lend(definition, "shape", shape)
        definition.curve = pointer(pairs, ctypes.c_double)
        definition.curve_count = len(pairs)
        definition.step = step
        context = context_of(context, shape)
        kept = pairs  # as long as the call goes on
        return build(lambda new, _kept=kept: cls._make(context, new, ctypes.byref(definition)),
                     lib.msq_field_shape_distance, job, step > 0)

    @remembers
    def map(self, curve: Any, *, context: Optional[Context] = None) -> Field:
        """A piecewise linear curve over this field: pairs (n, 2) of this one's value, strictly
        ascending, and the new one's; constant beyond the ends."""
        pairs = vector(curve, np.float64, (-1, 2), "curve")
        return self._make(context_of(context, self), lib.msq_field_map, self._ref,
                          pointer(pairs, ctypes.c_double), len(pairs))

    @property
    def hash(self) -> str:
        """32 hexadecimal digits: equal for equal definitions with equal inputs, on every machine,
        and different otherwise (docs/howto/caching.md)."""
        return hash_of(lib.msq_field_hash, self)

    def evaluate(self, points: Any, *, out: Optional[np.ndarray] = None,
                 job: Optional[Job] = None) -> Any:
        """The values at an array (..., 3) or a set of points, as msq uses them there. out: float64,
        contiguous, to write to."""
        given = definition_of(points)
        answers = output(out, given.shape, (np.float64,), given.array)
        context, reference = self.context._ref, self._ref
        interruptible(lambda work: lib.msq_field_evaluate(
            context, reference, ctypes.byref(given.definition), pointer(answers, ctypes.c_double),
            answers.size, work), job)
        return answers if answers.shape or out is not None else answers.item()


Param = Union[float, Field]  #: a number, or a field of it


def set_param(target: _abi.msq_param, name: str, value: Param) -> None:
    """Writes a parameter, as lend() does."""
    if isinstance(value, Field):
        lend(target, "field", value)
    elif hasattr(value, "__float__") and not np.iscomplexobj(value):
        target.value = float(value)
        target.field = ctypes.POINTER(_abi.msq_field)()
    else:
        hint = "; Field.host makes a field of a function" if callable(value) else ""
        raise TypeError(f"{name} is a {type(value).__name__}; it must be a number or a Field{hint}")


def set_parameters(definition: Any, parameters: Optional[Mapping[str, float]]) -> None:
    """Writes the parameters of an expression."""
    named = parameters or {}
    values = (_abi.msq_named_value * len(named))(
        *(_abi.msq_named_value(c_text(name, "a parameter's name"), value) for name, value in named.items()))
    definition.parameters = values if named else None
    definition.parameter_count = len(named)
