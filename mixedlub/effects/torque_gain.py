"""Gains of two torque meters that differ."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import SinhNormal


@effect(
    stage="measurement",
    acts_on="reading",
    parameters=(
        Parameter(
            "difference",
            "-",
            SinhNormal(1e-3),
            "gain of the torque meter at the input less that at the output",
            null=0.0,
            symbol="g",
        ),
    ),
    equation=r"y \leftarrow y + g\,T_1\,\omega_1",
    source="power loss as the difference of input and output power, each from a torque meter; meters of the classes of "
    "DIN 51309 are good to 0.05 to 1 % of the torque",
    fingerprint={"load": "-", "speed": "+", "roughness": "-"},
    separated_by="drive and brake swapped, or both meters in series on one shaft: the difference changes its sign",
    kinds=("gear_pair",),
    applied_after=("heat_leak", "torque_offset"),
    exact_form=True,
    prior_odds=0.5,
)
def torque_gain(reading: np.ndarray, torque: np.ndarray, pinion_speed: np.ndarray, *, difference: float) -> np.ndarray:
    """A share of the transmitted power adds to a loss that is the difference of two powers.

    A rig in which power circulates measures the loss itself and does not have this error.

    >>> round(torque_gain(200.0, 100.0, 157.0, difference=1e-3), 1)   # 0.1 % of 15.7 kW
    215.7
    """
    return reading + difference * torque * pinion_speed
