"""`mixedlub factors`: a study varied in oil, friction, gears or traces, and which factor decides the loss."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.console import echo, input_errors_from, print_findings, progress_bar, resumed
from mixedlub.commands.deliver import How, deliver, delivers
from mixedlub.schema.result import Result

NAME = "factors"
EXAMPLE = "mixedlub new factors --out my_factors\nmixedlub factors my_factors/factors.toml"


@delivers(NAME)
def command(
    file: Annotated[Path, typer.Argument(metavar="FACTORS.toml", help="The study, its factors and the design.")],
    how: How,
) -> None:
    """Which factor decides the loss: a study varied in oil, boundary friction, gears or traces.

    Every combination of the levels, or a random design: table of the runs, Sobol' indices, interactions and main
    effects as CSV and figures.

    An interrupted run resumes when it is started again with the same inputs.
    """
    from mixedlub.report.factor_figures import factor_figures
    from mixedlub.study.factor_file import read_factor_file
    from mixedlub.study.factor_parts import parts_folder
    from mixedlub.study.factor_runs import read_experiment
    from mixedlub.study.factor_tables import full_factorial, random_design, share_out_of_range, table_columns

    with input_errors_from(str(file)):
        experiment = read_experiment(file, read_factor_file(file))
    columns = table_columns(experiment)
    to = how.open(file.stem, experiment.origin, columns, "file of factors", "factors.toml", "study.toml")
    print_findings(experiment.study(experiment.runs[0]).notes)
    echo(f"{experiment.file.title}: {len(experiment.runs)} runs of {experiment.study_path}")
    start = time.perf_counter()
    with progress_bar("computing") as bar:
        random = experiment.file.design.random
        table, decided = (random_design if random else full_factorial)(
            experiment, resumed(bar, "runs"), parts_folder(to.folder, experiment)
        )
    echo(f"computed in {time.perf_counter() - start:.2f} s")
    tables = {"runs" if random else "results": table, **decided.tables()}
    files = {"factors.toml": file.read_bytes(), "study.toml": experiment.study_path.read_bytes()}
    outside = share_out_of_range(table)
    notes = [f"{100 * outside:.3g} % of all conditions are outside the model's range, as the table says"]
    shares = sorted(zip(decided.names, decided.indices.first, decided.indices.total), key=lambda share: -share[2])
    lines = tuple(
        f"  {name:22} decides {100 * first:5.1f} % of the variance alone, {100 * total:5.1f} % with others"
        for name, first, total in shares
    )
    figures, captions = factor_figures(decided)
    result = Result(
        *(experiment.file.title, tables, figures, lines, tuple(notes if outside else ())),
        files=files,
        columns=columns,
        captions=captions,
    )
    deliver(result, to, written=f"tables and figures in {to.folder}")
