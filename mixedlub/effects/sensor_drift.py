"""Drift of the recorded channel."""

import numpy as np

from mixedlub.effect import Parameter, Wide, effect


@effect(
    stage="measurement",
    acts_on="reading",
    parameters=(
        Parameter("drift", "-", Wide(0.05), "relative error at the end of the programme", null=0.0, symbol="d"),
    ),
    equation=r"y \leftarrow y\,(1 + d\,q)",
    source="measurement: scale error that grows in the course of the programme",
    fingerprint={"sequence": "+"},
    separated_by="the first point repeated at the end, and a reference (check weight, reference oil, gauge block) read "
    "before and after: drift shows in both, a sample or surface that changes in the first only",
    after=("fringe_order", "fringe_step", "heat_leak", "torque_constant", "torque_offset", "zero_drift"),
)
def sensor_drift(reading: np.ndarray, sequence: np.ndarray, *, drift: float) -> np.ndarray:
    """The channel's scale creeps in the course of the programme.

    >>> round(sensor_drift(100.0, 0.5, drift=0.06), 6)
    103.0
    """
    return reading * (1.0 + drift * sequence)
