"""`mixedlub kinds`: the format of a case in words."""

from __future__ import annotations

from typing import Annotated

import typer

from mixedlub.commands.console import say

NAME = "kinds"
EXAMPLE = "mixedlub kinds disc"


def command(
    kind: Annotated[str | None, typer.Argument(metavar="KIND", help="One kind; all of them when left out.")] = None,
) -> None:
    """The format of a case: what each kind records.

    Columns of recordings.csv and keys of system.toml, with unit, default, allowed values and meaning.
    """
    from mixedlub.case.format_reference import kinds_text

    say(kinds_text(kind))
