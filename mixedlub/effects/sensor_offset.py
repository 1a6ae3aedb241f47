"""Offset of the recorded channel."""

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
            SinhNormal(0.05),
            "offset of every reading, relative to the typical reading",
            null=0.0,
            symbol="a",
            relative_to="reading_scale",
        ),
    ),
    equation=r"y \leftarrow y + a\,y_0",
    source="measurement: zero error of a channel",
    fingerprint={"load": "-", "roughness": "-", "slide_roll_ratio": "-"},
    separated_by="a reading with the rig at rest: the same number everywhere",
    applied_after=(
        "fringe_order",
        "heat_leak",
        "sensor_drift",
        "sensor_gain",
        "torque_constant",
        "torque_gain",
        "torque_offset",
    ),
    exact_form=True,
)
def sensor_offset(reading: np.ndarray, reading_scale: np.ndarray, *, offset: float) -> np.ndarray:
    """The channel has a zero offset.

    >>> sensor_offset(100.0, 50.0, offset=0.1)
    105.0
    """
    return reading + offset * reading_scale
