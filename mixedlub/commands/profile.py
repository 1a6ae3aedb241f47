"""`mixedlub profile`: parameters, moments and asperities of roughness traces."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

NAME = "profile"
EXAMPLE = "mixedlub profile ground.csv polished.csv --out out/profile"


def command(
    files: Annotated[list[Path], typer.Argument(metavar="FILE...", help="Traces in any known format.")],
    out: Annotated[
        Path | None, typer.Option(help="Folder for profile.json and figures; default out/profile/NAME.")
    ] = None,
) -> None:
    """Parameters, moments and asperities of traces.

    ISO parameters, spectral moments, asperities and Gaussian verdict, with figures.
    """
    raise NotImplementedError
