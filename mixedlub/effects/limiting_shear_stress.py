"""Limiting shear stress."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, LogUniform, Uniform

FORTY_CELSIUS = 313.15
"""Reference oil temperature of the coefficient, 40 degC."""


@effect(
    stage="shear",
    acts_on="shear_stress",
    parameters=(
        Parameter(
            "coefficient",
            "-",
            LogUniform(0.015, 0.12),
            "limiting shear stress over pressure at 40 degC, Lambda",
            null=np.inf,
            symbol=r"\Lambda",
        ),
        Parameter("sharpness", "-", LogNormal(2.5, 0.7), "sharpness of the transition to the limit", symbol="n"),
        Parameter(
            "fall", "1/K", Uniform(0.0, 0.006), "relative fall of the limit per kelvin of oil temperature", symbol="b"
        ),
    ),
    equation=r"\tau \leftarrow \tau\left[1 + \left(\frac{\tau}{\Lambda p_0\,"
    r"e^{-b(\theta_{oil} - 40\,^\circ\text{C})}}\right)^{n}\right]^{-1/n}",
    source="S. Bair, W. O. Winer, J. Lubr. Technol. 101 (1979) 258, tau_L = Lambda p; joined smoothly to the "
    "film's law; falling with temperature as in L. Houpert, L. Flamand, D. Berthe, J. Lubr. Technol. 103 (1981) 526",
    special_cases={"Bair and Winer": {"fall": 0.0}},
    fingerprint={"load": "-", "speed": "-", "oil_temperature": "+", "roughness": "+", "slide_roll_ratio": "-"},
    separated_by="smooth surfaces, cold oil, high load: friction then stays at one level whatever the sliding and "
    "rolling speed, and the level moves with pressure only",
    applied_after=("film_heating", "coating_insulation", "contact_creep"),
)
def limiting_shear_stress(
    shear_stress: np.ndarray,
    hertz_pressure: np.ndarray,
    oil_temperature: np.ndarray,
    *,
    coefficient: float,
    sharpness: float,
    fall: float,
) -> np.ndarray:
    """The shear stress of the film cannot exceed a fixed share of its pressure.

    Lambda is 0.03 to 0.09 in the literature (naphthenic 0.053, paraffinic 0.047, PAO 0.035, polyglycol 0.044).

    Measured values fall by up to 0.5 % per kelvin.

    >>> law = dict(coefficient=0.05, sharpness=4.0, fall=0.0)
    >>> (limiting_shear_stress(np.array([200e6, 20e6]), 1e9, 313.15, **law) / 1e6).round(1).tolist()
    [50.0, 19.9]
    """
    limit = coefficient * hertz_pressure * np.exp(-fall * (oil_temperature - FORTY_CELSIUS))
    return shear_stress * (1.0 + (shear_stress / limit) ** sharpness) ** (-1.0 / sharpness)
