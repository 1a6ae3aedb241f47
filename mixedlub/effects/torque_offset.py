"""Offset of the torque meter."""

from mixedlub.effect import Parameter, Wide, effect


@effect(
    stage="measurement",
    acts_on="reading",
    parameters=(Parameter("torque", "N m", Wide(0.05), "what the torque meter reads at no torque", null=0.0),),
    equation=r"y \leftarrow y + T_0\,\omega_1",
    source="power from torque times speed: an error of torque becomes one of power",
    fingerprint={"load": "-", "speed": "+", "roughness": "-"},
    separated_by="zero load in both senses of rotation, or drive and brake swapped: its sign changes",
    kinds=("gear_pair",),
    after=("heat_leak",),
)
def torque_offset(reading, pinion_speed, *, torque):
    """A torque meter that does not read zero at rest adds a torque that is not there.

    >>> round(torque_offset(100.0, 157.0, torque=0.05), 2)
    107.85
    """
    return reading + torque * pinion_speed
