"""A step at each change of interference order."""

from mixedlub.effect import Normal, Parameter, effect


@effect(
    stage="measurement",
    acts_on="reading",
    parameters=(
        Parameter("step", "-", Normal(0.0, 0.08), "share by which the film steps at a change of order", null=0.0),
    ),
    equation=r"y \leftarrow y\,(1 + s\,N_f)",
    source="dispersion and phase change are corrected order by order: G. J. Johnston, R. Wayte, H. A. Spikes, Tribol. "
    "Trans. 34 (1991) 187",
    fingerprint={},
    separated_by="a repeat with another spacer thickness: the step stays with the order, not with the speed",
    kinds=("film",),
)
def order_change(reading, fringe_count, *, step):
    """Wavelengths of neighbouring orders are converted with constants that do not quite agree.

    >>> round(float(order_change(100.0, 1.0, step=-0.05)), 1)
    95.0
    """
    return reading * (1.0 + step * fringe_count)
