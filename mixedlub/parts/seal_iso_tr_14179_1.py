"""Torque of a radial lip seal after ISO/TR 14179-1."""

import numpy as np

from mixedlub.chain.documented import Coefficient
from mixedlub.chain.part_law import part_law


@part_law(
    "seal",
    "iso_tr_14179_1",
    "ISO/TR 14179-1",
    sources=0,
    status="the form is that of the report; its constants are not confirmed, so that they are yours",
    coefficients=(
        Coefficient("torque_per_diameter", "N", "torque over diameter of the lip; quoted: 3.737 Viton, 2.429 Buna N"),
    ),
)
def seal_iso_tr_14179_1(seal_diameter: np.ndarray, *, torque_per_diameter: float) -> np.ndarray:
    r"""Torque of one radial lip seal (N m), proportional to the diameter, whatever the speed.

    .. math:: T = c\, d

    Source: ISO/TR 14179-1, shaft seals.

    >>> round(float(seal_iso_tr_14179_1(0.05, torque_per_diameter=3.737)), 3)
    0.187
    """
    return torque_per_diameter * seal_diameter
