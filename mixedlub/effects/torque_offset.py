"""Zero offset of the torque meter."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import SinhNormal


@effect(
    stage="measurement",
    acts_on="reading",
    parameters=(
        Parameter(
            "offset",
            "-",
            SinhNormal(5e-4),
            "reading at zero torque, relative to the largest torque recorded",
            null=0.0,
            symbol="a",
            relative_to="largest_torque",
        ),
    ),
    equation=r"y \leftarrow y + a\,T_m\,\omega_1",
    source="power from torque times speed: an error of torque becomes one of power; a meter's zero is good to a share "
    "of the torque it is made for, here the largest recorded",
    fingerprint={"load": "-", "speed": "+", "roughness": "-"},
    separated_by="zero load in both senses of rotation, or drive and brake swapped: its sign changes",
    kinds=("gear_pair",),
    applied_after=("heat_leak",),
    exact_form=True,
)
def torque_offset(
    reading: np.ndarray, pinion_speed: np.ndarray, largest_torque: np.ndarray, *, offset: float
) -> np.ndarray:
    """The zero offset of the torque meter adds a constant torque to every reading.

    >>> round(torque_offset(100.0, 157.0, 100.0, offset=5e-4), 2)   # 0.05 N m at 1500 rpm
    107.85
    """
    return reading + offset * largest_torque * pinion_speed
