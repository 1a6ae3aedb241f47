"""Friction after Misharin."""

import numpy as np

from mixedlub.chain.friction_law import friction_law
from mixedlub.chain.powers import power


@friction_law(
    "Misharin",
    "contact",
    sources=1,
    status="one source, H. Xu's table 2.1",
    valid={
        "slide_roll_ratio": (0.8, 2.6),
        "hertz_pressure": (2500 * 98066.5, np.inf),
        "friction": (0.02, 0.08),
    },
    diverges=("sliding_speed", "entrainment_speed"),
)
def misharin(sliding_speed: np.ndarray, entrainment_speed: np.ndarray, kinematic_viscosity: np.ndarray) -> np.ndarray:
    r"""Friction coefficient of rolling and sliding discs (-), from speeds and viscosity.

    .. math:: \mu = 0.325\,(v_s v_r \nu)^{-0.25}

    nu in mm2/s, speeds in m/s with v_r the sum of both surface speeds. The range is printed as v_s/v_r 0.4 to 1.3: half
    of the slide-to-roll ratio. No load, no roughness, no curvature.

    Source: H. Xu, PhD thesis, Ohio State University, 2005, table 2.1, after Y. A. Misharin, Conf. on Gearing, IMechE,
    1958, 159.

    >>> round(float(misharin(2.5, 5.0, 13e-6)), 4)
    0.0765
    """
    return 0.325 * power(sliding_speed * 2.0 * entrainment_speed * kinematic_viscosity * 1e6, -0.25)
