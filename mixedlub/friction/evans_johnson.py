"""Traction of a smooth film in the regimes of Evans and Johnson, with the constants of the user."""

import numpy as np

from mixedlub.chain.friction_law import Coefficient, friction_law
from mixedlub.laws.contact import mean_hertz_pressure


@friction_law(
    "Evans and Johnson",
    "contact",
    sources=0,
    status="regimes only: no source opened prints the constants for a gear oil, so they are yours",
    coefficients=(
        Coefficient(
            "limiting_stress_ratio",
            "-",
            "limiting shear stress over mean pressure, of the plastic regime",
            usual=(0.03, 0.12),
        ),
        Coefficient(
            "shear_modulus_GPa",
            "GPa",
            "shear modulus of the oil under pressure, of the viscoelastic regime",
            usual=(0.05, 2.0),
        ),
    ),
)
def evans_johnson(
    shear_stress: np.ndarray,
    hertz_pressure: np.ndarray,
    hertz_half_width: np.ndarray,
    slide_roll_ratio: np.ndarray,
    film_thickness: np.ndarray,
    *,
    limiting_stress_ratio: float,
    shear_modulus_GPa: float,
) -> np.ndarray:
    r"""Friction coefficient of a smooth film (-): the least stress of Newton and Eyring, viscoelastic and plastic.

    .. math:: \mu = \min\left(\tau,\ G\,\frac{S\,b_H}{h},\ \Lambda\bar p\right)/\bar p

    tau is the shear stress of the film as the options of a study choose it; the strain of oil that crosses the contact
    grows to 2 S b_H/h, and its mean is half of that. No asperities, no heat.

    Source: C. R. Evans, K. L. Johnson, Proc. IMechE C 200 (1986) 313, the regimes; the mean strain is geometry.

    >>> one = dict(limiting_stress_ratio=0.05, shear_modulus_GPa=0.5)
    >>> [round(float(evans_johnson(t, 1e9, 0.2e-3, s, 0.5e-6, **one)), 4)   # Eyring, plastic, viscoelastic
    ...  for t, s in ((20e6, 0.1), (60e6, 0.1), (20e6, 1e-5))]
    [0.0255, 0.05, 0.0025]
    """
    mean = mean_hertz_pressure(hertz_pressure)
    elastic = shear_modulus_GPa * 1e9 * slide_roll_ratio * hertz_half_width / film_thickness
    return np.minimum(np.minimum(shear_stress, elastic) / mean, limiting_stress_ratio)
