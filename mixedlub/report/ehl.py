"""Figures of line contacts: pressure, film, temperature and shear through each, and results of all of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mixedlub.report.style import SMALL, panels, styled

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

VIEW = (-1.6, 1.3)
"""Part of the contact that is drawn (half widths)."""
MOST_DRAWN = 24
"""Most contacts that have a figure of their own; of more, evenly spaced ones."""


def drawn(table: pd.DataFrame) -> list[int]:
    """Numbers of the contacts that have a figure: all with a solution, or evenly spaced ones of many."""
    solved = table.loc[table["status"] == "converged", "contact"].to_list()
    picked = np.unique(np.linspace(0, len(solved) - 1, min(len(solved), MOST_DRAWN)).round().astype(int))
    return [solved[place] for place in picked] if solved else []


def contact_figure(title: str, contact: pd.Series, profile: pd.DataFrame) -> Figure:
    """Pressure, film, temperatures and shear stress of one contact, against the place in half widths."""
    place = profile["position_mm"].to_numpy() / contact["half_width_mm"]
    seen = (place >= VIEW[0]) & (place <= VIEW[1])
    with styled():
        figure, axes, _ = panels(4, 2, sharey=False)
        pressure, film, temperature, shear = axes
        hertz = contact["hertz_pressure_GPa"] * np.sqrt(np.maximum(1.0 - place**2, 0.0))
        pressure.plot(place[seen], hertz[seen], color="0.6", ls="--", label="Hertz")
        pressure.plot(place[seen], profile["pressure_GPa"][seen], color="C0", label="film")
        _finish(pressure, "pressure (GPa)", legend=True)
        film.plot(place[seen], profile["film_um"][seen], color="C0")
        inner = profile["film_um"][np.abs(place) < 1.0]
        film.set_ylim(0.0, 2.5 * float(inner.max()))
        _finish(film, "film thickness (µm)")
        for name, label in (
            ("film", "middle of the film"),
            ("first_wall", "first wall"),
            ("second_wall", "second wall"),
        ):
            temperature.plot(place[seen], profile[f"{name}_temperature_C"][seen], label=label)
        _finish(temperature, "temperature (°C)", legend=True)
        shear.plot(place[seen], profile["shear_stress_MPa"][seen], color="C0")
        _finish(shear, "shear stress (MPa)")
        for axis in axes:
            axis.set_xlabel("place along the flow over the half width (-)")
        figure.suptitle(f"{title}: contact {contact['contact']}, {_conditions(contact)}", fontsize=SMALL)
    return figure


def summary_figure(title: str, table: pd.DataFrame) -> Figure:
    """Films, friction and temperatures of all contacts, by their place on a path or their number."""
    on_path = "position_mm" in table
    place = table["position_mm"] if on_path else table["contact"]
    with styled():
        figure, axes, _ = panels(4, 2, sharey=False)
        for name in ("central_film_um", "minimum_film_um"):
            axes[0].plot(place, table[name], marker="o", label=name.partition("_film")[0])
        _finish(axes[0], "film thickness (µm)", legend=True)
        axes[1].plot(place, table["friction_coefficient"], marker="o")
        _finish(axes[1], "friction coefficient (-)")
        axes[2].plot(place, table["hertz_pressure_GPa"], marker="o")
        _finish(axes[2], "Hertz pressure (GPa)")
        for name in ("film", "first_wall", "second_wall"):
            axes[3].plot(place, table[f"largest_{name}_temperature_C"], marker="o", label=name.replace("_", " "))
        _finish(axes[3], "largest temperature (°C)", legend=True)
        for axis in axes:
            axis.set_xlabel("position on the path of contact (mm)" if on_path else "contact (number)")
        figure.suptitle(title, fontsize=SMALL)
    return figure


def _finish(axes: Axes, label: str, *, legend: bool = False) -> None:
    axes.set_ylabel(label)
    if legend:
        axes.legend()


def _conditions(contact: pd.Series) -> str:
    return (
        f"{contact['line_load_N_mm']:.4g} N/mm, {contact['entrainment_speed_m_s']:.3g} m/s, "
        f"slide-roll ratio {contact['slide_roll_ratio']:.3g}, oil at {contact['oil_temperature_C']:.3g} °C"
    )
