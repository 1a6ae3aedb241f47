"""Windage of a wheel after Diab and others."""

import numpy as np

from mixedlub.chain.documented import Coefficient
from mixedlub.chain.part_law import part_law
from mixedlub.laws.drag import windage_diab as law


@part_law(
    "windage",
    "diab",
    "Diab and others",
    sources=0,
    status="constants as quoted in reviews, not confirmed by the paper; within a factor 1.6 of the other laws",
    coefficients=(
        Coefficient(
            "clearance",
            "-",
            "distance of the walls beside the wheel over its radius; above 0.5 the wheel is free, as at 0.5",
            0.5,
        ),
    ),
)
def windage_diab(
    wheel_radius: np.ndarray,
    shaft_speed: np.ndarray,
    face_width: np.ndarray,
    wheel_teeth: np.ndarray,
    *,
    clearance: float,
) -> np.ndarray:
    r"""Power of a wheel against clean air (W), walls on both sides.

    .. math:: P = \tfrac12 C_t \rho\omega^3 R^5,\quad
              C_t = 60\,Re^{-0.25}\left(\tfrac{b}{R}\right)^{0.8} z^{-0.4}\,2\left(\tfrac{h}{R}\right)^{0.56}

    with Re = rho omega R^2/mu of air.

    Source: Y. Diab, F. Ville, P. Velex, C. Changenet, J. Mech. Des. 126 (2004) 903.

    >>> round(float(windage_diab(0.050, 10_000 * np.pi / 30, 0.020, 25.0, clearance=0.5)), -1)
    110.0
    """
    return law(wheel_radius, shaft_speed, face_width, wheel_teeth, min(clearance, 0.5))
