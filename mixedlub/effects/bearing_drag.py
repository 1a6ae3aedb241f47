"""Bearing drag."""

import numpy as np

from mixedlub.effect import Between, LogNormal, Parameter, effect
from mixedlub.laws.drag import palmgren_idle_torque, palmgren_load_torque

_SIZE = 1.25
_TYPICAL = 3000.0
_LEAST = 0.1


@effect(
    stage="loss",
    acts_on="power_loss",
    parameters=(
        Parameter("idle", "-", LogNormal(1.0, 1.0), "factor on the torque without load", null=0.0),
        Parameter("loaded", "-", LogNormal(1.0, 1.0), "factor on the torque that load adds", null=0.0),
        Parameter("load_power", "-", Between(1.0, 1.6), "power of load in it: 1 for rollers, about 1.5 for balls"),
        Parameter("rolling_power", "-", Between(0.0, 0.54), "power of load in the torque of rolling in oil"),
    ),
    equation=r"P \leftarrow P + \sum_{i=1,2} 2\,\omega_i\,(c_0 M_{0,i} x^b + c_1 M_1 x^{a-1}),\quad x = F_t/F_r,\ "
    r"M_0 = 10^{-7} f_0(\nu n_i)^{2/3} d_m^3,\ M_1 = f_1\tfrac{F_t}{2} d_m,\ d_m = 1.25\,r_1",
    source="A. Palmgren, Grundlagen der Waelzlagertechnik, 1964; ISO/TR 14179-2; T. A. Harris, Rolling Bearing "
    "Analysis, for f_1 that grows with load in ball bearings; SKF General Catalogue 6000, 2003, for rolling torque "
    "with load^0.54",
    fingerprint={"load": "-", "speed": "+", "oil_temperature": "-", "roughness": "-"},
    separated_by="the bearings alone on their rig, or their own oil supply; a change of flank finish leaves it "
    "where it was",
)
def bearing_drag(
    power_loss,
    transmitted_force,
    pinion_radius,
    pinion_speed,
    gear_speed,
    viscosity,
    oil_density,
    gears_fitted,
    *,
    idle,
    loaded,
    load_power,
    rolling_power,
):
    """Four rolling bearings turn in oil and carry the tooth force.

    Two bearings a shaft, each half the force, as large as a pinion's shaft allows. Palmgren's
    constant and the force F_r = 3 kN that powers of load turn about make the form belong to SI.

    >>> gear = dict(transmitted_force=3000.0, pinion_radius=0.036, pinion_speed=157.1, gear_speed=102.7, gears_fitted=1)
    >>> size = dict(idle=1.0, loaded=1.0, load_power=1.0, rolling_power=0.0)
    >>> round(bearing_drag(0.0, **gear, viscosity=0.01275, oil_density=850.0, **size))   # 15.7 kW
    24
    """
    diameter = _SIZE * pinion_radius
    size = np.where(gears_fitted > 0, np.maximum(transmitted_force / _TYPICAL, _LEAST), _LEAST)
    growth = size ** (load_power - 1.0)
    by_load = loaded * gears_fitted * growth * palmgren_load_torque(0.5 * transmitted_force, diameter)
    drag = 0.0
    for speed in (pinion_speed, gear_speed):
        by_oil = idle * size**rolling_power * palmgren_idle_torque(viscosity, oil_density, speed, diameter)
        drag = drag + 2.0 * speed * (by_oil + by_load)
    return power_loss + drag
