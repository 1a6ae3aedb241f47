"""Drift of the recorded channel."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import SinhNormal, Uniform

STEADY = 1e-9
"""Settling below which the linear limit is used."""


@effect(
    stage="measurement",
    acts_on="reading",
    parameters=(
        Parameter("drift", "-", SinhNormal(0.05), "relative error at the end of the programme", null=0.0, symbol="d"),
        Parameter(
            "settling",
            "-",
            Uniform(0.0, 8.0),
            "duration of the programme over the drift's time constant; 0: linear drift",
            null=0.0,
            symbol="s",
            kinds=("gear_pair", "disc", "film", "friction_map", "mesh_friction", "viscosity"),
        ),
    ),
    equation=r"y \leftarrow y\left(1 + d\,\frac{1 - e^{-s q}}{1 - e^{-s}}\right)",
    source="measurement: scale error that grows in the course of the programme, steadily or as an amplifier warms up",
    fingerprint={"sequence": "+"},
    separated_by="the first point repeated at the end, and a reference (check weight, reference oil, gauge block) read "
    "before and after: drift shows in both, a sample or surface that changes in the first only",
    applied_after=(
        "fringe_order",
        "fringe_step",
        "heat_leak",
        "torque_constant",
        "torque_gain",
        "torque_offset",
        "zero_drift",
    ),
    special_cases={"a steady drift": {"settling": 0.0}},
)
def sensor_drift(reading: np.ndarray, sequence: np.ndarray, *, drift: float, settling: float) -> np.ndarray:
    """The gain of the channel drifts during the programme.

    In friction histories the drift is linear: a change that settles is attributed to the surfaces.

    >>> round(float(sensor_drift(100.0, 0.5, drift=0.06, settling=0.0)), 6)
    103.0
    >>> round(float(sensor_drift(100.0, 0.5, drift=0.06, settling=2.0)), 2)   # 0.731 of it is done
    104.39
    """
    steep = max(settling, STEADY)
    return reading * (1.0 + drift * np.expm1(-steep * sequence) / np.expm1(-steep))
