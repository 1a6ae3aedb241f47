"""The page of an efficiency: findings, figures, tables and inputs of a gearbox."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.efficiency.gearbox import Gearbox, Losses
from mixedlub.efficiency.stage import StageModel
from mixedlub.efficiency.table import RPM, TABLES
from mixedlub.report.efficiency import caption
from mixedlub.report.figures import Drawn
from mixedlub.report.html import PAGE, drawn_all, rendered, shown, start_of
from mixedlub.report.laws import LawText, laws_used
from mixedlub.report.page import geometry_rows, input_rows, option_rows
from mixedlub.report.panels import panel_figure
from mixedlub.report.surfaces import surface_rows
from mixedlub.schema.findings import Finding, grouped
from mixedlub.schema.result import Drawing, declared
from mixedlub.study.options import ignored
from mixedlub.study.plan import Study
from mixedlub.study.results import versions

if TYPE_CHECKING:
    import pandas as pd

GIVEN = "efficiency.toml"
"""Copy of the user's file in the folder of the result."""
SHOWN = ("stages", "breakdown", "duty_summary", "members", "planets")
"""Tables on the page, if they exist."""


def write_gearbox_page(
    gearbox: Gearbox,
    losses: Losses,
    tables: Mapping[str, pd.DataFrame],
    drawings: Mapping[str, Drawing],
    folder: Path,
    *,
    notes: Sequence[Finding] = (),
    lines: Sequence[str] = (),
    given: str = "",
    formats: Sequence[str] = ("svg",),
    doing: Callable[[str], None] = lambda text: None,
) -> None:
    """Write ``index.html`` and ``figures/`` into a folder; ``lines``: result in words, ``given``: the user's file."""
    title = gearbox.file.title
    (folder / "figures").mkdir()
    made = {name: one() if callable(one) else panel_figure(title, one) for name, one in drawings.items()}
    drawn = [Drawn(name, caption(name), one) for name, one in made.items() if one is not None]
    svgs, _ = drawn_all(drawn, folder / "figures", formats, doing)
    page = rendered(
        "gearbox.html",
        title=title,
        conditions=losses.torque.size,
        axes=_axes(gearbox),
        notes=grouped(notes),
        findings=[*(line.strip() for line in lines), *findings(losses)],
        figures=shown(drawn, svgs),
        tables=[table_of(name, tables[name]) for name in SHOWN if name in tables],
        files=[f"{name}.csv" for name in tables],
        definitions=[(one.name, one.unit, one.meaning) for one in _columns("map", tables["map"])],
        meshes=[_mesh(name, study) for name, study in _studies(gearbox)],
        laws=_laws(gearbox),
        given=start_of(given, GIVEN),
        given_name=GIVEN,
        versions=", ".join(f"{name} {version}" for name, version in versions().items()),
    )
    (folder / PAGE).write_text(page, encoding="utf-8")


def _axes(gearbox: Gearbox) -> list[str]:
    """Levels of the conditions in words."""
    levels = gearbox.file.conditions
    axes = (("torque", levels.torque_Nm), ("speed", levels.speed_rpm), ("oil temperature", levels.oil_temperature_C))
    return [f"{len(one)} {name}{'' if len(one) == 1 else 's'}" for name, one in axes if one is not None]


def findings(losses: Losses) -> Iterator[str]:
    """The map in a few sentences."""
    for words, chosen in (("the input drives", losses.torque > 0.0), ("the output drives", losses.torque < 0.0)):
        if not chosen.any():
            continue
        part = losses.where(chosen)
        efficiency, total = 100.0 * part.efficiency(), part.total()
        if np.isfinite(efficiency).any():
            best = int(np.nanargmax(efficiency))
            yield (
                f"Where {words}, the gearbox efficiency lies between {np.nanmin(efficiency):.2f} and "
                f"{np.nanmax(efficiency):.2f} %, the largest {_at(part, best)}."
            )
        most = int(np.argmax(total))
        yield f"Where {words}, the largest loss is {total[most]:.4g} W, {_at(part, most)}."
    if losses.oil is not None and np.unique(losses.oil).size > 1:
        hardest = (losses.torque == losses.torque.max()) & (losses.speed == losses.speed.max())
        part = losses.where(hardest)
        assert part.oil is not None
        cold, hot = int(part.oil.argmin()), int(part.oil.argmax())
        total = part.total()
        yield (
            f"At {part.torque[0]:.4g} N m and {part.speed[0] * RPM:.4g} rpm the loss is {total[cold]:.4g} W with oil "
            f"at {part.oil[cold]:g} °C and {total[hot]:.4g} W at {part.oil[hot]:g} °C."
        )


def _at(losses: Losses, index: int) -> str:
    oil = "" if losses.oil is None else f" with oil at {losses.oil[index]:g} °C"
    return f"at {losses.torque[index]:.4g} N m and {losses.speed[index] * RPM:.4g} rpm{oil}"


def _columns(name: str, table: pd.DataFrame) -> list[Any]:
    return [declared(TABLES[name], str(column)) for column in table.columns]


def table_of(name: str, table: pd.DataFrame) -> dict[str, Any]:
    """A table for the page: title, heads with units, and rows as text."""
    columns = _columns(name, table)
    units = [one.unit if one.unit not in ("text", "-") else "" for one in columns]
    heads = [
        f"{one.name.removesuffix('_' + one.unit).replace('_', ' ')}{f' ({unit})' if unit else ''}"
        for one, unit in zip(columns, units, strict=True)
    ]
    rows = [[_text(value) for value in row] for row in table.itertuples(index=False)]
    return {"title": name.replace("_", " "), "heads": heads, "rows": rows}


def _text(value: object) -> str:
    if isinstance(value, float):
        return "" if np.isnan(value) else f"{value:.5g}"
    return str(value)


def _studies(gearbox: Gearbox) -> Iterator[tuple[str, Study]]:
    """Meshes with their names."""
    for stage in gearbox.stages:
        for mesh in (stage,) if isinstance(stage, StageModel) else stage.meshes:
            yield mesh.name, mesh.study


def _mesh(name: str, study: Study) -> dict[str, Any]:
    """Inputs of a mesh for the page."""
    return {
        "name": name,
        "gears": input_rows(study, "gears"),
        "geometry": geometry_rows(study),
        "oil": study.oil.name,
        "lubricant": input_rows(study, "lubricant"),
        "surfaces": surface_rows(study),
        "options": option_rows(study.file.options, ignored(study.file.options, study.plan.model())),
        "effects": [(e, study.plan.parameters[e.id]) for e in study.effects],
    }


def _laws(gearbox: Gearbox) -> list[LawText]:
    """Laws of all meshes, each once."""
    return list(dict.fromkeys(law for _, study in _studies(gearbox) for law in laws_used(study.plan.model())))
