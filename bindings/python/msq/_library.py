# SPDX-License-Identifier: Apache-2.0
"""Finds and loads the shared library; its functions raise exceptions instead of returning statuses.

The first of these is taken: the file that the environment variable MSQ_LIBRARY names, a library
beside this file, what the system's loader finds.
"""
from __future__ import annotations

import collections
import ctypes
import os
import pathlib
import sys
import threading
from typing import Any, List, NoReturn, Sequence, Type, TypeVar

from . import _abi
from ._words import in_words_of_python
from .errors import BY_STATUS, Error, HostError


def _names() -> Sequence[str]:
    major = _abi.MSQ_VERSION_MAJOR
    if sys.platform == "win32":
        return ("msq.dll", f"msq-{major}.dll")
    if sys.platform == "darwin":
        return (f"libmsq.{major}.dylib", "libmsq.dylib")
    return (f"libmsq.so.{major}", "libmsq.so")


def _candidates() -> List[str]:
    named = os.environ.get("MSQ_LIBRARY")
    if named:
        return [named]
    here = pathlib.Path(__file__).resolve().parent
    beside = [str(here / name) for name in _names() if (here / name).exists()]
    return beside or list(_names())


def _open() -> ctypes.CDLL:
    problems = []
    for name in _candidates():
        try:
            return ctypes.CDLL(name)
        except OSError as error:
            problems.append(str(error))
    raise ImportError("the shared library of msq cannot be loaded; MSQ_LIBRARY may name its file: "
                      + "; ".join(problems))


# Exceptions of callbacks on their way through C: each callback that fails returns a code of its
# own, by which the call that it made fail finds the exception. Callbacks that fail on several
# threads at once leave those that no call reports, so the oldest give way.
_MOST_EXCEPTIONS = 64
_exceptions: "collections.OrderedDict[int, BaseException]" = collections.OrderedDict()
_exceptions_lock = threading.Lock()
# Codes are below those of statuses, which a callback of C may return.
_FIRST_CODE = -1000
_last_code = _FIRST_CODE


def keep_exception(error: BaseException) -> int:
    """Keeps what a callback raised; returns the code that the callback has to return."""
    global _last_code
    with _exceptions_lock:
        _last_code = _last_code - 1 if _last_code > -2**31 else _FIRST_CODE
        _exceptions[_last_code] = error
        while len(_exceptions) > _MOST_EXCEPTIONS:
            _exceptions.popitem(last=False)
        return _last_code


def raise_error(status: int, message: str) -> NoReturn:
    """Raises the exception of a status that a call on this thread returned; of MSQ_E_HOST that which
    the callback raised, if it raised one."""
    error: BaseException = BY_STATUS.get(status, Error)(in_words_of_python(message))
    try:
        if isinstance(error, HostError):
            error.code = lib.msq_error_host_code()
            with _exceptions_lock:
                error = _exceptions.pop(error.code, error)
        raise error
    finally:
        del error  # its traceback refers to this frame, and so to all that the callers hold


def _raise_status(status: int, _function: Any, _arguments: Any) -> int:
    if status != _abi.MSQ_OK:
        # The message is this thread's, and stays until the next call on it that fails.
        raise_error(status, lib.msq_error_message().decode("utf-8", "replace"))
    return status


def _load() -> ctypes.CDLL:
    library = _open()
    missing = []
    for name, (result, *arguments) in _abi.FUNCTIONS.items():
        try:
            function = getattr(library, name)
        except AttributeError:
            missing.append(name)
            continue
        function.restype, function.argtypes = result, arguments
        if result is ctypes.c_int32 and name != "msq_error_host_code":
            function.errcheck = _raise_status
    path = getattr(library, "_name", "")
    if "msq_version" in missing:
        raise ImportError(f"{path} is not the library of msq")
    version = library.msq_version()
    if version // 100 != _abi.MSQ_VERSION // 100:  # the ABI may change with the minor version
        raise ImportError(f"{path} is msq {version // 10000}.{version // 100 % 100}; this package "
                          f"is for {_abi.MSQ_VERSION_MAJOR}.{_abi.MSQ_VERSION_MINOR}")
    if missing:
        raise ImportError(f"{path} is older than this package: it has no {', '.join(missing)}")
    return library


lib = _load()

StructT = TypeVar("StructT", bound=ctypes.Structure)


def defaults(kind: Type[StructT]) -> StructT:
    """A definition struct with the library's defaults."""
    definition = kind()
    getattr(lib, f"{kind.__name__}_init")(ctypes.byref(definition), ctypes.sizeof(definition))
    return definition


def report(kind: Type[StructT], function: Any, subject: Any) -> StructT:
    """A report struct, filled in by function(subject, report)."""
    filled = kind()
    filled.struct_size = ctypes.sizeof(filled)
    function(subject, ctypes.byref(filled))
    return filled


def constant(prefix: str, name: str, what: str) -> int:
    """The enumerator of msq.h called prefix + NAME; `schwarz_p` and `Schwarz P` are the same."""
    if isinstance(name, str):
        value = getattr(_abi, prefix + name.upper().replace(" ", "_").replace("-", "_"), None)
        if value is not None:
            return value
    known = [label[len(prefix):].lower() for label in vars(_abi) if label.startswith(prefix)]
    raise ValueError(f"{what} is {name!r}; it must be one of {', '.join(map(repr, known))}")


def constant_name(prefix: str, value: int) -> str:
    """The enumerator's name in lower case, without its prefix."""
    return next(label[len(prefix):].lower() for label, known in vars(_abi).items()
                if label.startswith(prefix) and known == value)
