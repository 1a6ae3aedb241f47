"""A surface state with a fast and a slow part."""

import numpy as np

from mixedlub.effect import LogNormal, Normal, Parameter, effect


@effect(
    stage="boundary",
    acts_on="boundary_friction",
    parameters=(
        Parameter("fast_change", "-", Normal(0.0, 0.15), "relative change that comes first", null=0.0),
        Parameter("slow_change", "-", Normal(0.0, 0.5), "relative change that follows", null=0.0),
        Parameter("fast_time", "-", LogNormal(0.03, 0.8), "share of the programme for 63 % of the fast change"),
        Parameter("slow_time", "-", LogNormal(0.7, 0.7), "share of the programme for 63 % of the slow change"),
    ),
    equation=r"\mu_B \leftarrow \mu_B\,[1 + a_1(1 - e^{-q/q_1}) + a_2(1 - e^{-q/q_2})]",
    source="running-in as a film that forms and a track that wears, each of first order; P. J. Blau, Tribol. Int. 38 "
    "(2005) 1007, curves with an early maximum",
    fingerprint={},
    separated_by="contact resistance and a wear scar measured at times: a film takes minutes, wear goes on",
    kinds=("friction_history",),
)
def two_time_scales(boundary_friction, sequence, *, fast_change, slow_change, fast_time, slow_time):
    """A film forms quickly while the track wears slowly; each moves friction by its own share.

    >>> x = two_time_scales(0.1, np.array([0.0, 9.0]), fast_change=0.1, slow_change=-0.3, fast_time=0.01, slow_time=0.2)
    >>> x.round(3).tolist()
    [0.1, 0.08]
    """
    since = np.maximum(sequence, 0.0)
    film, wear = -np.expm1(-since / fast_time), -np.expm1(-since / slow_time)
    return boundary_friction * (1.0 + fast_change * film + slow_change * wear)
