"""Limiting shear stress."""

import numpy as np

from mixedlub.effect import BetweenLog, LogNormal, Parameter, effect


@effect(
    stage="shear",
    acts_on="shear_stress",
    parameters=(
        Parameter(
            "coefficient",
            "-",
            BetweenLog(0.015, 0.12),
            "limiting stress over pressure, Lambda",
            null=np.inf,
            symbol=r"\Lambda",
        ),
        Parameter("sharpness", "-", LogNormal(2.5, 0.7), "how abruptly the stress stops growing", symbol="n"),
    ),
    equation=r"\tau \leftarrow \tau\left[1 + \left(\frac{\tau}{\Lambda p_0}\right)^{n}\right]^{-1/n}",
    source="S. Bair, W. O. Winer, J. Lubr. Technol. 101 (1979) 258, tau_L = Lambda p; joined smoothly to the "
    "film's law",
    fingerprint={"load": "-", "speed": "-", "oil_temperature": "+", "roughness": "+", "slide_roll_ratio": "-"},
    separated_by="smooth surfaces, cold oil, high load: friction then stays at one level whatever the sliding and "
    "rolling speed, and the level moves with pressure only",
    after=("film_heating", "coating_insulation", "contact_creep"),
)
def limiting_shear_stress(
    shear_stress: np.ndarray, hertz_pressure: np.ndarray, *, coefficient: float, sharpness: float
) -> np.ndarray:
    """A film under pressure cannot carry more shear than a fixed share of that pressure.

    Lambda is 0.03 to 0.09 in the literature (naphthenic 0.053, paraffinic 0.047, PAO 0.035, polyglycol 0.044).

    >>> round(float(limiting_shear_stress(200e6, 1e9, coefficient=0.05, sharpness=4.0)) / 1e6, 1)
    50.0
    >>> round(float(limiting_shear_stress(20e6, 1e9, coefficient=0.05, sharpness=4.0)) / 1e6, 1)
    19.9
    """
    return shear_stress * (1.0 + (shear_stress / (coefficient * hertz_pressure)) ** sharpness) ** (-1.0 / sharpness)
