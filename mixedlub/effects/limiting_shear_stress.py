"""Limiting shear stress."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, LogUniform, Uniform

FORTY_CELSIUS = 313.15
"""Reference oil temperature of the coefficient, 40 degC."""
REFERENCE_PRESSURE = 1e9
"""Hertz pressure (Pa) at which the coefficient is stated."""


@effect(
    stage="shear",
    acts_on="shear_stress",
    parameters=(
        Parameter(
            "coefficient",
            "-",
            LogUniform(0.015, 0.12),
            "limiting shear stress over pressure at 40 degC and 1 GPa, Lambda",
            null=np.inf,
            symbol=r"\Lambda",
        ),
        Parameter("sharpness", "-", LogNormal(2.5, 0.7), "sharpness of the transition to the limit", symbol="n"),
        Parameter(
            "fall", "1/K", Uniform(0.0, 0.006), "relative fall of the limit per kelvin of oil temperature", symbol="b"
        ),
        Parameter(
            "offset",
            "-",
            Uniform(0.0, 0.5),
            "share of the limit at 1 GPa that does not grow with pressure",
            symbol="a",
            nominal=0.0,
        ),
    ),
    equation=r"\tau \leftarrow \tau\left[1 + \left(\frac{\tau}{\tau_L}\right)^{n}\right]^{-1/n},\quad "
    r"\tau_L = \Lambda\,[(1 - a)\,p_0 + a\,p_u]\,e^{-b(\theta_{oil} - 40\,^\circ\text{C})},\ p_u = 1\,\text{GPa}",
    source="S. Bair, W. O. Winer, J. Lubr. Technol. 101 (1979) 258, tau_L = Lambda p (a = 0); "
    "tau_L = tau_0 + gamma p as K. L. Johnson, J. L. Tevaarwerk, Proc. R. Soc. A 356 (1977) 215, and V. Wikstroem, "
    "E. Hoeglund, J. Tribol. 116 (1994) 612; joined smoothly to the film's law; falling with "
    "temperature as in L. Houpert, L. Flamand, D. Berthe, J. Lubr. Technol. 103 (1981) 526",
    special_cases={"Bair and Winer": {"fall": 0.0, "offset": 0.0}},
    fingerprint={"load": "-", "speed": "-", "oil_temperature": "+", "roughness": "+", "slide_roll_ratio": "-"},
    separated_by="smooth surfaces, cold oil, high load: friction then stays at one level whatever the sliding and "
    "rolling speed, and the level moves with pressure only",
    applied_after=("contact_average", "film_heating", "coating_insulation", "contact_creep"),
)
def limiting_shear_stress(
    shear_stress: np.ndarray,
    hertz_pressure: np.ndarray,
    oil_temperature: np.ndarray,
    *,
    coefficient: float,
    sharpness: float,
    fall: float,
    offset: float,
) -> np.ndarray:
    """The shear stress of the film cannot exceed a fixed share of its pressure.

    Lambda is 0.03 to 0.09 in the literature (naphthenic 0.053, paraffinic 0.047, PAO 0.035, polyglycol 0.044).

    Measured values fall by up to 0.5 % per kelvin. An oil that flows plastically at no pressure has a part of its limit
    independent of pressure; the reference pressure of 1 GPa makes the form belong to Pa.

    >>> law = dict(coefficient=0.05, sharpness=4.0, fall=0.0, offset=0.0)
    >>> (limiting_shear_stress(np.array([200e6, 20e6]), 1e9, 313.15, **law) / 1e6).round(1).tolist()
    [50.0, 19.9]
    >>> half = dict(coefficient=0.05, sharpness=4.0, fall=0.0, offset=0.5)   # 25 MPa and 0.025 p
    >>> (limiting_shear_stress(1e12, np.array([0.5e9, 1e9, 2e9]), 313.15, **half) / 1e6).round(1).tolist()
    [37.5, 50.0, 75.0]
    """
    pressure = (1.0 - offset) * hertz_pressure + offset * REFERENCE_PRESSURE
    limit = coefficient * pressure * np.exp(-fall * (oil_temperature - FORTY_CELSIUS))
    return shear_stress * (1.0 + (shear_stress / limit) ** sharpness) ** (-1.0 / sharpness)
