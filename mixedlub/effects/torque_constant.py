"""A motor torque constant different from the value assumed by the controller."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Normal


@effect(
    stage="measurement",
    acts_on="reading",
    parameters=(
        Parameter("error", "-", Normal(0.0, 0.08), "relative excess of the assumed constant", null=0.0, symbol="a"),
        Parameter(
            "fall",
            "-",
            LogNormal(0.08, 0.8),
            "further relative excess at the largest torque, by saturation",
            null=0.0,
            symbol="f",
            relative_to="reference_torque",
        ),
    ),
    equation=r"y \leftarrow y + T_m\,(a + f\,|T_m|/T_{m0})",
    source="saturation of the iron, e.g. J. R. Hendershot, T. J. E. Miller, Design of Brushless Permanent-Magnet "
    "Machines, 2010, chapter 7",
    fingerprint={"motor_torque": "+"},
    separated_by="runs with the gears out, or a stalled motor against a torque sensor: what is left there is the "
    "motor, not the gears",
    kinds=("friction_map",),
    special_cases={"without saturation": {"fall": 0.0}},
)
def torque_constant(
    reading: np.ndarray, motor_torque: np.ndarray, reference_torque: np.ndarray, *, error: float, fall: float
) -> np.ndarray:
    """Torque computed from current is too high, increasingly so as the iron saturates; the error resembles friction.

    >>> round(float(torque_constant(0.1, 4.0, 8.0, error=0.02, fall=0.1)), 3)
    0.38
    """
    return reading + motor_torque * (error + fall * np.abs(motor_torque) / reference_torque)
