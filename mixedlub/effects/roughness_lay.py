"""Lay of the roughness."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal, Normal, Uniform


@effect(
    stage="film",
    acts_on="film_thickness",
    parameters=(
        Parameter(
            "lay",
            "-",
            Normal(0.0, 0.4),
            "positive for transverse ridges, negative for longitudinal ridges",
            null=0.0,
            symbol="a",
        ),
        Parameter(
            "onset", "-", LogNormal(0.4, 0.8), "film parameter at which the lay begins to matter", symbol=r"\lambda_r"
        ),
        Parameter("decay", "-", Uniform(1.0, 2.2), "exponent of the decay in thicker films", symbol="k", nominal=2.0),
        Parameter(
            "saturation",
            "-",
            Uniform(0.0, 1.0),
            "film parameter below which the effect is constant",
            symbol=r"\lambda_s",
        ),
    ),
    equation=r"h \leftarrow h\,\left[1 + \left(\frac{\lambda_r}{\lambda}\right)^{k}\right]^{a},\quad "
    r"\lambda = \left[(h/\sigma)^4 + \lambda_s^4\right]^{1/4}",
    source="N. Patir, H. S. Cheng, J. Lubr. Technol. 100 (1978) 12: first order of the flow factor, phi_x = 1 "
    "- 3 [(2-gamma)/(1+gamma)] (sigma/h)^2 (J. H. Tripp, J. Lubr. Technol. 105 (1983) 458), bounded; "
    "the flow factors are given for h/sigma above 0.5, where ridges do not touch",
    fingerprint={"load": "+", "oil_temperature": "-", "roughness": "-", "slide_roll_ratio": "+"},
    separated_by="the same Rq with turned lay or an isotropic finish: it changes sign or vanishes, an error of Rq "
    "does not",
    valid={"composite_roughness": (0.0, 5e-6)},
    applied_after=("inlet_shear_heating", "inlet_shear_thinning", "starvation"),
)
def roughness_lay(
    film_thickness: np.ndarray,
    composite_roughness: np.ndarray,
    *,
    lay: float,
    onset: float,
    decay: float,
    saturation: float,
) -> np.ndarray:
    """Transverse roughness ridges retain oil and thicken the film; longitudinal ridges let oil escape.

    The power form keeps the film positive for either sign and any roughness; a = 1, k = 1, lambda_r = 0.15 adds 0.15
    sigma to the film; a = -1 removes as much where the film is thick. Where asperities carry the load the film law does
    not give the gap, and the effect keeps its value at lambda_s, 0 to 1.

    >>> round(float(roughness_lay(0.5, 0.5, lay=1.0, onset=0.15, decay=1.0, saturation=0.0)), 3)
    0.575
    >>> fades = dict(lay=0.2, onset=1.0, decay=2.0, saturation=0.5)   # as 1/lambda^2
    >>> (roughness_lay(np.array([1e-3, 0.5, 3.0]), 1.0, **fades) / np.array([1e-3, 0.5, 3.0])).round(3).tolist()
    [1.38, 1.308, 1.021]
    """
    ratio = np.hypot(film_thickness**2, (saturation * composite_roughness) ** 2) ** 0.5
    return film_thickness * (1.0 + (onset * composite_roughness / ratio) ** decay) ** lay
