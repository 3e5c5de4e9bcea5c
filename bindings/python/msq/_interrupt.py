# SPDX-License-Identifier: Apache-2.0
"""Signals, such as the interrupt from the keyboard, while a call is in C.

Python runs the handlers of signals on the main thread, between its own bytecodes: never while that
thread is in C, and else at once, which for a callback from C is before its first statement, out of
reach of its `try`. There ctypes prints what the handler raises and answers 0, which means to go on.
"""
from __future__ import annotations

import signal
import threading
from typing import Any, Callable, Dict, List, Optional

from ._library import lib
from .context import Job, job_reference


def interruptible(call: Callable[[Any], Any], job: Optional[Job], is_long: bool = True) -> None:
    """Runs call(job), so that an interrupt cancels it.

    Where it is worth it, the main thread has another one make the call, and waits. After a second
    interrupt it no longer does: the call ends in its own time, and holds what it writes to.
    """
    if not is_long or threading.current_thread() is not threading.main_thread():
        call(job_reference(job))
        return
    reference = job_reference(Job() if job is None else job)
    ended = threading.Event()
    raised: List[BaseException] = []

    def run() -> None:
        try:
            call(reference)
        except BaseException as error:  # raised below, on the thread that asked
            raised.append(error)
        finally:
            ended.set()

    threading.Thread(target=run, name="msq").start()
    try:
        ended.wait()
    except BaseException:  # of a handler of signals
        lib.msq_job_cancel(reference)
        ended.wait()
        raise
    if raised:
        raise raised.pop()


class HeldSignals:
    """While in `with`, what a handler of signals raises is held in `raised`, save within `allowed`.

    A callback reads `raised` first, sets `allowed` inside its `try`, and unsets it there.
    """

    def __init__(self) -> None:
        self.allowed = False
        self.raised: Optional[BaseException] = None
        self._handlers: Dict[int, Callable[[int, Any], Any]] = {}

    def __enter__(self) -> HeldSignals:
        if threading.current_thread() is threading.main_thread():
            for number in signal.valid_signals():
                handler = signal.getsignal(number)
                if callable(handler):
                    self._handlers[number] = handler
                    signal.signal(number, self._handle)
        return self

    def __exit__(self, *_exception: Any) -> None:
        for number, handler in self._handlers.items():
            if signal.getsignal(number) == self._handle:  # else the callback has set its own
                signal.signal(number, handler)

    def _handle(self, number: int, frame: Any) -> None:
        try:
            self._handlers[number](number, frame)
        except BaseException as error:
            if self.allowed:
                raise
            self.raised = self.raised or error
