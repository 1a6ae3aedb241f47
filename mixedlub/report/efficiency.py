"""Figures of an efficiency: maps, losses by origin, and the mesh cycle."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.efficiency.gearbox import MESH, Losses
from mixedlub.efficiency.table import RPM, present
from mixedlub.report.style import SMALL, WIDTH, legend_above, panels, shades, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from mixedlub.efficiency.mesh_cycle import MeshCycle

LEVELS = 12
CURVES = 5
"""Most curves of a figure of the efficiency."""
LEAST_LEVELS = 2
"""Fewest torques and speeds that a map is drawn of."""


def map_figure(title: str, losses: Losses) -> Figure | None:
    """Loss and gearbox efficiency over torque and speed; None of a single torque or speed."""
    from matplotlib.figure import Figure
    from matplotlib.ticker import MaxNLocator

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
    with styled():
        figure = Figure(figsize=(WIDTH, 2.7), layout="constrained")
        for axis, (values, label, colours) in zip(figure.subplots(1, 3, sharey=True), shown, strict=True):
            if np.isfinite(values).any():
                low = np.nanpercentile(values, 5)
                clipped = np.ma.masked_invalid(np.maximum(values, low)) if "efficiency" in label else values
                drawn = axis.contourf(speed, torque, clipped, LEVELS, cmap=colours)
                figure.colorbar(drawn, ax=axis, label=label, location="top", ticks=MaxNLocator(3))
            axis.set_xlabel("input speed (rpm)")
            axis.grid(visible=False)
        figure.axes[0].set_ylabel("input torque (N m)")
        figure.suptitle(title, fontsize=SMALL, x=0.01, ha="left")
    return figure


def breakdown_figure(title: str, losses: Losses) -> Figure:
    """Losses by origin, stacked: over torque at the largest speed, and over speed at the largest torque."""
    with styled():
        figure, axes, _ = panels(2, 2, height=2.9, sharex=False, sharey=False)
        at_speed, at_torque = losses.speed == losses.speed.max(), losses.torque == losses.torque.max()
        _stacked(axes[0], losses, losses.torque, at_speed)
        axes[0].set_xlabel(f"input torque (N m) at {losses.speed.max() * RPM:.4g} rpm")
        _stacked(axes[1], losses, losses.speed * RPM, at_torque)
        axes[1].set_xlabel(f"input speed (rpm) at {losses.torque.max():.4g} N m")
        axes[0].set_ylabel("loss (W)")
        legend_above(figure, axes[0], f"{title}: losses by origin", columns=7)
    return figure


def _stacked(axis: Axes, losses: Losses, across: np.ndarray, chosen: np.ndarray) -> None:
    order = np.argsort(across[chosen])
    origins = [origin for origin in present(losses) if losses.total(origins=(origin,)).any()]
    stack = [losses.total(origins=(origin,))[chosen][order] for origin in origins]
    place = across[chosen][order]
    if place.size == 1:
        place, stack = np.array([0.0, 1.0]) * place, [np.repeat(values, 2) for values in stack]
    axis.stackplot(place, stack, labels=origins, colors=shades(len(origins)))
    axis.set_ylim(bottom=0.0)
    axis.set_xlim(place.min(), place.max())


def efficiency_figure(title: str, losses: Losses) -> Figure:
    """Tooth efficiency over torque at some speeds, and over speed at some torques."""
    torque, speed = losses.torque, losses.speed * RPM
    axes_of = ((torque, speed, "input torque (N m)", "rpm"), (speed, torque, "input speed (rpm)", "N m"))
    with styled():
        figure, axes, _ = panels(2, 2, height=2.9, sharex=False, sharey=True)
        for axis, (across, other, words, unit) in zip(axes, axes_of, strict=True):
            levels = _some(other[torque > 0.0])
            for level, colour in zip(levels, shades(len(levels)), strict=True):
                rows = (other == level) & (torque > 0.0)
                order = np.argsort(across[rows])
                value = 100.0 * losses.efficiency(MESH)[rows][order]
                axis.plot(across[rows][order], value, "o-", color=colour, markersize=3.0, label=f"{level:.4g} {unit}")
            axis.set_xlabel(words)
            axis.legend(fontsize=SMALL)
        axes[0].set_ylabel("tooth efficiency (%)")
        figure.suptitle(title, fontsize=SMALL, x=0.01, ha="left")
    return figure


def _some(values: np.ndarray) -> np.ndarray:
    """Up to `CURVES` levels, evenly spread."""
    levels = np.unique(values)
    return levels[np.unique(np.linspace(0, len(levels) - 1, CURVES).round().astype(int))] if levels.size else levels


def cycle_figure(title: str, cycles: Sequence[MeshCycle]) -> Figure:
    """Losses, tooth efficiency, friction of the mesh and friction force of each stage over one base pitch."""
    with styled():
        figure, axes, _ = panels(4, 2, height=2.6, sharey=False)
        for one, colour in zip(cycles, shades(len(cycles)), strict=True):
            name = f"{one.stage.name}, {one.stage.driving} drives"
            axes[0].plot(one.phase, one.sliding, color=colour, label=f"{name}: sliding")
            if one.rolling.any():
                axes[0].plot(one.phase, one.rolling, color=colour, linestyle="--", label=f"{name}: rolling")
            axes[1].plot(one.phase, 100.0 * one.efficiency, color=colour)
            axes[1].axhline(100.0 * one.efficiency.mean(), color=colour, linestyle=":", linewidth=0.9)
            axes[2].plot(one.phase, one.friction, color=colour)
            axes[3].plot(one.phase, one.friction_force, color=colour)
        axes[2].set_ylabel("friction coefficient of the mesh (-)")
        axes[3].set_ylabel("friction force on the pinion (N)")
        axes[0].set_ylabel("loss of the mesh (W)")
        axes[0].set_ylim(bottom=0.0)
        axes[1].set_ylabel("tooth efficiency (%); dotted: mean")
        for axis in axes:
            axis.set_xlabel("turn of the mesh (base pitches)")
        legend_above(figure, axes[0], title, columns=4)
    return figure


def tooth_figure(title: str, cycles: Sequence[MeshCycle]) -> Figure:
    """Normal and friction force of one tooth pair of each stage over the roll angle of the pinion."""
    with styled():
        figure, axes, _ = panels(2, 2, height=2.6, sharey=False)
        for one, colour in zip(cycles, shades(len(cycles)), strict=True):
            angle = np.degrees(one.pair.roll_angle)
            axes[0].plot(angle, one.pair.normal_force, color=colour, label=one.stage.name)
            axes[1].plot(angle, one.pair.friction_force, color=colour)
        axes[0].set_ylabel("normal force of a tooth pair (N)")
        axes[1].set_ylabel("friction force on the pinion (N)")
        for axis in axes:
            axis.set_xlabel("roll angle of the pinion (deg)")
        legend_above(figure, axes[0], title, columns=4)
    return figure
