"""`mixedlub efficiency`: losses by origin and efficiency of gear stages."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mixedlub.commands.console import busy, input_errors_from, print_findings
from mixedlub.commands.deliver import How, deliver, delivers
from mixedlub.running.origin import is_same, origin_of_file
from mixedlub.schema.findings import Finding
from mixedlub.schema.result import Result

if TYPE_CHECKING:
    import pandas as pd

    from mixedlub.efficiency import Gearbox, Losses

NAME = "efficiency"
EXAMPLE = "mixedlub new efficiency --out my_gearbox\nmixedlub efficiency my_gearbox/efficiency.toml"


@delivers(NAME)
def command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Gear stages with oil, surfaces and parts; conditions.")],
    how: How,
) -> None:
    """Efficiency of gear stages and their losses by origin.

    One stage or several in series, of one gear pair or planetary, each with its oil, bearings, seals and wheels in oil
    and air: map.csv and loss_map.csv over torque and speed, losses.csv by part, breakdown.csv, stages.csv,
    mesh_cycle.csv and tooth_pair.csv at one condition, members.csv, rolling.csv, planets.csv and pairings.csv of
    planetary stages, duty.csv of a duty cycle, figures, and one page. With [thermal] also the sump temperature at
    which the losses equal the heat that leaves: thermal.csv, thermal_duty.csv and thermal_history.csv.
    """
    import numpy as np

    from mixedlub.efficiency import read_gearbox
    from mixedlub.efficiency import table as tables
    from mixedlub.efficiency.mesh_cycle import mesh_cycles
    from mixedlub.efficiency.planetary_table import planetary_tables
    from mixedlub.report.efficiency import efficiency_figures
    from mixedlub.report.gearbox_page import GIVEN, PAGE, write_gearbox_page

    with input_errors_from(str(file)):
        gearbox, findings = read_gearbox(file)
        given = file.read_bytes()
        to = how.open(file.stem, origin_of_file(file), tables.TABLES, "file", PAGE, GIVEN)
        with busy("computing"):
            losses, at = gearbox.map(), gearbox.at_cycle()
            cycles = mesh_cycles(at.gearbox, at)
    print_findings([*losses.findings, *findings])
    made = {
        "map": tables.map_table(losses),
        "loss_map": tables.loss_map(losses),
        "losses": tables.part_table(losses),
        "breakdown": tables.breakdown_table(at),
        "stages": tables.stage_table(at),
        "mesh_cycle": tables.cycle_table(cycles),
        "tooth_pair": tables.tooth_table(cycles),
        **planetary_tables(at),
    }
    duty = gearbox.file.duty
    if duty is not None:
        hours = np.array(duty.duration_h)
        points = gearbox.losses(np.array(duty.torque_Nm), np.array(duty.speed_rpm) * np.pi / 30.0)
        made |= {"duty": tables.duty_table(points, hours), "duty_summary": tables.duty_summary(points, hours)}
    lines, warned = [*_lines(made, at)], [*losses.findings, *findings]
    if gearbox.file.thermal is not None:
        from mixedlub.efficiency.thermal import ThermalModel
        from mixedlub.efficiency.thermal_table import thermal_lines, thermal_tables

        with input_errors_from(str(file)), busy("balancing heat"):
            model = ThermalModel(gearbox)
            heat, found = thermal_tables(model, model.at_map())
        print_findings(found)
        warned += found
        made |= heat
        lines += thermal_lines(heat)
    title, notes = gearbox.file.title, tuple(_notes(gearbox))
    figures = efficiency_figures(title, losses, cycles, made)
    copy = {} if is_same(to.folder / GIVEN, file) else {GIVEN: given}

    def page(aside: Path, doing: Callable[[str], None]) -> list[Finding]:
        write_gearbox_page(
            *(gearbox, losses, made, figures, aside),
            notes=warned,
            lines=[*lines, *notes],
            given=given.decode("utf-8-sig"),
            formats=how.formats,
            doing=doing,
        )
        return []

    result = Result(title, made, figures, tuple(lines), notes, files=copy, columns=tables.TABLES)
    deliver(result, to, page=page, drawings=f", page {to.folder / PAGE}")


def _notes(gearbox: Gearbox) -> Iterator[str]:
    """Laws of parts with constants not confirmed by a source."""
    laws = {part.law.title: part.law for stage in gearbox.stages for part in stage.all_parts}
    doubtful = [title for title, law in laws.items() if not law.sources and law.kind != "other"]
    if doubtful:
        yield f"constants not confirmed by their source: {', '.join(doubtful)}; `mixedlub parts` says what is known"


def _lines(made: Mapping[str, pd.DataFrame], at: Losses) -> Iterator[str]:
    for row in made["stages"].to_dict("records"):
        yield (
            f"  {row['stage']}: the {row['driving']} drives the {row['driven']}, {row['input_torque_Nm']:.4g} N m at "
            f"{row['input_speed_rpm']:.4g} rpm: tooth efficiency {row['tooth_efficiency_percent']:.3f} %, with all "
            f"losses of the stage {row['stage_efficiency_percent']:.3f} %"
        )
    share = made["breakdown"].iloc[:-1].groupby("origin", sort=False)["loss_W"].sum()
    parts = ", ".join(f"{origin} {value:.4g}" for origin, value in share.items() if value)
    yield f"  gearbox: efficiency {100.0 * at.efficiency()[0]:.3f} %, loss {at.total()[0]:.4g} W ({parts})"
    if "duty_summary" in made:
        row = made["duty_summary"].to_dict("records")[0]
        mean = row["mean_gearbox_efficiency_percent"]
        yield (
            f"  duty cycle: {row['input_energy_kWh']:.5g} kWh in {row['duration_h']:.5g} h, "
            f"{row['loss_energy_kWh']:.4g} kWh lost, mean gearbox efficiency {mean:.3f} %"
        )
