"""Figures of line contacts: pressure, film, temperature and shear through each, and results of all."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mixedlub.schema.result import Curve, Drawing, Panel, curve

if TYPE_CHECKING:
    import pandas as pd

VIEW = (-1.6, 1.3)
"""Drawn part of the contact (half widths)."""
MOST_DRAWN = 24
"""Largest number of contacts with a separate figure; evenly spaced if there are more."""
ALONG = "place along the flow over the half width (-)"


def ehl_figures(contacts: pd.DataFrame, profiles: pd.DataFrame) -> dict[str, Drawing]:
    """A figure per solved contact, up to a number, and one of all contacts."""
    solved = np.flatnonzero(contacts["status"] == "converged")
    picked = np.unique(np.linspace(0, solved.size - 1, min(solved.size, MOST_DRAWN)).round().astype(int))
    drawn: dict[str, Drawing] = {}
    for row in solved[picked]:
        contact = contacts.iloc[row]
        drawn[f"contact_{contact['contact']}"] = _contact(contact, profiles[profiles["contact"] == contact["contact"]])
    if len(contacts) > 1 and len(profiles):
        drawn["contacts"] = _summary(contacts)
    return drawn


def _contact(contact: pd.Series, profile: pd.DataFrame) -> tuple[Panel, ...]:
    """Pressure, film, temperatures and shear stress of a contact, over the position in half widths."""
    profile = profile.assign(place=profile["position_mm"] / contact["half_width_mm"])
    profile = profile[profile["place"].between(*VIEW)]
    place = profile["place"].to_numpy()
    hertz = contact["hertz_pressure_GPa"] * np.sqrt(np.maximum(1.0 - place**2, 0.0))
    pressures = (Curve(place, hertz, "Hertz", style="--", group=1), curve(profile, "place", "pressure_GPa", "film"))
    walls = ("middle of the film", "first wall", "second wall")
    names = (f"{name}_temperature_C" for name in ("film", "first_wall", "second_wall"))
    temperatures = (curve(profile, "place", n, w, group=g) for g, (n, w) in enumerate(zip(names, walls, strict=True)))
    most = 2.5 * float(profile["film_um"][np.abs(place) < 1.0].max())
    return (
        Panel(ALONG, "pressure (GPa)", pressures),
        Panel(ALONG, "film thickness (µm)", (curve(profile, "place", "film_um"),), from_zero=True, ceiling=most),
        Panel(ALONG, "temperature (°C)", tuple(temperatures)),
        Panel(ALONG, "shear stress (MPa)", (curve(profile, "place", "shear_stress_MPa"),)),
    )


def _summary(table: pd.DataFrame) -> tuple[Panel, ...]:
    """Films, friction, pressure and temperatures of all contacts, by position on a path or number."""
    on_path = "position_mm" in table
    place, words = (
        ("position_mm", "position on the path of contact (mm)") if on_path else ("contact", "contact (number)")
    )
    shown = {
        "film thickness (µm)": {"central_film_um": "central", "minimum_film_um": "minimum"},
        "friction coefficient (-)": {"friction_coefficient": ""},
        "Hertz pressure (GPa)": {"hertz_pressure_GPa": ""},
        "largest temperature (°C)": {
            f"largest_{name}_temperature_C": name.replace("_", " ") for name in ("film", "first_wall", "second_wall")
        },
    }
    drawn = []
    for up, names in shown.items():
        lines = (curve(table, place, n, w, style="o-", group=g) for g, (n, w) in enumerate(names.items()))
        drawn.append(Panel(words, up, tuple(lines)))
    return tuple(drawn)
