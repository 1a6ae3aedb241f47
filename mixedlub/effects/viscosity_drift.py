"""Oil or a sample that changes during the test."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import Normal, SinhNormal, Uniform

FORTY_CELSIUS = 313.15
HUNDRED_KELVIN = 100.0
LINEAR_BELOW = 1e-9
"""Saturation that is treated as zero."""
LARGEST_LOG = 30.0
"""Largest logarithmic change of a viscosity, or of a rate, that is computed."""


@effect(
    stage="property",
    acts_on="viscosity",
    parameters=(
        Parameter(
            "drift",
            "-",
            Normal(0.0, 0.2),
            "change of ln viscosity over the programme at 40 degC",
            null=0.0,
            symbol="d",
        ),
        Parameter(
            "saturation",
            "-",
            Normal(0.0, 2.5),
            "fall of the logarithm of the rate over the programme: 0 constant, negative for a rising rate",
            symbol="s",
        ),
        Parameter(
            "cold_gain", "-", SinhNormal(0.7), "increase of the logarithm of the drift per 100 K of cooling", symbol="k"
        ),
        Parameter(
            "heat",
            "-",
            Uniform(0.0, 1.0),
            "weight of temperature: 0 the drift follows time, 1 time and temperature",
            symbol="a",
        ),
    ),
    equation=r"\eta_0 \leftarrow \eta_0\,"
    r"e^{d\,c\,e^{k(40\,^\circ\text{C} - \theta_{oil})/100\,\text{K}}},\quad "
    r"c = \frac{1 - e^{-s x}}{1 - e^{-s}},\quad x = (1 - a)q + a q_h",
    source="a change of first order, as evaporation of a light fraction or a reaction whose reactant is used up "
    "(s > 0), or one that feeds itself, as oxidation once the antioxidant is gone (s < 0); measured by ASTM D445",
    fingerprint={"sequence": "-"},
    separated_by="the first point repeated at the end, and a fresh sample under a solvent trap: what the trap stops is "
    "evaporation, what a fresh sample repeats is chemistry or the edge of the gap",
    special_cases={"a steady relative rate": {"saturation": 0.0, "cold_gain": 0.0, "heat": 0.0}},
)
def viscosity_drift(
    viscosity: np.ndarray,
    sequence: np.ndarray,
    ageing: np.ndarray,
    oil_temperature: np.ndarray,
    *,
    drift: float,
    saturation: float,
    cold_gain: float,
    heat: float,
) -> np.ndarray:
    """The sample changes during the programme, by evaporation, oxidation or wear, which are not distinguished here.

    No law of temperature and pressure describes it. A lost light fraction or a new phase raises viscosity most in the
    cold, hence ``cold_gain``. The rate of oxidation doubles every 10 K; evaporation accelerates with temperature too.

    Progress ends at one, so that ``drift`` is the final change at any rate.

    >>> place, rest = np.array([0.0, 0.5, 1.0]), dict(drift=0.2, cold_gain=1.0, heat=0.5)
    >>> viscosity_drift(0.04, place, place, 313.15, saturation=0.0, **rest).round(4).tolist()
    [0.04, 0.0442, 0.0489]
    >>> early = np.log(4.0)   # half-life is half the programme: two thirds of the change are done by then
    >>> viscosity_drift(0.04, place, place, 313.15, saturation=early, **rest).round(4).tolist()
    [0.04, 0.0457, 0.0489]
    """
    done = np.maximum((1.0 - heat) * sequence + heat * ageing, 0.0)
    grown = drift * _course(done, saturation)
    return viscosity * np.exp(
        np.clip(
            grown * np.exp(cold_gain * (FORTY_CELSIUS - oil_temperature) / HUNDRED_KELVIN), -LARGEST_LOG, LARGEST_LOG
        )
    )


def _course(done: np.ndarray, saturation: float) -> np.ndarray:
    """Progress from 0 to 1 with the elapsed share, continued beyond 1, at a rate that falls or rises exponentially."""
    if abs(saturation) < LINEAR_BELOW:
        return done
    rate = float(np.clip(saturation, -LARGEST_LOG, LARGEST_LOG))
    return np.expm1(-rate * done) / np.expm1(-rate)
