"""Chain with a film and asperities that share the load: the film thins until both together carry it."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence

import numpy as np

from mixedlub.chain.effect import Effect
from mixedlub.chain.model import Chain, Law, Model, Parameters
from mixedlub.laws import balance
from mixedlub.laws.contact import mean_hertz_pressure
from profiles.errors import InputError

_CLOSE, _MOST_STEPS = 1e-12, 80
"""Cost limits. Converged difference of the logarithms, and largest number of steps."""
_LEAST = 1e-290
"""Smallest share of the asperities, near the smallest number with a finite logarithm."""
_FARTHEST = 700.0
"""Largest logit of the asperities' share: the film carries 1e-304 of the load."""


def balanced_film(
    full_load_film: np.ndarray,
    mean_pressure: np.ndarray,
    sharing_exponent: float,
    carried: Callable[[np.ndarray], np.ndarray],
) -> np.ndarray:
    r"""Film thickness at which film and asperities together carry the load (m).

    .. math:: \frac{p_a(h)}{p_m} + \left(\frac{h}{h_0}\right)^{-1/k} = 1

    with the asperity pressure p_a (``carried``, decreasing with the film), the mean Hertz pressure p_m and the film h_0
    that carries the whole load. Newton's iteration in the logit z of the asperities' share, :math:`h = h_0(1 + e^z)^k`,
    on the difference of the logarithms of both sides, with the slope of p_a from its last two values; a step outside
    the bracket of the root is replaced by bisection.

    >>> film = balanced_film(np.array(1e-7), np.array(0.5e9), 0.13, lambda h: 1e9 * np.exp(-h / 2e-7))
    >>> round(float(1e9 * np.exp(-film / 2e-7) / 0.5e9 + (film / 1e-7) ** (-1 / 0.13)), 12)
    1.0
    """
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        return full_load_film * np.exp(
            sharing_exponent * _root(full_load_film, mean_pressure, sharing_exponent, carried)
        )


