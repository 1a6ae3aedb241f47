"""A friction law."""

from mixedlub.chain.friction_law import Coefficient, friction_law


@friction_law(
    "Rubbing of the fan",
    "mesh",
    sources=1,
    status="one source",
    coefficients=(Coefficient("grip", "-", "grip of the hand that stops the fan"),),
)
def fan_rubbing(pitch_line_speed, *, grip):
    r"""Friction coefficient of a hand on the fan (-).

    .. math:: \mu = g

    Source: the maker of the fan.
    """
    return grip + 0.0 * pitch_line_speed
