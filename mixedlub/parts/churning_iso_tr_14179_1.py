"""Churning of a wheel in oil after ISO/TR 14179-1."""

import numpy as np

from mixedlub.chain.documented import Coefficient
from mixedlub.chain.part_law import part_law


@part_law(
    "churning",
    "iso_tr_14179_1",
    "ISO/TR 14179-1",
    sources=0,
    status="constants as quoted in reviews, not confirmed by the report; with the cube of speed it is for slow drives",
    coefficients=(
        Coefficient("dip_factor", "-", "f_g: 0 of a wheel out of the oil, 1 of one in it, its share between"),
        Coefficient("arrangement", "-", "A_g", 0.2),
    ),
)
def churning_iso_tr_14179_1(
    tip_diameter: np.ndarray,
    shaft_speed: np.ndarray,
    face_width: np.ndarray,
    gear_module: np.ndarray,
    helix_angle: np.ndarray,
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    *,
    dip_factor: float,
    arrangement: float,
) -> np.ndarray:
    r"""Power of a wheel that dips into oil (W): its two sides and its teeth.

    .. math:: P = \frac{f_g\nu n^3 D^{4.7}}{10^{23} A_g}\left(1.474\,D + 7.37\,b\,
              \frac{R_f}{\sqrt{\tan\beta}}\right),\quad R_f = 7.93 - \frac{4.648}{m_t}

    with nu in mm^2/s, n in rpm, D, b, m_t in mm, beta from 10 degrees on.

    Source: ISO/TR 14179-1, gear churning.

    >>> given = dict(dip_factor=0.25, arrangement=0.2)
    >>> round(float(churning_iso_tr_14179_1(0.1, 100 * np.pi, 0.02, 4e-3, 0.0, 50e-6 * 850, 850.0, **given)))
    107
    """
    speed, outside, nu = shaft_speed * 30.0 / np.pi, tip_diameter * 1e3, viscosity / oil_density * 1e6
    rough = 7.93 - 4.648 / (1e3 * gear_module / np.cos(helix_angle))
    teeth = 7.37 * face_width * 1e3 * rough / np.sqrt(np.tan(np.maximum(helix_angle, np.radians(10.0))))
    return dip_factor * nu * speed**3 * outside**4.7 / (1e23 * arrangement) * (1.474 * outside + teeth)
