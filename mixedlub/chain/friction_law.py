"""Friction laws: published formulas for the friction coefficient, with range and status."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal, NamedTuple

import numpy as np

from mixedlub.chain.documented import Coefficient as Coefficient
from mixedlub.chain.law import Catalogue, Function, Law
from mixedlub.chain.plain_text import plain_equation
from mixedlub.chain.quantities import GLOSSARY, unit_and_factor
from mixedlub.chain.ranges import beyond

Place = Literal["contact", "mesh"]
PLACES: Mapping[Place, str] = {"contact": "every contact point", "mesh": "one value for the mesh"}
NEAR_REST = 0.02
"""Judgement. Slide-to-roll ratio below which a law that diverges without sliding is flagged."""
Limits = tuple[str | None, str, float]
"""Coefficients that are the lower end (None: zero) and upper end of a range, and their factor to SI."""


class OfOil(NamedTuple):
    """Required oil property at a temperature (K): name, factor of its coefficient to SI, tolerance."""

    quantity: str
    temperature: float
    factor: float
    tolerance: float


@dataclass(frozen=True, repr=False, kw_only=True)
class FrictionLaw(Law):
    """A friction law with its place of evaluation and its validity.

    ``limits``: coefficients that are the ends of a range, with their factor to SI. ``of_oil``: properties of the only
    oil of the law, zero if unknown. ``diverges``: quantities at whose zero friction is infinite.
    """

    place: Place
    diverges: tuple[str, ...] = ()
    limits: Mapping[str, Limits] = field(default_factory=dict)
    of_oil: Mapping[str, OfOil] = field(default_factory=dict)

    def bounded(self, given: Mapping[str, float]) -> FrictionLaw:
        """The law with the ranges set by its coefficients."""
        own = {
            name: (given[low] * factor if low else 0.0, given[high] * factor)
            for name, (low, high, factor) in self.limits.items()
            if high in given
        }
        return replace(self, valid={**self.valid, **own})

    def with_coefficients(self, given: Mapping[str, float]) -> Callable[..., Any]:
        """The law with fixed coefficients, by default the defaults; returns arrays, also for numbers."""
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
        """Mask of states outside the range of the source, or with negative or infinite friction."""
        friction = np.asarray(state["friction"])
        return beyond(state, self.valid) | ~(np.isfinite(friction) & (friction >= 0.0))

    def divergent(self, state: Mapping[str, Any]) -> np.ndarray:
        """Mask of states with too little sliding for a law that diverges without sliding."""
        if not self.diverges_at_pitch_point:
            return np.zeros(1, bool)
        return np.asarray(state["sliding_speed"] < NEAR_REST * state["entrainment_speed"])

    @property
    def diverges_at_pitch_point(self) -> bool:
        """Whether friction diverges at zero sliding, as at the pitch point of gears."""
        return "sliding_speed" in self.diverges

    @property
    def checked(self) -> tuple[str, ...]:
        """Quantities needed to flag the law."""
        slow = ("sliding_speed", "entrainment_speed") if self.diverges_at_pitch_point else ()
        return tuple(dict.fromkeys(("friction", *self.valid, *slow)))

    def ranges(self) -> list[str]:
        """Range of each quantity as text."""
        return [_range(name, *ends) for name, ends in self.valid.items()]

    def facts(self) -> Mapping[str, str]:
        """Lines of the page by their headings."""
        zero = " or ".join(GLOSSARY[name].meaning for name in self.diverges)
        return {
            "gives": PLACES[self.place],
            "equation": plain_equation(self.equation),
            "": self.remarks,
            "reads": ", ".join(f"{name} ({shown_unit(name)})".replace(" ()", "") for name in self.reads) or "nothing",
            "range": "; ".join(self.ranges()) or "none printed in its source",
            "diverges": f"as this goes to zero: {zero}" if zero else "nowhere",
            "status": self.status,
            "source": self.source,
        }


def shown_unit(quantity: str) -> str:
    """Unit of a quantity on pages."""
    return unit_and_factor(quantity)[0].removeprefix("-")


def _range(name: str, low: float, high: float) -> str:
    """A range as text.

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


BASE = "tallian_mixture"
"""Friction law of the base model."""
FRICTION_LAWS: Catalogue[FrictionLaw] = Catalogue(
    "mixedlub.friction", "friction law", GLOSSARY, lambda law: (law.name != BASE, list(PLACES).index(law.place))
)


def friction_law(title: str, place: Place, **known: Any) -> Callable[[Function], Function]:
    """Register the function below as a friction law under its name.

    Its arguments are quantities of the glossary, its keyword-only arguments the coefficients; its docstring contains
    the equation and the source. ``known``: fields of `FrictionLaw`.
    """
    return FRICTION_LAWS.declares(
        lambda law: FrictionLaw(name=law.__name__, law=law, title=title, place=place, **known)
    )
