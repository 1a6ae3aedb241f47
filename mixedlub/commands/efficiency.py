"""`mixedlub efficiency`: losses by origin and efficiency of gear stages."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mixedlub.commands.console import busy, echo, input_errors_from, note, output_folder, print_findings
from mixedlub.commands.figure_options import FiguresOrTables, Formats, chosen_formats
from mixedlub.running.atomic import writing

if TYPE_CHECKING:
    import pandas as pd

    from mixedlub.efficiency import Gearbox, Losses
    from mixedlub.efficiency.mesh_cycle import MeshCycle

NAME = "efficiency"
EXAMPLE = "mixedlub new efficiency --out my_gearbox\nmixedlub efficiency my_gearbox/efficiency.toml"
DIGITS = "%.12g"
"""Digits of the tables: parts add up to their total within 1e-9."""


def command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Gear stages with oil, surfaces and parts; conditions.")],
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder for the results; default out/efficiency/NAME.")
    ] = None,
    figures: FiguresOrTables = True,
    format_: Formats = "svg",
) -> None:
    """Efficiency of gear stages and their losses by origin.

    Of one stage or several in series, each with its oil, bearings, seals and wheels in oil and air: map.csv and
    loss_map.csv over torque and speed, losses.csv by part, breakdown.csv, stages.csv, mesh_cycle.csv and
    tooth_pair.csv at one condition, duty.csv of a duty cycle, and figures.
    """
    import numpy as np

    from mixedlub.efficiency import read_gearbox
    from mixedlub.efficiency import table as tables
    from mixedlub.efficiency.mesh_cycle import mesh_cycles

    formats = chosen_formats(format_)
    with input_errors_from(str(file)):
        gearbox, notes = read_gearbox(file)
        with busy("computing"):
            losses, at = gearbox.map(), gearbox.at_cycle()
            cycles = mesh_cycles(gearbox, at)
    print_findings([*losses.findings, *notes])
    _say_unconfirmed(gearbox)
    made = {
        "map": tables.map_table(losses),
        "loss_map": tables.loss_map(losses),
        "losses": tables.part_table(losses),
        "breakdown": tables.breakdown_table(at),
        "stages": tables.stage_table(at),
        "mesh_cycle": tables.cycle_table(cycles),
        "tooth_pair": tables.tooth_table(cycles),
    }
    duty = gearbox.file.duty
    if duty is not None:
        hours = np.array(duty.duration_h)
        points = gearbox.losses(np.array(duty.torque_Nm), np.array(duty.speed_rpm) * np.pi / 30.0)
        made |= {"duty": tables.duty_table(points, hours), "duty_summary": tables.duty_summary(points, hours)}
    folder = output_folder(out, NAME, file.stem)
    with writing(folder) as aside:
        for name, table in made.items():
            table.to_csv(aside / f"{name}.csv", index=False, lineterminator="\n", float_format=DIGITS)
        if figures:
            _draw(gearbox.file.title, losses, cycles, aside, formats)
    _print(made, at)
    echo(f"results in {folder / 'map.csv'}")


def _say_unconfirmed(gearbox: Gearbox) -> None:
    """Name the laws of parts whose constants no source that was read confirms."""
    laws = {part.law.title: part.law for stage in gearbox.stages for part in stage.parts}
    doubtful = [title for title, law in laws.items() if not law.sources and law.kind != "other"]
    if doubtful:
        note(f"constants not confirmed by their source: {', '.join(doubtful)}; `mixedlub parts` says what is known")


def _print(made: dict[str, pd.DataFrame], at: Losses) -> None:
    for row in made["stages"].to_dict("records"):
        echo(
            f"  {row['stage']}: the {row['driving']} drives the {row['driven']}, {row['input_torque_Nm']:.4g} N m at "
            f"{row['input_speed_rpm']:.4g} rpm: tooth efficiency {row['tooth_efficiency_percent']:.3f} %, with all "
            f"losses of the stage {row['stage_efficiency_percent']:.3f} %"
        )
    share = made["breakdown"].iloc[:-1].groupby("origin", sort=False)["loss_W"].sum()
    parts = ", ".join(f"{origin} {value:.4g}" for origin, value in share.items() if value)
    echo(f"  gearbox: efficiency {100.0 * at.efficiency()[0]:.3f} %, loss {at.total()[0]:.4g} W ({parts})")
    if "duty_summary" in made:
        row = made["duty_summary"].to_dict("records")[0]
        mean = row["mean_gearbox_efficiency_percent"]
        echo(
            f"  duty cycle: {row['input_energy_kWh']:.5g} kWh in {row['duration_h']:.5g} h, "
            f"{row['loss_energy_kWh']:.4g} kWh lost, mean gearbox efficiency {mean:.3f} %"
        )


def _draw(title: str, losses: Losses, cycles: list[MeshCycle], folder: Path, formats: tuple[str, ...]) -> None:
    from mixedlub.report.efficiency import breakdown_figure, cycle_figure, efficiency_figure, map_figure, tooth_figure
    from mixedlub.report.style import save_all

    drawn = {
        "map": map_figure(title, losses),
        "breakdown": breakdown_figure(title, losses),
        "mesh_cycle": cycle_figure(title, cycles),
        "tooth_pair": tooth_figure(title, cycles),
        "efficiency": efficiency_figure(title, losses),
    }
    save_all(((name, figure) for name, figure in drawn.items() if figure is not None), folder, formats)
