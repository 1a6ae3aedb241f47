"""Gain of the recorded channel."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import SinhNormal


@effect(
    stage="measurement",
    acts_on="reading",
    parameters=(Parameter("gain", "-", SinhNormal(0.05), "relative error of every reading", null=0.0, symbol="g"),),
    equation=r"y \leftarrow y\,(1 + g)",
    source="measurement: scale error of a channel",
    fingerprint={"load": "0", "speed": "0", "oil_temperature": "0", "roughness": "0", "slide_roll_ratio": "0"},
    separated_by="another instrument on the same quantity, or power circulation in both directions: the same share of "
    "every reading, whatever the surfaces",
    applied_after=(
        "fringe_order",
        "fringe_step",
        "heat_leak",
        "torque_constant",
        "torque_gain",
        "torque_offset",
        "zero_drift",
    ),
    exact_form=True,
)
def sensor_gain(reading: np.ndarray, *, gain: float) -> np.ndarray:
    """Every reading of the channel is too large by the same share.

    >>> round(sensor_gain(100.0, gain=0.02), 6)
    102.0
    """
    return reading * (1.0 + gain)
