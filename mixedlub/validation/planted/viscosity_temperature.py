"""Viscosity against temperature by laws other than ASTM D341, all through two known viscosities."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from mixedlub.validation.contact import KELVIN, Contact, Inputs, Oil
from mixedlub.validation.rig import Form, Knob, strength

Pair = tuple[float, float]
Law = Callable[[np.ndarray, Pair, Pair], np.ndarray]
"""Viscosity (Pa s) at temperatures (C), from two known temperatures (C) and their viscosities (Pa s)."""
Scale = Callable[[np.ndarray], np.ndarray]


def _through(scale: Scale, celsius: np.ndarray, known: Pair, viscosity: Pair) -> np.ndarray:
    """Viscosity with a logarithm linear in a scale of temperature, through both known points."""
    first, second = scale(np.array(known))
    slope = np.log(viscosity[0] / viscosity[1]) / (first - second)
    return np.asarray(viscosity[0] * np.exp(slope * (scale(celsius) - first)))


def vogel(celsius: np.ndarray, known: Pair, viscosity: Pair, divergence: float) -> np.ndarray:
    """eta = A exp(B/(T - T0)), T0 the ``divergence`` in kelvin (Vogel 1921, Fulcher 1925, Tammann and Hesse 1926).

    At rest equal to Williams, Landel and Ferry in Yasutomi, Bair and Winer 1984: T0 = Tg - C2, B = ln(10) C1 C2.
    """
    return _through(lambda t: 1 / (t + KELVIN - divergence), celsius, known, viscosity)


def slotte(celsius: np.ndarray, known: Pair, viscosity: Pair, above: float) -> np.ndarray:
    """eta = c/(a + t)^n, t in C and ``above`` the a (Slotte, Ann. Phys. 250 (1881) 13)."""
    return _through(lambda t: -np.log(t + above), celsius, known, viscosity)


def andrade(celsius: np.ndarray, known: Pair, viscosity: Pair) -> np.ndarray:
    """eta = A exp(B/T) (Andrade, Nature 125 (1930) 309): a liquid far from its glass, thin in the cold."""
    return _through(lambda t: 1 / (t + KELVIN), celsius, known, viscosity)


def reynolds(celsius: np.ndarray, known: Pair, viscosity: Pair) -> np.ndarray:
    """eta = A exp(-b T) (Reynolds, Phil. Trans. R. Soc. 177 (1886) 157), measured on olive oil near room temperature.

    Real oils deviate: the law is too thick between the known temperatures and too thin beyond them on either side.
    Cited from memory; no constants are taken.

    >>> round(float(reynolds(np.array(50.0), (40.0, 60.0), (0.04, 0.01))), 6)
    0.02
    """
    return _through(lambda t: -t, celsius, known, viscosity)


def misstated(oil: Oil, celsius: np.ndarray, error: float) -> np.ndarray:
    """Viscosity over the data-sheet value if the second viscosity is ``error`` too low, both by ASTM D341.

    >>> oil = Oil((40.0, 100.0), (30e-6, 6.2e-6), (18e-9, 14e-9))
    >>> [round(float(ratio), 6) for ratio in misstated(oil, np.array([40.0, 100.0]), 0.05)]
    [1.0, 1.05]
    """
    first, second = oil.kinematic
    meant = replace(oil, kinematic=(first, second * (1 + error)))
    return np.asarray(meant.kinematic_at(celsius) / oil.kinematic_at(celsius))


WHOLE = strength(0.0, 1.3, (0.9, 1.05))
DIVERGENCE = Knob("divergence", 150.0, 200.0, (155.0, 195.0))
ABOVE = Knob("above", 30.0, 90.0, (40.0, 60.0))
MISSTATED_BY = strength(-4.0, 6.0, (0.6, 2.0))
VOGEL, SLOTTE, ANDRADE = "Vogel 1921, Fulcher 1925, Tammann 1926", "Slotte 1881", "Andrade 1930"
REYNOLDS, MISSTATED = "Reynolds 1886", "second viscosity misstated"


def separates_laws(celsius: np.ndarray, known: Pair) -> bool:
    """Whether the temperatures separate the laws: at one, or at the known two, they differ only by a factor."""
    levels = set(np.unique(celsius))
    return len(levels) > 1 and not levels <= set(known)


def _cooled(c: Contact, strength: float, law: Law) -> Contact:
    """Contact with another law, ``strength`` of the way, through the two viscosities of the data sheet."""
    oil = c.rig.oil
    first, second = oil.viscosity_at(np.array(oil.temperature))
    ratio = law(c.temperature, oil.temperature, (first, second)) / oil.viscosity_at(c.temperature)
    return replace(c, viscosity=c.viscosity * ratio**strength)


def cooled_by_vogel(c: Contact, strength: float, divergence: float) -> Contact:
    """Vogel, Fulcher and Tammann; T0 in kelvin."""
    return _cooled(c, strength, partial(vogel, divergence=divergence))


def cooled_by_slotte(c: Contact, strength: float, above: float) -> Contact:
    """Slotte's power of the temperature over ``above`` C below the freezing point."""
    return _cooled(c, strength, partial(slotte, above=above))


def cooled_by_andrade(c: Contact, strength: float) -> Contact:
    """eta = A exp(B/T) through both known viscosities."""
    return _cooled(c, strength, andrade)


def cooled_by_reynolds(c: Contact, strength: float) -> Contact:
    """eta = A exp(-b T) through both known viscosities."""
    return _cooled(c, strength, reynolds)


def cooled_as_misstated(c: Contact, strength: float) -> Contact:
    """The second viscosity of the data sheet is 5 % strength too low."""
    return replace(c, viscosity=c.viscosity * misstated(c.rig.oil, c.temperature, 0.05 * strength))


def of_contacts(rig: Inputs) -> tuple[Form, ...]:
    """Forms for a lubricated contact, if its temperatures separate them from a factor on the viscosity."""
    if not separates_laws(rig.temperature, rig.oil.temperature):
        return ()
    return (
        Form("viscosity_temperature_law", "oil", cooled_by_vogel, (WHOLE, DIVERGENCE), VOGEL, within=True),
        Form("viscosity_temperature_law", "oil", cooled_by_slotte, (WHOLE, ABOVE), SLOTTE),
        Form("viscosity_temperature_law", "oil", cooled_by_andrade, (WHOLE,), ANDRADE, within=True),
        Form("viscosity_temperature_law", "oil", cooled_by_reynolds, (WHOLE,), REYNOLDS, within=True),
        Form("viscosity_temperature_law", "oil", cooled_as_misstated, (MISSTATED_BY,), MISSTATED),
    )


def of_unknown_oil(rig: Inputs, labelled: bool) -> tuple[Form, ...]:
    """Forms for an oil without data sheet: all if two viscosities are stated, otherwise some at four baths or more."""
    forms = of_contacts(rig)
    if labelled:
        return forms
    return tuple(f for f in forms if f.law is not cooled_as_misstated) if len(np.unique(rig.temperature)) > 3 else ()
