"""`mixedlub import`: instrument files into a case folder."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from time import monotonic
from typing import Annotated

import typer

from mixedlub.commands.console import ask, echo, named_folder
from profiles.errors import InputError

NAME = "import"
LONG = 5.0
"""Judgement. Time (s) after which an import reports its progress."""
EXAMPLE = "mixedlub new case --out rig\nmixedlub import rig/recordings.csv --answers rig/system.toml --out imported"


def command(
    files: Annotated[
        list[Path],
        typer.Argument(metavar="FILE...", help="Files as they were written: text, CSV, .xlsx, .mat, .tdms, .mf4."),
    ],
    out: Annotated[Path, typer.Option(metavar="CASE", parser=named_folder, help="Case folder to write.")],
    settings: Annotated[
        list[str], typer.Option("--set", metavar="KEY=VALUE", help="An answer, with its key in system.toml.")
    ] = [],  # noqa: B006  (typer reads the default, which is never changed)
    answers: Annotated[
        Path | None,
        typer.Option(metavar="FILE.toml", help="Answers, written as in system.toml; files they name come along."),
    ] = None,
    sheet: Annotated[
        str | None, typer.Option(metavar="NAME", help="Sheet or group to read; left out, the longest table.")
    ] = None,
    overwrite: Annotated[
        bool,
        typer.Option(
            "--overwrite",
            help="Replace system.toml and recordings.csv of an existing case. To keep its system.toml: "
            "mixedlub import table.csv --out rig --answers rig/system.toml --overwrite",
        ),
    ] = False,
) -> None:
    """Turn instrument files into a case folder.

    The result is a case for simulate, check and diagnose. At a terminal, all questions on information missing in the
    files are asked together (N? explains a question, N==VALUE sets a value for all rows); elsewhere they are listed
    with the --set line for each answer. Units are never guessed. An existing case that differs is kept unless
    --overwrite is given. Cut off a start-up and average raw readings before the import; --set import.every=10 keeps
    one reading of ten.
    """
    from mixedlub.importers.base import SHEET, Unanswered
    from mixedlub.importers.wizard import run
    from mixedlub.schema.toml_file import toml_value

    if sheet is not None:
        settings = [*settings, f"{SHEET}={toml_value(sheet)}"]
    try:
        with _progress_bar() as step:
            replies = ask if sys.stdin.isatty() else None
            run(files, out, settings, answers, replies, echo, overwrite=overwrite, step=step)
    except Unanswered as missing:
        for line in missing.lines:
            echo(line, error=True)
        raise InputError(missing.summary, where="import") from None


@contextmanager
def _progress_bar() -> Iterator[Callable[[str], None]]:
    """A progress bar on stderr, hidden while a question is open; elsewhere a line per step of a long import."""
    from rich.console import Console

    console = Console(stderr=True)
    if not console.is_terminal:
        started = monotonic()
        yield lambda doing: echo(f"{doing} ...", error=True) if doing and monotonic() - started > LONG else None
        return
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    from mixedlub.importers.wizard import STEPS

    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    bar = Progress(*columns, console=console, transient=True)
    task = bar.add_task("", total=len(STEPS))

    def step(doing: str) -> None:
        if not doing:
            bar.stop()
            return
        bar.start()
        bar.update(task, description=doing, completed=STEPS.index(doing))

    try:
        yield step
    finally:
        bar.stop()
