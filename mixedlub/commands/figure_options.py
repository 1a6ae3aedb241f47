"""Options of the commands that draw figures."""

from __future__ import annotations

from typing import Annotated

import typer

from profiles.errors import InputError, nearest

FORMATS = ("svg", "pdf", "png")
"""Formats of a figure's file."""

FiguresOrTables = Annotated[bool, typer.Option("--figures/--no-figures", help="Figures, or only the tables.")]
Formats = Annotated[
    str, typer.Option("--format", metavar="LIST", help="Formats of the figures: svg, pdf, png, with commas between.")
]


def chosen_formats(text: str) -> tuple[str, ...]:
    """The formats named in a comma-separated list."""
    names = tuple(dict.fromkeys(name.strip().lower() for name in text.split(",")))
    for name in names:
        if name not in FORMATS:
            raise InputError(f"no such format; {nearest(name, FORMATS)}", where="--format", value=name)
    return names
