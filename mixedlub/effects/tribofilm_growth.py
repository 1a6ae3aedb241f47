"""A reaction film that grows on the surfaces."""

import numpy as np

from mixedlub.effect import LogNormal, Normal, Parameter, effect


@effect(
    stage="boundary",
    acts_on="boundary_friction",
    parameters=(
        Parameter("change", "-", Normal(0.3, 0.5), "relative change of friction under a complete film", null=0.0),
        Parameter("time_constant", "-", LogNormal(0.3, 0.9), "share of the programme to cover 63 % of the track"),
        Parameter("order", "-", LogNormal(1.3, 0.4), "1: sites are there at once, above: they must form first"),
    ),
    equation=r"\mu_B \leftarrow \mu_B\,(1 + c\,\theta),\quad \theta = 1 - e^{-(q/q_c)^n}",
    source="coverage after M. Avrami, J. Chem. Phys. 7 (1939) 1103; friction of growing ZDDP films: H. Fujita, "
    "H. A. Spikes, Proc. IMechE J 218 (2004) 265",
    fingerprint={"sequence": "+"},
    separated_by="an image or contact resistance of the track after each step shows coverage grow; running-in "
    "of heights shows in a profile and ends within the first per cent of the test",
)
def tribofilm_growth(boundary_friction, sequence, *, change, time_constant, order):
    """Additives form a solid film on the track; friction goes with the share of the track that it covers.

    >>> float(tribofilm_growth(0.06, 1.0, change=1.0, time_constant=0.05, order=1.0).round(4))
    0.12
    """
    coverage = -np.expm1(-((np.maximum(sequence, 0.0) / time_constant) ** order))
    return boundary_friction * (1.0 + change * coverage)
