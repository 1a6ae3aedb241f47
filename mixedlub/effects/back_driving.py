"""Friction of a drive that grows with the load and differs between driving the load and being driven by it."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, SignedLogNormal


@effect(
    stage="loss",
    acts_on="coulomb_torque",
    parameters=(
        Parameter(
            "growth",
            "-",
            LogNormal(0.5, 1.0),
            "dry friction added at the largest load, mean of both senses, relative to T_c",
            null=0.0,
            symbol="c",
            relative_to="coulomb_torque",
        ),
        Parameter(
            "asymmetry",
            "-",
            SignedLogNormal(0.2, 0.7),
            "half the excess where the load drives, relative to the mean",
            symbol="b",
        ),
    ),
    equation=r"T_c \leftarrow T_c\,(1 + c\,q_F\,(1 - b\,s_L))",
    source="A. Wang, S. Kim, IEEE Int. Conf. Robotics and Automation (2015) 1055, directional efficiency of geared "
    "transmissions: the loss over the load torque is 1/eta - 1 where the motor drives and 1 - eta' where the load does",
    fingerprint={"load": "+"},
    separated_by="a known torque on the stalled output, or runs with the gears out: an error of the motor's torque "
    "constant stays there, a loss of the gears goes",
    kinds=("friction_map",),
    # Two statements at once, friction that grows and a difference: as improbable as a pair of effects.
    prior_odds=0.015,
)
def back_driving(
    coulomb_torque: np.ndarray, load_fraction: np.ndarray, load_sense: np.ndarray, *, growth: float, asymmetry: float
) -> np.ndarray:
    """Loaded flanks add dry friction in proportion to load, and more where the load drives the motor, or less.

    Loads up to 80 N m that cost 0.10 of the load driving and 0.16 driven, on 2 N m of dry friction:

    >>> loss = back_driving(2.0, 1.0, np.array([1.0, -1.0]), growth=0.13 * 80.0 / 2.0, asymmetry=0.03 / 0.13)
    >>> loss.round(9).tolist()
    [10.0, 14.8]
    """
    return coulomb_torque * (1.0 + growth * load_fraction * (1.0 - asymmetry * load_sense))
