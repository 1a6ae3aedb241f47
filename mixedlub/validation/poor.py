"""Batteries of poor recordings: flaws, their distribution over the cases, and their score.

Effects are as visible at the true noise as in the other batteries. The recording or its description is flawed: too few
readings, correlated or non-Gaussian noise, estimated sds, a calibration beyond its stated sd, or three effects.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from mixedlub.validation.answers import Answer, Truth
from mixedlub.validation.battery import (
    contents,
    deck,
    drawn_rigs,
    families,
    fewest,
    ordered,
    shuffled,
    sizes,
    surveyed,
)
from mixedlub.validation.measures import together
from mixedlub.validation.planted import FORMS
from mixedlub.validation.rig import Rig
from mixedlub.validation.rigs import CLASSES, KINDS, Family, Partners
from mixedlub.validation.sample_case import FEW, HEAVY, LASTING, MIS_SET, SD_ESTIMATED, Order
from mixedlub.validation.score import FIGURES, Measured, any_case, at_least, chosen, of_class, share
from mixedlub.validation.worlds.figures import WORLD_FIGURES
from profiles.errors import InputError

THREE = "three effects"
FLAWS = {
    FEW: "12 to 24 readings",
    LASTING: "0.3 to 0.8 of the variance of the noise lasts over 3 to 20 readings",
    HEAVY: "noise of Student's t with 3 degrees of freedom, of the stated standard deviation",
    SD_ESTIMATED: "standard deviations estimated from 3 to 6 repeats, of each reading or of all alike",
    MIS_SET: "two calibrations 2 to 3 stated standard deviations off",
    THREE: "three effects that act after different stages",
}
SHARES = dict(zip(CLASSES, (0.28, 0.42, 0.08, 0.06, 0.16)))
"""Shares of the classes among cases with at most two effects."""
TRIPLE = "triple"
MOST_DRAWS = 20
"""Largest number of draws of three effects, over the number wanted."""
SECOND_FLAW = 4
"""Every fourth case with at most two effects has a second flaw."""


def _triple(rng: np.random.Generator, partners: Sequence[Partners]) -> tuple[str, ...] | None:
    """Three effects after different stages; the first forms a pair with each of the others."""
    first, seconds, _ = partners[int(rng.integers(len(partners)))]
    more = [one for name, some, _ in partners if name == first for one in some]
    more += [name for name, some, _ in partners if first in some]
    seconds = tuple(dict.fromkeys(one for one in (*seconds, *more) if one != first))
    hooks = {name: FORMS[name][0].hook if name in FORMS else name for name in seconds}
    for place in rng.permutation(len(seconds)):
        one = seconds[place]
        fitting = [name for name in seconds if hooks[name] != hooks[one]]
        if fitting:
            return first, one, fitting[int(rng.integers(len(fitting)))]
    return None


def _triples(rng: np.random.Generator, drawn: Mapping[str, Sequence[Rig]], count: int) -> list[Order]:
    """Cases with three effects, on rigs open to all three."""
    orders: list[Order] = []
    for _ in range(MOST_DRAWS * count):
        if len(orders) == count:
            break
        kind = list(drawn)[len(orders) % len(drawn)]
        effects = _triple(rng, KINDS[kind].pairs)
        if effects and any(set(effects) <= rig.ids for rig in drawn[kind]):
            orders.append(Order("", kind, TRIPLE, effects, "clear", flaws=(THREE,)))
    return orders


def _orders(rng: np.random.Generator, family: Family, seed: int, cases: int) -> list[Order]:
    drawn = {kind: drawn_rigs(kind, seed) for kind in family.kinds}
    surveys = {kind: surveyed(rigs) for kind, rigs in drawn.items()}
    partners = {kind: KINDS[kind].pairs for kind in family.kinds}
    triples = _triples(rng, drawn, cases // len(FLAWS))
    dealt = contents(rng, replace(family, classes=SHARES), cases - len(triples), surveys, partners)
    others = [name for name in FLAWS if name != THREE]
    flaws = deck(rng, others, [1.0] * len(others), len(dealt))
    made = []
    for place, order in enumerate(ordered(rng, family, dealt)):
        own = {flaws[place]}
        if place % SECOND_FLAW == 0:
            more = [name for name in others if name not in own]
            own.add(more[int(rng.integers(len(more)))])
        # Without a data sheet there is no stated calibration that could be off.
        unnamed = order.no_data_sheet and MIS_SET not in own
        made.append(replace(order, flaws=tuple(sorted(own)), small=FEW in own, no_data_sheet=unnamed))
    return made + triples


def plan_poor(seed: int, cases: int, kinds: Sequence[str]) -> list[Order]:
    """Orders of a battery of poor recordings, half of them gears and discs; each has one or two flaws."""
    chosen = families(kinds)
    least = fewest(kinds) + len(chosen)
    if cases < least:
        raise InputError(f"a battery of these kinds has at least {least} cases", where="cases", value=cases)
    rng = np.random.default_rng([seed, 4])
    each = sizes(rng, chosen, cases, least // len(chosen))
    return shuffled(rng, [order for family, n in zip(chosen, each) for order in _orders(rng, family, seed, n)])


def _two_of_three(truth: Truth, answer: Answer) -> float:
    return float(len(truth.label & answer.verdict) >= 2)


def _few_tied(truth: Truth, answer: Answer) -> float:
    return float(len(answer.tied) <= 3)


POOR_FIGURES: tuple[Measured, ...] = (
    *FIGURES,
    share("three", "three effects named, or in one tie", of_class(TRIPLE), together, at_least(0.6)),
    share("two_of_three", "  two of them named", of_class(TRIPLE), _two_of_three),
    *chosen(WORLD_FIGURES, "false_physics", "unknown_false"),
    share("few_tied", "at most three explanations tied", any_case, _few_tied, at_least(0.9)),
)
