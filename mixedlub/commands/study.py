"""`mixedlub study`: the full factorial of a study file."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.console import echo, input_errors_from, print_findings, progress_bar, resumed
from mixedlub.commands.deliver import How, deliver, delivers
from mixedlub.schema.findings import Finding
from mixedlub.schema.result import Result
from profiles.errors import InputError

NAME = "study"
EXAMPLE = "mixedlub new study --out my_study\nmixedlub study my_study/study.toml"

Scheduler = Annotated[
    str | None, typer.Option(metavar="ADDRESS", help="Address of a Dask scheduler, e.g. tcp://host:8786.")
]


@delivers(NAME)
def command(
    file: Annotated[Path, typer.Argument(metavar="STUDY.toml", help="The study: gears, oil, surfaces, conditions.")],
    how: How,
    paper_figures: Annotated[
        bool, typer.Option("--paper-figures", help="Also figures for print, one column wide, losses normalised.")
    ] = False,
    curves: Annotated[
        bool, typer.Option("--curves", help="Also a table of every point of the path of contact at every condition.")
    ] = False,
    scheduler: Scheduler = None,
) -> None:
    """Power loss of every pairing at every condition.

    Every pairing of surfaces at every torque, speed and oil temperature: table, figures, one HTML page.

    An interrupted run resumes when it is started again with the same inputs.
    """
    from mixedlub.full_base.progress import building
    from mixedlub.study import checkpoint, counted, factors, read_study, run_study
    from mixedlub.study.columns import every_column
    from mixedlub.study.curves import curve_columns, curve_table, refuse_too_many
    from mixedlub.study.fits import fit_columns, fits_table
    from mixedlub.study.rank import COMPARISONS, RANKING, ranking_tables
    from mixedlub.study.record import TABLES, WRITTEN, record_files, running, study_origin
    from mixedlub.study.validity import out_of_range

    if paper_figures and not how.figures:
        raise InputError("draws figures, which --no-figures leaves out; leave one of them out", where="--paper-figures")
    with input_errors_from(str(file)), progress_bar("full solutions") as bar, building(resumed(bar), scheduler):
        study = read_study(file)
        given = file.read_bytes()
    if curves:
        refuse_too_many(study)
    to = how.open(study.name, study_origin(study, file), TABLES, "study", *WRITTEN)
    with running(to.folder, study):
        print_findings(study.notes)
        echo(f"{study.file.title}: {' x '.join(factors(study))} = {counted(study.conditions, 'condition')}")
        start = time.perf_counter()
        with progress_bar("computing") as bar:
            results = run_study(
                study,
                parts=checkpoint.parts_folder(to.folder, study.plan),
                scheduler=scheduler,
                progress=resumed(bar),
            )
        echo(f"computed in {time.perf_counter() - start:.2f} s")
        print_findings(out_of_range(results))
        ranked = ranking_tables(results)
        tables = {"results": results.long_table(), "fits": fits_table(results), **ranked}
        columns = {"results": every_column(study.plan.losing), "fits": fit_columns(), "curves": curve_columns()}
        columns |= {"ranking": list(RANKING), "comparisons": list(COMPARISONS)}
        if curves:
            tables["curves"] = curve_table(study)
        result = Result(
            study.file.title, tables, {}, files=record_files(to.folder, study, file, given), columns=columns
        )

        def page(aside: Path, doing: Callable[[str], None]) -> list[Finding]:
            from mixedlub.report.page import write_page

            text = given.decode("utf-8-sig")
            return write_page(
                *(results, aside, results.findings),
                given=text,
                formats=how.formats,
                as_in_paper=paper_figures,
                ranked=ranked,
                doing=doing,
            )

        written = f"results in {to.folder / 'results.csv'} and .parquet"
        deliver(result, to, page=page, written=written, drawings=f", page {to.folder / 'index.html'}")
