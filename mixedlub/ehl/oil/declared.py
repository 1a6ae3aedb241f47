"""Laws of the solver's oil: a function each, declared with the keys of the file for its constants."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from mixedlub.chain.law import Catalogue, Function, Law
from mixedlub.ehl.oil.oil import constant
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.schema.section import Number, key

GIGA, MEGA, MILLI, MICRO = 1e9, 1e6, 1e-3, 1e-6
NEWTON_SCALE = 1e9
"""Stress scale of a Newtonian oil (Pa): larger than in any contact, so that its law is linear."""
QUANTITIES = ("pressure", "temperature", "stress", "density", "volume")
"""Arguments of laws: state, density at ambient pressure, and law of the relative volume."""
Pair = tuple[Number, Number]


@dataclass(frozen=True, eq=False)
class Given:
    """A constant of a law: argument of the function, key of the file with its field, and conversion to SI.

    Several keys with the same argument are entries of a tuple. ``usual``: range of values of nine oils in ten, over
    which a fit to readings looks for the constant; None for a temperature to which the others refer.
    """

    name: str
    key: str
    meaning: str
    to_si: Callable[[float], float] = float
    type: Any = Number
    example: Any = None
    limits: dict[str, Any] = field(default_factory=dict)
    usual: tuple[float, float] | tuple[tuple[float, float], ...] | None = None

    @property
    def field(self) -> tuple[Any, Any]:
        """Type and description of the key; mentions the law that requires it."""
        return self.type | None, key(
            self.meaning, None, example=self.example, alternative=self.example is None, **self.limits
        )


def kelvin(celsius: float) -> float:
    """A temperature in K.

    >>> round(kelvin(60.0), 9)
    333.15
    """
    return celsius + ZERO_CELSIUS


def times(factor: float) -> Callable[[float], float]:
    """Conversion by a factor."""
    return lambda value: value * factor


@dataclass(frozen=True, repr=False, kw_only=True)
class OilLaw(Law):
    """A law of viscosity, shear or density with the keys of its constants.

    ``refuse`` raises an error for contradictory keys. ``volume``: relative volume of a law of density. ``scale``:
    stress at which a law of shear departs from Newton, a constant or a function of pressure, None for a Newtonian oil.
    ``limit``: upper bound of the stress. All are called with the constants of the law.
    """

    keys: tuple[Given, ...] = ()
    refuse: Callable[[Any], None] | None = None
    volume: Callable[..., Any] | None = None
    scale: str | Callable[..., Any] = ""
    limit: Callable[..., Any] | None = None

    @property
    def newtonian(self) -> bool:
        """Whether the law is linear at every stress."""
        return not self.scale

    def stress_scale(self, numbers: dict[str, Any]) -> Callable[..., Any]:
        """Law of the stress scale (Pa) over pressure."""
        own = self.scale
        return partial(own, **numbers) if callable(own) else constant(numbers.get(own, NEWTON_SCALE))

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """Arguments given by keys of the file."""
        return tuple(given.name for given in self.keys)

    def si(self, section: Any) -> dict[str, Any]:
        """Constants of a section of the file in SI."""
        found: dict[str, list[Any]] = {}
        for given in self.keys:
            value = getattr(section, given.key)
            si = tuple(map(given.to_si, value)) if isinstance(value, tuple) else given.to_si(value)
            found.setdefault(given.name, []).append(si)
        return {name: values[0] if len(values) == 1 else tuple(values) for name, values in found.items()}


class OilLaws(Catalogue[OilLaw]):
    """Laws of a property in the order of their file, then laws of plug-ins."""

    def __init__(self, role: str) -> None:
        super().__init__(
            "mixedlub.ehl.oil",
            role,
            QUANTITIES,
            lambda law: (not law.law.__module__.startswith("mixedlub."), law.law.__code__.co_firstlineno),
        )

    def offers(self, title: str, *keys: Given, **known: Any) -> Callable[[Function], Function]:
        """Offer the law below under its name, with a title for the file reference and the keys of its constants."""
        return self.declares(lambda law: OilLaw(name=law.__name__, law=law, title=title, keys=keys, **known))

    @property
    def keys(self) -> list[Given]:
        """Keys of all laws; a key used by a single law follows its neighbour in this law."""
        found: list[Given] = []
        for law in self.all.values():
            place = len(found)
            for given in law.keys:
                if given in found:
                    place = found.index(given) + 1
                else:
                    found.insert(place, given)
                    place += 1
        return found


VISCOSITY, SHEAR, DENSITY = OilLaws("viscosity law"), OilLaws("shear law"), OilLaws("density law")
