"""Work shared between the processors of this machine."""

from __future__ import annotations

import multiprocessing
import os
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor, Future, ProcessPoolExecutor, as_completed
from typing import Any, TypeVar

Item = TypeVar("Item")
Result = TypeVar("Result")

_work: tuple[Callable[[Any], Any], Sequence[Any]] | None = None
_WORKER = "MIXEDLUB_WORKER"
"""Environment variable that marks a worker process."""


def shared_out(function: Callable[[Item], Result], items: Sequence[Item]) -> list[Result]:
    """``[function(item) for item in items]`` over the processors; serial on a single processor and within a worker.

    Linux forks processes, which share all memory; elsewhere new processes receive function and items.

    >>> shared_out(lambda item: item**2, [1, 2, 3])
    [1, 4, 9]
    """
    found = dict(as_done(function, items))
    return [found[place] for place in range(len(items))]


def as_done(function: Callable[[Item], Result], items: Sequence[Item]) -> Iterator[tuple[int, Result]]:
    """Indices and results of ``function(item)`` in order of completion; distributed as by `shared_out`.

    >>> sorted(as_done(lambda item: item**2, [1, 2, 3]))
    [(0, 1), (1, 4), (2, 9)]
    """
    count = min(len(items), processors())
    if count < 2 or multiprocessing.parent_process() is not None or _WORKER in os.environ:
        yield from ((place, function(item)) for place, item in enumerate(items))
    elif sys.platform == "linux":
        fork = multiprocessing.get_context("fork")
        with ProcessPoolExecutor(count, fork, initializer=_take, initargs=(function, items)) as pool:
            try:
                yield from _completed({pool.submit(_one, place): place for place in range(len(items))})
            finally:
                pool.shutdown(cancel_futures=True)
    else:
        # Spawned by the standard library, each process would run an unguarded script of the user again.
        from loky import get_reusable_executor

        others: Executor = get_reusable_executor(count, env={_WORKER: "1", "OPENBLAS_NUM_THREADS": "1"})
        waiting = {others.submit(function, item): place for place, item in enumerate(items)}
        try:
            yield from _completed(waiting)
        finally:
            for one in waiting:
                one.cancel()


def processors() -> int:
    """Number of processors available to this process."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _completed(places: Mapping[Future[Result], int]) -> Iterator[tuple[int, Result]]:
    for done in as_completed(places):
        yield places[done], done.result()


def _take(function: Callable[[Any], Any], items: Sequence[Any]) -> None:
    global _work
    _work = (function, items)


def _one(place: int) -> Any:
    assert _work is not None
    function, items = _work
    return function(items[place])
