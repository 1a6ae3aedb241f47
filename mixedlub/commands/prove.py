"""`mixedlub prove`: the project's own blind battery."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.output import output_folder

NAME = "prove"
EXAMPLE = "mixedlub prove --out out/prove"


def command(
    out: Annotated[Path | None, typer.Option(help="Folder for the score table; default out/prove/battery.")] = None,
    quick: Annotated[bool, typer.Option("--quick", help="A handful of cases instead of all.")] = False,
) -> None:
    """Put the diagnosis to a blind test.

    Concealed cases made by an independent rig model are diagnosed, and the score is printed.
    """
    from mixedlub.proof import prove

    prove(output_folder(out, NAME, "battery"), quick=quick)
