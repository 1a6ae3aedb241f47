"""Output of commands: folders, messages and tracebacks."""

from __future__ import annotations

import errno
import os
import shutil
import sys
import tempfile
import time
import traceback
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from textwrap import fill
from typing import TextIO

import typer

from mixedlub.schema.findings import Finding, grouped, listed
from mixedlub.schema.messages import printable
from profiles.errors import InputError

CONDITIONS = (
    "Columns: those of recordings.csv without the reading (`mixedlub kinds KIND` lists them); "
    "rows without run are numbered."
)
"""Help on a table of conditions."""


def named_folder(text: str) -> Path:
    """Folder named by an option, ``~`` expanded; an empty text would mean the current folder."""
    if not text.strip():
        raise typer.BadParameter("must name a folder; '.' is the current one")
    try:
        return Path(text).expanduser()
    except RuntimeError:
        raise typer.BadParameter(f"no home folder of {text.partition('/')[0]!r} is known") from None


_opened: list[Path] = []
_made: list[Path] = []
_published: list[Path] = []


def output_folder(out: Path | None, command: str, name: str, *, knows_own: bool = False) -> Path:
    """Output folder, created if necessary; default ``out/COMMAND/NAME``.

    ``knows_own``: the command itself checks which files it would replace.
    """
    folder = Path("out") / command / name if out is None else out
    if out is None and not knows_own and folder.is_dir() and any(p.name[0] != "." for p in folder.iterdir()):
        note(f"the result in {folder}, maybe of another input of that name, is replaced; --out names another folder")
    try:
        _made[:] = [path for path in (folder, *folder.parents) if not path.exists()]
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise InputError(f"cannot be written to ({error.strerror})", where="--out", value=str(folder)) from None
    _opened[:] = [folder]
    return folder


def reset_output() -> None:
    """Forget the output folder of an earlier command."""
    _opened.clear()
    _made.clear()
    _published.clear()


def tables_written() -> None:
    """Record that the tables of the result are in the output folder."""
    _published[:] = _opened


def drop_empty_folders() -> None:
    """Remove folders that were created for results that were never written."""
    for folder in _made:
        try:
            folder.rmdir()
        except OSError:
            return


def resume_hint(partial: str) -> str:
    """Hint on the saved work of an interrupted command and its resumption; empty if the command writes nothing.

    ``partial``: pattern of the files from which the same command resumes; empty if it starts again.
    """
    if not _opened:
        return ""
    (folder,) = _opened
    if _published:
        return f"; the tables are in {folder}"
    if partial and any(path.is_file() for path in folder.glob(partial)):
        return f"; what was done is kept in {folder}, and the same command goes on from there"
    return "; no result was written, and the same command starts anew"


def case_folder(case: Path) -> Path:
    """Case folder named by the user."""
    if case.is_file():
        raise InputError("is a file; name the case folder that holds it", where=str(case))
    if not case.is_dir():
        raise InputError("no such case folder", where=str(case))
    if not (case / "system.toml").exists():
        found = (path.parent.name for path in case.glob("*/system.toml"))
        inside = sorted(name for name in found if not name.startswith("."))
        cases = f"; cases in it: {listed(inside)}" if inside else "; `mixedlub new case` writes one"
        raise InputError(f"is a folder without system.toml, so no case{cases}", where=str(case))
    return case


PROGRESS = "MIXEDLUB_PROGRESS_S"
"""Environment variable with another time between two lines on progress."""
EVERY_S = float(os.environ.get(PROGRESS, "20"))
"""Time (s) between two lines on the progress of a run that has no terminal."""


def now_and_then() -> Callable[[str], None]:
    """Function that prints a line on progress to stderr, at most every `EVERY_S`."""
    last = time.monotonic()

    def tell(text: str) -> None:
        nonlocal last
        if time.monotonic() - last >= EVERY_S:
            last = time.monotonic()
            echo(text, error=True)

    return tell


@contextmanager
def busy(first: str) -> Iterator[Callable[[str], None]]:
    """A progress line on stderr, or occasional lines without a terminal; yields the function that changes it."""
    from rich.console import Console

    console = Console(stderr=True)
    if not console.is_terminal:
        yield now_and_then()
        return
    with console.status(first) as status:
        yield status.update


