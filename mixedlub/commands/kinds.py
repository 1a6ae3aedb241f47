"""`mixedlub kinds`: the formats of a case and of a study file in words."""

from __future__ import annotations

from typing import Annotated

import typer

from mixedlub.commands.console import echo

NAME = "kinds"
EXAMPLE = "mixedlub kinds disc"


def command(
    kind: Annotated[
        str | None,
        typer.Argument(
            metavar="KIND",
            help="One kind, a file (`study`, `factors`, `gear`, `efficiency`, `ehl`, `law`), `friction-laws`, or "
            "a method of `evaluate`; all kinds when left out.",
        ),
    ] = None,
) -> None:
    """The format of a case, kind by kind, of a study, of gears, of a gearbox or of an evaluation.

    Columns of recordings.csv and keys of the file, with unit, default, allowed values and meaning.
    """
    from mixedlub.report.format_reference import kinds_text

    echo(kinds_text(kind))
