# SPDX-License-Identifier: Apache-2.0
"""Calls of msq when the program ends.

Python ends every thread but the main one at the point where it next wants the interpreter lock. In a
callback that unwinds through the frames of C++, which aborts the program. So calls that may call back
are cancelled and waited for at its end.
"""
from __future__ import annotations

import atexit
import os
import time
from typing import Any, Dict

from ._library import lib
from .errors import CancelledError

_MOST_SECONDS = 2.0  # that the program waits for calls at its end


class Calls:
    """Calls in progress that may call back. An object, because it outlives the names of modules."""

    def __init__(self) -> None:
        self._jobs: Dict[int, Any] = {}  # of each call: its job, or None
        self._is_ending = False
        if hasattr(os, "register_at_fork"):
            os.register_at_fork(after_in_child=self._jobs.clear)  # other threads are not in the child

    def begin(self, call: Any, job: Any = None) -> bool:
        """Call this before a call of msq. False: the program ends, and the call must not be made."""
        self._jobs[id(call)] = job
        if self._is_ending:  # read after the call is listed: cancel() sees it, or it sees this
            self.end(call)
            return False
        return True

    def end(self, call: Any) -> None:
        """Call this after it."""
        self._jobs.pop(id(call), None)

    def cancel(self) -> None:
        """Cancels the calls, and waits for them. From here on none can begin, and nothing is released:
        what C would call is taken apart."""
        self._is_ending = True
        until = time.monotonic() + _MOST_SECONDS
        while self._jobs and time.monotonic() < until:
            for job in list(self._jobs.values()):
                if job is not None:
                    lib.msq_job_cancel(job)
            time.sleep(0.001)


calls = Calls()
atexit.register(calls.cancel)


class Running:
    """Within `with`, a call that may call back, under a job that cancels it when the program ends."""

    def __init__(self, job: Any) -> None:
        self._job = job

    def __enter__(self) -> None:
        if not calls.begin(self, self._job):
            raise CancelledError("the program ends, so no call can begin that may call functions of "
                                 "Python")

    def __exit__(self, *_exception: Any) -> None:
        calls.end(self)
