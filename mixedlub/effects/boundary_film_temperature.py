"""Boundary film that forms with temperature."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Normal, Uniform
from mixedlub.laws.mixture import tallian_friction

SLOWEST = 1e-3
"""Sliding speed (m/s) below which the film has all the time that it needs."""


@effect(
    stage="boundary",
    acts_on="boundary_friction",
    parameters=(
        Parameter(
            "drop",
            "-",
            Normal(0.35, 0.35),
            "fall of ln boundary friction under the complete film",
            null=0.0,
            symbol="d",
        ),
        Parameter(
            "activation",
            "K",
            Uniform(318.0, 413.0),
            "temperature at which half the film has formed",
            symbol=r"\theta_f",
        ),
        Parameter(
            "width", "K", LogNormal(8.0, 0.5), "width of the temperature range in which the film forms", symbol="w"
        ),
        Parameter(
            "flash",
            "-",
            Uniform(0.0, 1.0),
            "share of the contact's flash temperature that activates the film",
            null=0.0,
            symbol="s",
            kinds=("gear_pair", "disc", "mesh_friction"),
        ),
        Parameter(
            "haste",
            "-",
            Uniform(0.0, 1.0),
            "exponent of sliding speed in the rate of activation: 0 temperature alone, 1 time of an encounter too",
            null=0.0,
            symbol="h",
            nominal=0.0,
            kinds=("gear_pair", "disc", "mesh_friction"),
        ),
    ),
    equation=r"\mu_B \leftarrow \mu_B \exp\left[-\frac{d}{1 + v^h e^{-(\theta - \theta_f)/w}}\right],\quad "
    r"\theta = \theta_{oil} + s\,\theta_\mu\,[\mu_E + (\mu_B - \mu_E)\,P_B],\quad "
    r"v = \max\left(\frac{v_s}{\text{1 m/s}},\ 10^{-3}\right)",
    source="H. Spikes, Tribol. Lett. 60 (2015) 5 (friction modifiers); the sigmoid is the usual description "
    "of activation, its coefficients are not from a table; h = 1 as E. P. Kingsbury, J. Appl. Phys. 29 (1958) 888, for "
    "molecules that leave the surface in heat",
    fingerprint={"oil_temperature": "-", "roughness": "-", "slide_roll_ratio": "+"},
    separated_by="oil without the additive, or film ratios above 3, where it vanishes; it sits between two "
    "temperatures, whereas everything viscous changes steadily",
    special_cases={"a film as warm as the oil": {"flash": 0.0, "haste": 0.0}},
    applied_after=(
        "boundary_speed_dependence",
        "friction_event",
        "friction_run_in",
        "tribofilm_growth",
        "two_time_scales",
        "wandering_surface_state",
    ),
)
def boundary_film_temperature(
    boundary_friction: np.ndarray,
    oil_temperature: np.ndarray,
    fluid_friction: np.ndarray,
    area_ratio: np.ndarray,
    flash_per_friction: np.ndarray,
    sliding_speed: np.ndarray,
    *,
    drop: float,
    activation: float,
    width: float,
    flash: float,
    haste: float,
) -> np.ndarray:
    """Above a certain temperature additives form a film on the asperities and change boundary friction.

    A negative drop raises friction. The film forms at the oil temperature plus a share of the flash temperature, which
    is computed with the friction without the film. Where the sliding speed is not known the flash temperature is left
    out. Molecules that come and go in heat leave fewer sites bare where surfaces meet for a shorter time; the reference
    speed of 1 m/s makes the form belong to m/s.

    >>> film = dict(drop=0.7, activation=353.15, width=8.0)
    >>> round(float(boundary_film_temperature(0.1, 353.15, 0.0, 0.0, 0.0, 1.0, **film, flash=0.0, haste=0.0)), 3)
    0.07
    >>> warm = dict(flash=1 / 3, haste=0.0)   # 20 K
    >>> round(float(boundary_film_temperature(0.1, 333.15, 0.05, 0.2, 1000.0, 1.0, **film, **warm)), 3)
    0.07
    >>> fast = np.array([0.1, 1.0, 10.0])   # ten times as fast as 18 K colder
    >>> boundary_film_temperature(0.1, 353.15, 0.0, 0.0, 0.0, fast, **film, flash=0.0, haste=1.0).round(4).tolist()
    [0.0529, 0.0705, 0.0938]
    """
    rise = flash * flash_per_friction * tallian_friction(fluid_friction, boundary_friction, area_ratio)
    colder = haste * np.log(np.maximum(sliding_speed, SLOWEST)) - (oil_temperature + rise - activation) / width
    return boundary_friction * np.exp(-drop / (1.0 + np.exp(colder)))
