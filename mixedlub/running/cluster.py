"""Blocks of a study on the workers of a Dask scheduler; errors become one-line messages."""

from __future__ import annotations

import asyncio
import logging
import socket
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import CancelledError
from contextlib import closing, contextmanager
from typing import TYPE_CHECKING, Any, TypeVar
from urllib.parse import urlsplit

from profiles.errors import InputError, RunError

if TYPE_CHECKING:
    from distributed import Client

OPTION = "--scheduler"
ANSWER_S = 2.0
"""Time (s) for a host to accept a connection, and then for a scheduler to identify itself: many round trips."""
CLIENT_S = 10.0
"""Time (s) for an identified scheduler to accept a client: longer, as a large cluster is busy."""
Task = TypeVar("Task")
Found = TypeVar("Found")
LOGGERS = ("distributed", "tornado", "asyncio")
"""Packages that log a lost connection with tracebacks of their event loop."""


def on_cluster(
    compute: Callable[[Any, Task], Found], shared: Any, todo: Sequence[Task], address: str
) -> Iterator[tuple[Task, Found]]:
    """Results of ``compute`` for each task on the workers of a scheduler, in order of completion."""
    _check_host(address)
    try:
        from distributed import Client, as_completed
        from distributed.comm.core import CommClosedError
        from distributed.scheduler import KilledWorker
    except ImportError:
        raise InputError("running on a cluster needs Dask: pip install 'dask[distributed]'", where=OPTION) from None
    with _quiet():
        _check_scheduler(address)
        with closing(Client(address, timeout=CLIENT_S, set_as_default=False)) as client:
            if not client.nthreads():
                raise RunError(f"the scheduler at {address} has no worker: start one with `dask worker {address}`")
            try:
                everywhere = client.scatter(shared, broadcast=True)
                tasks = {client.submit(compute, everywhere, task, pure=False): task for task in todo}
                for done in as_completed(tasks, loop=client.loop):
                    found = done.result()
                    yield tasks.pop(done), found
                    done.release()
            except ModuleNotFoundError as error:
                raise RunError(f"the workers of {address} lack {error.name}: install mixedlub where they run") from None
            except (asyncio.CancelledError, CancelledError, KilledWorker, CommClosedError, OSError):
                raise RunError(_what_was_lost(client, address)) from None


def _check_scheduler(address: str) -> None:
    """Raise an error if no Dask scheduler answers at an address, without waiting for the retries of a client."""
    from distributed.core import rpc

    async def identity() -> dict[str, Any]:
        async with rpc(address) as there:
            return await there.identity()

    async def in_time() -> str:
        return (await asyncio.wait_for(identity(), ANSWER_S))["type"]

    try:
        kind = asyncio.run(in_time())
    except (OSError, ValueError, TypeError) as error:
        raise _no_answer(address, error) from None
    if kind != "Scheduler":
        raise InputError(f"is the address of a Dask {kind}, not of a scheduler", where=OPTION, value=address)


def _check_host(address: str) -> None:
    """Raise an error if no host accepts a connection at an address, before Dask is loaded."""
    try:
        parts = urlsplit(address if "://" in address else f"tcp://{address}")
        if parts.scheme == "inproc":
            return
        if not parts.hostname or parts.port is None:
            raise ValueError("an address is tcp://HOST:PORT")
        socket.create_connection((parts.hostname, parts.port), ANSWER_S).close()
    except (OSError, ValueError) as error:
        raise _no_answer(address, error) from None


def _no_answer(address: str, error: Exception) -> InputError:
    reason = getattr(error, "strerror", None) or str(error) or "what is there speaks another protocol"
    return InputError(f"no Dask scheduler answers there ({reason})", where=OPTION, value=address)


def _what_was_lost(client: Client, address: str) -> str:
    if client.status == "running" and client.scheduler_info()["workers"]:
        return f"a worker of the scheduler at {address} was lost with the data of the study"
    if client.status == "running":
        return f"the last worker of the scheduler at {address} was lost"
    return f"the connection to the scheduler at {address} was lost"


@contextmanager
def _quiet() -> Iterator[None]:
    """Context in which Dask logs nothing."""
    known = [name for name in logging.root.manager.loggerDict if name.partition(".")[0] in LOGGERS]
    loggers = [logging.getLogger(name) for name in known]
    before = [logger.level for logger in loggers]
    for logger in loggers:
        logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        for logger, level in zip(loggers, before):
            logger.setLevel(level)
