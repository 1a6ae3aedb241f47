"""Bearing drag."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform
from mixedlub.laws.drag import bearing_asperity_share, palmgren_idle_torque, palmgren_load_torque

_SIZE = 1.25
_TYPICAL_LOAD = 3000.0
_LEAST_LOAD = 0.1


@effect(
    stage="loss",
    acts_on="power_loss",
    parameters=(
        Parameter(
            "strength",
            "-",
            LogNormal(0.6, 1.0),
            "factor on the torque, for bearing size and design",
            null=0.0,
            symbol="c",
            nominal=1.0,
        ),
        Parameter(
            "loaded",
            "-",
            LogNormal(1.0, 0.8),
            "factor on the load-dependent part, relative to the other part",
            symbol="c_1",
        ),
        Parameter(
            "load_power",
            "-",
            Uniform(1.0, 1.6),
            "exponent of load in that part: 1 for rollers, about 1.5 for balls",
            symbol="a",
        ),
        Parameter(
            "idle",
            "-",
            Uniform(0.0, 1.0),
            "share of the torque from rolling in oil: 0 where friction is a constant share of load",
            symbol="c_0",
            nominal=1.0,
        ),
        Parameter("rolling_power", "-", Uniform(0.0, 0.54), "exponent of load in the rolling torque", symbol="b"),
        Parameter(
            "rubbing",
            "-",
            Uniform(0.0, 2.0),
            "relative rise of the load-dependent part where the bearing's film has collapsed",
            symbol="m",
            published=(0.0, 1.4),
        ),
    ),
    equation=r"P_L \leftarrow P_L + c\,\sum_{i=1,2} 2\,\omega_i\,"
    r"[c_0 x^b M_{0,i} + \chi c_1 x^{a-1} (1 + m\,\phi_{bl,i}) M_1],\quad "
    r"x = \max(\chi F_t/F_r,\ 0.1),\ F_r = 3\,\text{kN},\ "
    r"M_1 = f_1\,\tfrac12 F_t d_m,\ f_1 = 0.0003,\ d_m = 1.25\,r_1,\quad "
    r"M_{0,i} = 2\times10^{-7}\,\max(N_i,\ 2000)^{2/3} d_m^3,\ "
    r"\phi_{bl,i} = \exp(-2.6\times10^{-8}\,N_i^{1.4} d_m),\ "
    r"N_i = \nu\,\frac{30\,\omega_i}{\pi},\ \nu = \frac{\eta_0}{\rho}\ "
    r"(\text{torques in N mm, lengths in mm, }\nu\text{ in mm}^2/\text{s})",
    source="A. Palmgren, Grundlagen der Waelzlagertechnik, 1964; ISO/TR 14179-2; T. A. Harris, Rolling Bearing "
    "Analysis, for f_1 that grows with load in ball bearings; SKF General Catalogue, 2005, for rolling torque with "
    "load^0.54; SKF, Rolling Bearings, 2018, for phi_bl and 0.12 over 0.05 in mineral oil (m = 1.4), and for a "
    "constant coefficient of friction, 0.0010 to 0.0024",
    fingerprint={"load": "-", "speed": "0", "roughness": "-"},
    special_cases={
        "Palmgren": {"load_power": 1.0, "idle": 1.0, "rolling_power": 0.0, "rubbing": 0.0},
        "constant coefficient": {"loaded": 4.0, "load_power": 1.0, "idle": 0.0, "rolling_power": 0.0, "rubbing": 0.0},
    },
    separated_by="the bearings alone on their rig, or their own oil supply; a change of flank finish leaves it "
    "where it was",
)
def bearing_drag(
    power_loss: np.ndarray,
    transmitted_force: np.ndarray,
    pinion_radius: np.ndarray,
    pinion_speed: np.ndarray,
    gear_speed: np.ndarray,
    viscosity: np.ndarray,
    oil_density: np.ndarray,
    gears_fitted: np.ndarray,
    *,
    strength: float,
    loaded: float,
    load_power: float,
    idle: float,
    rolling_power: float,
    rubbing: float,
) -> np.ndarray:
    """Four rolling bearings add drag: one part from rolling in oil, one from the tooth force that they carry.

    Two bearings per shaft carry half the force each; they are as large as the pinion shaft allows. Palmgren's constant
    and the reference force F_r = 3 kN make the form belong to SI. Without the idle torque (c_0 = 0, c_1 = 4)
    friction is the coefficient f = 0.0024 c of load on a journal of diameter d_m.

    >>> gear = dict(transmitted_force=3000.0, pinion_radius=0.036, pinion_speed=157.1, gear_speed=102.7, gears_fitted=1)
    >>> palmgren = dict(strength=1.0, loaded=1.0, load_power=1.0, idle=1.0, rolling_power=0.0, rubbing=0.0)
    >>> round(bearing_drag(0.0, **gear, viscosity=0.01275, oil_density=850.0, **palmgren))   # 15.7 kW
    17
    """
    diameter = _SIZE * pinion_radius
    size = np.where(gears_fitted > 0, np.maximum(transmitted_force / _TYPICAL_LOAD, _LEAST_LOAD), _LEAST_LOAD)
    growth = size ** (load_power - 1.0)
    by_load = loaded * gears_fitted * growth * palmgren_load_torque(0.5 * transmitted_force, diameter)
    drag = 0.0
    for speed in (pinion_speed, gear_speed):
        oil = (viscosity, oil_density, speed, diameter)
        by_oil = idle * size**rolling_power * palmgren_idle_torque(*oil)
        drag = drag + 2.0 * speed * (by_oil + by_load * (1.0 + rubbing * bearing_asperity_share(*oil)))
    return power_loss + strength * drag
