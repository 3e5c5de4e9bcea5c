# SPDX-License-Identifier: Apache-2.0
"""What objects were made from: parameters that can be read back, and repr."""
from __future__ import annotations

import collections.abc
import dataclasses
import functools
import inspect
import io
from numbers import Number
from typing import Any, Callable, Generic, NoReturn, TypeVar, Union, cast, overload

import numpy as np

F = TypeVar("F", bound=Callable[..., Any])
T = TypeVar("T")
_MOST = 16  # numbers of an array that is kept, so that an object does not keep its input in memory


class _Left:
    """Stands for an array that is not kept."""

    def __init__(self, text: str) -> None:
        self._text = text

    def __repr__(self) -> str:
        return self._text


def _kept(value: Any) -> Any:
    if isinstance(value, (bytes, bytearray, memoryview)):
        return _Left(f"<{len(value)} bytes>")
    if isinstance(value, np.ndarray):
        return value.copy() if value.size <= _MOST else _Left(f"<array {value.shape}>")
    if type(value) in (list, tuple):
        if _count(value) > _MOST:
            return _Left(f"<{type(value).__name__} of {len(value)}>")
        return type(value)(_kept(one) for one in value)
    if isinstance(value, dict):
        return dict(value)
    if callable(value):  # msq keeps it, for as long as it needs it
        return _Left(f"<function {getattr(value, '__name__', repr(value))}>")
    return value


def _count(value: Any) -> int:
    """Numbers in a value. Objects are kept, however many there are."""
    if isinstance(value, np.ndarray):
        return value.size
    return sum(map(_count, value)) if isinstance(value, (list, tuple)) else isinstance(value, Number)


class Given:
    """The arguments of a constructor, those left out with their defaults."""

    def __init__(self, function: Callable[..., Any], bound: inspect.BoundArguments) -> None:
        arguments = list(bound.arguments.items())[1:]
        explicit = {name for name, _ in arguments}
        bound.apply_defaults()
        self.parameters = {name: one for name, one in bound.signature.parameters.items()
                           if name not in ("context", "job")}
        self.values = {name: _kept(value) for name, value in list(bound.arguments.items())[1:]
                       if name in self.parameters}
        self.shown = explicit & set(self.values)
        self.name = "" if function.__name__ == "__init__" else f".{function.__name__}"
        owner, subject = next(iter(bound.arguments.items()))
        #: what a method made another object from
        self.original = subject if owner == "self" and self.name else None

    def text(self, subject: str) -> str:
        parts = []
        for name, parameter in self.parameters.items():
            if name not in self.shown:
                continue
            value = self.values[name]
            if parameter.kind == parameter.VAR_POSITIONAL:
                parts += [repr(one) for one in value]
            elif parameter.kind == parameter.VAR_KEYWORD:
                parts += [f"{key}={one!r}" for key, one in value.items()]
            elif parameter.kind == parameter.KEYWORD_ONLY:
                parts.append(f"{name}={value!r}")
            else:
                parts.append(repr(value))
        if self.original is not None:
            subject = repr(self.original)
        return f"{subject}{self.name}({', '.join(parts)})"


def shown(value: Any) -> str:
    """repr of a tuple with names or a dataclass, as a call. Defaults are left out."""
    if dataclasses.is_dataclass(value):
        defaults = {field.name: field.default for field in dataclasses.fields(value)}
    else:
        defaults = {name: value._field_defaults.get(name, dataclasses.MISSING)
                    for name in value._fields}
    parts = {name: repr(_kept(getattr(value, name))) for name in defaults}
    given = ", ".join(f"{name}={part}" for name, part in parts.items()
                      if part != repr(defaults[name]))
    return f"msq.{type(value).__name__}({given})"


def plain(value: Any) -> Any:
    """Arrays and lists as tuples, so that objects that hold them can be compared."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    return tuple(map(plain, value)) if isinstance(value, (list, tuple)) else value


def kept(value: Any) -> Any:
    """An iterator is used up by the call. Files, which are iterators of lines, are read by it."""
    is_used_up = isinstance(value, collections.abc.Iterator) and not isinstance(value, io.IOBase)
    return tuple(value) if is_used_up else value


def remembers(make: F) -> F:
    """For __init__ and for class methods that make objects: keeps what they were called with."""
    signature = inspect.signature(make)

    @functools.wraps(make)
    def wrapped(*arguments: Any, **named: Any) -> Any:
        arguments = tuple(map(kept, arguments))
        named = {name: kept(one) for name, one in named.items()}
        result = make(*arguments, **named)
        made = arguments[0] if result is None else result
        made._given = Given(make, signature.bind(*arguments, **named))
        return result

    return cast(F, wrapped)


class parameter(Generic[T]):
    """A property that returns what a parameter was given, or its default."""

    def __init__(self, doc: str) -> None:
        self.__doc__ = doc

    def __set_name__(self, _owner: Any, name: str) -> None:
        self._name = name

    @overload
    def __get__(self, subject: None, owner: Any) -> parameter[T]: ...

    @overload
    def __get__(self, subject: object, owner: Any) -> T: ...

    def __get__(self, subject: Any, _owner: Any) -> Union[parameter[T], T]:
        if subject is None:
            return self
        given = getattr(subject, "_given", None)
        if given is None or self._name not in given.values:
            raise AttributeError(f"this {type(subject).__name__} was made without a {self._name}")
        return cast(T, given.values[self._name])

    def __set__(self, subject: Any, _value: Any) -> NoReturn:
        raise AttributeError(f"{self._name} cannot be set: a {type(subject).__name__} is immutable; "
                             "make another one")
