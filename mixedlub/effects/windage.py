"""Windage."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform
from mixedlub.laws.drag import windage_diab

_PIVOT = 15.0


@effect(
    stage="loss",
    acts_on="power_loss",
    parameters=(
        Parameter(
            "strength",
            "-",
            LogNormal(1.5, 1.2),
            "factor for housing walls and oil in the air",
            null=0.0,
            symbol="c",
            nominal=1.0,
        ),
        Parameter("exponent", "-", Uniform(2.5, 3.0), "exponent of speed", symbol="k", published=(2.75, 2.9)),
    ),
    equation=r"P_L \leftarrow P_L + \chi c\left(\frac{r_1\omega_1}{15\,\text{m/s}}\right)^{k-2.75}\,"
    r"\sum_{i=1,2} \tfrac12 C_i\rho_a\omega_i^3 r_i^5,\quad "
    r"C_i = 81.4\,\mathrm{Re}_i^{-0.25}\,\left(\frac{b_w}{r_i}\right)^{0.8} z_i^{-0.4},\ "
    r"\mathrm{Re}_i = \rho_a\omega_i r_i^2/\eta_a,\quad "
    r"\rho_a = 1.2\,\text{kg/m}^3,\ \eta_a = 1.8\times10^{-5}\,\text{Pa s}",
    source="Y. Diab, F. Ville, P. Velex, C. Changenet, J. Mech. Des. 126 (2004) 903; power 2.9 after P. H. Dawson, "
    "Proc. IMechE A 198 (1984) 51, 2.8 after N. E. Anderson, S. H. Loewenthal, NASA TP-1622, 1980",
    fingerprint={"load": "-", "speed": "+", "oil_temperature": "0", "roughness": "-"},
    special_cases={
        "Diab and others": {"exponent": 2.75},
        "Dawson": {"exponent": 2.9},
        "Anderson and Loewenthal": {"exponent": 2.8},
    },
    separated_by="a dry, shrouded or evacuated run: nearly the cube of speed, and blind to oil and its temperature",
)
def windage(
    power_loss: np.ndarray,
    pinion_radius: np.ndarray,
    gear_radius: np.ndarray,
    pinion_speed: np.ndarray,
    gear_speed: np.ndarray,
    face_width: np.ndarray,
    pinion_teeth: np.ndarray,
    gear_teeth: np.ndarray,
    gears_fitted: np.ndarray,
    *,
    strength: float,
    exponent: float,
) -> np.ndarray:
    """The wheels drag the surrounding air along.

    The properties of air and the reference speed of 15 m/s make the form belong to SI. Published formulas agree within
    a factor of 1.6 in clean air; oil mist adds more.

    >>> speed = 10_000 * 3.14159 / 30
    >>> alone = windage(0.0, 0.05, 1e-9, speed, 1e-9, 0.02, 25.0, 25.0, 1.0, strength=1.0, exponent=2.75)
    >>> round(float(alone), -1)   # a 100 mm wheel at 10 000 rpm
    110.0
    """
    air = windage_diab(pinion_radius, pinion_speed, face_width, pinion_teeth) + windage_diab(
        gear_radius, gear_speed, face_width, gear_teeth
    )
    return power_loss + strength * gears_fitted * air * (pinion_radius * pinion_speed / _PIVOT) ** (exponent - 2.75)
