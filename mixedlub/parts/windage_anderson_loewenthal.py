"""Windage of a wheel after Anderson and Loewenthal."""

import numpy as np

from mixedlub.chain.part_law import part_law


@part_law(
    "windage",
    "anderson_loewenthal",
    "Anderson and Loewenthal",
    sources=0,
    status="constants as quoted in reviews, not confirmed by the report; metric and customary units agree",
)
def windage_anderson_loewenthal(
    wheel_radius: np.ndarray, shaft_speed: np.ndarray, face_width: np.ndarray, viscosity: np.ndarray
) -> np.ndarray:
    r"""Power of a wheel in the mist of a gearbox (W).

    .. math:: P = 2.82\times10^{-4}\left(1 + 2.3\,\frac{b}{R}\right) n^{2.8} R^{4.6} (0.028\,\eta + 0.019)^{0.2}

    with n in rpm, R and b in m, eta in mPa s. A mist of 34 parts of air to one of oil is part of the law.

    Source: N. E. Anderson, S. H. Loewenthal, NASA TP-1622, 1980.

    >>> round(float(windage_anderson_loewenthal(0.050, 10_000 * np.pi / 30, 0.020, 0.010)))
    70
    """
    speed = shaft_speed * 30.0 / np.pi
    mist = (0.028 * viscosity * 1e3 + 0.019) ** 0.2
    return 2.82e-4 * (1.0 + 2.3 * face_width / wheel_radius) * speed**2.8 * wheel_radius**4.6 * mist
