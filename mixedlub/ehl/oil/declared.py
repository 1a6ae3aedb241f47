"""Laws of the solver's oil: one function each, declared with the keys of the file that give its numbers."""

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
"""Scale of stress of a Newtonian oil (Pa): beyond any contact's, so that its law is straight."""
QUANTITIES = ("pressure", "temperature", "stress", "density", "volume")
"""Arguments of laws: the state, the density at ambient pressure, and the law of the relative volume."""
Pair = tuple[Number, Number]


@dataclass(frozen=True, eq=False)
class Given:
    """A number of a law: the argument of the function, the key of the file with its field, and the conversion to SI.

    Keys of one argument are the entries of a tuple.
    """

    name: str
    key: str
    meaning: str
    to_si: Callable[[float], float] = float
    type: Any = Number
    example: Any = None
    limits: dict[str, Any] = field(default_factory=dict)

    @property
    def field(self) -> tuple[Any, Any]:
        """Type and description of the key; a law that needs the key says so."""
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
    """The conversion by a factor."""
    return lambda value: value * factor


@dataclass(frozen=True, repr=False, kw_only=True)
class OilLaw(Law):
    """A law of viscosity, shear or density with the keys of its numbers.

    ``refuse`` raises an error for keys that contradict each other. A law of density may give the ``volume``. A law of
    shear has the ``scale`` of stress at which it leaves Newton, a number of the law or a law over pressure, none for a
    Newtonian oil, and the ``limit`` that no stress reaches. All take the numbers of the law.
    """

    keys: tuple[Given, ...] = ()
    refuse: Callable[[Any], None] | None = None
    volume: Callable[..., Any] | None = None
    scale: str | Callable[..., Any] = ""
    limit: Callable[..., Any] | None = None

    @property
    def newtonian(self) -> bool:
        """Whether no stress leaves Newton's law."""
        return not self.scale

    def stress_scale(self, numbers: dict[str, Any]) -> Callable[..., Any]:
        """The law of the scale of stress (Pa) over pressure."""
        own = self.scale
        return partial(own, **numbers) if callable(own) else constant(numbers.get(own, NEWTON_SCALE))

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """Arguments that the keys of the file give."""
        return tuple(given.name for given in self.keys)

    def si(self, section: Any) -> dict[str, Any]:
        """The numbers of a section of the file in SI."""
        found: dict[str, list[Any]] = {}
        for given in self.keys:
            value = getattr(section, given.key)
            si = tuple(map(given.to_si, value)) if isinstance(value, tuple) else given.to_si(value)
            found.setdefault(given.name, []).append(si)
        return {name: values[0] if len(values) == 1 else tuple(values) for name, values in found.items()}


class OilLaws(Catalogue[OilLaw]):
    """The laws of one property in the order of their file, then those of plug-ins."""

    def __init__(self, role: str) -> None:
        super().__init__(
            "mixedlub.ehl.oil",
            role,
            QUANTITIES,
            lambda law: (not law.law.__module__.startswith("mixedlub."), law.law.__code__.co_firstlineno),
        )

    def offers(self, title: str, *keys: Given, **known: Any) -> Callable[[Function], Function]:
        """Offer the law below under its own name, with a title for the file's reference and the keys of its numbers."""
        return self.declares(lambda law: OilLaw(name=law.__name__, law=law, title=title, keys=keys, **known))

    @property
    def keys(self) -> list[Given]:
        """The keys of all laws; a key that only one law has follows its neighbour in this law."""
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
