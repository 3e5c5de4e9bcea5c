# SPDX-License-Identifier: Apache-2.0
"""Progress of a long call, shown by a bar such as tqdm's."""
from __future__ import annotations

import contextlib
import threading
from typing import Any, Iterator

from .context import Job


@contextlib.contextmanager
def progress(bar: Any, *, interval: float = 0.1) -> Iterator[Job]:
    """A job whose progress a bar shows, as a share of its total:

        with msq.progress(tqdm(total=100, unit="%")) as job:
            mesh = model.mesh(0.1, job=job)

    bar: has `total`, `n` and `update(amount)`, as a tqdm; it is updated on a thread of its own, every
    interval seconds, and at the end, and is the caller's to close. Slicers need no job: tqdm(slicer)
    counts layers.
    """
    total = getattr(bar, "total", None)
    if not total:
        raise ValueError(f"the bar's total is {total!r}; it must be a number above 0")
    job, is_over = Job(), threading.Event()

    def update() -> None:
        missing = job.progress * total - bar.n
        if missing > 0:
            bar.update(missing)

    def follow() -> None:
        while not is_over.wait(interval):
            update()

    thread = threading.Thread(target=follow, daemon=True)
    thread.start()
    try:
        yield job
    finally:
        is_over.set()
        thread.join()
        update()
