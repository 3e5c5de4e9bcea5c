# SPDX-License-Identifier: Apache-2.0
"""Long calls that the interrupt from the keyboard, or another signal, can stop.

Python runs the handlers of signals on the main thread, and never while that thread is in C.
"""
from __future__ import annotations

import queue
import threading
from typing import Any, Callable, List, Optional, TypeVar

from ._library import lib
from ._signals import HeldSignals, held, may_call_back
from .context import Job, job_reference


Made = TypeVar("Made")


class Relay:
    """Functions that a call has run on the thread that waits for it."""

    def __init__(self) -> None:
        self._waiting: "queue.SimpleQueue[Optional[_Request]]" = queue.SimpleQueue()
        self._is_open = True

    def run(self, function: Callable[[], Any]) -> Any:
        """What function() returns or raises on the other thread. Not run if that has been
        interrupted: then None."""
        request = _Request(function)
        self._waiting.put(request)
        while self._is_open or request.is_begun:
            if request.done.wait(_LOOK):
                break
        if request.raised:
            raise request.raised.pop()
        return request.result

    def serve(self, seconds: float) -> None:
        """Runs what comes within that time, or waits."""
        try:
            request = self._waiting.get(timeout=seconds)
        except queue.Empty:
            return
        if request is not None:
            request.serve()

    def wake(self) -> None:
        """Ends a wait: there is nothing more to run."""
        self._waiting.put(None)

    def close(self) -> None:
        """No more functions are run."""
        self._is_open = False


class _Request:
    """One function to be run, and what came of it."""

    def __init__(self, function: Callable[[], Any]) -> None:
        self._function = function
        self.done = threading.Event()
        self.is_begun = False
        self.result: Any = None
        self.raised: List[BaseException] = []

    def serve(self) -> None:
        try:
            self.is_begun = True
            self.result = self._function()
        except BaseException as error:  # raised on the thread that asked
            self.raised.append(error)
        finally:
            self.done.set()


def interruptible(call: Callable[[Any], Any], job: Optional[Job], is_long: bool = True,
                  relay: Optional[Relay] = None, calls_back: bool = False) -> None:
    """Runs call(job), so that an interrupt cancels it, and the end of the program if it may call back.

    Where it is worth it, the main thread has another one make the call, and waits. After a second
    interrupt it no longer does: the call ends in its own time, and holds what it writes to. relay:
    runs functions of the call meanwhile; it makes the call long. calls_back: the call itself is given
    a function of Python.
    """
    if threading.current_thread() is not threading.main_thread():
        if not calls_back and not may_call_back():
            call(job_reference(job))
            return
        reference = job_reference(Job() if job is None else job)
        with HeldSignals(reference):
            call(reference)
        return
    if not is_long and not may_call_back():
        call(job_reference(job))
        return
    reference = job_reference(Job() if job is None else job)
    if not is_long:
        with held(reference):
            call(reference)
        return
    begun, ended = threading.Event(), threading.Event()
    raised: List[BaseException] = []

    def run() -> None:
        begun.set()
        try:
            call(reference)
        except BaseException as error:  # raised below, on the thread that asked
            raised.append(error)
        finally:
            ended.set()
            if relay is not None:
                relay.wake()

    try:
        threading.Thread(target=run, name="msq").start()
        while not ended.is_set():
            if relay is None:
                ended.wait(_LOOK)
            else:
                relay.serve(_LOOK)
        _let_handlers_run()
    except BaseException:  # of a handler of signals
        lib.msq_job_cancel(reference)
        if relay is not None:
            relay.close()
        if begun.wait(1):  # else there is no thread
            ended.wait()
        raise
    if raised:
        raise raised.pop()


def build(make: Callable[[Callable[..., Any]], Made], create: Any, job: Optional[Job],
          is_long: bool = True) -> Made:
    """make(constructor), where the constructor is `create` of msq without its last argument, a job,
    and an interrupt cancels it."""
    made: List[Made] = []
    interruptible(lambda work: made.append(make(lambda *given: create(*given, work))), job, is_long)
    return made[0]


# Seconds: a signal that another thread than the main one receives does not end its wait.
_LOOK = 0.05


def _let_handlers_run() -> None:
    """Handlers run where a function of Python begins. Without this one that would be, for a signal
    at the end of a call, the next destructor, and what it raises be lost there."""
