"""Friction after Benedict and Kelley."""

import numpy as np

from mixedlub.chain.friction_law import friction_law

INCH = 0.0254
POUND_PER_INCH = 175.12684
"""One lbf/in in N/m."""
MOST_FACTOR = 3.0
"""Largest roughness factor, 50/(50 - S), that the source prints."""


@friction_law(
    "Benedict and Kelley",
    "contact",
    sources=2,
    status="two sources: H. Xu's table 2.1 and the use of AGMA 925",
    valid={"composite_roughness": (0.0, 50.0 * (1.0 - 1.0 / MOST_FACTOR) * 1e-6 * INCH)},
    diverges=("sliding_speed", "entrainment_speed"),
)
def benedict_kelley(
    line_load: np.ndarray,
    composite_roughness: np.ndarray,
    viscosity: np.ndarray,
    sliding_speed: np.ndarray,
    entrainment_speed: np.ndarray,
) -> np.ndarray:
    r"""Friction coefficient of rolling and sliding discs (-), from load, roughness, viscosity and speeds.

    .. math:: \mu = 0.0127\,\frac{50}{50 - \sigma}\,
              \log_{10}\left(\frac{3.17\times10^8\,w}{\eta\,v_s\,v_r^2}\right)

    w in lbf/in, sigma in microinch rms, eta in mPa s, speeds in in/s with v_r the sum of both surface speeds. The
    factor of roughness is at most 3; no curvature.

    Source: H. Xu, PhD thesis, Ohio State University, 2005, table 2.1, after G. H. Benedict, B. W. Kelley, ASLE Trans. 4
    (1961) 59.

    >>> round(float(benedict_kelley(553e3, 0.07e-6, 0.010, 2.5, 5.0)), 4)
    0.0513
    """
    smooth = np.maximum(1.0 - composite_roughness / (50e-6 * INCH), 1.0 / MOST_FACTOR)
    flow = viscosity * 1e3 * (sliding_speed / INCH) * (2.0 * entrainment_speed / INCH) ** 2
    return 0.0127 / smooth * np.log10(3.17e8 * line_load / POUND_PER_INCH / flow)
