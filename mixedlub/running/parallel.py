"""Work shared between the processors of this machine."""

from __future__ import annotations

import multiprocessing
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from typing import Any, TypeVar

Item = TypeVar("Item")
Result = TypeVar("Result")

_work: tuple[Callable[[Any], Any], Sequence[Any]] | None = None


def shared_out(function: Callable[[Item], Result], items: Sequence[Item]) -> list[Result]:
    """``[function(item) for item in items]``, in forked processes that have all of this one's memory.

    In turn where there is one processor or no fork, and within a process that itself is one of several.

    >>> shared_out(lambda item: item**2, [1, 2, 3])
    [1, 4, 9]
    """
    found = dict(as_done(function, items))
    return [found[place] for place in range(len(items))]


def as_done(function: Callable[[Item], Result], items: Sequence[Item]) -> Iterator[tuple[int, Result]]:
    """Places and results of ``function(item)``, each as soon as it is there; shared as by `shared_out`.

    >>> sorted(as_done(lambda item: item**2, [1, 2, 3]))
    [(0, 1), (1, 4), (2, 9)]
    """
    count = min(len(items), len(os.sched_getaffinity(0)) if sys.platform == "linux" else 1)
    if count < 2 or multiprocessing.parent_process() is not None:
        yield from ((place, function(item)) for place, item in enumerate(items))
        return
    fork = multiprocessing.get_context("fork")
    with ProcessPoolExecutor(count, fork, initializer=_take, initargs=(function, items)) as pool:
        places = {pool.submit(_one, place): place for place in range(len(items))}
        try:
            for done in as_completed(places):
                yield places[done], done.result()
        finally:
            pool.shutdown(cancel_futures=True)


def _take(function: Callable[[Any], Any], items: Sequence[Any]) -> None:
    global _work
    _work = (function, items)


def _one(place: int) -> Any:
    assert _work is not None
    function, items = _work
    return function(items[place])
