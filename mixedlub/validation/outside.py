"""Batteries of physics outside the catalogue: their distribution, the laws that describe it, and the score of laws."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mixedlub.validation.answers import Answer, Truth
from mixedlub.validation.battery import deck, drawn_rigs, ordered, shuffled, surveyed
from mixedlub.validation.measures import coverage, false_physics, held_ratio, unknown_suspected
from mixedlub.validation.rigs import FAMILIES
from mixedlub.validation.sample_case import Order
from mixedlub.validation.score import FIGURES, Figure, Measured, any_case, at_least, at_most, chosen, of_class, share
from profiles.errors import InputError

KINDS = ("gear_pair", "disc", "film", "friction_map", "friction_history")
"""Kinds of rig with physics outside the catalogue on several stages of the chain."""
SHAPES = {
    "step": r"tanh\(",
    "resonance": r"exp\(-0\.5\*\(",
    "threshold": r"(max|min)\(",
    "saturation": r"/\([^()]+\+",
    "power": r"\^",
}
"""Shapes of a term, with the text by which an expression shows them."""


@dataclass(frozen=True)
class Law:
    """A law that describes a planted form: quantities on which it may act, and shapes that follow it."""

    acts_on: frozenset[str]
    shapes: frozenset[str]


def _law(acts_on: str, shapes: str) -> Law:
    return Law(frozenset(acts_on.split()), frozenset(shapes.split()))


_CONTACT = "friction reading"
_DRIVE = "running_friction friction reading boundary_friction"
_FILM = "film_thickness reading"
LAWS = {
    "speed_band": _law(_CONTACT, "resonance"),
    "load_threshold": _law(_CONTACT, "step threshold"),
    "hot_cavitation": _law("film_thickness", "step power threshold"),
    "odd_slip_power": _law(_CONTACT, "power"),
    "square_law_brake": _law("reading", "power"),
    "cold_light_drag": _law(_CONTACT, "power step threshold"),
    "slow_excess": _law(_CONTACT, "power step threshold"),
    "trembling": _law(_FILM, "resonance"),
    "refilled": _law(_FILM, "step"),
    "slip_lifts": _law(_FILM, "power"),
    "load_squeezes": _law(_FILM, "power"),
    "ringing": _law(_DRIVE, "resonance"),
    "lifting": _law(_DRIVE, "step"),
    "stepped": _law(_DRIVE, "step"),
    "dented": _law(_DRIVE, "resonance"),
}
"""Laws of the forms that one law describes; no law of one or two terms describes the others, such as waves."""


def plan_outside(seed: int, cases: int, kinds: Sequence[str] = KINDS) -> list[Order]:
    """Orders of a battery of physics outside the catalogue: every form of every kind in turn."""
    if bare := [kind for kind in kinds if kind not in KINDS]:
        raise InputError("no physics outside the catalogue is dealt for this kind", where="kinds", value=bare)
    rng = np.random.default_rng([seed, 51])
    orders: list[Order] = []
    shares = deck(rng, list(kinds), [1.0] * len(kinds), cases)
    for kind in kinds:
        family = next(family for family in FAMILIES if kind in family.kinds)
        names = sorted(surveyed(drawn_rigs(kind, seed))[1])
        start = int(rng.integers(len(names)))
        dealt = [("unknown", kind, (names[(start + i) % len(names)],)) for i in range(shares.count(kind))]
        orders += [replace(o, level="clear", beyond=i % 2 == 0) for i, o in enumerate(ordered(rng, family, dealt))]
    return shuffled(rng, orders)


def shapes_of(expression: str) -> frozenset[str]:
    """Shapes that an expression shows.

    >>> sorted(shapes_of("exp(a*(0.5+0.5*tanh(log(load_N/b)/w)))")), sorted(shapes_of("(load_N/420)^a"))
    (['step'], ['power'])
    """
    found = {name for name, text in SHAPES.items() if re.search(text, expression)}
    # The square within a resonance is no power law.
    return frozenset(found - {"power"} if "resonance" in found and expression.count("^") == 1 else found)


def _lawful(truth: Truth, answer: Answer) -> bool:
    return bool(truth.effects) and truth.effects[0] in LAWS


def _lawless(truth: Truth, answer: Answer) -> bool:
    return truth.group == "unknown" and not _lawful(truth, answer)


def _claimed(truth: Truth, answer: Answer) -> bool:
    return bool(answer.laws)


def _no_law(truth: Truth, answer: Answer) -> float:
    return float(not answer.laws)


def _said(truth: Truth, answer: Answer) -> float:
    """Whether unknown is said, alone or tied, and no name is claimed at 0.9."""
    said = any("unknown" in one for one in (answer.verdict, *answer.tied)) or unknown_suspected(truth, answer)
    return float(said and not false_physics(truth, answer))


def _stage(truth: Truth, answer: Answer) -> float:
    return float(any(acts_on in LAWS[truth.effects[0]].acts_on for acts_on, _ in answer.laws))


def _shape(truth: Truth, answer: Answer) -> float:
    return float(any(shapes_of(text) & LAWS[truth.effects[0]].shapes for _, text in answer.laws))


def _within(beyond: bool, measure: Callable[[Truth, Answer], float]) -> Callable[[Truth, Answer], float]:
    """A measure at the withheld conditions inside or beyond the recorded range; nan if there are none."""

    def found(truth: Truth, answer: Answer) -> float:
        part = replace(truth, withheld=truth.withheld & (truth.beyond == beyond))
        return measure(part, answer) if part.withheld.any() else float("nan")

    return found


def _both(truth: Truth, answer: Answer) -> bool:
    return _lawful(truth, answer) and _claimed(truth, answer)


OUTSIDE_FIGURES: tuple[Measured, ...] = (
    share("said", "unknown said or tied, and no false name at 0.9", of_class("unknown"), _said, at_least(0.90)),
    share("false_name", "  a false name at 0.9 or more", any_case, false_physics, at_most(0.04)),
    share("stage", "a law describes it: quantity right or tied", _lawful, _stage, at_least(0.80)),
    share("shape", "  shape right, up to equivalence", _lawful, _shape, at_least(0.60)),
    share("stage_claimed", "  quantity right or tied, where a law is claimed", _both, _stage),
    share("none_claimed", "no law describes it: none claimed", _lawless, _no_law, at_least(0.90)),
    Figure("inside", "withheld inside the range: error over recalibration", _lawful, _within(False, held_ratio),
           at_most(0.35), "median"),
    Figure("beyond", "withheld beyond the range: error over recalibration", _lawful, _within(True, held_ratio),
           at_most(0.50), "median"),
    Figure("cover_inside", "coverage of 90 % intervals inside the range", _lawful, _within(False, coverage)),
    Figure("cover_beyond", "coverage of 90 % intervals beyond the range", _lawful, _within(True, coverage),
           at_least(0.85)),
    *chosen(FIGURES, "seconds", "slowest"),
)  # fmt: skip
"""Figures of a battery of physics outside the catalogue."""
