"""Terms of a law: powers, exponentials, saturations, thresholds, steps and resonances of one variable, and products."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from mixedlub.chain.quantities import GLOSSARY
from mixedlub.diagnosis.discrepancy.waves import is_explained_by, stepped_levels
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import COLLINEAR, VARIED_FROM
from mixedlub.diagnosis.settings.discovery import (
    FEW_PLACES,
    FEW_POWERS,
    LARGEST_LOG,
    LEAST_LEVELS_OF_PLACE,
    PLACES,
    POWERS,
    RESONANCE_WIDTHS,
    STEP_WIDTHS,
    WIDTH_MEDIAN,
    WIDTH_SPREAD,
)
from mixedlub.recording.conditions import PASSING
from mixedlub.recording.set_points import set_points

GROUPS = (
    ("film_thickness/composite_roughness", ("film_thickness", "composite_roughness")),
    ("viscosity*entrainment_speed", ("viscosity", "entrainment_speed")),
)
"""Groups of chain quantities that a term may read, as text, with the quantities."""
CHAIN = ("slide_roll_ratio", "composite_roughness", "viscosity", "hertz_pressure", "entrainment_speed", "sliding_speed")
"""Chain quantities that a term may read."""


@dataclass(frozen=True, eq=False)
class Variable:
    """Variable of a term: its text in an expression, and its value for each reading."""

    text: str
    values: np.ndarray

    @property
    def bracketed(self) -> str:
        """The text as a factor."""
        return f"({self.text})" if "*" in self.text or "/" in self.text else self.text

    @property
    def positive(self) -> bool:
        """Whether all values are positive, so that logarithms and powers exist."""
        return bool((self.values > 0.0).all())

    @property
    def middle(self) -> float:
        """A round number in the middle of the range."""
        low, high = float(self.values.min()), float(self.values.max())
        return float(f"{np.sqrt(low * high) if self.positive else 0.5 * (low + high):.2g}")

    @property
    def places(self) -> np.ndarray:
        """Places between the levels, at most PLACES."""
        levels = np.unique(set_points(self.values))
        if levels.size < LEAST_LEVELS_OF_PLACE:
            return np.zeros(0)
        between = np.sqrt(levels[1:] * levels[:-1]) if self.positive else 0.5 * (levels[1:] + levels[:-1])
        every = np.sort(np.concatenate([levels, between]))[1:-1]
        return every[np.unique(np.linspace(0, every.size - 1, PLACES).round().astype(int))]

    @property
    def span(self) -> float:
        """Length of the range, of the logarithm where all values are positive."""
        v = np.log(self.values) if self.positive else self.values
        return float(np.ptp(v))


@dataclass(frozen=True, eq=False)
class Term:
    """A function of one or two variables without its amplitude: text with numbered parameters, and values.

    ``start`` holds the parameters of the text, ``priors`` their prior: a kind and two numbers, ``units`` their unit if
    any.
    """

    shape: str
    variables: tuple[str, ...]
    text: str
    start: dict[str, float]
    priors: dict[str, tuple[str, float, float]]
    values: np.ndarray
    units: dict[str, str] = field(default_factory=dict)

    @property
    def read(self) -> set[str]:
        """Names in the text."""
        return set(re.findall(r"\w+", self.text))

    def numbered(self, number: int) -> Term:
        """The term with its parameters marked by a number, so that two terms can stand together."""
        text, mark = self.text, str(number)
        for name in self.start:
            text = text.replace(f"<{name}>", f"<{name}{mark}>")
        start = {f"{name}{mark}": value for name, value in self.start.items()}
        priors = {f"{name}{mark}": value for name, value in self.priors.items()}
        units = {f"{name}{mark}": unit for name, unit in self.units.items()}
        return replace(self, text=text, start=start, priors=priors, units=units)

    def times(self, other: Term) -> Term:
        """The product with a term of another variable."""
        one, two = self.numbered(1), other.numbered(2)
        return Term(
            f"{self.shape} x {other.shape}",
            (*self.variables, *other.variables),
            f"{one.text}*{two.text}",
            one.start | two.start,
            one.priors | two.priors,
            self.values * other.values,
            one.units | two.units,
        )


def variables(search: Search) -> list[Variable]:
    """Conditions and quantities of the chain that varied, without powers of an earlier one."""
    problem, fit = search.problem, search.discrepancy.base
    rows, run = problem.rows, problem.run(fit.explanation, fit.z)
    found: list[Variable] = []
    swept = [axis.name for axis in search.space.axes if not axis.named]
    for name in swept:
        # Time by another name: a condition that was stepped up once through the programme.
        others = stepped_levels(search.values, search.space.place(name)) if name in PASSING else []
        if name in rows and not any(is_explained_by(np.asarray(rows[name], float)[:, None], one) for one in others):
            _add(found, Variable(name, np.asarray(rows[name], float)))
    if any(v.values.min() < 0.0 < v.values.max() for v in found):
        found += [Variable(f"abs({v.text})", np.abs(v.values)) for v in found if v.values.min() < 0.0]
    made = {*run.inputs, *(name for name, _ in problem.forward.chain)}
    every = [*((name, (name,)) for name in CHAIN), *GROUPS]
    for text, parts in every:
        if not made.issuperset(parts) or not all(part in GLOSSARY for part in parts):
            continue
        state = problem.forward.model(parts)(run.inputs, run.record.values)
        value = {part: np.atleast_2d(np.asarray(state[part], float)).mean(axis=-1) for part in parts}
        first, *rest = parts
        total = value[first]
        for part in rest:
            total = total / value[part] if "/" in text else total * value[part]
        _add(found, Variable(text, np.broadcast_to(total, problem.y.shape)))
    return found


def _add(found: list[Variable], new: Variable) -> None:
    """Add a variable that varied, except a power of an earlier one."""
    v = new.values
    if not np.isfinite(v).all() or np.ptp(v) <= 0.0:
        return
    shape = np.log(v) if new.positive else v
    if new.positive and np.ptp(shape) < VARIED_FROM:
        return
    for other in found:
        there = np.log(other.values) if other.positive else other.values
        if abs(np.corrcoef(shape, there)[0, 1]) > COLLINEAR:
            return
    found.append(new)


def single_terms(v: Variable) -> list[Term]:
    """Terms of one variable that may be the logarithm of a factor."""
    name, x, middle = v.bracketed, v.values, v.middle
    found: list[Term] = []
    if v.positive:
        found.append(_term("power", v, f"log({name}/{middle:.4g})", {}, {}, np.log(x / middle)))
    else:
        wide = float(f"{np.ptp(x):.2g}")
        found.append(_term("linear", v, f"({v.text}-{_signed(middle)})/{wide:.4g}", {}, {}, (x - middle) / wide))
    found += list(_powers(v, POWERS))
    if v.positive:
        for share in (0.3, 1.0, 3.0):
            b = share * middle
            prior = {"b": ("lognormal", middle, 1.0)}
            found.append(_term("saturation", v, f"{name}/({name}+<b>)", {"b": b}, prior, x / (x + b)))
        within = {"b": ("uniform", float(x.min()), float(x.max()))}
        for b in v.places:
            for bound in ("max", "min"):
                values = getattr(np, f"{bound}imum")(np.log(x / b), 0.0)
                found.append(_term("threshold", v, f"log({bound}({name}/<b>,1))", {"b": float(b)}, within, values))
    found += list(_local(v, v.places))
    return [t for t in found if np.isfinite(t.values).all() and np.ptp(t.values) > 0.0]


def bounded_terms(v: Variable) -> list[Term]:
    """Terms of one variable between zero and one, for products and additions."""
    places = v.places
    few = places[np.unique(np.linspace(0, places.size - 1, FEW_PLACES).round().astype(int))] if places.size else places
    found = [*_powers(v, FEW_POWERS), *_local(v, few)]
    return [t for t in found if np.isfinite(t.values).all() and np.ptp(t.values) > 0.0]


def _powers(v: Variable, powers: tuple[float, ...]) -> Iterator[Term]:
    if not v.positive:
        return
    for p in powers:
        top = float(f"{v.values.max() if p > 0.0 else v.values.min():.4g}")
        values = np.exp(np.clip(p * np.log(v.values / top), -LARGEST_LOG, LARGEST_LOG))
        priors = {"p": ("normal", p, 1.0)}
        yield _term(
            "grown power",
            v,
            f"({v.text}/{top:.4g})^<p>" if v.text == v.bracketed else f"({v.bracketed}/{top:.4g})^<p>",
            {"p": p},
            priors,
            values,
        )


def _local(v: Variable, places: np.ndarray) -> Iterator[Term]:
    """Steps and resonances at places along a variable."""
    x, name = v.values, v.bracketed
    place = ("uniform", float(x.min()), float(x.max()))
    width = ("lognormal", WIDTH_MEDIAN * v.span, WIDTH_SPREAD)
    for b in places:
        off = np.log(x / b) if v.positive else x - b
        text = f"log({name}/<b>)" if v.positive else f"({v.text}-<b>)"
        for shape, widths in (("step", STEP_WIDTHS), ("resonance", RESONANCE_WIDTHS)):
            for share in widths:
                w = share * v.span
                if shape == "step":
                    values, body = 0.5 + 0.5 * np.tanh(off / w), f"(0.5+0.5*tanh({text}/<w>))"
                else:
                    values, body = np.exp(-0.5 * (off / w) ** 2), f"exp(-0.5*({text}/<w>)^2)"
                yield _term(shape, v, body, {"b": float(b), "w": w}, {"b": place, "w": width}, values)


def _signed(value: float) -> str:
    return f"{value:.4g}" if value >= 0.0 else f"({value:.4g})"


def _term(
    shape: str,
    v: Variable,
    text: str,
    start: dict[str, float],
    priors: dict[str, tuple[str, float, float]],
    values: np.ndarray,
) -> Term:
    return Term(shape, (v.text,), text, start, priors, np.asarray(values))
