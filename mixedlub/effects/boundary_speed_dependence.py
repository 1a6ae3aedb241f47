"""Boundary friction that depends on speed."""

from mixedlub.effect import BetweenLog, Normal, Parameter, effect


@effect(
    stage="boundary",
    acts_on="boundary_friction",
    parameters=(
        Parameter("slope", "-", Normal(0.0, 0.12), "power of sliding speed; positive with friction modifier", null=0.0),
        Parameter("knee", "m/s", BetweenLog(0.01, 1.0), "sliding speed below which friction stays"),
    ),
    equation=r"\mu_B \leftarrow \mu_B\,\bigl[1 + (v_s/v_0)^2\bigr]^{\kappa/2}",
    source="H. Spikes, Tribol. Lett. 60 (2015) 5: friction grows with the logarithm of speed under adsorbed "
    "films and falls without; written as a small power, which is that logarithm to first order",
    fingerprint={"load": "-", "oil_temperature": "+", "roughness": "+", "slide_roll_ratio": "+"},
    separated_by="film ratios below 0.5 at small sliding: friction follows the logarithm of sliding speed where the "
    "film cannot matter; it vanishes at thick films",
)
def boundary_speed_dependence(boundary_friction, sliding_speed, *, slope, knee):
    """The friction of touching asperities grows or falls with the logarithm of sliding speed.

    >>> round(float(boundary_speed_dependence(0.1, 1.0, slope=0.1, knee=0.1)), 3)   # a decade above the knee
    0.126
    """
    return boundary_friction * (1.0 + (sliding_speed / knee) ** 2) ** (0.5 * slope)
