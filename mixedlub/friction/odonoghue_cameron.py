"""Friction after O'Donoghue and Cameron."""

import numpy as np

from mixedlub.chain.friction_law import friction_law
from mixedlub.chain.powers import power

INCH = 0.0254


@friction_law(
    "O'Donoghue and Cameron",
    "contact",
    sources=1,
    status="one source, H. Xu's table 2.1; the exponents are read in the order of its print",
    diverges=("sliding_speed", "entrainment_speed"),
)
def odonoghue_cameron(
    composite_roughness: np.ndarray,
    viscosity: np.ndarray,
    sliding_speed: np.ndarray,
    entrainment_speed: np.ndarray,
    radius: np.ndarray,
) -> np.ndarray:
    r"""Friction coefficient of rolling and sliding discs (-), from roughness, viscosity, speeds and radius.

    .. math:: \mu = 0.6\,\frac{(R_a + 22)/35}{\eta^{1/8}\,v_s^{1/3}\,v_r^{1/6}\,R^{1/2}}

    R_a is the centre-line average of both surfaces together in microinch, eta in mPa s, speeds in in/s with v_r the
    sum of both surface speeds, R in inch; R_a of normal heights from the composite roughness. No load.

    Source: H. Xu, PhD thesis, Ohio State University, 2005, table 2.1, after J. P. O'Donoghue, A. Cameron, ASLE Trans.
    9 (1966) 186.

    >>> round(float(odonoghue_cameron(0.07e-6 * np.sqrt(np.pi / 2), 0.010, 2.5, 5.0, 5e-3)), 4)
    0.0574
    """
    finish = np.sqrt(2.0 / np.pi) * composite_roughness / (1e-6 * INCH)
    speeds = power(sliding_speed / INCH, 1 / 3) * power(2.0 * entrainment_speed / INCH, 1 / 6)
    return 0.6 * (finish + 22.0) / 35.0 / (power(viscosity * 1e3, 0.125) * speeds * np.sqrt(radius / INCH))
