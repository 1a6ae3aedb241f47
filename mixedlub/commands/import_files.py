"""`mixedlub import`: instrument files into a case folder."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

NAME = "import"
EXAMPLE = "mixedlub import traction.txt --out my_case"


def command(
    files: Annotated[list[Path], typer.Argument(metavar="FILE...", help="Files as the instrument wrote them.")],
    out: Annotated[Path, typer.Option(metavar="CASE", help="Case folder to write.")],
) -> None:
    """Turn instrument files into a case folder.

    One that simulate, check and diagnose understand.
    """
    from mixedlub.importers import import_files

    import_files(files, out)
