"""Columns common to several kinds of recording, which kinds may override."""

from __future__ import annotations

from mixedlub.schema.table import Column

LOAD = Column(
    "load_N",
    above=0.0,
    meaning="normal load",
    words=("load", "ball load", "pin load", "normal load", "normal force", "normal", "normalkraft"),
    hints=("fn", "fz"),
)
ENTRAINMENT_SPEED = Column(
    "entrainment_speed_m_s",
    above=0.0,
    meaning="mean of the two surface speeds",
    words=("rolling speed", "entrainment speed", "mean speed"),
)
SLIDE_ROLL_RATIO = Column(
    "slide_roll_ratio",
    at_least=-200.0,
    at_most=200.0,
    meaning="sliding speed over mean speed",
    words=("srr", "slide roll ratio", "slide to roll ratio", "slide/roll", "slide/roll ratio"),
)
OIL_TEMPERATURE = Column(
    "oil_temperature_C",
    at_least=-60.0,
    at_most=300.0,
    meaning="temperature of the oil where it enters the contact",
    words=("oil temperature", "oil temp", "lubricant temperature", "lube temp", "lube rtd temp", "öltemperatur"),
)
TIME = Column(
    "time_s",
    required=False,
    meaning="time since the start of the recording",
    words=("test time", "elapsed time", "timestamp", "time", "step time"),
)
SPEED = Column(
    "speed_rpm", above=0.0, meaning="speed of the pinion", words=("speed", "motor speed", "rotational speed")
)
TORQUE = Column(
    "torque_Nm", above=0.0, meaning="torque on the pinion", words=("torque", "load torque", "pinion torque")
)
FRICTION = Column(
    "friction_coefficient",
    meaning="friction over load, positive but for noise",
    words=(
        *("traction coeff", "friction coefficient", "cof", "friction coeff", "traction coefficient"),
        *("coefficient of friction", "coeff. of friction", "mu", "µ", "μ"),
        *("reibungszahl", "reibzahl", "reibwert", "reibbeiwert", "reibungskoeffizient", "reibungsbeiwert"),
        *("gleitreibungszahl", "gleitreibung", "haftreibungszahl", "haftreibung"),
    ),
)


def surface(name: str) -> Column:
    """Column with the name of a surface of the system."""
    return Column(name, "name", meaning="a surface of system.toml")
