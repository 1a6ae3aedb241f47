"""Correction of a base law per rig: a constant factor times powers of speed and load, fitted to each rig.

The scatter of the corrections over rigs is the uncertainty of the law on a single rig; the residual is not a power law.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
import pandas as pd

from mixedlub.solutions.ratios import ALL, FILM_RATIOS, STRESSES, TRACTION_RATIOS
from mixedlub.solutions.rigs import LEAST_CONTACTS

FLATTENED = 2.0
"""Moes' M above which film laws hold: below, the contact is not flattened."""
COLUMNS = {
    "speed": "speed_parameter",
    "load": "load_parameter",
    "sliding": "slide_roll_ratio",
    "pressure": "hertz_pressure_GPa",
}
"""Variables of the exponents, with their columns."""
TERMS: Mapping[str, tuple[str, ...]] = {
    **dict.fromkeys(FILM_RATIOS, ("speed", "load")),
    **dict.fromkeys(TRACTION_RATIOS, ("speed", "load", "sliding")),
    **dict.fromkeys(STRESSES, ("pressure",)),
}
"""Exponents of each ratio."""
SHEARED = 10.0
"""Newtonian over Eyring stress above which friction varies with the Eyring stress by more than two thirds of a
power."""
_WIDEST = 6.0
"""Bound of the logarithm of the factor on an Eyring stress, and of its exponent."""


def of_rigs(fitted: pd.DataFrame) -> pd.DataFrame:
    """Table with a row per ratio and rig: factor at the rig's centre, exponents, and rms residual of the logarithm."""
    rows = list(_rows(fitted[fitted["moes_load"] >= FLATTENED]))
    return pd.DataFrame(rows) if rows else pd.DataFrame(columns=["ratio", "oil", "rig", "factor"])


def _rows(flattened: pd.DataFrame) -> Iterator[dict[str, object]]:
    for ratio in TERMS:
        for (oil, rig), part in flattened.groupby(["oil", "rig"], sort=False):
            row = fit(part, ratio)
            if row is not None:
                yield {"ratio": ratio, "oil": oil, "rig": rig, **row}


def fit(part: pd.DataFrame, ratio: str) -> dict[str, float] | None:
    """Factor at the centre, exponents, and rms residual; None with too few contacts.

    >>> speed, load = (axis.ravel() for axis in np.meshgrid(np.geomspace(1e-12, 1e-11, 4), np.geomspace(1e-5, 1e-4, 4)))
    >>> ratio = 0.8 * (speed / 10**-11.5) ** 0.02 * (load / 10**-4.5) ** -0.05
    >>> table = pd.DataFrame({"speed_parameter": speed, "load_parameter": load, "film_over_law": ratio})
    >>> {name: round(value, 6) for name, value in fit(table, "film_over_law").items()}
    {'contacts': 16, 'factor': 0.8, 'speed_exponent': 0.02, 'load_exponent': -0.05, 'left_rms_of_log': 0.0}
    """
    terms = TERMS[ratio]
    known = part[part[STRESSES.get(ratio, ratio)] > (SHEARED * part["eyring_stress_Pa"] if ratio in STRESSES else 0.0)]
    if len(known) < LEAST_CONTACTS:
        return None
    logs = [np.log(known[COLUMNS[name]].to_numpy()) for name in terms]
    design = np.column_stack([np.ones(len(known)), *(log - log.mean() for log in logs)])
    found, left = _stress_fit(known, ratio, design) if ratio in STRESSES else _power_fit(known, ratio, design)
    exponents = {f"{name}_exponent": float(value) for name, value in zip(terms, found[1:], strict=True)}
    rms = float(np.sqrt(np.sum(left**2) / (len(known) - len(found))))
    return {"contacts": len(known), "factor": float(np.exp(found[0])), **exponents, "left_rms_of_log": rms}


def _power_fit(known: pd.DataFrame, ratio: str, design: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    wanted = np.log(known[ratio].to_numpy())
    found = np.linalg.lstsq(design, wanted, rcond=None)[0]
    return found, wanted - design @ found


def _stress_fit(known: pd.DataFrame, ratio: str, design: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Factor and exponent of the Eyring stress that fit Ree and Eyring's law to the solved friction."""
    from scipy.optimize import least_squares

    rate, own = known[STRESSES[ratio]].to_numpy(), known["eyring_stress_Pa"].to_numpy()
    wanted = np.log(known["isothermal_stress_Pa"].to_numpy())

    def off(found: np.ndarray) -> np.ndarray:
        stress = own * np.exp(design @ found)
        return np.asarray(wanted - np.log(stress * np.arcsinh(rate / stress)))

    fitted = least_squares(off, np.zeros(design.shape[1]), bounds=(-_WIDEST, _WIDEST))
    return fitted.x, fitted.fun


def summary(rigs: pd.DataFrame, fitted: pd.DataFrame) -> pd.DataFrame:
    """Table by ratio and oil: mean and scatter over rigs of factor and exponents, and residual within a rig.

    ``overall_rms_of_log``: residual of a single factor and set of exponents for all contacts of the row.
    """
    rows = []
    flattened = fitted[fitted["moes_load"] >= FLATTENED]
    for ratio, terms in TERMS.items():
        for oil in (ALL, *fitted["oil"].unique()):
            chosen, part = rigs[rigs["ratio"] == ratio], flattened
            if oil != ALL:
                chosen, part = chosen[chosen["oil"] == oil], part[part["oil"] == oil]
            if not len(chosen):
                continue
            logs = np.log(chosen["factor"])
            row: dict[str, object] = {"ratio": ratio, "oil": oil, "rigs": len(chosen)}
            row |= {"factor": np.exp(logs.mean()), "factor_sd_of_log": logs.std()}
            for name in terms:
                own = chosen[f"{name}_exponent"]
                row |= {f"{name}_exponent": own.mean(), f"{name}_exponent_sd": own.std()}
            row["left_rms_of_log"] = np.sqrt((chosen["left_rms_of_log"] ** 2).mean())
            whole = fit(part, ratio)
            rows.append(row | {"overall_rms_of_log": np.nan if whole is None else whole["left_rms_of_log"]})
    return pd.DataFrame(rows) if rows else pd.DataFrame(columns=["ratio", "oil"])
