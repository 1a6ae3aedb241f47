"""Lay of the roughness."""

import numpy as np

from mixedlub.effect import Between, LogNormal, Normal, Parameter, effect


@effect(
    stage="film",
    acts_on="film_thickness",
    parameters=(
        Parameter(
            "lay", "-", Normal(0.0, 0.4), "positive for ridges across the motion, negative along", null=0.0, symbol="a"
        ),
        Parameter("onset", "-", LogNormal(0.4, 0.8), "film ratio at which ridges begin to matter", symbol=r"\lambda_r"),
        Parameter("decay", "-", Between(1.0, 2.2), "power with which it fades in thicker films", symbol="k"),
    ),
    equation=r"h \leftarrow h\,\left[1 + \left(\frac{\lambda_r}{h/\sigma}\right)^{k}\right]^{a}",
    source="N. Patir, H. S. Cheng, J. Lubr. Technol. 100 (1978) 12: first order of the flow factor, phi_x = 1 "
    "- 3 [(2-gamma)/(1+gamma)] (sigma/h)^2 (J. H. Tripp, J. Lubr. Technol. 105 (1983) 458), bounded",
    fingerprint={"load": "+", "speed": "+", "oil_temperature": "-", "roughness": "-", "slide_roll_ratio": "+"},
    separated_by="the same Rq with turned lay or an isotropic finish: it changes sign or vanishes, an error of Rq "
    "does not",
    valid={"composite_roughness": (0.0, 5e-6)},
    after=("inlet_shear_heating", "inlet_shear_thinning", "starvation"),
)
def roughness_lay(
    film_thickness: np.ndarray, composite_roughness: np.ndarray, *, lay: float, onset: float, decay: float
) -> np.ndarray:
    """Ridges across the motion hold oil back and thicken the film, ridges along it let the oil out.

    The power form keeps the film positive for either sign and any roughness; a = 1, k = 1, lambda_r = 0.15 adds
    0.15 sigma to the film, a = -1 takes as much away where the film is thick.

    >>> round(float(roughness_lay(0.5, 0.5, lay=1.0, onset=0.15, decay=1.0)), 3)
    0.575
    >>> round(float(roughness_lay(3.0, 1.0, lay=0.2, onset=1.0, decay=2.0)) / 3.0, 3)   # fades as 1/lambda^2
    1.021
    """
    return film_thickness * (1.0 + (onset * composite_roughness / film_thickness) ** decay) ** lay
