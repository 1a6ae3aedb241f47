"""A law of a machine part."""

from mixedlub.chain.documented import Coefficient
from mixedlub.chain.part_law import part_law


@part_law(
    "other",
    "fan_blades",
    "Blades of the fan",
    sources=1,
    status="one source",
    coefficients=(Coefficient("blades", "-", "blades of the fan"),),
)
def fan_blades(shaft_speed, *, blades):
    r"""Torque of the blades of a fan (N m).

    .. math:: T = 0.01 z

    Source: the maker of the fan.
    """
    return 0.01 * blades + 0.0 * shaft_speed
