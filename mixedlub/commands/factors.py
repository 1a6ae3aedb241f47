"""`mixedlub factors`: a study varied in oil, friction, gears or traces, and which factor decides the loss."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Annotated

import typer

from mixedlub.commands.console import echo, input_errors_from, named_folder, note, output_folder, print_findings
from mixedlub.commands.figure_options import Formats, chosen_formats
from mixedlub.commands.study import progress_bar, resumed
from mixedlub.running.atomic import clear_parts, writing

NAME = "factors"
EXAMPLE = "mixedlub new factors --out my_factors\nmixedlub factors my_factors/factors.toml"


def command(
    file: Annotated[Path, typer.Argument(metavar="FACTORS.toml", help="The study, its factors and the design.")],
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", parser=named_folder, help="Folder for the results; default out/factors/NAME."),
    ] = None,
    format_: Formats = "svg",
    replace: Annotated[
        bool, typer.Option("--replace", help="Replace the result of other factors, or other files, in that folder.")
    ] = False,
) -> None:
    """Which factor decides the loss: a study varied in oil, boundary friction, gears or traces.

    Every combination of the levels, or a random design: table of the runs, Sobol' indices, interactions and main
    effects as CSV and figures.

    An interrupted run resumes when it is started again with the same inputs.
    """
    from mixedlub.report.factor_figures import factor_figures
    from mixedlub.report.style import save
    from mixedlub.study.factor_file import read_factor_file
    from mixedlub.study.factor_parts import parts_folder
    from mixedlub.study.factor_runs import read_experiment
    from mixedlub.study.factor_tables import WRITTEN, full_factorial, random_design, share_out_of_range, write_tables

    formats = chosen_formats(format_)
    with input_errors_from(str(file)):
        experiment = read_experiment(file, read_factor_file(file))
    folder = output_folder(out, NAME, file.stem, knows_own=True)
    origin = experiment.origin
    earlier = "" if replace else origin.check_folder(folder, WRITTEN, "file of factors")
    if earlier:
        note(earlier)
    print_findings(experiment.study(experiment.runs[0]).notes)
    echo(f"{experiment.file.title}: {len(experiment.runs)} runs of {experiment.study_path}")
    start = time.perf_counter()
    with progress_bar("computing") as bar:
        random = experiment.file.design.random
        table, decided = (random_design if random else full_factorial)(
            experiment, resumed(bar, "runs"), parts_folder(folder, experiment)
        )
    echo(f"computed in {time.perf_counter() - start:.2f} s")
    with writing(folder) as aside:
        write_tables({"runs" if random else "results": table, **decided.tables()}, aside)
        drawn = list(factor_figures(decided))
        for one in drawn:
            for form in formats:
                save(one.figure, aside / f"{one.name}.{form}")
        captions = "\n\n".join(f"{one.name}\n{one.caption}" for one in drawn)
        (aside / "captions.txt").write_text(captions + "\n", encoding="utf-8")
        (aside / "factors.toml").write_bytes(file.read_bytes())
        (aside / "study.toml").write_bytes(experiment.study_path.read_bytes())
        origin.write_record(aside, folder)
    clear_parts(folder)
    outside = share_out_of_range(table)
    if outside > 0.0:
        note(f"{100 * outside:.3g} % of all conditions are outside the model's range, as the table says")
    for name, first, total in sorted(
        zip(decided.names, decided.indices.first, decided.indices.total), key=lambda r: -r[2]
    ):
        echo(f"  {name:22} decides {100 * first:5.1f} % of the variance alone, {100 * total:5.1f} % with others")
    echo(f"tables and figures in {folder}")
