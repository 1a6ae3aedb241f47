"""Comparison of friction laws: along the path of contact, over the slide-to-roll ratio, and for the mesh."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.chain.friction_law import PLACES
from mixedlub.friction import BASE, catalogue
from mixedlub.report.plots import some
from mixedlub.report.style import SMALL, WIDTH, legend_above, panels, shades
from mixedlub.study.friction_comparison import DIVERGES, OUTSIDE, VALID, Comparison

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from mixedlub.schema.result import Drawing

COLOURS = {"contact": "#1f5fa8", "mesh": "#b3541e"}
GREY, REFERENCE = "0.72", "0.45"
MOST_PAIRINGS = 6
ROW_HEIGHT = 0.22
"""Height of the row of a law (inches)."""


def figures(
    comparison: Comparison, path: pd.DataFrame, ratio: pd.DataFrame, mesh: pd.DataFrame
) -> tuple[dict[str, Drawing], dict[str, str]]:
    """The three figures of a comparison and their captions; the mesh is drawn at its condition."""
    at = _condition(comparison)
    grey = "Grey: outside the range of the source. Dotted: the base model. Friction that diverges is not drawn."
    drawn: dict[str, Drawing] = {
        "friction_along_path": partial(_small_multiples, path, "roll_angle_deg", "pinion roll angle (°)"),
        "friction_over_ratio": partial(_small_multiples, ratio, "slide_roll_ratio", "slide-to-roll ratio (-)"),
    }
    captions = {
        "friction_along_path": f"Friction coefficient along the path of contact, {at}. {grey}",
        "friction_over_ratio": "Friction coefficient over the slide-to-roll ratio in the contact of the pitch point, "
        f"{at}. {grey}",
    }
    if len(mesh):
        drawn["friction_of_mesh"] = partial(_of_mesh, mesh)
        captions["friction_of_mesh"] = (
            f"Mean friction of the mesh by law and pairing, {at.partition(', ')[2]}. Grey and hollow: outside the "
            "range of the source at a point of the path."
        )
    return drawn, captions


def _condition(comparison: Comparison) -> str:
    study = comparison.study
    levels, (a, b) = study.file.conditions, study.pairings[0]
    torque, speed, oil = levels.torque_Nm[0], levels.speed_rpm[0], levels.oil_temperature_C[0]
    return f"{a} / {b}, {torque:g} N m, {speed:g} rpm, oil at {oil:g} °C"


def _small_multiples(table: pd.DataFrame, place: str, label: str) -> Figure:
    """A panel per law with equal axes: coloured inside the range of the law, grey outside, the base model dotted."""
    names = list(dict.fromkeys(table["law"]))
    figure, axes, columns = panels(len(names), 4, height=1.45)
    base = table[table["law"] == BASE]
    top = _top(table)
    for index, (name, panel) in enumerate(zip(names, axes, strict=True)):
        rows = table[table["law"] == name]
        panel.plot(base[place], base["friction"], color=REFERENCE, linestyle=":", linewidth=0.9)
        _law(panel, rows, place, COLOURS[catalogue()[name].place])
        panel.set_title(catalogue()[name].title, fontsize=SMALL)
        panel.set_ylim(0.0, top)
        panel.set_xlim(rows[place].min(), rows[place].max())
        if index % columns == 0:
            panel.set_ylabel("friction (-)")
    figure.supxlabel(label, fontsize=8.5)
    words = "; ".join(f"{'blue' if p == 'contact' else 'brown'}: {text}" for p, text in PLACES.items())
    figure.suptitle(f"{words}; grey: outside its range; dotted: base model", fontsize=SMALL, x=0.01, ha="left")
    return figure


def _top(table: pd.DataFrame) -> float:
    """Upper end of the axis, unaffected by divergence."""
    whole = table[table["validity"] != DIVERGES]["friction"]
    return 1.1 * float(whole.groupby(table["law"]).quantile(0.9).max())


def _law(panel: Axes, rows: pd.DataFrame, place: str, colour: str) -> None:
    x, y, judged = rows[place].to_numpy(), rows["friction"].to_numpy(), rows["validity"].to_numpy()
    drawn = np.where(judged == DIVERGES, np.nan, y)
    panel.plot(x, np.where(judged == OUTSIDE, drawn, np.nan), color=GREY, linewidth=1.6)
    panel.plot(x, np.where(judged == VALID, drawn, np.nan), color=colour)


def _of_mesh(mesh: pd.DataFrame) -> Figure:
    """A row per law, a mark per pairing; hollow outside the range of the law."""
    from matplotlib.figure import Figure as Canvas

    names = list(dict.fromkeys(mesh["law"]))
    every = list(dict.fromkeys(zip(mesh["pinion_surface"], mesh["gear_surface"], strict=True)))
    pairs = [every[i] for i in some(len(every), MOST_PAIRINGS)]
    figure = Canvas(figsize=(WIDTH, 1.1 + ROW_HEIGHT * len(names)), layout="constrained")
    panel = figure.subplots()
    places = np.arange(len(names))
    for (pinion, gear), colour in zip(pairs, shades(len(pairs)), strict=True):
        rows = mesh[(mesh["pinion_surface"] == pinion) & (mesh["gear_surface"] == gear)].set_index("law").loc[names]
        inside = np.array([f"law_extrapolated:{name}" not in rows.loc[name, "validity"] for name in names])
        friction = rows["mean_friction"].to_numpy()
        panel.scatter(friction[inside], places[inside], 22, color=[colour], label=f"{pinion} / {gear}", zorder=3)
        panel.scatter(friction[~inside], places[~inside], 22, facecolor="white", edgecolor=GREY, zorder=2)
    panel.set_yticks(places, [catalogue()[name].title for name in names])
    panel.invert_yaxis()
    panel.set_xlim(left=0.0)
    panel.set_xlabel("mean friction of the mesh (-)")
    legend_above(figure, panel, "pinion / gear", columns=MOST_PAIRINGS)
    return figure
