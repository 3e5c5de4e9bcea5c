# SPDX-License-Identifier: Apache-2.0
"""One exception for each status of msq, with the message of the library.

They derive from Error and, where Python has one that says the same, from that: a wrong argument is
a ValueError too, a missing file an OSError.
"""
from __future__ import annotations

from . import _abi


class Error(Exception):
    """A call to msq failed. The text is the library's, with the value and the limit."""

    status: int = _abi.MSQ_E_INTERNAL  #: MSQ_E_* of msq.h


class ArgumentError(Error, ValueError):
    """An argument is non-finite, out of range or inconsistent."""

    status = _abi.MSQ_E_ARGUMENT


class OutOfMemoryError(Error, MemoryError):
    """An allocation failed."""

    status = _abi.MSQ_E_MEMORY


class CancelledError(Error):
    """The job was cancelled."""

    status = _abi.MSQ_E_CANCELLED


class HostError(Error):
    """A callback gave an answer that cannot be. (Exceptions of callbacks are raised themselves.)"""

    status = _abi.MSQ_E_HOST
    code: int = 0  #: what the callback returned


class FileError(Error, OSError):
    """A file cannot be opened or read."""

    status = _abi.MSQ_E_IO


class UnsupportedError(Error, NotImplementedError):
    """Not in this build of the library, or a file format that it does not read."""

    status = _abi.MSQ_E_UNSUPPORTED


class MeshError(Error, ValueError):
    """Mesh data that cannot be made sense of."""

    status = _abi.MSQ_E_MESH


class LimitError(Error):
    """A stated limit, such as the context's memory_limit, would be passed."""

    status = _abi.MSQ_E_LIMIT


class InternalError(Error):
    """A defect in msq: please report it."""

    status = _abi.MSQ_E_INTERNAL


BY_STATUS = {kind.status: kind for kind in
             (ArgumentError, OutOfMemoryError, CancelledError, HostError, FileError,
              UnsupportedError, MeshError, LimitError, InternalError)}
