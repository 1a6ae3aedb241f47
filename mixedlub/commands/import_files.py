"""`mixedlub import`: instrument files into a case folder."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from profiles.errors import InputError

NAME = "import"
EXAMPLE = "mixedlub import examples/case/recordings.csv --out out/import --answers examples/case/system.toml"


def command(
    files: Annotated[list[Path], typer.Argument(metavar="FILE...", help="Files as the instrument wrote them.")],
    out: Annotated[Path, typer.Option(metavar="CASE", help="Case folder to write.")],
    settings: Annotated[
        list[str], typer.Option("--set", metavar="KEY=VALUE", help="An answer, with its key in system.toml.")
    ] = [],  # noqa: B006  (typer reads the default, nothing changes it)
    answers: Annotated[
        Path | None,
        typer.Option(metavar="FILE.toml", help="Answers, written as in system.toml; files they name come along."),
    ] = None,
    overwrite: Annotated[
        bool,
        typer.Option(
            "--overwrite",
            help="Replace system.toml and recordings.csv of a case that is there. To keep what its system.toml says: "
            "mixedlub import table.csv --out rig --answers rig/system.toml --overwrite",
        ),
    ] = False,
) -> None:
    """Turn instrument files into a case folder.

    One that simulate, check and diagnose understand. What the files do not say is asked, or listed
    where nobody is there to answer; units are never guessed. A case that is there and differs, as one
    edited since, is left as it is unless --overwrite is said.
    """
    from mixedlub.importers.draft import Unanswered
    from mixedlub.importers.wizard import run

    try:
        run(files, out, settings, answers, ask=input if sys.stdin.isatty() else None, overwrite=overwrite)
    except Unanswered as missing:
        print(*missing.lines, sep="\n", file=sys.stderr)
        raise InputError(missing.summary, where="import") from None
