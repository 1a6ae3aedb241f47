"""An adsorbed film of a friction modifier."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal


@effect(
    stage="boundary",
    acts_on="coulomb_torque",
    parameters=(
        Parameter(
            "drop",
            "-",
            LogNormal(0.3, 0.6),
            "relative fall of dry friction under a full layer",
            null=0.0,
            symbol="d",
            relative_to="coulomb_torque",
        ),
        Parameter(
            "half_share",
            "-",
            LogNormal(0.1, 1.2),
            "content at half coverage, relative to the largest content tested",
            symbol="q_h",
        ),
    ),
    equation=r"T_c \leftarrow T_c\,\left(1 - d\,\frac{q_a}{q_a + q_h}\right)",
    source="adsorption after I. Langmuir, J. Am. Chem. Soc. 40 (1918) 1361; friction with the covered share as in "
    "S. Jahanmir, M. Beltzer, J. Tribol. 108 (1986) 109",
    fingerprint={"additive_fraction": "-"},
    separated_by="the same oil at several contents of the additive: friction falls and levels off",
    kinds=("friction_map",),
)
def friction_modifier_film(
    coulomb_torque: np.ndarray, additive_fraction: np.ndarray, *, drop: float, half_share: float
) -> np.ndarray:
    """Adsorbed additive molecules cover the surfaces and shear more easily than metal on metal.

    >>> round(friction_modifier_film(0.16, 0.5, drop=0.4, half_share=0.1), 4)
    0.1067
    """
    return coulomb_torque * (1.0 - drop * additive_fraction / (additive_fraction + half_share))