def _root(film: np.ndarray, pressure: np.ndarray, k: float, carried: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
    """Logarithm of total over film load, ln(1 + e^z)."""

    def log_share(thicker: np.ndarray) -> np.ndarray:
        """Logarithm of the asperities' share, for a film thicker by this factor than under the whole load."""
        return np.log(np.maximum(carried(film * thicker) / pressure, _LEAST))

    thicker, before = np.array(1.0 + 1e-4), log_share(np.ones(()))
    slope = np.minimum((log_share(thicker) - before) / 1e-4, 0.0)
    thicker = np.ones(())
    z = np.where(before > 0.0, np.log1p(before / np.maximum(-slope, _LEAST)) / k, before)
    low, high = np.minimum(before, 0.0) - 30.0, np.full_like(z, _FARTHEST)
    z = np.clip(z, low, high)
    wrong = np.full_like(z, np.inf)
    for _ in range(_MOST_STEPS):
        # ln(1 + e^z) as below takes a sixth of the time of np.logaddexp.
        less = np.exp(-np.abs(z))
        growth = np.maximum(z, 0.0) + np.log(1.0 + less)
        last, thicker = thicker, np.exp(k * growth)
        now = log_share(thicker)
        wrong, wrong_before = now + growth - z, wrong
        found = np.abs(wrong) < _CLOSE
        # the error of a secant step is about the product of the last two
        last_step = bool((found | (np.abs(wrong * wrong_before) < _CLOSE)).all())
        moved = thicker - last
        known = np.abs(moved) > 1e-9 * thicker
        slope = np.where(known, np.minimum((now - before) / np.where(known, moved, 1.0), 0.0), slope)
        before = now
        low, high = np.where(wrong > 0.0, z, low), np.where(wrong > 0.0, high, z)
        share = np.where(z > 0.0, 1.0, less) / (1.0 + less)
        step = wrong / ((1.0 - share) - slope * thicker * k * share)
        # pressure falls with the film itself, which grows with z as e^(kz) where asperities carry most
        step = np.where(z > 0.0, np.log(np.maximum(1.0 + k * step, 0.1)) / k, step)
        closer = np.where((z + step > low) & (z + step < high), z + step, 0.5 * (low + high))
        z = np.where(found, z, closer)
        if last_step:
            break
    return np.logaddexp(0.0, z)


def balanced(chain: Chain) -> Chain:
    """The chain with a film that shares the load with the asperities, by the chain's laws for both.

    >>> from mixedlub.base_model.chains import LINE
    >>> names = [name for name, _ in balanced(LINE)]
    >>> names[names.index("full_load_film") :][:3]
    ['full_load_film', 'film_thickness', 'film_load_share']
    """
    laws = dict(chain)
    exponent = sharing_exponent(laws["film_thickness"])
    shared = (
        ("sharing_exponent", _constant(exponent)),
        ("full_load_film", balance.full_load_film),
        ("film_thickness", _film_law(laws["separation"], laws["asperity_pressure"])),
        ("film_load_share", balance.film_load_share),
        ("least_film_share", balance.least_film_share),
    )
    place = [name for name, _ in chain].index("separation")
    return (*chain[:place], *shared, *chain[place:])


def _constant(exponent: float) -> Law:
    """The exponent as a law of the chain."""

    def law() -> float:
        return exponent

    law.__doc__ = sharing_exponent.__doc__
    return law


def _film_law(separation: Law, asperity_pressure: Law) -> Law:
    """The balanced film as a law of the chain: arguments of both laws except the film."""
    gap, load = (tuple(inspect.signature(law).parameters) for law in (separation, asperity_pressure))
    made = ("film_thickness", "separation")
    others = [name for name in dict.fromkeys((*gap, *load)) if name not in made]
    names = ("full_load_film", "hertz_pressure", "sharing_exponent", *others)

    def film_thickness(*values: np.ndarray) -> np.ndarray:
        state = dict(zip(names, values, strict=True))

        def carried(film: np.ndarray) -> np.ndarray:
            state["film_thickness"] = film
            if "separation" in load:
                state["separation"] = separation(*(state[name] for name in gap))
            found: np.ndarray = asperity_pressure(*(state[name] for name in load))
            return found

        pressure = mean_hertz_pressure(state["hertz_pressure"])
        return balanced_film(state["full_load_film"], pressure, float(state["sharing_exponent"]), carried)

    kind = inspect.Parameter.POSITIONAL_OR_KEYWORD
    # A function may state its signature, which its type does not declare.
    film_thickness.__signature__ = inspect.Signature([inspect.Parameter(n, kind) for n in names])  # type: ignore[attr-defined]
    film_thickness.__doc__ = JOHNSON_GREENWOOD_POON
    return film_thickness


JOHNSON_GREENWOOD_POON = r"""Film thickness at which film and asperities together carry the load (m).

    .. math:: \frac{p_a(h)}{p_m} + \frac{1}{\gamma} = 1,\quad h = h_0\,\gamma^k

    with the pressure :math:`p_a` of the asperities, the mean Hertz pressure :math:`p_m`, and the film :math:`h_0` that
    carries the whole load; k is 0.13 for Dowson and Toyoda. Source: K. L. Johnson, J. A. Greenwood, S. Y. Poon, Wear 19
    (1972) 91.
    """


def sharing_exponent(film_law: Law, effects: Sequence[Effect] = (), values: Parameters | None = None) -> float:
    r"""Exponent k of the film over the ratio of total to film load, :math:`h = h_0\gamma^k` (-).

    From the law, with effects on its film, at the load :math:`w/\gamma` and the modulus :math:`E'/\gamma` relative to w
    and E'; for a power law in U and G, k is the exponent of U minus the exponent of G, at line and point contacts.
    Raises an error for other laws. Source: K. L. Johnson, J. A. Greenwood, S. Y. Poon, Wear 19 (1972) 91.

    >>> from mixedlub.laws.film import dowson_higginson, dowson_toyoda, hamrock_dowson
    >>> [round(sharing_exponent(law), 12) for law in (dowson_toyoda, dowson_higginson, hamrock_dowson)]
    [0.13, 0.16, 0.14]
    """
    if not _STEEL.keys() >= set(inspect.signature(film_law).parameters):
        raise InputError("needs a film law of the contact's groups alone", where="balance")
    model = Model((("film_thickness", film_law),), tuple(_STEEL), ("film_thickness",), effects)

    def film(ratio: float) -> float:
        contact = {name: value / (ratio if name in _SHARED else 1.0) for name, value in _STEEL.items()}
        return float(model(contact, values)["film_thickness"])

    near, far = (np.log(film(ratio) / film(1.0)) / np.log(ratio) for ratio in (2.0, 1e3))
    if not (near > 0.0 and abs(far - near) < 1e-9):
        raise InputError("needs a film law in powers of speed, load and modulus, thicker at less load", where="balance")
    return float(near)


_STEEL = {
    "radius": 0.01,
    "entrainment_speed": 2.0,
    "transverse_radius": 0.01,
    "line_load": 2e5,
    "load": 100.0,
    "viscosity": 0.015,
    "pressure_viscosity": 1.5e-8,
    "reduced_modulus": 2.26e11,
}
"""A contact of steel (SI); a power law has the same exponent at any contact."""
_SHARED = ("line_load", "load", "reduced_modulus")
