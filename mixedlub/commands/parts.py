"""`mixedlub parts`: the laws of bearings, seals and wheels in oil and air."""

from __future__ import annotations

from typing import Annotated

import typer

from mixedlub.commands.console import echo

NAME = "parts"
EXAMPLE = "mixedlub parts skf_deep_groove"


def command(
    law: Annotated[str | None, typer.Argument(metavar="LAW", help="One law; a table of all when left out.")] = None,
) -> None:
    """The laws of bearings, seals and wheels in oil and air, for `mixedlub efficiency`.

    The page of a law has its equation, inputs, coefficients with values for known series, and the status of its
    constants.
    """
    from mixedlub.report.part_pages import parts_text

    echo(parts_text(law))
