"""Friction of a drive that grows with its load."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal


@effect(
    stage="loss",
    acts_on="coulomb_torque",
    parameters=(
        Parameter(
            "growth",
            "-",
            LogNormal(0.5, 1.0),
            "dry friction added at the largest load, relative to T_c",
            null=0.0,
            symbol="c",
            relative_to="coulomb_torque",
        ),
        Parameter("power", "-", LogNormal(1.0, 0.35), "exponent of load", symbol="n"),
    ),
    equation=r"T_c \leftarrow T_c\,(1 + c\,q_F^n)",
    source="Coulomb's law for the loaded flanks; A. C. Bittencourt, S. Gunnarsson, J. Dyn. Syst. Meas. Control 134 "
    "(2012) 051013, load term",
    fingerprint={"load": "+"},
    separated_by="runs with the gears out: the friction of gears goes with them, an error of the motor's torque "
    "constant stays",
    kinds=("friction_map",),
    special_cases={"Coulomb": {"power": 1.0}},
)
def load_dependent_friction(
    coulomb_torque: np.ndarray, load_fraction: np.ndarray, *, growth: float, power: float
) -> np.ndarray:
    """Loaded flanks and bearings add dry friction, proportional to load by Coulomb's law.

    Terms relative to dry friction, such as the excess at low speed, grow with it. The exponent is 1.5 for rolling
    bearings that load themselves and below 1 for films, because their friction grows more slowly than load.

    >>> round(float(load_dependent_friction(2.0, 0.5, growth=0.2, power=1.0)), 9)
    2.2
    """
    return coulomb_torque * (1.0 + growth * load_fraction**power)
