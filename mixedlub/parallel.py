"""Work shared between the processors of this machine."""

from __future__ import annotations

import multiprocessing
import os
import sys
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
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
    count = min(len(items), len(os.sched_getaffinity(0)) if sys.platform == "linux" else 1)
    if count < 2 or multiprocessing.parent_process() is not None:
        return [function(item) for item in items]
    fork = multiprocessing.get_context("fork")
    with ProcessPoolExecutor(count, fork, initializer=_take, initargs=(function, items)) as pool:
        return list(pool.map(_one, range(len(items))))


def _take(function: Callable[[Any], Any], items: Sequence[Any]) -> None:
    global _work
    _work = (function, items)


def _one(place: int) -> Any:
    assert _work is not None
    function, items = _work
    return function(items[place])
