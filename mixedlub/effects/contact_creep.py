"""Elastic creep of a contact at low slip."""

import numpy as np

from mixedlub.effect import LogNormal, Parameter, effect


@effect(
    stage="shear",
    acts_on="friction",
    parameters=(
        Parameter("saturation_slip", "-", LogNormal(0.015, 1.0), "slip at which the whole contact slides", null=0.0),
        Parameter("power", "-", LogNormal(2.4, 0.25), "3 for a point contact of like bodies, 2 for a line contact"),
    ),
    equation=r"\mu \leftarrow \mu\,[1 - (1 - S/S_c)^m]\quad (S < S_c)",
    source="P. J. Vermeulen, K. L. Johnson, J. Appl. Mech. 31 (1964) 338, m = 3; "
    "F. W. Carter, Proc. R. Soc. A 112 (1926) 151, m = 2",
    fingerprint={"slide_roll_ratio": "+"},
    separated_by="a sweep of slip below one per cent at constant speed: the rise is proportional to slip and does "
    "not depend on viscosity or speed as a fluid film does",
    valid={"slide_roll_ratio": (0.0, 0.5)},
    kinds=("disc", "friction_history"),
)
def contact_creep(friction, slide_roll_ratio, *, saturation_slip, power):
    """Part of a nominal slip is taken up by elastic shear of the bodies, so friction starts in proportion to slip.

    >>> contact_creep(0.06, np.array([0.0, 0.01, 0.05]), saturation_slip=0.02, power=3.0).round(4).tolist()
    [0.0, 0.0525, 0.06]
    """
    sticking = np.maximum(saturation_slip - slide_roll_ratio, 0.0) / max(saturation_slip, 1e-12)
    return friction * (1.0 - sticking**power)
