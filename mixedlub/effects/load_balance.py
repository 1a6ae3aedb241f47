"""Film and asperities that share the load."""

from collections.abc import Sequence

import numpy as np

from mixedlub.base_model.balanced import balanced_film, sharing_exponent
from mixedlub.chain.effect import Effect, Parameter, effect
from mixedlub.chain.model import Chain, Parameters
from mixedlub.chain.priors import LogNormal
from mixedlub.laws.contact import pressure_per_overlap, summit_separation
from mixedlub.laws.film import DOWSON_TOYODA
from profiles.errors import InputError
from roughness.integrals import load_integral

EXPONENT = DOWSON_TOYODA.speed - DOWSON_TOYODA.material


def exponent_of_film(chain: Chain, effects: Sequence[Effect], values: Parameters) -> float:
    """Exponent of the film law of a chain, or of the effect that replaces it (-)."""
    others = [e for e in effects if e.replaces == "film thickness"]
    try:
        return sharing_exponent(dict(chain)["film_thickness"], others, values)
    except InputError as error:
        laws = " and ".join(f"effects.{e.id}" for e in others) or "the film law"
        raise InputError(f"{error.rule}, unlike {laws}; state it", where="effects.load_balance.exponent") from None


@effect(
    stage="law",
    acts_on="film_thickness",
    parameters=(
        Parameter(
            "stiffness", "-", LogNormal(1.0, 0.5), "factor on the pressure of the asperities", null=0.0, symbol="c"
        ),
        Parameter(
            "exponent",
            "-",
            LogNormal(EXPONENT, 0.3),
            "exponent of whole over film load in the growth of the film; that of the film law unless stated",
            symbol="k",
            of_chain=exponent_of_film,
        ),
    ),
    equation=r"h \leftarrow h\,\gamma^{k},\quad \gamma = \frac{p_m}{p_m - c\,p_a},\quad "
    r"p_a = \tfrac23 E' D R_s^{1/2}\sigma_s^{3/2} F(t),\ t = \frac{h\gamma^k - z_s}{\sigma_s},\quad "
    r"F(t) = \int_t^\infty (z - t)^{3/2}\,\frac{e^{-z^2/2}}{\sqrt{2\pi}}\,dz",
    source="K. L. Johnson, J. A. Greenwood, S. Y. Poon, Wear 19 (1972) 91; E. R. M. Gelinck, D. J. Schipper, Tribol. "
    "Int. 33 (2000) 175",
    fingerprint={"load": "+", "oil_temperature": "-", "roughness": "-"},
    separated_by="contact resistance over speed: a film that shares the load never falls far below the roughness",
    applied_after=(
        "inlet_shear_heating",
        "inlet_shear_thinning",
        "starvation",
        "roughness_lay",
        "film_law",
        "soft_contact_film",
        "boundary_film",
        "boundary_film_temperature",
    ),
    replaces="load of film and asperities",
    special_cases={"Johnson, Greenwood and Poon": {"stiffness": 1.0, "exponent": EXPONENT}},
)
def load_balance(
    film_thickness: np.ndarray,
    mean_pressure: np.ndarray,
    plane_offset: np.ndarray,
    summit_sigma: np.ndarray,
    summit_density: np.ndarray,
    summit_radius: np.ndarray,
    reduced_modulus: np.ndarray,
    *,
    stiffness: float,
    exponent: float,
) -> np.ndarray:
    """Asperities carry part of the load, and the film, which carries the rest, is thicker.

    The base law imposes the film of smooth surfaces on the rough ones; below a film ratio of about 1 its asperities
    would carry more than the load.

    >>> from mixedlub.laws.contact import asperity_pressure
    >>> rough = (0.2214e-6, 0.7573e9, 0.13298e-6, 0.48970e-6, 4.4106e10, 7.8332e-6, 226.374e9)
    >>> h = load_balance(*rough, stiffness=1.0, exponent=0.13)
    >>> load = asperity_pressure((h - 0.13298e-6) / 0.48970e-6, 4.4106e10, 7.8332e-6, 0.48970e-6, 226.374e9)
    >>> round(float(h) * 1e6, 3), round(float(load / 0.7573e9 + (h / 0.2214e-6) ** (-1 / 0.13)), 9)
    (0.512, 1.0)
    """
    if stiffness == 0.0:
        return film_thickness

    whole = stiffness * pressure_per_overlap(summit_density, summit_radius, summit_sigma, reduced_modulus)

    def carried(film: np.ndarray) -> np.ndarray:
        return whole * load_integral(summit_separation(film, plane_offset, summit_sigma))

    return balanced_film(film_thickness, mean_pressure, exponent, carried)
