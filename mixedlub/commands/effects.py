"""`mixedlub effects`: the catalogue in words."""

from __future__ import annotations

from typing import Annotated

import typer

from mixedlub.commands.console import echo

NAME = "effects"
EXAMPLE = "mixedlub effects inlet_shear_heating"


def command(
    effect: Annotated[
        str | None,
        typer.Argument(metavar="ID", help="One effect, or the file of a law of yours; all effects when left out."),
    ] = None,
) -> None:
    """The catalogue of effects, or one of them in full.

    Equation, source, parameters, fingerprint, similar effects and the test that separates them.
    """
    from mixedlub.report.effect_pages import effects_text

    echo(effects_text(effect))