@contextmanager
def progress_bar(what: str) -> Iterator[Callable[[int, int], None]]:
    """A progress bar on stderr for work of many blocks, or occasional lines without a terminal."""
    from rich.console import Console

    console = Console(stderr=True)
    if not console.is_terminal:
        tell = now_and_then()
        yield lambda done, of: tell(f"{what}: {done} of {of} blocks")
        return
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    bar = Progress(
        TextColumn(what),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("blocks"),
        TimeRemainingColumn(),
        console=console,
    )
    with bar:
        task = bar.add_task(what, total=None, visible=False)
        yield lambda done, of: bar.update(task, completed=done, total=of, visible=of > 1)


def resumed(progress: Callable[[int, int], None], parts: str = "blocks") -> Callable[[int, int], None]:
    """The progress callback, first reporting parts from an earlier run."""
    calls = 0

    def counted(done: int, of: int) -> None:
        nonlocal calls
        calls += 1
        if calls == 1 and done:
            echo(f"{parts} kept from an earlier start: {done} of {of}; to compute: {of - done}")
        progress(done, of)

    return counted


@contextmanager
def input_errors_from(where: str) -> Iterator[None]:
    """Add the place to input errors: the input for arithmetic out of range, the file for keys of a case."""
    from mixedlub.schema.system_file import in_file

    try:
        yield
    except InputError as error:
        file = Path(where) / "system.toml" if Path(where).is_dir() else Path(where)
        raise in_file(error, str(file)) from None
    except ArithmeticError as error:
        raise InputError(f"has numbers too large or too small to compute with ({error})", where=where) from None


def echo(text: str = "", *, error: bool = False) -> None:
    """Print a line to stdout, or to stderr."""
    _print(text, sys.stderr if error else sys.stdout)


def ask(text: str) -> str:
    """Reply to a question at the terminal."""
    return input(printable(text))


def print_findings(found: Iterable[Finding]) -> None:
    """Print findings to stderr, grouped by kind."""
    for one in grouped(found):
        _print(f"{one.severity}: {one}", sys.stderr)


def note(text: str) -> None:
    """Print a note to stderr on something assumed, ignored or doubtful."""
    _print(f"note: {text}", sys.stderr)


def fail(text: str) -> None:
    """Print a one-line error message."""
    _print("mixedlub: " + " ".join(text.split()), sys.stderr)


def _print(text: str, stream: TextIO) -> None:
    """Print text; on a terminal, long lines are wrapped between words and indented."""
    shown = printable(text)
    if stream.isatty():
        width = shutil.get_terminal_size().columns
        shown = "\n".join(line if len(line) <= width else _wrapped(line, width) for line in shown.split("\n"))
    print(shown, file=stream, flush=True)


def _wrapped(line: str, width: int) -> str:
    hanging = " " * (len(line) - len(line.lstrip()) + 2)
    return fill(line, width, subsequent_indent=hanging, break_long_words=False, break_on_hyphens=False)


LOG = "mixedlub-error.log"
"""File in the folder of the results with the traceback of an unexpected error."""


def save_traceback(error: BaseException) -> str:
    """Save the traceback of an unexpected error; returns its file, or the origin of the error without an output
    folder."""
    for folder in _opened:
        try:
            (folder / LOG).write_text("".join(traceback.format_exception(error)), encoding="utf-8")
        except OSError:
            (folder / LOG).unlink(missing_ok=True)
            continue
        return f"details in {folder / LOG}"
    last = traceback.extract_tb(error.__traceback__)[-1]
    return f"at line {last.lineno} of {last.filename}"


def forget_traceback() -> None:
    """Remove the traceback of an earlier run from the output folder."""
    for folder in _opened:
        (folder / LOG).unlink(missing_ok=True)


def is_full(error: OSError) -> bool:
    """Whether an error means that a disk or quota is full."""
    return error.errno in (errno.ENOSPC, errno.EDQUOT)


def opened() -> Path | None:
    """The current output folder."""
    return _opened[0] if _opened else None
