"""Film of a soft point contact with too low a pressure to thicken the oil."""

import numpy as np

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import Normal
from mixedlub.laws.film import hamrock_dowson_soft


@effect(
    stage="law",
    acts_on="film_thickness",
    parameters=(
        Parameter(
            "share", "-", Normal(1.0, 0.1), "way from the film of hard to that of soft contacts", null=0.0, symbol="s"
        ),
    ),
    equation=r"h \leftarrow h\left(\frac{h_s}{h_r}\right)^{s},\quad h_s = 7.32\,R\,(1 - 0.72\,e^{-0.28\,k})"
    r"\left(\frac{\eta_0 u}{E' R}\right)^{0.64}\left(\frac{F}{E' R^2}\right)^{-0.22},\quad "
    r"k = 1.03\left(\frac{R_y}{R}\right)^{0.64}",
    source="B. J. Hamrock, D. Dowson, J. Lubr. Technol. 100 (1978) 236",
    fingerprint={},
    separated_by="speed and load: a soft film grows with U^0.64 and falls with W^0.22, and oils of equal viscosity but "
    "another pressure-viscosity coefficient give the same one",
    valid={"isoviscous_ratio": (1.0, np.inf)},
    offered_within={"isoviscous_ratio": (1.0, np.inf)},
    applied_after=("inlet_shear_heating", "inlet_shear_thinning", "starvation", "roughness_lay"),
    kinds=("film",),
    replaces="film thickness",
    special_cases={"Hamrock and Dowson, soft contacts": {"share": 1.0}},
)
def soft_contact_film(
    film_thickness: np.ndarray,
    regression_film: np.ndarray,
    radius: np.ndarray,
    transverse_radius: np.ndarray,
    entrainment_speed: np.ndarray,
    load: np.ndarray,
    viscosity: np.ndarray,
    reduced_modulus: np.ndarray,
    *,
    share: float,
) -> np.ndarray:
    """The film of a soft point contact follows the law of isoviscous elastic contacts.

    Rubber and soft plastics flatten at pressures of some MPa, at which oils hardly thicken. It is offered where the
    contacts of most readings are such.

    >>> ball = (9.5e-3, 9.5e-3, 0.01, 1.0, 0.28938, 2.667e8)   # on rubber; regression 83.9 nm
    >>> round(float(soft_contact_film(83.9e-9, 83.9e-9, *ball, share=1.0) * 1e9))
    557
    """
    soft = hamrock_dowson_soft(radius, transverse_radius, entrainment_speed, load, viscosity, reduced_modulus)
    return film_thickness * (soft / regression_film) ** share
