"""`mixedlub simulate`: the base model at a case's conditions, nothing fitted."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mixedlub.atomic import writing
from mixedlub.commands.console import case_folder, output_folder, say, tell, within_range
from profiles.errors import InputError

NAME = "simulate"
EXAMPLE = "mixedlub new case --out my_case && mixedlub simulate my_case"


def command(
    case: Annotated[Path, typer.Argument(metavar="CASE", help="Case folder with system.toml.")],
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder for simulation.csv; default out/simulate/NAME.")
    ] = None,
    at: Annotated[Path | None, typer.Option(metavar="conditions.csv", help="Other conditions than the case's.")] = None,
) -> None:
    """The base model at the conditions of a case.

    Those of recordings.csv and conditions.csv, or of another table; nothing is fitted.
    """
    from mixedlub.case.folder import hidden, read_case, read_conditions
    from mixedlub.case.forward import Forward
    from mixedlub.rig.plausibility import far_off
    from mixedlub.schema.findings import collected

    rows: dict[int, float] = {}
    with collected() as notes, within_range(str(case)):
        found = read_case(case_folder(case), need_recordings=False)
        notes += [*found.notes, *far_off(found.rig)]
        tables = [found.recordings, found.conditions] if at is None else [read_conditions(found, at)]
        notes += hidden(found, found.conditions) if at is None else []
        for table in tables:
            if table is not None:
                forward = Forward(found, table)
                notes.extend(note for note in forward.notes if note not in notes)
                each = zip(table["run"].tolist(), forward.nominal().tolist(), strict=True)
                rows |= {run: value for run, value in each if run not in rows}
    if not rows:
        raise InputError("has neither recordings.csv nor conditions.csv; name a table with --at", where=str(case))
    folder = output_folder(out, NAME, found.name)
    tell(notes)
    with writing(folder) as aside:
        lines = [f"run,{found.quantity}", *(f"{run},{value!r}" for run, value in rows.items())]
        (aside / "simulation.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    say(f"{len(rows)} rows of {found.quantity} in {folder / 'simulation.csv'}")
