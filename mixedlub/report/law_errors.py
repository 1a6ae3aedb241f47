"""Maps of the errors of line-contact laws against full solutions."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import LogNorm

from mixedlub.report.style import panels
from mixedlub.solutions.ratios import FILM_RATIOS, TRACTION_RATIOS

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from mixedlub.schema.result import Drawing

FILM_LAWS = ("dowson_toyoda_central", "dowson_higginson_minimum", "moes", "inlet_shear_heating (Gupta)")
FRICTION_LAWS = ("base model, isothermal", "base model and film_heating", "crook", "xu_kahraman")
"""Laws with a map."""
TITLES = {
    "dowson_toyoda_central": "Dowson and Toyoda, central film",
    "dowson_higginson_minimum": "Dowson and Higginson, minimum film",
    "moes": "Moes, flow film",
    "inlet_shear_heating (Gupta)": "Gupta's inlet heating",
    "base model and film_heating": "base model and film heating",
    "crook": "Crook",
    "xu_kahraman": "Xu and Kahraman",
    "film_over_law": "central film, isothermal",
    "thermal_film_over_law": "central film, with heat",
    "flow_film_over_law": "flow film, isothermal",
    "minimum_film_over_law": "minimum film, isothermal",
    "traction_mean_over_peak": "isothermal",
    "thermal_traction_over_peak": "with heat",
}
"""Titles of panels."""
NARROW, WIDE, TRACTION = (0.7, 1.0 / 0.7), (0.25, 4.0), (0.4, 2.5)
"""Ratios at the ends of the colours of films, of friction, and of traction over traction at the largest pressure."""
_TICKS = {
    NARROW: (0.7, 0.8, 0.9, 1.0, 1.1, 1.25, 1.4),
    WIDE: (0.25, 0.5, 0.7, 1.0, 1.4, 2.0, 4.0),
    TRACTION: (0.4, 0.6, 0.8, 1.0, 1.25, 1.6, 2.5),
}
"""Ticks of the colours, by their ends."""


def figures(laws: pd.DataFrame, fitted: pd.DataFrame) -> dict[str, Drawing]:
    """Maps of film and friction laws, and of the fitted ratios, over their conditions."""
    regime = ("moes_load", "Moes' load parameter M (-)"), ("moes_material", "Moes' material parameter L (-)")
    sliding = ("hertz_pressure_GPa", "Hertz pressure (GPa)"), ("slide_roll_ratio", "slide-to-roll ratio (-)")
    titles = "solved film over that of its law (-)", "traction over that at\nlargest pressure (-)"
    drawn = {
        "film_laws": (laws, _there(laws, FILM_LAWS), regime, NARROW, "film by the law over the solved one (-)"),
        "friction_laws": (
            *(laws, _there(laws, FRICTION_LAWS), sliding, WIDE),
            "friction by the law over the solved one (-)",
        ),
        "film_ratios": (fitted, FILM_RATIOS, regime, NARROW, titles[0]),
        "traction_ratios": (fitted, TRACTION_RATIOS, sliding, TRACTION, titles[1]),
    }
    return {name: partial(_maps, *given) for name, given in drawn.items()}


def _there(table: pd.DataFrame, names: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(name for name in names if name in table)


def _maps(
    table: pd.DataFrame,
    names: tuple[str, ...],
    axes_of: tuple[tuple[str, str], tuple[str, str]],
    ends: tuple[float, float],
    label: str,
) -> Figure:
    """A panel per name: a mark per contact, coloured by the ratio."""
    (across, x_label), (up, y_label) = axes_of
    figure, axes, columns = panels(len(names), 2, height=2.4)
    for place, (panel, name) in enumerate(zip(axes, names, strict=True)):
        marks = panel.scatter(
            table[across], table[up], c=table[name], s=5.0, cmap="coolwarm", norm=LogNorm(*ends), linewidths=0.0
        )
        panel.set_title(TITLES.get(name, name))
        _scale(panel, across, up)
        if place + columns >= len(names):
            panel.set_xlabel(x_label)
        if place % columns == 0:
            panel.set_ylabel(y_label)
    bar = figure.colorbar(marks, ax=axes, label=label, extend="both", shrink=0.7)
    bar.set_ticks(_TICKS[ends], labels=[f"{tick:g}" for tick in _TICKS[ends]])
    bar.minorticks_off()
    return figure


def _scale(panel: Axes, across: str, up: str) -> None:
    """Set logarithmic axes except for the material parameter and the pressure."""
    if across == "moes_load":
        panel.set_xscale("log")
    if up == "slide_roll_ratio":
        panel.set_yscale("log")


def law_lines(summary: pd.DataFrame, oil: str) -> list[str]:
    """Table of laws as text, for an oil or for all."""
    lines = [f"{'law over full solution':<44}{'contacts':>9}{'median':>9}{'5 %':>8}{'95 %':>8}"]
    for row in summary[summary["oil"] == oil].to_dict("records"):
        numbers = [row[name] for name in ("median_ratio", "low_ratio_5_percent", "high_ratio_95_percent")]
        middle, low, high = (f"{value:.3g}" if np.isfinite(value) else "-" for value in numbers)
        lines.append(f"{row['law']:<44}{row['contacts']:>9}{middle:>9}{low:>8}{high:>8}")
    return lines


def fit_lines(fits: pd.DataFrame, oil: str) -> list[str]:
    """Table of factors and exponents as text, for an oil or for all."""
    names = [name for name in fits if str(name).endswith("_exponent")]
    heads = "".join(f"{str(name).removesuffix('_exponent'):>16}" for name in names)
    lines = [f"{'full solution over base law':<30}{'rigs':>5}{'factor':>14}{heads}{'left':>8}"]
    for row in fits[fits["oil"] == oil].to_dict("records"):
        exponents = "".join(_with_sd(row[name], row[f"{name}_sd"]) for name in names)
        spread = 100.0 * row["factor_sd_of_log"]
        factor = f"{row['factor']:.3f}" + (f" ±{spread:.1f} %" if np.isfinite(spread) else "")
        lines.append(
            f"{row['ratio']:<30}{row['rigs']:>5}{factor:>14}{exponents}{100.0 * row['left_rms_of_log']:>6.1f} %"
        )
    return lines


def _with_sd(value: float, sd: float) -> str:
    text = f"{value:+.3f}" if np.isfinite(value) else ""
    return f"{text + (f' ±{sd:.3f}' if np.isfinite(sd) else ''):>16}"
