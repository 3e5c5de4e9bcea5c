# SPDX-License-Identifier: Apache-2.0
"""Fields: a number at every point of space. They stand wherever a parameter is a number."""
from __future__ import annotations

import ctypes
from typing import Any, Optional, Sequence, Union

from . import _abi
from ._handle import Handle
from ._library import lib
from .context import Context, context_of, doubles


class Field(Handle):
    """A number at every point of space, of known range. Made by the class methods."""

    _kind = "field"
    context: Context

    def __init__(self) -> None:
        raise TypeError("fields are made by Field.gradient and the like")

    @classmethod
    def _make(cls, context: Context, create: Any, *arguments: Any) -> Field:
        made = cls._wrap(cls._create(create, context._ref, *arguments))
        made.context = context
        return made

    @classmethod
    def gradient(cls, start: Sequence[float], start_value: float, end: Sequence[float],
                 end_value: float, *, context: Optional[Context] = None) -> Field:
        """Linear from start_value in the plane through start, normal to end - start, to end_value
        in that through end; constant beyond both."""
        return cls._make(context_of(context), lib.msq_field_gradient, doubles(start, "start"),
                         start_value, doubles(end, "end"), end_value)


Param = Union[float, Field]  #: a number, or a field of it


def set_param(target: _abi.msq_param, value: Param) -> None:
    """Writes a parameter. The caller keeps `value` until what it is for has been made."""
    if isinstance(value, Field):
        target.field = value._pointer
    else:
        target.value = value
        target.field = ctypes.POINTER(_abi.msq_field)()
