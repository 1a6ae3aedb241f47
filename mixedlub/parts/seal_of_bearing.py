"""Torque of the contact seals of a rolling bearing."""

import numpy as np

from mixedlub.chain.documented import Coefficient
from mixedlub.chain.part_law import part_law


@part_law(
    "seal",
    "skf_bearing_seals",
    "SKF, contact seals of a bearing",
    sources=1,
    status="one public program has the constants of the types in its table, after the catalogue of 2006",
    coefficients=(
        Coefficient("factor", "-", "K_S1 of the type"),
        Coefficient("exponent", "-", "beta of the type"),
        Coefficient("constant", "N mm", "K_S2 of the type"),
    ),
    series="bearing_seals",
)
def skf_bearing_seals(seal_diameter: np.ndarray, *, factor: float, exponent: float, constant: float) -> np.ndarray:
    r"""Torque of both contact seals of a rolling bearing (N m); half of it for a seal on one side.

    .. math:: T = K_{S1}\, d_s^{\beta} + K_{S2}

    with the diameter d_s of the counterface in mm and T in N mm.

    Source: SKF, General Catalogue, 2006, frictional moment of seals.

    >>> round(float(skf_bearing_seals(0.047, factor=0.018, exponent=2.25, constant=20.0)) * 1e3)   # a bearing 6207-2RS1
    124
    """
    return (factor * (seal_diameter * 1e3) ** exponent + constant) * 1e-3
