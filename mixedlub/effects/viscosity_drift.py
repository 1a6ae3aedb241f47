"""Oil or a sample that changes during the test."""

import numpy as np

from mixedlub.effect import Between, LogNormal, Normal, Parameter, Wide, effect

WARM = 313.15
KELVIN = 100.0
MOST = 30.0
"""Logarithm of a viscosity's change beyond which no oil is one."""


@effect(
    stage="property",
    acts_on="viscosity",
    parameters=(
        Parameter(
            "drift",
            "-",
            Normal(0.0, 0.2),
            "log change of viscosity over the programme at 40 degC",
            null=0.0,
            symbol="d",
        ),
        Parameter("power", "-", LogNormal(1.0, 0.4), "1: steady, above: it gathers pace", symbol="m"),
        Parameter("cold_gain", "-", Wide(0.7), "log growth of the drift over 100 K of cooling", symbol="k"),
        Parameter("heat", "-", Between(0.0, 1.0), "0: it goes with time, 1: with time and heat", symbol="a"),
    ),
    equation=r"\eta_0 \leftarrow \eta_0\,"
    r"e^{d\,[(1 - a)q + a q_h]^m e^{k(40\,^\circ\text{C} - \theta_{oil})/100\,\text{K}}}",
    source="evaporation, oxidation or shear-down as a steady relative rate; e.g. ASTM D445 on used oils reports it so",
    fingerprint={"sequence": "-"},
    separated_by="the first point repeated at the end, and a fresh sample under a solvent trap: what the trap stops is "
    "evaporation, what a fresh sample repeats is chemistry or the edge of the gap",
)
def viscosity_drift(
    viscosity: np.ndarray,
    sequence: np.ndarray,
    ageing: np.ndarray,
    oil_temperature: np.ndarray,
    *,
    drift: float,
    power: float,
    cold_gain: float,
    heat: float,
) -> np.ndarray:
    """The sample changes with its history; these readings cannot say whether by evaporation, chemistry or wear.

    No law of temperature and pressure can show it. What a lost light fraction or a new phase adds is felt most in
    the cold, hence ``cold_gain``. Oxidation goes on twice as fast every 10 K, evaporation faster in heat too.

    >>> place = np.array([0.0, 1.0])
    >>> viscosity_drift(0.04, place, place, 313.15, drift=0.2, power=1.0, cold_gain=1.0, heat=0.5).round(4).tolist()
    [0.04, 0.0489]
    """
    grown = drift * np.maximum((1.0 - heat) * sequence + heat * ageing, 0.0) ** power
    return viscosity * np.exp(np.clip(grown * np.exp(cold_gain * (WARM - oil_temperature) / KELVIN), -MOST, MOST))
