"""`mixedlub schema`: JSON Schema of a file, for completion and checks in editors."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.console import echo

NAME = "schema"
EXAMPLE = "mixedlub schema study --out study.schema.json"


def command(
    kind: Annotated[
        str,
        typer.Argument(
            metavar="KIND",
            help="A kind of case, a file (`study`, `factors`, `gear`, `bevel`, `worm`, `efficiency`, `ehl`, `law`), "
            "or a method of `evaluate`.",
        ),
    ],
    out: Annotated[Path | None, typer.Option(metavar="FILE", help="File to write; printed when left out.")] = None,
) -> None:
    """JSON Schema of system.toml of a kind of case, of a study file, or of a file of another command.

    An editor with Taplo or Even Better TOML takes it from a first line `#:schema study.schema.json`.
    """
    import json

    from mixedlub.report.json_schema import json_schema
    from mixedlub.running.atomic import whole

    text = json.dumps(json_schema(kind), indent=1, ensure_ascii=False)
    if out is None:
        echo(text)
        return
    with whole(out) as path:
        path.write_text(text + "\n", encoding="utf-8")
