"""Processes that work side by side, and stop together when they are told to."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager


@contextmanager
def workers(jobs: int) -> Iterator[ProcessPoolExecutor]:
    """So many processes; whatever goes wrong here takes what is still waiting off their hands."""
    with ProcessPoolExecutor(jobs, initializer=_stop_at_once) as pool:
        try:
            yield pool
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


def _stop_at_once() -> None:
    """Ctrl-C ends a worker without a word and in the midst of a case, which is done anew when the work goes on."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
