# SPDX-License-Identifier: Apache-2.0
"""Signals, such as the interrupt from the keyboard, while C calls back.

Python runs the handlers of signals on the main thread, between its own bytecodes: for a callback
from C before its first statement, out of reach of its `try`. There ctypes prints what the handler
raises and answers 0, which means to go on. So meanwhile it is held, and raised where it is not
lost.
"""
from __future__ import annotations

import contextlib
import signal
import threading
from typing import Any, Callable, ContextManager, Dict, Optional

from ._ending import Running
from ._library import lib


# Those whose handlers may well raise; to look through all would cost as much as many a call.
_NUMBERS = [getattr(signal, name) for name in
            ("SIGINT", "SIGTERM", "SIGALRM", "SIGHUP", "SIGUSR1", "SIGUSR2")
            if hasattr(signal, name)]


class HeldSignals:
    """Within `with`, a call that may call back (Running). On the main thread, what a handler of signals
    raises is held: to its end, or to the next callback that asks for it.

    A callback calls raise_held first and then sets `allowed`, inside its `try`, and unsets it
    there: between the two handlers raise as ever. job: of the call; cancels: when something is held.
    """

    def __init__(self, job: Any = None, cancels: bool = True) -> None:
        self.allowed = False
        self._running = Running(job)
        self._held: Optional[BaseException] = None
        self._job = job if cancels else None
        self._handlers: Dict[int, Callable[[int, Any], Any]] = {}

    def __enter__(self) -> HeldSignals:
        self._running.__enter__()
        try:
            if threading.current_thread() is threading.main_thread():
                for number in _NUMBERS:
                    handler = signal.getsignal(number)
                    if callable(handler):
                        self._handlers[number] = handler
                        signal.signal(number, self._handle)
        except BaseException:  # of a handler
            self._running.__exit__()
            raise
        return self

    def __exit__(self, *_exception: Any) -> None:
        self._running.__exit__()
        for number, handler in self._handlers.items():
            if signal.getsignal(number) == self._handle:  # else the callback has set its own
                signal.signal(number, handler)
        self.raise_held()

    def raise_held(self) -> None:
        """Raises what is held, if anything is."""
        held, self._held = self._held, None
        try:
            if held is not None:
                raise held
        finally:
            del held  # its traceback refers to this frame, and so to all that the callers hold

    def _handle(self, number: int, frame: Any) -> None:
        try:
            self._handlers[number](number, frame)
        except BaseException as error:
            if self.allowed:
                raise
            self._held = self._held or error
            if self._job is not None:
                lib.msq_job_cancel(self._job)


# Whether msq may call functions of Python in any call, and not only in those that take one.
_calls_back = False


def expect_callbacks() -> None:
    """To be said before the first such function is given to msq."""
    global _calls_back
    _calls_back = True


def may_call_back() -> bool:
    return _calls_back


def held(job: Any = None) -> ContextManager[Any]:
    """Signals held if msq may call back."""
    return HeldSignals(job) if _calls_back else contextlib.nullcontext()
