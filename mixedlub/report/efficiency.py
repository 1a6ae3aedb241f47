"""Figures of an efficiency: maps, losses by origin, and the mesh cycle."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.efficiency.gearbox import MESH, Losses, strongest
from mixedlub.efficiency.table import RPM, map_table, present
from mixedlub.report.panels import panel_figure
from mixedlub.report.style import SMALL, WIDTH, legend_above, panels, shades
from mixedlub.schema.result import Curve, Drawing, Panel, curve

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from matplotlib.figure import Figure

    from mixedlub.efficiency.mesh_cycle import MeshCycle

LEVELS = 12
CURVES = 5
"""Largest number of curves in a figure of the efficiency."""
FLAT = 1e-3
"""Judgement. Range of a map over its values below which it counts as flat and its colours span this much."""
LEAST_LEVELS = 2
"""Smallest number of torques and speeds of a map."""
CAPTIONS = {
    "map": "Total loss, tooth efficiency and gearbox efficiency over input speed and torque. Below a torque of 0 the "
    "output drives. The lowest twentieth of the efficiencies has one colour.",
    "breakdown": "Losses by origin, stacked: over torque at the largest speed, and over speed at the largest torque, "
    "of coast alone the lowest.",
    "efficiency": "Tooth efficiency over torque at some speeds, and over speed at some torques; the input drives, in a "
    "map of coast alone the output.",
    "loss_torque": "All losses as a torque of the input over its torque, at some speeds. Below a torque of 0 the "
    "output drives.",
    "oil_temperature": "Total loss and gearbox efficiency over the oil temperature at the largest speed.",
    "mesh_cycle": "Loss, tooth efficiency, friction coefficient and friction force of each mesh over one base pitch, "
    "at the condition of the breakdown.",
    "tooth_pair": "Normal and friction force of one tooth pair of each stage over the roll angle of the pinion.",
    "thermal": "Temperature of the sump at which all losses leave as heat: over speed at some torques, and over the "
    "time of the duty cycle.",
}
"""Captions of the figures, by name without oil temperature."""


def efficiency_figures(
    title: str, losses: Losses, cycles: Sequence[MeshCycle], tables: Mapping[str, pd.DataFrame]
) -> dict[str, Drawing]:
    """All figures by file name."""
    found: dict[str, Drawing] = {}
    for suffix, words, part in _at_oils(losses):
        table = map_table(part)
        found |= {
            f"map{suffix}": partial(map_figure, title + words, part),
            f"breakdown{suffix}": partial(breakdown_figure, title + words, part),
            f"efficiency{suffix}": partial(panel_figure, title + words, tuple(_efficiency(table))),
            f"loss_torque{suffix}": partial(panel_figure, title + words, tuple(_loss_torque(table))),
        }
    if losses.oil is not None and np.unique(losses.oil).size > 1:
        found["oil_temperature"] = tuple(_over_oil(tables["map"]))
    return {
        **found,
        "mesh_cycle": tuple(_cycle(cycles)),
        "tooth_pair": tuple(_tooth(tables["tooth_pair"])),
        **({"thermal": tuple(_thermal(tables))} if "thermal" in tables else {}),
    }


def _thermal(tables: Mapping[str, pd.DataFrame]) -> Iterator[Panel]:
    """Sump temperature over speed for some torques, and over the time of the duty cycle."""
    table = tables["thermal"]
    torques = np.unique(table["torque_Nm"])
    chosen = torques[np.unique(np.linspace(0, torques.size - 1, CURVES).astype(int))]
    curves = tuple(
        curve(table[table["torque_Nm"] == one], "speed_rpm", "sump_temperature_C", f"{one:g} N m", style="o-")
        for one in chosen
    )
    yield Panel("speed of the input (rpm)", "sump temperature (°C)", curves)
    if "thermal_history" in tables:
        over = curve(tables["thermal_history"], "time_h", "sump_temperature_C")
        yield Panel("time (h)", "sump temperature (°C)", (over,))


def caption(name: str) -> str:
    """Caption of a figure, by its name with the oil temperature.

    >>> caption("tooth_pair")
    'Normal and friction force of one tooth pair of each stage over the roll angle of the pinion.'
    >>> caption("loss_torque_40C").rpartition(". ")[2]
    'Oil at 40 °C.'
    """
    known = next(known for known in CAPTIONS if name.startswith(known))
    oil = name.removeprefix(f"{known}_").removesuffix("C") if name != known else ""
    return CAPTIONS[known] + (f" Oil at {oil} °C." if oil else "")


def _at_oils(losses: Losses) -> Iterator[tuple[str, str, Losses]]:
    """Losses at the lowest and the highest oil temperature, with the end of a name and words for a title."""
    if losses.oil is None:
        yield "", "", losses
        return
    for at in sorted({losses.oil.min(), losses.oil.max()}):
        yield f"_{at:g}C", f", oil at {at:g} °C", losses.where(losses.oil == at)


def map_figure(title: str, losses: Losses) -> Figure | None:
    """Loss and gearbox efficiency over torque and speed; None for a single torque or speed."""
    from matplotlib.figure import Figure
    from matplotlib.ticker import MaxNLocator, ScalarFormatter

    torque, speed = np.unique(losses.torque), np.unique(losses.speed) * RPM
    if min(torque.size, speed.size) < LEAST_LEVELS:
        return None
    order = np.lexsort((losses.speed, losses.torque))
    shape = (torque.size, speed.size)
    shown = (
        (losses.total()[order].reshape(shape), "total loss (W)", "viridis_r"),
        (100.0 * losses.efficiency(MESH)[order].reshape(shape), "tooth efficiency (%)", "viridis"),
        (100.0 * losses.efficiency()[order].reshape(shape), "gearbox efficiency (%)", "viridis"),
    )
    figure = Figure(figsize=(WIDTH, 2.7), layout="constrained")
    for axis, (values, label, colours) in zip(figure.subplots(1, 3, sharey=True), shown, strict=True):
        if np.isfinite(values).any():
            low = np.nanpercentile(values, 5)
            clipped = np.maximum(values, low) if "efficiency" in label else values
            drawn = _coloured(axis, speed, torque, clipped, colours)
            ticks: dict[str, Any] = {"ticks": MaxNLocator(3), "format": ScalarFormatter(useOffset=False)}
            figure.colorbar(drawn, ax=axis, label=label, location="top", **ticks)
        axis.set_xlabel("input speed (rpm)")
        axis.grid(visible=False)
    figure.axes[0].set_ylabel("input torque (N m)")
    figure.suptitle(title, fontsize=SMALL, x=0.01, ha="left")
    return figure


def _coloured(axis: Axes, speed: np.ndarray, torque: np.ndarray, values: np.ndarray, colours: str) -> ScalarMappable:
    """Values over speed and torque as coloured areas; as points where no neighbour has a value."""
    there = np.isfinite(values)
    cells = there[:-1, :-1] & there[1:, :-1] & there[:-1, 1:] & there[1:, 1:]
    inside = np.zeros_like(there)
    for rows, columns in product((slice(None, -1), slice(1, None)), repeat=2):
        inside[rows, columns] |= cells
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    least = FLAT * max(abs(low), abs(high))
    flat = high - low < least
    ends = (low - least, high + least) if flat else (low, high)
    drawn: ScalarMappable | None = None
    if cells.any():
        levels = np.linspace(*ends, LEVELS + 1) if flat else LEVELS
        drawn = axis.contourf(speed, torque, np.ma.masked_invalid(values), levels, cmap=colours)
    row, column = np.nonzero(there & ~inside)
    if row.size:
        scale = {"norm": drawn.norm} if drawn is not None else dict(zip(("vmin", "vmax"), ends, strict=True))
        points = axis.scatter(speed[column], torque[row], c=values[row, column], cmap=colours, clip_on=False, **scale)
        drawn = drawn or points
    axis.set_xlim(speed.min(), speed.max())
    axis.set_ylim(torque.min(), torque.max())
    assert drawn is not None
    return drawn


def breakdown_figure(title: str, losses: Losses) -> Figure:
    """Losses by origin, stacked: over torque at the largest speed, and over speed at the largest torque."""
    figure, axes, _ = panels(2, 2, height=2.9, sharex=False, sharey=False)
    torque = strongest(losses.torque.tolist())
    at_speed, at_torque = losses.speed == losses.speed.max(), losses.torque == torque
    _stacked(axes[0], losses, losses.torque, at_speed)
    axes[0].set_xlabel(f"input torque (N m) at {losses.speed.max() * RPM:.4g} rpm")
    _stacked(axes[1], losses, losses.speed * RPM, at_torque)
    axes[1].set_xlabel(f"input speed (rpm) at {torque:.4g} N m")
    axes[0].set_ylabel("loss (W)")
    legend_above(figure, axes[0], f"{title}: losses by origin", columns=7)
    return figure


def _stacked(axis: Axes, losses: Losses, across: np.ndarray, chosen: np.ndarray) -> None:
    order = np.argsort(across[chosen])
    origins = [origin for origin in present(losses) if losses.total(origins=(origin,)).any()]
    stack = [losses.total(origins=(origin,))[chosen][order] for origin in origins]
    place = across[chosen][order]
    if place.size > 1:
        axis.stackplot(place, stack, labels=origins, colors=shades(len(origins)))
        axis.set_xlim(place.min(), place.max())
    else:
        below = np.cumsum([0.0 * place, *stack], axis=0)
        for origin, values, start, colour in zip(origins, stack, below, shades(len(origins)), strict=False):
            axis.bar([f"{place[0]:.4g}"], values, 0.4, start, label=origin, color=colour)
        axis.set_xlim(-1.0, 1.0)
    axis.set_ylim(bottom=0.0)


def _efficiency(table: pd.DataFrame) -> Iterator[Panel]:
    """Tooth efficiency over torque at some speeds, and over speed at some torques; a single level has no panel.

    Of drive; of coast in a map of coast alone.
    """
    drive = table["torque_Nm"] > 0.0
    table = table[drive if drive.any() else table["torque_Nm"] < 0.0]
    torque, speed = ("torque_Nm", "torque (N m)", "N m"), ("speed_rpm", "speed (rpm)", "rpm")
    over = [pair for pair in ((torque, speed), (speed, torque)) if table[pair[0][0]].nunique() > 1]
    for (name, words, _), (other, _, unit) in over or ((torque, speed),):
        lines = [
            curve(
                table[table[other] == level].sort_values(name),
                *(name, "tooth_efficiency_percent", f"{level:.4g} {unit}"),
                style="o-",
                group=group,
            )
            for group, level in enumerate(_some(table[other].to_numpy()))
        ]
        yield Panel(f"input {words}", "tooth efficiency (%)", tuple(lines))


def _loss_torque(table: pd.DataFrame) -> Iterator[Panel]:
    """All losses as a torque of the input over its torque, at some speeds."""
    torque = table["total_loss_W"] * RPM / table["speed_rpm"]
    style = "-" if table["torque_Nm"].nunique() > 1 else "o"
    lost = table.assign(torque_loss_Nm=torque)
    lines = [
        curve(
            rows.sort_values("torque_Nm"), "torque_Nm", "torque_loss_Nm", f"{level:.4g} rpm", group=group, style=style
        )
        for group, level in enumerate(_some(table["speed_rpm"].to_numpy()))
        for rows in (lost[lost["speed_rpm"] == level],)
    ]
    yield Panel("input torque (N m)", "torque loss at the input (N m)", tuple(lines), from_zero=True)


def _over_oil(table: pd.DataFrame) -> Iterator[Panel]:
    """Loss and gearbox efficiency over the oil temperature at the largest speed, at some torques."""
    fastest = table[table["speed_rpm"] == table["speed_rpm"].max()]
    for name, up in (("total_loss_W", "total loss (W)"), ("gearbox_efficiency_percent", "gearbox efficiency (%)")):
        lines = [
            curve(rows, "oil_temperature_C", name, f"{level:.4g} N m", group=group, style="o-")
            for group, level in enumerate(_some(table["torque_Nm"].to_numpy()))
            for rows in (fastest[fastest["torque_Nm"] == level].sort_values("oil_temperature_C"),)
        ]
        yield Panel("oil temperature (°C)", up, tuple(lines))


def _some(values: np.ndarray) -> np.ndarray:
    """Up to `CURVES` levels, evenly spread."""
    levels = np.unique(values)
    return levels[np.unique(np.linspace(0, len(levels) - 1, CURVES).round().astype(int))] if levels.size else levels


def _cycle(cycles: Sequence[MeshCycle]) -> Iterator[Panel]:
    """Losses, tooth efficiency, friction of the mesh and friction force of each stage over one base pitch."""
    drawn: dict[str, list[Curve]] = {}
    for group, one in enumerate(cycles):
        name = f"{one.stage.name}, {one.stage.driving} drives"
        mean = np.full(one.phase.size, 100.0 * one.efficiency.mean())
        rolling = [("loss of the mesh (W)", one.rolling, f"{name}: rolling", "--")] if one.rolling.any() else []
        for up, values, label, style in (
            ("loss of the mesh (W)", one.sliding, f"{name}: sliding", "-"),
            *rolling,
            ("tooth efficiency (%); dotted: mean", 100.0 * one.efficiency, "", "-"),
            ("tooth efficiency (%); dotted: mean", mean, "", ":"),
            ("friction coefficient of the mesh (-)", one.friction, "", "-"),
            ("friction force on the pinion (N)", one.friction_force, "", "-"),
        ):
            drawn.setdefault(up, []).append(Curve(one.phase, values, label, group=group, style=style))
    for up, curves in drawn.items():
        yield Panel("turn of the mesh (base pitches)", up, tuple(curves), from_zero=up.startswith("loss"))


def _tooth(table: pd.DataFrame) -> Iterator[Panel]:
    """Normal and friction force of one tooth pair of each stage over the roll angle of the pinion."""
    stages = list(table.groupby("stage", sort=False))
    for name, up in (
        ("normal_force_N", "normal force of a tooth pair (N)"),
        ("friction_force_N", "friction force (N)"),
    ):
        lines = (curve(rows, "roll_angle_deg", name, str(stage), group=g) for g, (stage, rows) in enumerate(stages))
        yield Panel("roll angle of the pinion (deg)", up, tuple(lines))
