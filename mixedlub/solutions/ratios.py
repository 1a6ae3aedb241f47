"""Ratios of laws to full solutions by contact, and their spread by law and oil."""

from __future__ import annotations

import numpy as np
import pandas as pd

from mixedlub.ehl.oil.oil import Oil
from mixedlub.laws.film import dowson_higginson
from mixedlub.solutions.kept import CONDITIONS, WAYS, columns, contacts_of
from mixedlub.solutions.laws import State, compared, state_of

FILM_RATIOS = ("film_over_law", "thermal_film_over_law", "flow_film_over_law", "minimum_film_over_law")
TRACTION_RATIOS = ("traction_mean_over_peak", "thermal_traction_over_peak")
STRESSES = {"eyring_stress": "solved_rate_Pa", "eyring_stress_of_base_model": "base_rate_Pa"}
"""Fitted Eyring stresses, each with its Newtonian stress: from the viscosity of the oil's law and the solved film, or
from viscosity and film of the base model."""
ALL = "all"
"""Name of all oils together."""
_STEPS = 60
"""Bisection steps for a stress."""


def by_contact(table: pd.DataFrame, of: dict[str, Oil]) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Conditions with the ratio of every law to the solution, and with the fitted ratios; NaN without a solution."""
    parts = [_one_oil(table[table["oil"] == name], oil) for name, oil in of.items()]
    laws, fitted = ([part[place] for part in parts] for place in (0, 1))
    return pd.concat(laws, ignore_index=True), pd.concat(fitted, ignore_index=True)


def _one_oil(table: pd.DataFrame, oil: Oil) -> tuple[pd.DataFrame, pd.DataFrame]:
    found = contacts_of(table)
    state = state_of(oil, found)
    solved = {name: table[name].to_numpy() for name in columns() if name.startswith(WAYS)}
    load, material = found.moes(state["viscosity"], state["pressure_viscosity"])
    known = table[["oil", "rig", *CONDITIONS]].reset_index(drop=True)
    known["hertz_pressure_GPa"] = found.pressure * 1e-9
    known["moes_load"], known["moes_material"] = load, material
    laws = {one.name: one.value(state, solved) / solved[one.against] for one in compared()}
    size = state["reduced_modulus"] * state["radius"]
    known["speed_parameter"] = state["viscosity"] * state["entrainment_speed"] / size
    known["load_parameter"] = state["line_load"] / size
    return known.assign(**laws), known.assign(**_fitted(oil, state, solved))


def _fitted(oil: Oil, state: State, solved: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Full solutions over base laws, and traction of the contact over the traction at the largest pressure."""
    law = 1e9 * state["film_thickness"]
    names = ("radius", "entrainment_speed", "line_load", "viscosity", "pressure_viscosity", "reduced_modulus")
    least = 1e9 * dowson_higginson(*(state[name] for name in names))
    film = 1e-9 * solved["isothermal_central_film_nm"]
    rate = state["own_viscosity"] * state["sliding_speed"] / film
    base_rate = state["contact_viscosity"] * state["sliding_speed"] / state["film_thickness"]
    peak = stress_of(oil, rate, state["hertz_pressure"], state["oil_temperature"]) / state["hertz_pressure"]
    return {
        "film_over_law": solved["isothermal_central_film_nm"] / law,
        "thermal_film_over_law": solved["thermal_central_film_nm"] / law,
        "flow_film_over_law": solved["isothermal_flow_film_nm"] / law,
        "minimum_film_over_law": solved["isothermal_minimum_film_nm"] / least,
        "traction_mean_over_peak": solved["isothermal_friction"] / peak,
        "thermal_traction_over_peak": solved["thermal_friction"] / peak,
        "isothermal_stress_Pa": solved["isothermal_friction"] * state["hertz_pressure"],
        "eyring_stress_Pa": state["eyring_stress"],
        "solved_rate_Pa": np.where(np.isfinite(film), rate, np.nan),
        "base_rate_Pa": np.where(np.isfinite(film), base_rate, np.nan),
    }


def stress_of(oil: Oil, rate: np.ndarray, pressure: np.ndarray, temperature: np.ndarray) -> np.ndarray:
    """Shear stress (Pa) of an oil at viscosity times shear rate ``rate`` (Pa), by bisection.

    >>> from mixedlub.ehl import example_oil
    >>> round(float(stress_of(example_oil(), *np.array([[228.5e6], [1e9], [333.15]]))[0]) / 1e6, 2)   # asinh of 45.7
    22.58
    """
    low, high = np.zeros_like(rate), np.minimum(rate, oil.stress_limit(pressure))
    for _ in range(_STEPS):
        middle = 0.5 * (low + high)
        above = oil.sheared(middle, pressure, temperature)[0] > rate
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    return 0.5 * (low + high)


def summary(laws: pd.DataFrame) -> pd.DataFrame:
    """Table by law and oil: contacts; median, 5 and 95 % points, mean absolute logarithm of law over solution.

    Contacts with a zero, negative or missing value have no logarithm and are counted separately.
    """
    rows = []
    for name in (one.name for one in compared()):
        for oil in (ALL, *laws["oil"].unique()):
            ratio = laws.loc[laws["oil"] == oil, name] if oil != ALL else laws[name]
            known = ratio.dropna()
            positive = known[known > 0.0]
            low, middle, high = positive.quantile([0.05, 0.5, 0.95])
            rows.append(
                {
                    "law": name,
                    "oil": oil,
                    "contacts": len(known),
                    "not_positive": len(known) - len(positive),
                    "median_ratio": middle,
                    "low_ratio_5_percent": low,
                    "high_ratio_95_percent": high,
                    "mean_size_of_log": np.log(positive).abs().mean(),
                }
            )
    return pd.DataFrame(rows)
