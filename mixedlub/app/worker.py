"""A process beside the server for short calculations, so that the page answers while a file is read."""

from __future__ import annotations

import asyncio
import errno
import multiprocessing
import signal
import warnings
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from importlib import import_module
from typing import Any

from profiles.errors import InputError

LONGEST_S = 240.0
"""Cost limit. Time that one reading of a file may take (s)."""


class Worker:
    """One process that is started anew when a calculation takes too long or ends it."""

    def __init__(self) -> None:
        self._pool = _started()

    async def call(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """Result of a function in the other process; its bad input is an error here too."""
        future = self._pool.submit(_guarded, function, *arguments)
        try:
            kind, found = await asyncio.wait_for(asyncio.wrap_future(future), LONGEST_S)
        except TimeoutError:
            self.restart()
            raise InputError(f"takes longer than {LONGEST_S:g} s to read; send a shorter file") from None
        except BrokenProcessPool:
            self.restart()
            raise InputError("could not be read: memory ran out, or the process was ended from outside") from None
        if kind == "input":
            raise InputError(found)
        if kind == "system":
            raise OSError(*found)
        return found

    def restart(self) -> None:
        """End the process and start another."""
        self.close()
        self._pool = _started()

    def close(self) -> None:
        """End the process."""
        processes = list((getattr(self._pool, "_processes", None) or {}).values())
        self._pool.shutdown(wait=False, cancel_futures=True)
        for process in processes:
            process.kill()


def _started() -> ProcessPoolExecutor:
    pool = ProcessPoolExecutor(1, multiprocessing.get_context("spawn"), initializer=_leave_ctrl_c_to_the_server)
    pool.submit(_ready)
    return pool


def _leave_ctrl_c_to_the_server() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _ready() -> None:
    """Load the readers before the first file is sent."""
    import_module("mixedlub.app.reading")


def _guarded(function: Callable[..., Any], *arguments: Any) -> tuple[str, Any]:
    """Result of a function, or its error in a form that passes between processes."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return "result", function(*arguments)
        except InputError as error:
            return "input", str(error)
        except OSError as error:
            return "system", (error.errno or errno.EIO, error.strerror or str(error), error.filename)
        except (ArithmeticError, MemoryError) as error:
            return "input", f"has numbers too large or too many to compute with ({error or 'memory ran out'})"
