"""Load sharing between film and asperities, and weighting of their friction."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mixedlub.validation.contact import Contact, dowson_toyoda
from mixedlub.validation.rig import ASPERITIES, BALANCE, FILM, MIXTURE, Law
from mixedlub.validation.rigs.ball import hamrock_dowson
from mixedlub.validation.worlds import follow
from mixedlub.validation.worlds.asperities import (
    Asperities,
    bush_gibson_thomas,
    greenwood_tripp,
    greenwood_williamson,
    persson,
)

HALVINGS, SEPARATED = 16, 9.0
"""Bisections of a balance, and rms heights above which asperities carry no load."""
Lighter = Callable[[Contact], Contact]
"""Contact with half the load carried by the film."""


def half_load(c: Contact) -> Contact:
    """Half the load on the same bodies: Johnson, Greenwood and Poon, Wear 19 (1972) 91."""
    return replace(c, force=0.5 * c.force, line_load=0.5 * c.line_load)


def half_load_and_modulus(c: Contact) -> Contact:
    """Half the load on bodies of half the modulus, so that the film keeps its shape: Gelinck and Schipper 2000.

    With gamma = 1/(1 - L) load and modulus scale by 1/gamma in the film law; Tribol. Int. 33 (2000) 175. Laws with
    equal powers of speed and material (Grubin's, one limit of Moes') give no film growth, hence no balance.
    """
    solid = replace(c.rig.solid, modulus=(0.5 * c.rig.solid.modulus[0], 0.5 * c.rig.solid.modulus[1]))
    return replace(half_load(c), rig=replace(c.rig, solid=solid))


def growth(c: Contact, lighter: Lighter) -> np.ndarray:
    """Exponent of film growth at falling load, exact for power laws: 0.1 or 0.13 for the base law."""
    law = c.rig.laws.get("film", hamrock_dowson if c.rig.is_point else dowson_toyoda)
    return np.asarray(np.log2(law(lighter(c)).film / law(c).film))


def mean_pressure(c: Contact) -> np.ndarray:
    """Mean pressure of the whole contact (Pa): 2/3 of the maximum in a point contact, pi/4 in a line contact."""
    return c.pressure * (2 / 3 if c.rig.is_point else np.pi / 4)


def balanced(c: Contact, asperities: Asperities, lighter: Lighter) -> tuple[np.ndarray, np.ndarray]:
    """Film (m) and the share L of the load that asperities carry: p_a(h) = L p with h = h_0 (1 - L)^-s, by bisection.

    h_0: film under full load; p: mean Hertz pressure. Unique, since asperity pressure falls and L rises with the film.
    """
    power, load = growth(c, lighter), mean_pressure(c)

    def excess(rise: np.ndarray) -> np.ndarray:
        """Pressure of the asperities above their share, at the logarithm of the film over h_0."""
        return np.asarray(asperities.pressure(c.film * np.exp(rise)) + np.expm1(-rise / power) * load)

    low = np.zeros_like(c.film)
    high = np.maximum(np.log(SEPARATED * c.roughness / c.film), 1e-12) + low
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        above = excess(middle) > 0
        low, high = np.where(above, middle, low), np.where(above, high, middle)
    # The chord of what is left: smooth in the inputs, as the fits of rivals need it.
    first, last = np.maximum(excess(low), 0.0), np.minimum(excess(high), 0.0)
    rise = low + (high - low) * first / np.maximum(first - last, 1e-300)
    return c.film * np.exp(rise), -np.expm1(-rise / power)


def meet(c: Contact) -> Contact:
    """Contact with film and share of boundary friction by the laws of asperities, balance and weighting.

    Without a balance, film and asperities both carry the whole load, as in the base model.
    """
    laws = c.rig.laws
    asperities = laws.get("asperities", greenwood_williamson)(c)
    carried = np.zeros_like(c.film)
    if "balance" in laws:
        film, carried = balanced(c, asperities, laws["balance"])
        c = replace(c, film=film)
    weight = laws["weight"](c, carried) if "weight" in laws else asperities.area(c.film)
    return replace(c, area=np.clip(weight, 0.0, 1.0))


def by_load(c: Contact, carried: np.ndarray) -> np.ndarray:
    """Share of the load on the asperities (Gelinck and Schipper 2000), with Coulomb friction."""
    return carried


def by_error_function(c: Contact, carried: np.ndarray) -> np.ndarray:
    """1 - erf(h/Rq), after tests of contact resistance (Arana, Larranaga and Ulacia 2018), for VG 220 and thinner oils.

    >>> from scipy.special import erfc
    >>> [round(float(erfc(x)), 4) for x in (0.5, 1.0, 1.5)]
    [0.4795, 0.1573, 0.0339]
    """
    from scipy.special import erfc

    return np.asarray(erfc(c.film / c.roughness))


def by_doleschel(c: Contact, carried: np.ndarray) -> np.ndarray:
    """(1 - h/(2 Ra))^2 below h = 2 Ra, none above (Doleschel 2003); mean Ra = sqrt(2/pi) Rq of both surfaces."""
    mean = 0.5 * np.sqrt(2 / np.pi) * np.sqrt(c.rig.shares[:, :, 0]).sum(axis=1)[:, None] * c.roughness
    return np.asarray(np.maximum(1 - 0.5 * c.film / mean, 0.0) ** 2)


def _met(
    id: str,
    step: str,
    name: str,
    source: str,
    law: Callable[..., object],
    needs: frozenset[str] = frozenset(),
    bars: frozenset[str] = frozenset(),
) -> Law:
    def enter(c: Contact) -> Contact:
        return follow(follow(c, step, law), "contact", meet)

    return Law(id, name, source, enter, needs=needs, bars=bars)


THEORIES = (
    _met(ASPERITIES, "asperities", "Greenwood and Tripp", "Greenwood and Tripp 1970", greenwood_tripp),
    _met(ASPERITIES, "asperities", "Bush, Gibson and Thomas", "Bush, Gibson and Thomas 1975", bush_gibson_thomas),
    _met(ASPERITIES, "asperities", "Persson", "Persson 2001", persson),
)
BALANCES = (
    _met(BALANCE, "balance", "Johnson, Greenwood and Poon", "Johnson, Greenwood and Poon 1972", half_load),
    _met(
        BALANCE,
        "balance",
        "Gelinck and Schipper",
        "Gelinck and Schipper 2000",
        half_load_and_modulus,
        bars=frozenset({FILM}),
    ),
)
MIXTURES = (
    _met(MIXTURE, "weight", "share of the load", "Gelinck and Schipper 2000", by_load, needs=frozenset({BALANCE})),
    _met(
        MIXTURE,
        "weight",
        "error function of the film parameter",
        "Arana, Larranaga and Ulacia 2018",
        by_error_function,
    ),
    _met(MIXTURE, "weight", "square of the film parameter", "Doleschel 2003", by_doleschel),
)
