"""Mode in which emulators are built: progress and scheduler, set around a command."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass


@dataclass(frozen=True)
class Building:
    """Function that receives the numbers of solved and of all parts, and address of a Dask scheduler."""

    progress: Callable[[int, int], None] = lambda done, of: None
    scheduler: str | None = None


_building: ContextVar[Building] = ContextVar("building")


@contextmanager
def building(progress: Callable[[int, int], None], scheduler: str | None = None) -> Iterator[None]:
    """Context in which emulators are built with a progress, or on the workers of a scheduler."""
    token = _building.set(Building(progress, scheduler))
    try:
        yield
    finally:
        _building.reset(token)


def mode() -> Building:
    """The mode set by the command, by default silent and on this machine."""
    return _building.get(Building())
