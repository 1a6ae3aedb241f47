"""Torque of a radial lip seal after ISO/TR 14179-2."""

import numpy as np

from mixedlub.chain.documented import Coefficient
from mixedlub.chain.part_law import part_law
from mixedlub.laws.drag import seal_torque

_PIVOT = 20e-6


@part_law(
    "seal",
    "iso_tr_14179_2",
    "ISO/TR 14179-2",
    sources=2,
    status="two public programs have the constant",
    coefficients=(
        Coefficient(
            "viscous", "-", "exponent of the viscosity over 20 mm²/s; 0 in the report, Linke has it above 0", 0.0
        ),
    ),
)
def seal_iso_tr_14179_2(
    viscosity: np.ndarray, oil_density: np.ndarray, seal_diameter: np.ndarray, *, viscous: float
) -> np.ndarray:
    r"""Torque of one radial lip seal (N m), whatever the speed.

    .. math:: T = 7.343\times10^{-5}\, d^2\left(\frac{\nu}{20\,\text{mm}^2/\text{s}}\right)^k

    with d in mm.

    Source: ISO/TR 14179-2, P = 7.69e-6 d^2 n in W, mm and rpm (k = 0); H. Linke, Stirnradverzahnung, 1996, for k.

    >>> round(float(seal_iso_tr_14179_2(0.01, 850.0, 0.05, viscous=0.0)), 4)
    0.1836
    """
    thinner = (viscosity / (oil_density * _PIVOT)) ** viscous
    return seal_torque(seal_diameter) * thinner
