# SPDX-License-Identifier: Apache-2.0
"""Long calls that the interrupt from the keyboard, or another signal, can stop.

Python runs the handlers of signals on the main thread, and never while that thread is in C.
"""
from __future__ import annotations

import threading
from typing import Any, Callable, List, Optional, TypeVar

from ._library import lib
from ._signals import held, may_call_back
from .context import Job, job_reference


Made = TypeVar("Made")


def interruptible(call: Callable[[Any], Any], job: Optional[Job], is_long: bool = True) -> None:
    """Runs call(job), so that an interrupt cancels it.

    Where it is worth it, the main thread has another one make the call, and waits. After a second
    interrupt it no longer does: the call ends in its own time, and holds what it writes to.
    """
    if threading.current_thread() is not threading.main_thread():
        call(job_reference(job))
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

    try:
        threading.Thread(target=run, name="msq").start()
        while not ended.wait(_LOOK):
            pass
        _let_handlers_run()
    except BaseException:  # of a handler of signals
        lib.msq_job_cancel(reference)
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
