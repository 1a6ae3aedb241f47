"""Film thickness of line contacts and of a ball on a flat by other laws than the base model's."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mixedlub.validation.contact import Contact
from mixedlub.validation.rig import FILM, Law
from mixedlub.validation.rigs.ball import lubricate_ball_in_any_regime
from mixedlub.validation.worlds import follow

Groups = tuple[np.ndarray, np.ndarray, np.ndarray]
Height = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]
"""Film over the radius from the groups of speed U, material G and load W."""


def groups(c: Contact) -> Groups:
    """U = eta u/(E' R) with the mean speed u, G = alpha E', and W = w/(E' R) of a line or F/(E' R^2) of a point."""
    modulus, radius = c.rig.solid.reduced, c.rig.radius
    size = modulus * radius
    load = c.force / (size * radius) if c.rig.is_point else c.line_load / size
    return c.viscosity * c.entrainment / size, c.pressure_viscosity * modulus, load


def dowson_higginson_1966(u: np.ndarray, g: np.ndarray, w: np.ndarray) -> np.ndarray:
    """H_min = 1.6 U^0.7 G^0.6 W^-0.13 (Dowson and Higginson, Elasto-hydrodynamic lubrication, 1966).

    A minimum film, often used as the film thickness; elastic and piezoviscous contacts. Also in ISO/TR 15144-1.
    """
    return np.asarray(1.6 * u**0.70 * g**0.60 * w**-0.13)


def dowson_higginson_1968(u: np.ndarray, g: np.ndarray, w: np.ndarray) -> np.ndarray:
    """H_min = 2.65 U^0.7 G^0.54 W^-0.13 (Dowson, Proc. Instn Mech. Engrs 182 (1968) 151).

    A minimum film; elastic and piezoviscous contacts. Within 12 % of full solutions at the conditions of gears.
    """
    return np.asarray(2.65 * u**0.70 * g**0.54 * w**-0.13)


def grubin(u: np.ndarray, g: np.ndarray, w: np.ndarray) -> np.ndarray:
    """H = 1.95 (U G)^(8/11) W^(-1/11) (Grubin 1949, after Ertel), for heavily loaded contacts.

    >>> round(float(grubin(np.array(1e-11), np.array(5000.0), np.array(1e-4))), 8)
    2.207e-05
    """
    return np.asarray(1.95 * (u * g) ** (8 / 11) * w ** (-1 / 11))


def pan_hamrock(u: np.ndarray, g: np.ndarray, w: np.ndarray) -> np.ndarray:
    """H_c = 2.922 U^0.692 G^0.470 W^-0.166 (Pan and Hamrock, J. Tribol. 111 (1989) 246), central, compressible.

    The constants were not compared with the print; they lie within 18 % of full solutions for U 1e-12 to 1e-10.
    """
    return np.asarray(2.922 * u**0.692 * g**0.470 * w**-0.166)


def moes(u: np.ndarray, g: np.ndarray, w: np.ndarray) -> np.ndarray:
    """Flow film of a line contact, rigid or elastic, isoviscous or not (Moes 1992; Venner's form of 1991).

    With M = W (2 U)^-1/2 and L = G (2 U)^1/4 four asymptotes, 3/M, 1.287 L^2/3, 2.621 M^-1/5 and
    1.311 M^-1/8 L^3/4, are joined by powers.
    """
    double = 2 * u
    m, ell = w * double**-0.5, g * double**0.25
    rigid, elastic = 3 / m, 2.621 * m**-0.2
    rigid_thick, elastic_thick = 1.287 * ell ** (2 / 3), 1.311 * m**-0.125 * ell**0.75
    power = (7 + 8 * np.exp(-2 * elastic / rigid)) / 5
    isoviscous = (rigid ** (7 / 3) + elastic ** (7 / 3)) ** (3 / 7)
    thick = (rigid_thick**-3.5 + elastic_thick**-3.5) ** (-2 / 7)
    return np.asarray(np.sqrt(double) * (isoviscous**power + thick**power) ** (1 / power))


def chittenden(u: np.ndarray, g: np.ndarray, w: np.ndarray) -> np.ndarray:
    """H_c = 4.31 U^0.68 G^0.49 W^-0.073 (1 - e^-1.23) of a ball on a flat.

    Chittenden, Dowson, Dunn and Taylor, Proc. R. Soc. A 397 (1985) 245, with equal radii along and across the motion.
    The constants were not compared with the print; they lie within 9 % of Hamrock and Dowson's law.
    """
    return np.asarray(4.31 * u**0.68 * g**0.49 * w**-0.073 * -np.expm1(-1.23))


def _law(name: str, source: str, height: Height) -> Law:
    def lubricated(c: Contact) -> Contact:
        return replace(c, film=c.rig.radius * height(*groups(c)))

    return Law(FILM, name, source, lambda c: follow(c, "film", lubricated))


LINE = (
    _law("Dowson and Higginson 1966, minimum", "Dowson and Higginson 1966", dowson_higginson_1966),
    _law("Dowson and Higginson 1968, minimum", "Dowson 1968", dowson_higginson_1968),
    _law("Grubin", "Grubin 1949", grubin),
    _law("Pan and Hamrock, central", "Pan and Hamrock 1989", pan_hamrock),
    _law("Moes, all regimes", "Moes 1992", moes),
)
POINT = (
    _law("Chittenden and others, central", "Chittenden, Dowson, Dunn and Taylor 1985", chittenden),
    Law(
        FILM,
        "Nijenbanning, Venner and Moes, all regimes",
        "Nijenbanning, Venner and Moes 1994",
        lambda c: follow(c, "film", lubricate_ball_in_any_regime),
    ),
)
