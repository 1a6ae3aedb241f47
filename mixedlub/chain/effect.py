"""Effects: switchable pieces of physics, one per file."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np

from mixedlub.chain.law import Catalogue, Function, Law, Ranges
from mixedlub.chain.plain_text import INDENT, entry, plain_equation, plain_symbol, with_symbol
from mixedlub.chain.priors import Prior
from mixedlub.chain.quantities import GLOSSARY

STAGES = ("film", "shear", "contact", "boundary", "load", "loss", "property", "law", "measurement")


@dataclass(frozen=True)
class Parameter:
    """A parameter of an effect.

    ``null``: value that switches the effect off, if any. ``symbol``: letter in the equation, as LaTeX. ``n_scan``:
    number of values a search must try, if the likelihood has many separate maxima in the parameter. ``change_point``:
    readings jump at this parameter, so the likelihood is nearly flat between two readings. ``kinds``: kinds of
    recording in which the parameter is free (empty: all); elsewhere it stays at its null. ``published``: range of the
    laws cited in the source, if the prior is wider. ``relative_to``: input of which the parameter is a fraction, if
    any. ``nominal``: value of the cited laws, if the prior is centred on another value. ``base_sd``: standard deviation
    about the null within which the base law itself is uncertain (0: exact). ``of_chain``: value that the laws of the
    published case have under a chain, known effects and their parameter values, if it depends on them.
    """

    name: str
    unit: str
    prior: Prior
    meaning: str
    null: float | None = None
    symbol: str = ""
    n_scan: int = 0
    change_point: bool = False
    kinds: tuple[str, ...] = ()
    published: tuple[float, float] | None = None
    relative_to: str = ""
    nominal: float | None = None
    base_sd: float = 0.0
    of_chain: Callable[[Any, Any, Any], float] | None = None

    @property
    def usual(self) -> float:
        """Value in the cited laws, unless a special case sets another: ``nominal``, else the prior median."""
        return self.prior.value(0.0) if self.nominal is None else self.nominal

    @property
    def null_value(self) -> float:
        """The null, else the prior median."""
        return self.prior.value(0.0) if self.null is None else self.null

    def described(self) -> str:
        """Meaning, prior, unit, null, and kinds of recording in which the parameter is free."""
        off = "" if self.null is None else f"; off at {self.null:g}"
        free = f"; free in recordings of {', '.join(self.kinds)}" if self.kinds else ""
        return f"{self.meaning}; {self.prior}{_unit(self.unit)}{off}{free}"

    @property
    def typical(self) -> tuple[float, float]:
        """The middle 80 % of the prior."""
        low, high = self.prior.value(-1.2816), self.prior.value(1.2816)
        return (low, high)


@dataclass(frozen=True, repr=False, kw_only=True)
class Effect(Law):
    """A law that changes one or more quantities of the chain, with its metadata.

    ``fingerprint``: for each condition (load, speed, slide_roll_ratio, oil_temperature, roughness, sequence), whether
    the relative effect on the reading, (with - without)/without, grows (``"+"``), falls (``"-"``; also becomes more
    negative) or stays (``"0"``) as the condition grows. It refers to the loss of gears and the friction of discs; for
    an effect invisible in both, to the first standard rig that shows it. Another reading, e.g. a film, may have the
    opposite sign. ``applied_after``: effects on the same quantity applied earlier. ``kinds``: kinds of recording
    (empty: all). ``prior_odds``: relative to most effects, at most 1. ``special_cases``: laws or limits that the effect
    equals at the given parameter values. ``descriptive``: follows readings without naming a cause. ``exact_form``: the
    law defines the effect, so no error of form is considered. ``needs_variation_in``: the effect is not offered at a
    single value of this quantity, where it would only rescale the base model. ``offered_within``: ranges of base
    quantities which must contain most rows of a recording. ``replaces``: step of the base model replaced by a law that
    adds no physics. ``expected``: acts by mechanics wherever its quantities exist, so that its absence has to be shown.
    ``valid``: range common to all its laws. ``also_valid``: range of some laws, by parameter values.
    """

    stage: str
    acts_on: tuple[str, ...]
    parameters: tuple[Parameter, ...]
    fingerprint: Mapping[str, str]
    separated_by: str
    applied_after: tuple[str, ...] = ()
    kinds: tuple[str, ...] = ()
    prior_odds: float = 1.0
    special_cases: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    descriptive: bool = False
    exact_form: bool = False
    needs_variation_in: str = ""
    offered_within: Ranges = field(default_factory=dict)
    replaces: str = ""
    expected: bool = False
    fixed: Mapping[str, float] = field(default_factory=dict)
    also_valid: Callable[[Mapping[str, float]], Ranges] | None = None
    margin: ClassVar[str] = ""

    @property
    def id(self) -> str:
        """The name of the effect."""
        return self.name

    @cached_property
    def reads(self) -> tuple[str, ...]:
        """Arguments of the law other than the quantities it changes."""
        return self.arguments[len(self.acts_on) :]

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """Keyword-only arguments of the law."""
        return (*(p.name for p in self.parameters), *self.fixed)

    def valid_at(self, values: Mapping[str, float]) -> Ranges:
        """Valid range at these parameter values, which may select a law with a narrower range."""
        return {**self.valid, **(self.also_valid(values) if self.also_valid else {})}

    def fixing(self, values: Mapping[str, float]) -> Effect:
        """The effect with some parameters fixed at these values."""
        free = tuple(p for p in self.parameters if p.name not in values)
        return replace(self, parameters=free, fixed={**self.fixed, **values})

    @property
    def laws_within_reach(self) -> dict[str, dict[str, float]]:
        """Special cases reachable by the free parameters, with the parameter values."""
        free = {p.name for p in self.parameters}
        still_to_fix = {
            law: {name: value for name, value in values.items() if self.fixed.get(name) != value}
            for law, values in self.special_cases.items()
        }
        return {law: values for law, values in still_to_fix.items() if values and values.keys() <= free}

    def law_values(self, law: str = "") -> dict[str, float]:
        """Parameters of a named law, by default the first within reach."""
        laws = self.laws_within_reach
        fixed = laws.get(law or next(iter(laws), ""), {})
        return {p.name: fixed.get(p.name, p.usual) for p in self.parameters}

    @property
    def nulls(self) -> dict[str, float]:
        """Parameter values that switch the effect off; the prior median of a parameter without a null."""
        return {**self.fixed, **{p.name: p.null_value for p in self.parameters}}

    @property
    def prior_medians(self) -> dict[str, float]:
        """Every parameter at its prior median."""
        return {p.name: p.prior.value(0.0) for p in self.parameters}

    def facts(self) -> Mapping[str, str]:
        """Lines of the page by their headings."""
        acted = (", ".join(filter(None, (_letter(n), _unit(GLOSSARY[n].unit).strip()))) for n in self.acts_on)
        return {
            "stage": self.stage,
            "changes": ", ".join(map(with_symbol, self.acts_on, acted)),
            "reads": ", ".join(with_symbol(name, _letter(name)) for name in self.reads) or "nothing else",
            "equation": plain_equation(self.equation),
            "source": self.source,
            "valid": _ranges(self.valid),
            "offered": _ranges(self.offered_within) and f"where most rows have {_ranges(self.offered_within)}",
            "recordings": ", ".join(self.kinds),
            "prior odds": f"{self.prior_odds:g} times those of most effects" if self.prior_odds < 1.0 else "",
            "form": "exact by definition: no error of form is considered" if self.exact_form else "",
        }

    def numbers(self) -> list[str]:
        """Lines of the page on parameters, special cases, and the separating test."""
        labels = [f"  {with_symbol(p.name, plain_equation(p.symbol))}" for p in self.parameters]
        indent = max(INDENT, 2 + max(map(len, labels), default=0))
        numbers = [entry(label, p.described(), indent) for p, label in zip(self.parameters, labels, strict=True)]
        laws = [
            entry("special case", f"{law}, at " + ", ".join(f"{n} {v:g}" for n, v in values.items()))
            for law, values in self.special_cases.items()
        ]
        return ["", "parameters", *numbers, *laws, "", entry("separated by", self.separated_by)]

    def values(self, z: np.ndarray) -> dict[str, float]:
        """Parameter values at standard-normal coordinates of the prior."""
        return {**self.fixed, **{p.name: p.prior.value(float(x)) for p, x in zip(self.parameters, z, strict=True)}}


def _unit(unit: str) -> str:
    return {"-": "", "*": " unit of the channel"}.get(unit, f" {unit}")


def _ranges(ranges: Ranges) -> str:
    units = {n: _unit(GLOSSARY[n].unit) if n in GLOSSARY else "" for n in ranges}
    return "; ".join(f"{n} {low:g} to {high:g}{units[n]}" for n, (low, high) in ranges.items())


def _letter(quantity: str) -> str:
    symbol = GLOSSARY[quantity].symbol if quantity in GLOSSARY else "-"
    return "" if symbol == "-" else plain_symbol(symbol)


EFFECTS: Catalogue[Effect] = Catalogue(
    "mixedlub.effects", "effect", GLOSSARY, lambda effect: STAGES.index(effect.stage)
)


def effect(*, acts_on: str | tuple[str, ...], **known: Any) -> Callable[[Function], Function]:
    """Register a law as an effect; its signature must agree with the declaration.

    Arguments in order: quantities acted on, quantities read, keyword-only parameters. ``known``: fields of `Effect`.
    """
    targets = (acts_on,) if isinstance(acts_on, str) else acts_on
    given = {name: value for name, value in known.items() if value is not None}
    frozen: dict[str, Any] = {n: MappingProxyType(dict(v)) if isinstance(v, Mapping) else v for n, v in given.items()}

    return EFFECTS.declares(lambda law: _checked(Effect(name=law.__name__, law=law, acts_on=targets, **frozen)))


def _checked(found: Effect) -> Effect:
    """Return the effect; raise an error if its declaration and signature disagree."""
    where, begin = f"effect {found.name!r}", found.arguments[: len(found.acts_on)]
    if found.stage not in STAGES:
        raise TypeError(f"{where}: stage {found.stage!r} is none of {STAGES}")
    if begin != found.acts_on:
        raise TypeError(f"{where}: first arguments {begin} must be what it acts on, {found.acts_on}")
    if found.needs_variation_in and found.needs_variation_in not in found.arguments:
        raise TypeError(f"{where}: needs_variation_in {found.needs_variation_in!r} is not among what it reads")
    if not 0.0 < found.prior_odds <= 1.0:
        raise TypeError(f"{where}: prior_odds {found.prior_odds!r} must lie above 0 and not above 1")
    for case, values in found.special_cases.items():
        if not values.keys() <= set(found.parameter_names):
            raise TypeError(f"{where}: special case {case!r} fixes {sorted(values)}, not all of them parameters")
    return found
