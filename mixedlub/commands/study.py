"""`mixedlub study`: the full factorial of a study file."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.console import busy, echo, input_errors_from, named_folder, note, output_folder, print_findings
from mixedlub.commands.figure_options import Formats, chosen_formats
from mixedlub.running.atomic import clear_parts, writing
from profiles.errors import InputError

NAME = "study"
EXAMPLE = "mixedlub new study --out my_study\nmixedlub study my_study/study.toml"

Scheduler = Annotated[
    str | None, typer.Option(metavar="ADDRESS", help="Address of a Dask scheduler, e.g. tcp://host:8786.")
]


def command(
    file: Annotated[Path, typer.Argument(metavar="STUDY.toml", help="The study: gears, oil, surfaces, conditions.")],
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", parser=named_folder, help="Folder for the results; default out/study/NAME."),
    ] = None,
    figures: Annotated[bool, typer.Option("--figures/--no-figures", help="Figures and the HTML page, or not.")] = True,
    format_: Formats = "svg",
    paper_figures: Annotated[
        bool, typer.Option("--paper-figures", help="Also figures for print, one column wide, losses normalised.")
    ] = False,
    curves: Annotated[
        bool, typer.Option("--curves", help="Also a table of every point of the path of contact at every condition.")
    ] = False,
    replace: Annotated[
        bool, typer.Option("--replace", help="Replace the result of another study, or other files, in that folder.")
    ] = False,
    scheduler: Scheduler = None,
) -> None:
    """Power loss of every pairing at every condition.

    Every pairing of surfaces at every torque, speed and oil temperature: table, figures, one HTML page.

    An interrupted run resumes when it is started again with the same inputs.
    """
    from mixedlub.study import checkpoint, counted, factors, read_study, run_study
    from mixedlub.study.curves import is_of_another_study, refuse_too_many, write_curves
    from mixedlub.study.fits import write_fits
    from mixedlub.study.record import CURVES, FITS, WRITTEN, running, study_origin, write_record
    from mixedlub.study.validity import out_of_range

    formats = chosen_formats(format_)
    if paper_figures and not figures:
        raise InputError("draws figures, which --no-figures leaves out; leave one of them out", where="--paper-figures")
    with input_errors_from(str(file)):
        study = read_study(file)
        given = file.read_bytes()
    if curves:
        refuse_too_many(study)
    folder = output_folder(out, NAME, study.name, knows_own=True)
    with running(folder, study):
        earlier = "" if replace else study_origin(study, file).check_folder(folder, WRITTEN, "study")
        if earlier:
            note(earlier)
        print_findings(study.notes)
        echo(f"{study.file.title}: {' x '.join(factors(study))} = {counted(study.conditions, 'condition')}")
        start = time.perf_counter()
        with progress_bar("computing") as bar:
            results = run_study(
                study,
                parts=checkpoint.parts_folder(folder, study.plan),
                scheduler=scheduler,
                progress=resumed(bar),
            )
        echo(f"computed in {time.perf_counter() - start:.2f} s")
        warnings = out_of_range(results)
        print_findings(warnings)
        with writing(folder) as aside:
            results.write(aside / "results.csv", aside / "results.parquet")
            write_fits(results, aside / FITS)
            if curves:
                write_curves(study, *(aside / name for name in CURVES))
            if figures:
                from mixedlub.report.page import write_page

                text = given.decode("utf-8-sig")
                with busy("drawing figures") as doing:
                    known = results.findings
                    of_heights = write_page(
                        results, aside, known, given=text, formats=formats, as_in_paper=paper_figures, doing=doing
                    )
                print_findings(of_heights)
            write_record(aside, folder, study, file, given)
        clear_parts(folder)
    page = folder / "index.html"
    if not figures and page.exists() and checkpoint.fingerprint(study.plan) not in page.read_text("utf-8", "replace"):
        note(f"{page} and the figures beside it are of another study; without --no-figures they are drawn anew")
    if not curves and is_of_another_study(folder / CURVES[-1], study):
        note(f"{folder / CURVES[-1]} is of another state of the study; with --curves it is written anew")
    echo(f"results in {folder / 'results.csv'} and .parquet" + (f", page {page}" if figures else ""))


def resumed(progress: Callable[[int, int], None], parts: str = "blocks") -> Callable[[int, int], None]:
    """The same progress callback, which first reports the parts that are kept from an earlier run."""
    calls = 0

    def counted(done: int, of: int) -> None:
        nonlocal calls
        calls += 1
        if calls == 1 and done:
            echo(f"{parts} kept from an earlier start: {done} of {of}; to compute: {of - done}")
        progress(done, of)

    return counted


@contextmanager
def progress_bar(what: str) -> Iterator[Callable[[int, int], None]]:
    """A progress bar on stderr for work of many blocks, in interactive terminals only."""
    from rich.console import Console

    console = Console(stderr=True)
    if not console.is_terminal:
        yield lambda done, of: None
        return
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    bar = Progress(
        TextColumn(what),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("blocks"),
        TimeRemainingColumn(),
        console=console,
    )
    with bar:
        task = bar.add_task(what, total=None, visible=False)
        yield lambda done, of: bar.update(task, completed=done, total=of, visible=of > 1)
