# SPDX-License-Identifier: Apache-2.0
"""Contexts, jobs, and what the library says of itself."""
from __future__ import annotations

import copy
import ctypes
import dataclasses
import itertools
import numbers
import operator
import os
import threading
from typing import Any, Callable, Dict, Optional, Tuple, Type, TypeVar, Union, overload

import numpy as np

from . import _abi
from ._given import parameter, remembers
from ._handle import Handle
from ._library import constant, defaults, lib, report
from ._signals import expect_callbacks

RecordT = TypeVar("RecordT")


def record(kind: Type[RecordT], filled: ctypes.Structure) -> RecordT:
    """A dataclass of the same field names as a report struct."""
    values = {}
    for field in dataclasses.fields(kind):  # type: ignore[arg-type]
        value = getattr(filled, field.name)
        if isinstance(value, ctypes.Array):
            value = tuple(value)
        elif isinstance(value, bytes):
            value = value.decode()
        elif field.type == "bool":
            value = bool(value)
        values[field.name] = value
    return kind(**values)


@dataclasses.dataclass(frozen=True)
class BuildInfo:
    """How the loaded library was built."""

    version: int  #: major * 10000 + minor * 100 + patch
    with_assimp: bool  #: all mesh files are read; else no binary STL, 3MF and AMF
    with_cgal: bool  #: foam method 2 and Shape.self_intersections are there
    licence: str  #: effective SPDX licence of the binary
    simd: str  #: instruction set that the kernels use on this machine
    with_xxhash: bool  #: shapes, fields, structures, materials and models have a hash
    with_json: bool  #: models are read from JSON and written
    with_tiff: bool  #: models may name stacks of TIFF files


@dataclasses.dataclass(frozen=True)
class MemoryInfo:
    """Memory accounted to a context."""

    bytes: int  #: held now by meshes, slabs and cached cells
    peak_bytes: int
    limit_bytes: int  #: 0: no limit


@dataclasses.dataclass(frozen=True)
class CacheInfo:
    """Counters of a context's cell cache."""

    hits: int
    misses: int
    evictions: int
    bytes: int
    peak_bytes: int
    limit_bytes: int
    building_bytes: int  #: of bytes: set aside for cells that are being built
    cells: int  #: held now
    duplicates: int  #: of misses: two threads built the cell at once
    unkept: int  #: of misses: no room was found, and the cell served one caller


@dataclasses.dataclass(frozen=True)
class JobInfo:
    """What answered the points of the last set query or statistic under a job."""

    points: int  #: number of points answered
    by_shape: int  #: points that the coarse shape alone answered
    by_point: int  #: points that structures answered one by one, counted for each structure
    by_set: int  #: points that structures answered in groups, counted for each structure
    groups: int  #: number of these groups


def build_info() -> BuildInfo:
    """Says how the loaded library was built."""
    filled = _abi.msq_build_report()
    filled.struct_size = ctypes.sizeof(filled)
    lib.msq_build_info(ctypes.byref(filled))
    return record(BuildInfo, filled)


# The functions of contexts that are alive, by the number that C has for them.
_on_warning: Dict[int, Callable[[str, str], Any]] = {}
_numbers = itertools.count(1)


@_abi.msq_warning_fn
def _take_warning(user: int, code: int, message: bytes) -> None:
    function = _on_warning[user]
    kinds = {value: label[len("MSQ_WARNING_"):].lower() for label, value in vars(_abi).items()
             if label.startswith("MSQ_WARNING_")}
    function(kinds.get(code, str(code)), message.decode())


@_abi.msq_release_fn
def _forget_warning(user: int) -> None:
    _on_warning.pop(user, None)


class Context(Handle):
    """Threads, cell cache and memory limit that objects share.

    threads: greatest number of threads per call, with the caller. 0: one per core. More than the cores
    need beyond_cores, which is for tests. cache_bytes: greatest size of the cell cache; None: 1 GiB.
    memory_limit: bytes that meshes, slabs and cached cells may hold; 0: no limit. cache_policy: `fifo`,
    or `segmented`, which keeps cells that were used again. Results depend on none of these.

    The package has no `parallel_for` of msq_context_def: a task of Python would take the interpreter
    lock, so threads of msq are quicker. Objects made without a context take the context of what they
    are made from, or else a shared one with the defaults.

    on_warning(kind, message): msq calls it, on the thread that calls msq, once for each object that is
    legal but doubtful. Kinds are `open_mesh`, `coarse_pitch`, `small_cache` and `unmatched_cells`. It
    must not raise. It lives as long as anything that was made in the context.
    """

    _kind = "context"
    threads: parameter[int] = parameter("As given; 0: one a core.")
    memory_limit: parameter[int] = parameter("Bytes; 0: none.")
    cache_policy: parameter[str] = parameter("As given.")
    beyond_cores: parameter[bool] = parameter("Whether threads may exceed the cores.")

    @remembers
    def __init__(self, *, threads: int = 0, cache_bytes: Optional[int] = None,
                 memory_limit: int = 0, cache_policy: str = "fifo", beyond_cores: bool = False,
                 on_warning: Optional[Callable[[str, str], Any]] = None) -> None:
        definition = defaults(_abi.msq_context_def)
        definition.threads = unsigned(threads, 32, "threads")
        definition.beyond_cores = bool(beyond_cores)
        if cache_bytes is not None:
            definition.cache_bytes = unsigned(cache_bytes, 64, "cache_bytes")
        definition.memory_limit = unsigned(memory_limit, 64, "memory_limit")
        definition.cache_policy = constant("MSQ_CACHE_", cache_policy, "cache_policy")
        if on_warning is not None:
            if not callable(on_warning):
                raise TypeError(f"on_warning is a {type(on_warning).__name__}; it must be a function")
            number = next(_numbers)
            _on_warning[number] = on_warning
            expect_callbacks()
            definition.warning = _take_warning
            definition.warning_user = number
            definition.warning_release = _forget_warning
        try:
            self._reference = self._create(lib.msq_context_create, ctypes.byref(definition))
        except BaseException:
            if on_warning is not None:
                del _on_warning[number]
            raise

    @property
    def memory(self) -> MemoryInfo:
        """Memory held now, at most so far, and the limit."""
        return record(MemoryInfo, report(_abi.msq_memory_report, lib.msq_context_memory, self._ref))

    @property
    def cache(self) -> CacheInfo:
        """Counters of the cell cache since the context was made."""
        return record(CacheInfo, report(_abi.msq_cache_report, lib.msq_cache_stats, self._ref))

    def clear_cache(self) -> None:
        """Drops all cached cells. Counters stay."""
        lib.msq_cache_clear(self._ref)


