"""Friction after Drozdov and Gavrikov."""

import numpy as np

from mixedlub.chain.friction_law import friction_law

KGF_PER_CM2 = 98066.5


@friction_law(
    "Drozdov and Gavrikov",
    "contact",
    sources=1,
    status="one source, H. Xu's table 2.1, whose print loses the square root; with it friction stays plausible",
    valid={
        "kinematic_viscosity": (4e-6, 500e-6),
        "sliding_speed": (0.0, 15.0),
        "entrainment_speed": (1.5, 10.0),
        "hertz_pressure": (4000 * KGF_PER_CM2, 20000 * KGF_PER_CM2),
    },
)
def drozdov_gavrikov(
    kinematic_viscosity: np.ndarray,
    sliding_speed: np.ndarray,
    entrainment_speed: np.ndarray,
    hertz_pressure: np.ndarray,
) -> np.ndarray:
    r"""Friction coefficient of rolling and sliding discs (-), from speeds, viscosity and pressure.

    .. math:: \mu = \frac{1}{0.8\sqrt{\nu}\,v_s + \phi\,v_r + 13.4},\quad
              \phi = 0.47 - 0.13\times10^{-4} p_0 - 0.4\times10^{-3}\nu

    nu in mm2/s, speeds in m/s with v_r the sum of both surface speeds, p_0 in kgf/cm2. No roughness, no curvature.

    Source: H. Xu, PhD thesis, Ohio State University, 2005, table 2.1, after Y. N. Drozdov, Y. A. Gavrikov, Wear 11
    (1968) 291.

    >>> round(float(drozdov_gavrikov(13e-6, 2.5, 5.0, 2e9)), 4)
    0.0442
    """
    nu = kinematic_viscosity * 1e6
    phi = 0.47 - 0.13e-4 * hertz_pressure / KGF_PER_CM2 - 0.4e-3 * nu
    return 1.0 / (0.8 * np.sqrt(nu) * sliding_speed + 2.0 * entrainment_speed * phi + 13.4)
