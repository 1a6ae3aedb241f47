"""Friction of a drive that differs between driving the load and being driven by it."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import Normal


@effect(
    stage="loss",
    acts_on="running_friction",
    parameters=(
        Parameter(
            "difference",
            "-",
            Normal(0.0, 0.03),
            "half the excess of the loss over the load torque where the load drives",
            null=0.0,
            symbol="b",
        ),
    ),
    equation=r"T_r \leftarrow T_r - b\,T_L",
    source="A. Wang, S. Kim, IEEE Int. Conf. Robotics and Automation (2015) 1055, directional efficiency of geared "
    "transmissions: the loss over the load torque is 1/eta - 1 where the motor drives and 1 - eta' where the load does",
    fingerprint={},
    separated_by="a known torque on the stalled output, or runs with the gears out: an error of the motor's torque "
    "constant stays there, a loss of the gears goes",
    applied_after=("stribeck", "load_dependent_friction", "fluid_drag", "direction_dependence", "presliding"),
    kinds=("friction_map",),
)
def back_driving(running_friction: np.ndarray, load_torque: np.ndarray, *, difference: float) -> np.ndarray:
    """Loaded flanks lose more where the load drives than where the motor drives, or less.

    Friction that grows with the load by 0.13 on average and a difference of 0.03 are 0.10 driving and 0.16 driven:

    >>> back_driving(np.array([2.6, 2.6]), np.array([20.0, -20.0]), difference=0.03).tolist()
    [2.0, 3.2]
    """
    return running_friction - difference * load_torque
