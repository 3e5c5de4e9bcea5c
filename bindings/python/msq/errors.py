# SPDX-License-Identifier: Apache-2.0
"""One exception for each status of msq, with the message of the library.

All derive from Error, and also from the exception of Python with the same meaning, if there is one:
a wrong argument is a ValueError too, a missing file a FileNotFoundError.
"""
from __future__ import annotations

import contextlib
import errno
import os
from typing import Any, Iterator, Optional

from . import _abi


class Error(Exception):
    """A call to msq failed. The text is the library's, with the value and the limit."""

    status: int = _abi.MSQ_E_INTERNAL  #: MSQ_E_* of msq.h


class ArgumentError(Error, ValueError):
    """An argument is not finite, out of range, or inconsistent with another."""

    status = _abi.MSQ_E_ARGUMENT


class OutOfMemoryError(Error, MemoryError):
    """An allocation failed."""

    status = _abi.MSQ_E_MEMORY


class CancelledError(Error):
    """The job was cancelled."""

    status = _abi.MSQ_E_CANCELLED


class HostError(Error):
    """A callback returned an invalid value. (Exceptions of callbacks are raised themselves.)"""

    status = _abi.MSQ_E_HOST
    code: int = 0  #: what the callback returned


class FileError(Error, OSError):
    """A file cannot be opened, read or written, is truncated, or is malformed.

    filename is its path. errno is None where the system reports no error, but the content of the file
    is at fault.
    """

    status = _abi.MSQ_E_IO

    def __str__(self) -> str:
        return str(self.strerror) if self.strerror else super().__str__()


class MissingFileError(FileError, FileNotFoundError):
    """There is no such file."""


class FileAccessError(FileError, PermissionError):
    """The file may not be read or written."""


class FolderError(FileError, IsADirectoryError):
    """The path is that of a folder."""


class ExistingFileError(FileError, FileExistsError):
    """The file to be written exists already."""


_BY_ERRNO = {errno.ENOENT: MissingFileError, errno.EACCES: FileAccessError,
             errno.EPERM: FileAccessError, errno.EISDIR: FolderError,
             errno.EEXIST: ExistingFileError}


def _errno_in(message: str) -> Optional[int]:
    """The errno that a message names by its text, at its end or before a path."""
    if message.startswith("the file exists and replace is "):
        return errno.EEXIST
    for number in errno.errorcode:
        text = f": {os.strerror(number)}"
        if message.endswith(text) or f"{text}: " in message:
            return number
    return None


def with_path(error: FileError, path: Any) -> FileError:
    """The error with the path, and with the errno that its message names."""
    number = _errno_in(str(error))
    kind = FileError if number is None else _BY_ERRNO.get(number, FileError)
    return kind(number, str(error), os.fspath(path))


@contextlib.contextmanager
def naming(path: Any) -> Iterator[None]:
    """Errors of files within `with` get the path."""
    try:
        yield
    except FileError as error:
        raise with_path(error, path) from None


class UnsupportedError(Error, NotImplementedError):
    """This build lacks the feature, or msq does not read the file format."""

    status = _abi.MSQ_E_UNSUPPORTED


class MeshError(Error, ValueError):
    """Malformed mesh arrays."""

    status = _abi.MSQ_E_MESH


class LimitError(Error):
    """A documented limit would be exceeded, for example the context's memory_limit."""

    status = _abi.MSQ_E_LIMIT


class InternalError(Error):
    """A defect in msq. Please report it."""

    status = _abi.MSQ_E_INTERNAL


BY_STATUS = {kind.status: kind for kind in
             (ArgumentError, OutOfMemoryError, CancelledError, HostError, FileError,
              UnsupportedError, MeshError, LimitError, InternalError)}
