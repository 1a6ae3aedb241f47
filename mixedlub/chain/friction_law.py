"""What a friction law is: one published formula for the friction coefficient, with its range and its status."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal, NamedTuple

import numpy as np

from mixedlub.chain.documented import Coefficient, Documented
from mixedlub.chain.model import Law
from mixedlub.chain.plain_text import plain_equation
from mixedlub.chain.quantities import GLOSSARY, unit_and_factor
from mixedlub.chain.ranges import beyond
from profiles.errors import nearest

Place = Literal["contact", "mesh"]
PLACES: Mapping[Place, str] = {"contact": "every contact point", "mesh": "one value for the mesh"}
NEAR_REST = 0.02
"""Judgement. Slide-to-roll ratio below which a law that diverges without sliding is flagged."""
Limits = tuple[str | None, str, float]
"""Coefficients that are the ends of a range, the lower one zero where none is, and their factor to SI."""


class OfOil(NamedTuple):
    """A property that an oil must have at a temperature (K): its name, factor of its coefficient to SI, tolerance."""

    quantity: str
    temperature: float
    factor: float
    tolerance: float


@dataclass(frozen=True, repr=False)
class FrictionLaw(Documented):
    """A friction law: the function, where it is evaluated, and what is known of its validity.

    ``valid`` is the range of its source in SI, by quantity of the glossary; ``limits`` names the coefficients that are
    the ends of such a range, and their factor to SI; ``of_oil`` names those that are properties of the only oil that
    the law is for, zero where unknown; ``diverges`` names quantities at whose zero the law has no finite
    value; ``sources`` counts independent sources of the constants, 0 where none was found.
    """

    name: str
    law: Law
    title: str
    place: Place
    sources: int
    status: str
    valid: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    diverges: tuple[str, ...] = ()
    coefficients: tuple[Coefficient, ...] = ()
    limits: Mapping[str, Limits] = field(default_factory=dict)
    of_oil: Mapping[str, OfOil] = field(default_factory=dict)

    def bounded(self, given: Mapping[str, float]) -> FrictionLaw:
        """The law with the range that its coefficients give it."""
        own = {
            name: (given[low] * factor if low else 0.0, given[high] * factor)
            for name, (low, high, factor) in self.limits.items()
            if high in given
        }
        return replace(self, valid={**self.valid, **own})

    def with_coefficients(self, given: Mapping[str, float]) -> Law:
        """The law with its coefficients fixed, defaults where none are given; a number becomes an array of one."""
        values, law = self.values(given), self.law

        def fixed(*quantities: Any) -> Any:
            return np.atleast_1d(law(*quantities, **values))

        fixed.__doc__, fixed.__name__ = law.__doc__, self.name
        own = inspect.signature(law)
        kept = [a for a in own.parameters.values() if a.kind is not a.KEYWORD_ONLY]
        # A function may state its signature, which its type does not declare.
        fixed.__signature__ = own.replace(parameters=kept)  # type: ignore[attr-defined]
        return fixed

    def outside(self, state: Mapping[str, Any]) -> np.ndarray:
        """Where quantities are outside the range of the source, or friction is no finite positive number."""
        friction = np.asarray(state["friction"])
        return beyond(state, self.valid) | ~(np.isfinite(friction) & (friction >= 0.0))

    def divergent(self, state: Mapping[str, Any]) -> np.ndarray:
        """Where sliding is too slow for a law that diverges without it."""
        if not self.diverges_at_pitch_point:
            return np.zeros(1, bool)
        return np.asarray(state["sliding_speed"] < NEAR_REST * state["entrainment_speed"])

    @property
    def diverges_at_pitch_point(self) -> bool:
        """Whether friction grows without limit where sliding ends, as at the pitch point of gears."""
        return "sliding_speed" in self.diverges

    @property
    def checked(self) -> tuple[str, ...]:
        """Quantities that its flags need."""
        slow = ("sliding_speed", "entrainment_speed") if self.diverges_at_pitch_point else ()
        return tuple(dict.fromkeys(("friction", *self.valid, *slow)))

    def ranges(self) -> list[str]:
        """The range of each quantity in words."""
        return [_range(name, *ends) for name, ends in self.valid.items()]

    def page(self) -> str:
        """Equation, inputs, range, status, coefficients and source, as text of 80 columns."""
        zero = " or ".join(GLOSSARY[name].meaning for name in self.diverges)
        parts = {
            "gives": PLACES[self.place],
            "equation": plain_equation(self.equation),
            "": self.remarks,
            "reads": ", ".join(f"{name} ({shown_unit(name)})".replace(" ()", "") for name in self.reads) or "nothing",
            "range": "; ".join(self.ranges()) or "none printed in its source",
            "diverges": f"as this goes to zero: {zero}" if zero else "nowhere",
            "status": self.status,
            "source": self.source,
        }
        return self._page(parts)

    __repr__ = page


def shown_unit(quantity: str) -> str:
    """Unit in which a page gives a quantity."""
    return unit_and_factor(quantity)[0].removeprefix("-")


def _range(name: str, low: float, high: float) -> str:
    """A range in words.

    >>> _range("kinematic_viscosity", 4e-6, 500e-6), _range("pitch_line_speed", 0.0, 50.0)
    ('kinematic viscosity 4 to 500 mm²/s', 'pitch line speed up to 50 m/s')
    """
    unit, factor = unit_and_factor(name)
    ends = f"{low * factor:.4g} to {high * factor:.4g}"
    if not np.isfinite(high):
        ends = f"from {low * factor:.4g}"
    elif low <= 0.0:
        ends = f"up to {high * factor:.4g}"
    return f"{name.replace('_', ' ')} {ends} {unit.removeprefix('-')}".rstrip()


REGISTRY: dict[str, FrictionLaw] = {}
"""Laws by name, as their modules were imported; `mixedlub.friction.catalogue` imports them all."""
Function = Callable[..., Any]


def friction_law(
    title: str,
    place: Place,
    *,
    sources: int,
    status: str,
    valid: Mapping[str, tuple[float, float]] | None = None,
    diverges: tuple[str, ...] = (),
    coefficients: tuple[Coefficient, ...] = (),
    limits: Mapping[str, Limits] | None = None,
    of_oil: Mapping[str, OfOil] | None = None,
) -> Callable[[Function], Function]:
    """Register the function below as a friction law under its own name.

    Its arguments are quantities of the glossary, its keyword-only arguments the coefficients; its docstring has the
    equation and names the source.
    """

    def register(law: Function) -> Function:
        about = (title, place, sources, status, valid or {}, diverges, coefficients, limits or {}, of_oil or {})
        found = FrictionLaw(law.__name__, law, *about)
        _check(found)
        REGISTRY[found.name] = found
        return law

    return register


def _check(found: FrictionLaw) -> None:
    where = f"friction law {found.name!r}"
    known = REGISTRY.get(found.name)
    if known is not None and known.law.__module__ != found.law.__module__:
        raise TypeError(f"{where} is already defined in {known.law.__module__}")
    for name in (*found.reads, *found.valid, *found.diverges):
        if name not in GLOSSARY:
            raise TypeError(f"{where}: {name!r} is no quantity; {nearest(name, GLOSSARY)}")
    keywords = {n for n, a in inspect.signature(found.law).parameters.items() if a.kind is a.KEYWORD_ONLY}
    if keywords != {c.name for c in found.coefficients}:
        raise TypeError(f"{where}: its coefficients are not its keyword-only arguments")
    if not found.source:
        raise TypeError(f"{where}: its docstring names no 'Source: '")