class MadeIn:
    """The context that the object was made in."""

    # The object keeps a handle of its own, which stands for the one given once that is closed.

    @overload
    def __get__(self, subject: None, owner: Any) -> MadeIn: ...

    @overload
    def __get__(self, subject: object, owner: Any) -> Context: ...

    def __get__(self, subject: Any, _owner: Any) -> Union[MadeIn, Context]:
        if subject is None:
            return self
        given: Context = subject._context
        return subject._kept_context or given if given.closed else given

    def __set__(self, subject: Any, context: Context) -> None:
        if "_context" in vars(subject):
            raise AttributeError(f"context cannot be set: a {type(subject).__name__} is immutable; make "
                                 "another one")
        subject._context, subject._kept_context = context, copy.copy(context)


_default: Optional[Context] = None
_default_lock = threading.Lock()


def context_of(context: Optional[Context], *parts: Any) -> Context:
    """The context given, else that of the first part that has one, else one of defaults."""
    global _default
    if context is not None:
        if not isinstance(context, Context):
            raise TypeError(f"context is a {type(context).__name__}; it must be a Context")
        return context
    for part in parts:
        found = getattr(part, "context", None)
        if isinstance(found, Context) and not found.closed:
            return found
    with _default_lock:
        if _default is None or _default.closed:
            _default = Context()
        return _default


class Job(Handle):
    """One long call: its progress, and the means to cancel it, from any thread."""

    _kind = "job"

    def __init__(self) -> None:
        self._reference = self._create(lib.msq_job_create)

    def __repr__(self) -> str:
        return "<msq.Job, closed>" if self.closed else f"<msq.Job, {100 * self.progress:.0f} % done>"

    def cancel(self) -> None:
        """Asks the call under the job to stop, with CancelledError; later ones stop at once."""
        lib.msq_job_cancel(self._ref)

    @property
    def progress(self) -> float:
        """Fraction done of the last call under the job; 1 only after success."""
        fraction = ctypes.c_double()
        lib.msq_job_progress(self._ref, ctypes.byref(fraction))
        return fraction.value

    @property
    def info(self) -> JobInfo:
        """What answered the points of the last set query or statistic; 0 for other calls."""
        return record(JobInfo, report(_abi.msq_job_report, lib.msq_job_info, self._ref))


def job_reference(job: Optional[Job]) -> Any:
    """What calls take for a job or None."""
    if job is not None and not isinstance(job, Job):
        raise TypeError(f"job is a {type(job).__name__}; it must be a Job")
    return None if job is None else job._ref


def unsigned(value: int, bits: int, name: str) -> int:
    """The value, which ctypes would cut to the field's size without a word."""
    value = operator.index(value)
    if not 0 <= value < 2**bits:
        raise ValueError(f"{name} is {value}; it must be from 0 to {2**bits - 1}")
    return value


def c_text(value: str, name: str) -> bytes:
    """The text as C takes it, which would end it at a null character."""
    if not isinstance(value, str):
        raise TypeError(f"{name} is {value!r}; it must be a str")
    if "\0" in value:
        raise ValueError(f"{name} is {value!r}; it must not contain the null character")
    return value.encode()


def c_path(path: Union[str, bytes, "os.PathLike[str]"]) -> bytes:
    """The path as C takes it."""
    name = os.fsencode(path)
    if b"\0" in name:
        raise ValueError(f"the path is {path!r}; it must not contain the null character")
    return name


def triple(value: Any, name: str) -> Tuple[float, float, float]:
    """Three numbers; one number stands for all three."""
    try:
        if np.iscomplexobj(value):
            raise TypeError
        if isinstance(value, numbers.Real) or isinstance(value, np.ndarray) and value.ndim == 0:
            return (float(value),) * 3
        values = tuple(float(number) for number in value)
    except TypeError:
        raise TypeError(f"{name} is {value!r}; it must be a number or three numbers") from None
    if len(values) != 3:
        raise ValueError(f"{name} has {len(values)} numbers; it must have 3")
    return values  # type: ignore[return-value]


def doubles(value: Any, name: str) -> Any:
    """Three numbers as `const double[3]`."""
    return (ctypes.c_double * 3)(*triple(value, name))
