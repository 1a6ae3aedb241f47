"""Figures of a battery of rigs that follow other laws: missing effects and laws separately."""

from __future__ import annotations

from collections.abc import Callable

from mixedlub.validation.answers import Answer, Truth
from mixedlub.validation.measures import false_law, false_physics, laws_named, right, tied, unknown_suspected
from mixedlub.validation.score import (
    FIGURES,
    Figure,
    Measured,
    any_case,
    at_least,
    at_most,
    chosen,
    clear,
    of_class,
    share,
)
from mixedlub.validation.worlds.catalogue import TOGETHER

Counts = Callable[[Truth, Answer], bool]
Goal = tuple[float, float] | None


def _together(group: str) -> Counts:
    return lambda truth, answer: truth.group == group and set(TOGETHER) <= truth.laws


def _by_law(key: str, text: str, laws: Callable[[Truth], frozenset[str]], goal: Goal) -> Measured:
    """Figure that counts the laws of a case separately."""
    return Figure(
        key,
        text,
        lambda truth, answer: bool(laws(truth)),
        lambda truth, answer: laws_named(laws(truth), truth, answer),
        goal,
        "share",
        lambda truth: len(laws(truth)),
    )


def _every_law(truth: Truth, answer: Answer) -> float:
    return float(laws_named(truth.clear_laws, truth, answer) == 1.0)


_NOTHING = of_class("none")
_LAWS = (
    share("false_physics", "nothing missing: a false effect at 0.9 or more", _NOTHING, false_physics, at_most(0.03)),
    share("none", "  none, or laws alone", _NOTHING, right),
    share("unknown_false", "  unknown above 0.5", _NOTHING, unknown_suspected, at_most(0.05)),
    share("none_together", "  four laws at once: none, or laws alone", _together("none"), right, at_least(0.90)),
    share("unknown_together", "  four laws at once: unknown above 0.5", _together("none"), unknown_suspected,
           at_most(0.05)),
    _by_law("law", "law named or tied, where it leaves over 100", lambda truth: truth.clear_laws, at_least(0.70)),
    _by_law("law_sole", "  of these, no law of another step comes near", lambda truth: truth.sole_laws, None),
    share("laws_all", "  all such laws of a rig", lambda truth, answer: bool(truth.clear_laws), _every_law),
    share("law_false", "a law named that the rig does not follow", any_case, false_law),
    share("tied", "one effect: right or tied, beside any laws", of_class("single"), tied, at_least(0.95)),
    share("right", "  right, where identifiable", clear("single"), right),
    share("tied_together", "  four laws at once: right or tied", _together("single"), tied, at_least(0.85)),
    share("fault", "an instrument fault: right or tied, beside any laws", of_class("measurement"), tied),
)  # fmt: skip
AS_EVER = ("pair_both", "unknown", "outliers_found", "outliers_false", "crossed", "held_out", "coverage")
WORLD_FIGURES: tuple[Measured, ...] = (*_LAWS, *chosen(FIGURES, *AS_EVER, "seconds", "slowest"))
