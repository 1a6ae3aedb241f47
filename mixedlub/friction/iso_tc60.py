"""Friction after ISO TC60."""

import numpy as np

from mixedlub.chain.friction_law import friction_law
from mixedlub.chain.powers import power


@friction_law(
    "ISO TC60",
    "contact",
    sources=1,
    status="one source, H. Xu's table 2.1",
    diverges=("entrainment_speed",),
)
def iso_tc60(
    line_load: np.ndarray,
    composite_roughness: np.ndarray,
    radius: np.ndarray,
    entrainment_speed: np.ndarray,
    viscosity: np.ndarray,
) -> np.ndarray:
    r"""Friction coefficient of a tooth contact (-), from load, roughness, radius, rolling speed and viscosity.

    .. math:: \mu = 0.12\left(\frac{w\,\sigma}{R\,v_r\,\eta}\right)^{0.25}

    w in N/mm, sigma in um rms, R in mm, v_r the sum of both surface speeds in m/s, eta in mPa s. No sliding speed.

    Source: H. Xu, PhD thesis, Ohio State University, 2005, table 2.1, after ISO TC60, DTR 13989.

    >>> round(float(iso_tc60(553e3, 0.07e-6, 5e-3, 5.0, 0.010)), 4)
    0.0633
    """
    load = line_load * composite_roughness * 1e3 / (radius * 1e3)
    return 0.12 * power(load / (2.0 * entrainment_speed * viscosity * 1e3), 0.25)
