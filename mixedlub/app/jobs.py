"""Commands in processes of their own, one after another, with progress and an end on request."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from mixedlub.app.store import PAGES, Item, Store, read_record, write_record
from mixedlub.commands.console import PROGRESS
from profiles.errors import InputError

RECORD = "job.json"
WAITING, RUNNING, DONE, FAILED, CANCELLED = "waiting", "running", "done", "failed", "cancelled"
OPEN = (WAITING, RUNNING)
STEP_S = "0.5"
"""Cost limit. Time between two lines on the progress of a job (s)."""
PATIENCE_S = 4.0
"""Judgement. Time that a cancelled job has to end by itself (s)."""
ALMOST_NOTHING = 2**20
"""Judgement. Free space below which a disk counts as full (bytes)."""
SHARE = re.compile(r"(\d+) of (\d+)")
ERROR = "mixedlub: "
LOST = "the page was closed before the run was done; start it again"
ENDED = "ended on request; earlier results are kept"
OTHERS_WAIT = "waits for the run before it"


@dataclass
class Job:
    """Run of a command for an item."""

    item: Item
    words: tuple[str, ...]
    ended: Callable[[], None] = lambda: None
    state: str = WAITING
    text: str = OTHERS_WAIT
    seconds: float = 0.0
    started: float = 0.0
    process: subprocess.Popen[str] | None = None
    lines: deque[str] = field(default_factory=lambda: deque(maxlen=400))

    @property
    def record(self) -> dict[str, Any]:
        """State as shown to the user."""
        running = time.monotonic() - self.started if self.state == RUNNING else self.seconds
        share = SHARE.search(self.text) if self.state == RUNNING else None
        return {
            "page": self.item.page,
            "id": self.item.id,
            "name": self.item.record.get("name", ""),
            "state": self.state,
            "text": self.text,
            "seconds": round(running, 1),
            "done": int(share[1]) if share else None,
            "of": int(share[2]) if share else None,
            "command": shlex.join(("mixedlub", *self.words)),
        }

    def move(self, state: str, text: str) -> None:
        """Change the state and write it into the folder of the item, where the disk has room."""
        self.state, self.text = state, text
        with suppress(OSError):
            write_record(self.item.folder / RECORD, self.record)


class Queue:
    """Jobs of one lane, which run one after another."""

    def __init__(self) -> None:
        self._waiting: deque[Job] = deque()
        self._change = threading.Condition()
        self._stopped = False
        self._current: Job | None = None
        self._thread = threading.Thread(target=self._work, daemon=True)
        self._thread.start()

    def put(self, job: Job) -> None:
        """Add a job to the end."""
        with self._change:
            job.move(WAITING, OTHERS_WAIT)
            self._waiting.append(job)
            self._change.notify()

    def cancel(self, job: Job) -> None:
        """End a job, or take it from the queue."""
        with self._change:
            if job in self._waiting:
                self._waiting.remove(job)
                job.move(CANCELLED, "taken from the queue")
                return
            if job.state == RUNNING:
                job.state, job.text = CANCELLED, ENDED
        if job.process is not None:
            _end(job.process)

    def close(self) -> None:
        """End the current job and take no other."""
        with self._change:
            self._stopped = True
            waiting, current = list(self._waiting), self._current
            self._waiting.clear()
            self._change.notify()
        for job in waiting:
            job.move(FAILED, LOST)
        if current is not None and current.process is not None:
            _end(current.process)
        self._thread.join(2 * PATIENCE_S)

    def _work(self) -> None:
        while True:
            with self._change:
                while not self._waiting and not self._stopped:
                    self._change.wait()
                if self._stopped:
                    return
                job = self._current = self._waiting.popleft()
                job.started = time.monotonic()
                job.move(RUNNING, "starting")
            try:
                self._run(job)
            except OSError as error:
                job.move(FAILED, f"cannot be started ({error.strerror})")
            finally:
                self._current = None

    def _run(self, job: Job) -> None:
        environment = {**os.environ, PROGRESS: STEP_S, "PYTHONUNBUFFERED": "1", "PYTHONIOENCODING": "utf-8"}
        command = [sys.executable, "-m", "mixedlub", *job.words]
        pipes: dict[str, Any] = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
        text: dict[str, Any] = {"text": True, "encoding": "utf-8", "errors": "replace"}
        job.process = subprocess.Popen(command, env=environment, start_new_session=True, **pipes, **text)
        assert job.process.stdout is not None
        if job.state != RUNNING:
            _end(job.process)
        for line in job.process.stdout:
            if line.strip():
                job.lines.append(line.rstrip())
                if job.state == RUNNING:
                    job.text = _short(line, job.item)
        status = job.process.wait()
        job.seconds = time.monotonic() - job.started
        if self._stopped:
            job.move(FAILED, LOST)
        elif job.state == CANCELLED:
            job.move(CANCELLED, ENDED)
        elif status == 0:
            with suppress(OSError):
                job.ended()
            job.move(DONE, "done")
        else:
            job.move(FAILED, _sentence(job, status))


def _short(line: str, item: Item) -> str:
    """A line without the folder of the item."""
    return " ".join(line.replace(f"{item.folder}{os.sep}", "").split())


def _sentence(job: Job, status: int) -> str:
    """The message of a failed command; without one, the likely cause."""
    told = next((line for line in reversed(job.lines) if line.startswith(ERROR)), "")
    if told:
        return _short(told.removeprefix(ERROR), job.item)
    if shutil.disk_usage(job.item.folder).free < ALMOST_NOTHING:
        return f"the disk of {job.item.folder} is full; make room and start the run again"
    why = "memory ran out, or it was ended from outside" if status < 0 else f"exit status {status}"
    return f"the run ended without a message: {why}"


def _end(process: subprocess.Popen[str]) -> None:
    """End a process with its children: first as Ctrl-C does, after a while at once."""
    if sys.platform == "win32":
        import psutil

        with suppress(psutil.NoSuchProcess):
            family = psutil.Process(process.pid)
            for one in (*family.children(recursive=True), family):
                one.kill()
        return
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGINT)
    try:
        process.wait(PATIENCE_S)
    except subprocess.TimeoutExpired:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)


class Jobs:
    """The last job of each item, in a lane for long runs and a lane for short ones."""

    def __init__(self, store: Store) -> None:
        self.store = store
        self._long, self._short = Queue(), Queue()
        self._jobs: dict[tuple[str, str], tuple[Job, Queue]] = {}
        for item in (one for page in PAGES for one in store.items(page)):
            record = read_record(item.folder / RECORD)
            if record.get("state") in OPEN:
                with suppress(OSError):
                    write_record(item.folder / RECORD, {**record, "state": FAILED, "text": LOST})

    def start(
        self, item: Item, words: list[str], *, short: bool = False, ended: Callable[[], None] = lambda: None
    ) -> dict[str, Any]:
        """Start a command for an item; an error while another one runs for it."""
        if self.state(item).get("state") in OPEN:
            raise InputError("has a run already; wait for its end or cancel it", where=item.record.get("name", ""))
        job, queue = Job(item, tuple(words), ended), self._short if short else self._long
        self._jobs[item.page, item.id] = (job, queue)
        queue.put(job)
        return job.record

    def state(self, item: Item) -> dict[str, Any]:
        """State of the last job of an item; empty if there was none."""
        held = self._jobs.get((item.page, item.id))
        return held[0].record if held else read_record(item.folder / RECORD)

    def lines(self, item: Item) -> list[str]:
        """Lines that the last job of an item printed."""
        held = self._jobs.get((item.page, item.id))
        return [_short(line, item) for line in list(held[0].lines)] if held else []

    def cancel(self, item: Item) -> dict[str, Any]:
        """End the job of an item."""
        held = self._jobs.get((item.page, item.id))
        if held is not None and held[0].state in OPEN:
            held[1].cancel(held[0])
        return self.state(item)

    def open(self) -> list[dict[str, Any]]:
        """All jobs that wait or run."""
        return [job.record for job, _ in list(self._jobs.values()) if job.state in OPEN]

    def close(self) -> None:
        """End all jobs."""
        for queue in (self._long, self._short):
            queue.close()
