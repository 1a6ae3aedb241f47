"""`mixedlub app`: the local page in the browser."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.console import echo, named_folder, output_folder
from profiles.errors import InputError

NAME = "app"
EXAMPLE = "mixedlub app --port 8765"
PORT = 8765


def command(
    port: Annotated[int, typer.Option(metavar="NUMBER", min=0, max=65535, help="Port; 0 takes a free one.")] = PORT,
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", parser=named_folder, help="Folder of all work; default out/app."),
    ] = None,
    browser: Annotated[bool, typer.Option("--browser/--no-browser", help="Open the page in the browser.")] = True,
) -> None:
    """A local page: recordings, surfaces, pairings.

    Drop files, answer questions, run a diagnosis, a roughness evaluation or a study, and download the results. The
    page is served to this machine alone and needs no network. Ctrl-C ends it; all work is listed at the next start.
    """
    try:
        from mixedlub.app.server import serve
    except ModuleNotFoundError as error:
        rule = f"needs the package {error.name}, which comes with the extra app: pip install '.[app]' in the clone"
        raise InputError(rule, where="app") from None
    folder = output_folder(Path("out") / NAME if out is None else out, NAME, "")
    serve(folder, port, browser, echo)
