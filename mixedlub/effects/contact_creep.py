"""Elastic creep of a contact at low slip."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Uniform

REFERENCE_FRICTION = 0.05
"""Friction coefficient at which the saturation slip is stated."""
REFERENCE_PRESSURE = 1e9
"""Hertz pressure (Pa) at which the saturation slip is stated."""
CARTER, VERMEULEN_JOHNSON = 8.8e-4, 7.7e-4
"""That slip of steel bodies alone: 4 mu p_0/E' of a line contact, 2 mu p_0 (0.609)/G of a circle at Poisson's 0.3."""


@effect(
    stage="shear",
    acts_on="friction",
    parameters=(
        Parameter(
            "saturation_slip",
            "-",
            LogNormal(0.015, 1.5),
            "slip at which the whole contact slides, at a friction coefficient of 0.05 and 1 GPa",
            null=0.0,
            symbol="S_0",
            nominal=CARTER,
        ),
        Parameter(
            "power",
            "-",
            LogNormal(2.4, 0.6),
            "exponent of the creep law: 3 for a point contact of like bodies, 2 for a line contact",
            symbol="m",
        ),
        Parameter(
            "elastic",
            "-",
            Uniform(0.0, 1.0),
            "exponent of friction times pressure in that slip: 1 for elastic shear of the bodies alone",
            symbol="k",
        ),
        Parameter(
            "of_asperities",
            "-",
            Uniform(0.0, 1.0),
            "share of the asperity friction that follows the creep law too",
            symbol="a",
        ),
    ),
    equation=r"\mu \leftarrow \mu - [\mu - (1 - a)\,\mu_B P_B]\,(1 - S/S_c)^m\quad (S < S_c),\quad "
    r"S_c = S_0\left(\frac{\mu}{0.05}\,\frac{p_0}{\text{1 GPa}}\right)^k",
    source="P. J. Vermeulen, K. L. Johnson, J. Appl. Mech. 31 (1964) 338, m = 3; "
    "F. W. Carter, Proc. R. Soc. A 112 (1926) 151, m = 2; K. L. Johnson, J. L. Tevaarwerk, Proc. R. Soc. A 356 (1977) "
    "215, film and bodies yielding under the film's traction alone (a = 0)",
    fingerprint={"slide_roll_ratio": "+"},
    applied_after=("mixture_law",),
    special_cases={
        "Carter": {"saturation_slip": CARTER, "power": 2.0, "elastic": 1.0, "of_asperities": 1.0},
        "Vermeulen and Johnson": {
            "saturation_slip": VERMEULEN_JOHNSON,
            "power": 3.0,
            "elastic": 1.0,
            "of_asperities": 1.0,
        },
        "bodies alone": {"elastic": 1.0},
        "one slip": {"elastic": 0.0},
    },
    separated_by="a sweep of slip below one per cent at constant speed: the rise is proportional to slip and does "
    "not depend on viscosity or speed as a fluid film does",
    valid={"slide_roll_ratio": (0.0, 0.5)},
    kinds=("disc", "friction_history", "mesh_friction"),
)
def contact_creep(
    friction: np.ndarray,
    boundary_friction: np.ndarray,
    area_ratio: np.ndarray,
    slide_roll_ratio: np.ndarray,
    hertz_pressure: np.ndarray,
    *,
    saturation_slip: float,
    power: float,
    elastic: float,
    of_asperities: float,
) -> np.ndarray:
    """Elastic shear of the bodies takes up part of the slip, so friction at low slip is proportional to slip.

    Creep is proportional to traction, so full sliding begins at a slip proportional to friction and pressure;
    wheel-rail laws often use one constant slip. In dry contact this holds for all friction. In lubricated contact it
    may hold for the film's traction only: asperities meet and part many times in a passage and may slide from first
    touch. Steel bodies alone have S_0 of 0.0009 (Carter) or 0.0008 (Vermeulen and Johnson); the film and the fixtures
    of a rig give way too, to 0.03 and more, and the prior reaches over both. The reference pressure of 1 GPa of S_0
    makes the form belong to Pa.

    >>> S, creep = np.array([0.0, 0.01, 0.05]), dict(saturation_slip=0.02, power=3.0, elastic=1.0)
    >>> contact_creep(0.05, 0.1, 0.2, S, 1e9, **creep, of_asperities=1.0).round(5).tolist()
    [0.0, 0.04375, 0.05]
    >>> contact_creep(0.05, 0.1, 0.2, S, 1e9, **creep, of_asperities=0.0).round(5).tolist()   # 0.1 x 0.2 stays
    [0.02, 0.04625, 0.05]
    """
    pressed = np.maximum(friction, 0.0) / REFERENCE_FRICTION * (hertz_pressure / REFERENCE_PRESSURE)
    slides = saturation_slip * pressed**elastic
    sticking = np.maximum(slides - slide_roll_ratio, 0.0) / np.maximum(slides, 1e-12)
    return friction - (friction - (1.0 - of_asperities) * boundary_friction * area_ratio) * sticking**power
