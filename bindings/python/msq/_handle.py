# SPDX-License-Identifier: Apache-2.0
"""Objects of msq as Python objects: released with the last Python reference, or by close()."""
from __future__ import annotations

import ctypes
from typing import Any, ClassVar, Optional, Sequence, Type, TypeVar

from . import _abi
from ._ending import calls
from ._given import Given
from ._library import lib
from ._signals import held


class Reference:
    """One reference to an object of msq, dropped with this one.

    Calls pass this object itself as their argument, so one that works on another thread keeps the
    object although the handle is closed meanwhile.
    """

    __slots__ = ("_as_parameter_", "_release")
    _calls: ClassVar[Any] = calls

    def __init__(self, pointer: Any, release: Any) -> None:
        self._as_parameter_ = pointer
        self._release = release

    def __del__(self) -> None:
        if hasattr(self, "_release") and self._calls.begin(self):  # not if __init__ did not run
            try:
                self._release(self._as_parameter_)
            finally:
                self._calls.end(self)


SelfT = TypeVar("SelfT", bound="Handle")


class Handle:
    """An object of msq. `with` closes it at the end; else it goes with the last reference to it."""

    _kind: ClassVar[str] = ""  # as in msq_<kind>_release
    _reference: Optional[Reference] = None
    _given: Optional[Given] = None
    _kept_context: Any = None

    @classmethod
    def _create(cls, create: Any, *arguments: Any) -> Reference:
        """Calls a constructor of msq, whose last argument is the new handle."""
        pointer = ctypes.POINTER(getattr(_abi, f"msq_{cls._kind}"))()
        with held():
            create(*arguments, ctypes.byref(pointer))
        return Reference(pointer, getattr(lib, f"msq_{cls._kind}_release"))

    @classmethod
    def _wrap(cls: Type[SelfT], reference: Reference) -> SelfT:
        """A new object of the class that holds the reference, without __init__."""
        made = cls.__new__(cls)
        made._reference = reference
        return made

    @property
    def _ref(self) -> Reference:
        """What calls to msq take."""
        reference = self._reference
        if reference is None:
            raise ValueError(f"this {type(self).__name__} is closed")
        return reference

    def __copy__(self: SelfT) -> SelfT:
        """Another handle of the same object, which is immutable."""
        made = type(self).__new__(type(self))
        made.__dict__.update(self.__dict__)
        return made

    def __reduce_ex__(self, _protocol: Any) -> Any:
        raise TypeError(f"{type(self).__name__} objects can neither be pickled nor deep-copied: they "
                        "belong to this process. Share them, or make them again from their arguments")

    def __repr__(self) -> str:
        name = f"msq.{type(self).__name__}"
        if self.closed:
            return f"<{name}, closed>"
        return f"<{name}>" if self._given is None else self._given.text(name)

    @property
    def closed(self) -> bool:
        """Whether close() was called."""
        return self._reference is None

    def close(self) -> None:
        """Drops this object's reference. What was built from it, and calls on it, go on."""
        self._reference = None
        self._given = None
        self._kept_context = None

    def __enter__(self: SelfT) -> SelfT:
        return self

    def __exit__(self, *_exception: Any) -> None:
        self.close()


def lend(target: Any, field: str, handle: Handle) -> None:
    """Writes a handle to a field of a struct. The memory of the struct keeps the object, which the
    call needs even if another thread closes the handle meanwhile."""
    reference = handle._ref
    setattr(target, field, reference._as_parameter_)
    while target._b_base_ is not None:
        target = target._b_base_
    target.__dict__.setdefault("_lent", []).append(reference)


def pointers(handles: Sequence[Handle]) -> Any:
    """An array of pointers to objects, which it keeps."""
    references = [handle._ref for handle in handles]
    array = (type(references[0]._as_parameter_) * len(references))(
        *(reference._as_parameter_ for reference in references))
    array._lent = references
    return array


def hash_of(call: Any, handle: Handle) -> str:
    """What a function such as msq_shape_hash writes, as hexadecimal digits."""
    digest = (ctypes.c_uint8 * 16)()
    call(handle._ref, digest)
    return bytes(digest).hex()
