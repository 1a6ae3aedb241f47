"""Friction in the form of Löpenhaus, with the coefficients of the user."""

import numpy as np

from mixedlub.chain.friction_law import Coefficient, friction_law
from mixedlub.chain.powers import power

_C = {
    1: "factor",
    2: "exponent of the sum speed in m/s",
    3: "of the pressure, per N/mm²",
    4: "of the squared viscosity, mm²/s",
    5: "of the viscosity, mm²/s",
    6: "of viscosity zero",
    7: "exponent of Ra in µm",
    8: "added to the slide-to-roll ratio",
    9: "added to its square",
}


@friction_law(
    "Löpenhaus",
    "contact",
    sources=0,
    status="form only: no source opened prints the coefficients c1 to c9, so they are yours; `mixedlub evaluate "
    "calibration` fits them to losses of gears",
    coefficients=(
        *(Coefficient(f"c{i}", "-", meaning) for i, meaning in _C.items()),
        Coefficient("lubricant_factor", "-", "factor of the oil, X_L", 1.0),
        Coefficient("surface_factor", "-", "factor of the surface, X_OS", 1.0),
    ),
)
def loepenhaus(
    entrainment_speed: np.ndarray,
    hertz_pressure: np.ndarray,
    kinematic_viscosity: np.ndarray,
    mean_roughness: np.ndarray,
    slide_roll_ratio: np.ndarray,
    radius: np.ndarray,
    *,
    c1: float,
    c2: float,
    c3: float,
    c4: float,
    c5: float,
    c6: float,
    c7: float,
    c8: float,
    c9: float,
    lubricant_factor: float,
    surface_factor: float,
) -> np.ndarray:
    r"""Friction coefficient of a tooth contact (-), a form fitted to discs and refitted to high-speed gears.

    .. math:: \mu = c_1 v_\Sigma^{c_2} e^{c_3 p_0}(c_4\nu^2 + c_5\nu + c_6) R_a^{c_7}
              \frac{S}{(S + c_8)^2 + c_9}\,R^{0.2} X_L X_{OS}

    v_Sigma is the sum of both surface speeds in m/s, p_0 in N/mm2, nu in mm2/s at oil temperature (the source: at bulk
    temperature), Ra in um, S the slide-to-roll ratio, R in mm. Friction is zero without sliding and largest at S =
    sqrt(c8^2 + c9).

    Source: Measurement and Modelling of Friction for Cylindrical Gears with Pitch Line Velocities up to 100 m/s, eq. 9,
    after C. Löpenhaus, thesis, RWTH Aachen, 2015.

    >>> plain = dict(c1=0.1, c2=0.0, c3=0.0, c4=0.0, c5=0.0, c6=1.0, c7=0.0, c8=3.0, c9=16.0)
    >>> plain |= {"lubricant_factor": 1.0, "surface_factor": 1.0}
    >>> s = np.array([4.9, 5.0, 5.1])
    >>> friction = loepenhaus(5.0, 1e9, 1e-5, 1e-6, s, 1e-3, **plain)
    >>> int(friction.argmax()), round(float(friction[1]), 5)   # 0.1 * 5/80 at sqrt(9 + 16)
    (1, 0.00625)
    """
    nu, ratio = kinematic_viscosity * 1e6, np.abs(slide_roll_ratio)
    speed = power(2.0 * entrainment_speed, c2) * np.exp(c3 * hertz_pressure * 1e-6)
    oil = (c4 * nu**2 + c5 * nu + c6) * lubricant_factor * surface_factor
    finish = power(mean_roughness * 1e6, c7) * power(radius * 1e3, 0.2)
    return c1 * speed * oil * finish * ratio / ((ratio + c8) ** 2 + c9)
