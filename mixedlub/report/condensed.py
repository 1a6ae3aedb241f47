"""Figures of a condensed friction law: residuals, and deviation from the published law."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.friction.condensed import INPUTS
from mixedlub.report.style import panels, shades

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from mixedlub.schema.result import Drawing
    from mixedlub.solutions.regression import Regression


def figures(found: Regression, against: pd.DataFrame) -> dict[str, Drawing]:
    """Residual plots, and friction by both laws over sliding."""
    return {"residuals": partial(_residuals, found.table), "against_published": partial(_against, against)}


def _residuals(table: pd.DataFrame) -> Figure:
    """Fitted over solved friction, residuals over fitted friction and every input, and their histogram."""
    left = table["residual_of_log"]
    figure, axes, _ = panels(3 + len(INPUTS), 2, sharex=False, sharey=False)
    for out, label in ((False, "fitted to"), (True, "left out")):
        part = table[table["left_out"] == out]
        axes[0].plot(part["friction"], part["fitted"], ".", ms=2.5, label=label)
        axes[1].plot(part["fitted"], part["residual_of_log"], ".", ms=2.5)
        for axis, one in zip(axes[3:], INPUTS, strict=True):
            axis.plot(part[one.column], part["residual_of_log"], ".", ms=2.5)
            axis.set_xlabel(f"{one.name.replace('_', ' ').replace('hertz', 'Hertz')} ({one.written})")
    ends = [float(table["friction"].min()), float(table["friction"].max())]
    axes[0].plot(ends, ends, color="0.5", lw=0.8)
    axes[0].set(
        xscale="log",
        yscale="log",
        xlabel="solved friction coefficient (-)",
        ylabel="fitted friction coefficient (-)",
    )
    axes[0].legend()
    axes[1].set(xscale="log", xlabel="fitted friction coefficient (-)")
    axes[2].hist(left / left.std(), bins=30, color="C0")
    axes[2].set(xlabel="residual over its standard deviation (-)", ylabel="solutions (number)")
    for axis in (axes[1], *axes[3:]):
        axis.set_ylabel("residual of ln µ (-)")
    for axis in axes[4:]:
        axis.set_xscale("log")
        axis.xaxis.set_major_formatter("{x:g}")
        axis.xaxis.set_minor_formatter("")
    return figure


def _against(table: pd.DataFrame) -> Figure:
    """Friction over sliding by both laws, at the middle viscosity: a panel per pressure, a colour per speed."""
    middle = _middle(table["viscosity_mPa_s"])
    table = table[table["viscosity_mPa_s"] == middle]
    pressures, speeds = np.unique(table["hertz_pressure_GPa"])[1:], np.unique(table["entrainment_speed_m_s"])[::2]
    figure, axes, _ = panels(len(pressures), 2)
    for axis, pressure in zip(axes, pressures, strict=True):
        _curves(axis, table[table["hertz_pressure_GPa"] == pressure], speeds)
        axis.set(xscale="log", title=f"{pressure:.2g} GPa, {middle:.3g} mPa s")
        axis.set_xlabel("slide-to-roll ratio (-)")
        axis.set_ylabel("friction coefficient (-)")
    axes[0].plot([], [], color="0.4", ls="--", label="published, each speed")
    axes[0].legend()
    return figure


def _curves(axis: Axes, table: pd.DataFrame, speeds: np.ndarray) -> None:
    for speed, colour in zip(speeds, shades(len(speeds)), strict=True):
        part = table[table["entrainment_speed_m_s"] == speed]
        axis.plot(part["slide_roll_ratio"], part["condensed_friction"], color=colour, label=f"{speed:.3g} m/s")
        axis.plot(part["slide_roll_ratio"], part["published_friction"], color=colour, ls="--")


def _middle(values: pd.Series) -> float:
    levels = np.unique(values)
    return float(levels[len(levels) // 2])
