"""Mean friction in the form of ISO/TR 14179-1, with the constants of the user."""

import numpy as np

from mixedlub.chain.friction_law import Coefficient, friction_law
from mixedlub.chain.powers import power


@friction_law(
    "ISO/TR 14179-1",
    "mesh",
    sources=0,
    status="form only: no text of the standard could be opened, so its four constants are yours to copy from it",
    valid={"pitch_line_speed": (2.0, 25.0), "load_intensity": (1.4e6, 14e6)},
    diverges=("pitch_line_speed",),
    coefficients=(
        Coefficient("divisor", "-", "constant C1 of the standard", usual=(0.3, 30.0)),
        Coefficient("viscosity_exponent", "-", "exponent of the viscosity", usual=(-1.0, 0.5)),
        Coefficient("load_exponent", "-", "exponent of the load intensity", usual=(-1.0, 1.0)),
        Coefficient("speed_exponent", "-", "exponent of the pitch-line speed", usual=(0.0, 1.5)),
    ),
)
def iso_tr_14179_1(
    kinematic_viscosity: np.ndarray,
    load_intensity: np.ndarray,
    pitch_line_speed: np.ndarray,
    *,
    divisor: float,
    viscosity_exponent: float,
    load_exponent: float,
    speed_exponent: float,
) -> np.ndarray:
    r"""Mean friction coefficient of a gear mesh (-), from viscosity, load intensity and pitch-line speed.

    .. math:: \mu_m = \frac{\nu^{a} K^{c}}{C_1 v_t^{d}}

    nu in mm2/s, K in N/mm2, v_t in m/s. It belongs to the loss factor of the same standard, not of ISO/TR 14179-2.

    Source: ISO/TR 14179-1:2001.

    >>> exponents = {"viscosity_exponent": -0.5, "load_exponent": 0.5, "speed_exponent": 1.0}
    >>> round(float(iso_tr_14179_1(16e-6, 4e6, 10.0, divisor=2.0, **exponents)), 9)   # (1/4) 2/(2 * 10)
    0.025
    """
    load = power(load_intensity * 1e-6, load_exponent)
    thickness = power(kinematic_viscosity * 1e6, viscosity_exponent)
    return thickness * load / (divisor * power(pitch_line_speed, speed_exponent))
