"""A battery of rigs that follow other laws: contents of the cases, and steps with another law."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from mixedlub.validation.battery import (
    Survey,
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
from mixedlub.validation.rig import ASPERITIES, BALANCE, LAWS, MIXTURE, Law, Rig
from mixedlub.validation.rigs import CLASSES, KINDS, Family, Partners
from mixedlub.validation.sample_case import Order
from mixedlub.validation.worlds.catalogue import OF_KIND, SPOILT, TOGETHER, candidates, has_contact, laws_on
from profiles.errors import InputError

SHARES = dict(zip(CLASSES, (0.28, 0.36, 0.06, 0.05, 0.25)))
"""Shares of the classes: 60 cases and more in each group that has a goal, of 240."""
HOW_MANY = (0.5, 0.3, 0.2)
"""Shares of cases with one, two and three laws."""
FULL_PHYSICS, ANY_SIZE = 4, 4
"""Every fourth case with at most one effect has all of ``TOGETHER``; in every fourth the misfit may be small."""


Pool = Mapping[str, Sequence[Law]]
"""Laws that a rig can follow, by id."""


def worlds_of(kinds: Sequence[str]) -> tuple[str, ...]:
    """Kinds with other laws of their base chain."""
    return tuple(kind for kind in kinds if kind in OF_KIND)


def _named(survey: Survey) -> Survey:
    """Effects without the laws, which are followed and not planted."""
    named, outside = survey
    return {name: weight for name, weight in named.items() if name not in LAWS}, outside


def _pairs(kind: str, named: Sequence[str]) -> tuple[Partners, ...]:
    """Pairs of effects that can be planted on rigs of a kind that follow laws."""
    kept = [
        (first, tuple(one for one in partners if one in named), weight)
        for first, partners, weight in KINDS[kind].pairs
        if first in named
    ]
    return tuple(one for one in kept if one[1])


def _steps(rng: np.random.Generator, order: Order, ids: Sequence[str], lead: str) -> tuple[str, ...]:
    """Steps with another law, the dealt step first; none overruled by an effect of the case."""
    barred = {name for effect in order.effects for name in SPOILT.get(effect, ())}
    free = [name for name in ids if name not in barred]
    lead = lead if lead in free else free[int(rng.integers(len(free)))]
    rest = [name for name in free if name != lead]
    count = min(int(rng.choice(len(HOW_MANY), p=HOW_MANY)), len(rest))
    laws = (lead, *(rest[i] for i in rng.permutation(len(rest))[:count]))
    if {ASPERITIES, MIXTURE} <= set(laws) and BALANCE not in laws:
        # Weights by the film parameter leave asperities nothing to do.
        laws = tuple(name for name in laws if name != ASPERITIES) if lead == MIXTURE else (*laws, BALANCE)
    return laws


def _together(rng: np.random.Generator, order: Order, ids: Sequence[str]) -> bool:
    """Whether a case can have the laws of full physics."""
    barred = {name for effect in order.effects for name in SPOILT.get(effect, ())}
    return order.label in ("none", "single") and set(TOGETHER) <= set(ids) - barred


def _possible(order: Order, laws: Sequence[str], rigs: Sequence[tuple[Rig, Pool]]) -> bool:
    """Whether a rig is open to the effects of an order and can follow the laws at once."""
    for rig, pool in rigs:
        forms = rig.outside if order.label == "unknown" else rig.forms
        opened = {form.id for form in forms if form.rarity > 0}
        if set(order.effects) <= opened and all(candidates(pool, name, laws) for name in laws):
            return True
    return False


def _allowed(order: Order, laws: tuple[str, ...], ids: Sequence[str], rigs: Sequence[tuple[Rig, Pool]]) -> Order:
    """Order with the laws; with one of them, or else another, where no rig can follow them beside its effects."""
    free = [name for name in ids if not any(name in SPOILT.get(effect, ()) for effect in order.effects)]
    for some in (laws, *((name,) for name in (*laws, *free))):
        if _possible(order, some, rigs):
            return replace(order, laws=some)
    effects = " and ".join(order.effects)
    raise InputError(f"no rig of this kind has {effects} and follows another law", where="kinds", value=order.kind)


def _orders(rng: np.random.Generator, family: Family, seed: int, cases: int) -> list[Order]:
    rigs: dict[str, list[Rig]] = {kind: [r for r in drawn_rigs(kind, seed) if has_contact(r)] for kind in family.kinds}
    surveys = {kind: _named(surveyed(some)) for kind, some in rigs.items()}
    partners = {kind: _pairs(kind, list(surveys[kind][0])) for kind in family.kinds}
    pools = {kind: [(rig, laws_on(rig)) for rig in some] for kind, some in rigs.items()}
    ids = {kind: sorted({name for _, pool in some for name in pool}) for kind, some in pools.items()}
    family = replace(family, classes=SHARES)
    orders = ordered(rng, family, contents(rng, family, cases, surveys, partners))
    leads = {kind: iter(deck(rng, some, [1.0] * len(some), len(orders))) for kind, some in ids.items()}
    full, made = 0, []
    for place, order in enumerate(orders):
        laws = _steps(rng, order, ids[order.kind], next(leads[order.kind]))
        if _together(rng, order, ids[order.kind]):
            full += 1
            if full % FULL_PHYSICS == 0:
                laws = tuple(TOGETHER[i] for i in rng.permutation(len(TOGETHER)))
        order = replace(order, strong=place % ANY_SIZE != 0, no_data_sheet=False)
        made.append(_allowed(order, laws, ids[order.kind], pools[order.kind]))
    return made


def plan_worlds(seed: int, cases: int, kinds: Sequence[str] = tuple(OF_KIND)) -> list[Order]:
    """Orders of a battery of rigs that follow other laws: half of it gears and discs, if both are dealt."""
    if lawless := [kind for kind in kinds if kind not in OF_KIND]:
        raise InputError(
            f"other laws than the base model's are dealt for {', '.join(OF_KIND)}; leave out the others",
            where="kinds",
            value=", ".join(lawless),
        )
    if cases < fewest(kinds):
        raise InputError(f"a battery of these kinds has at least {fewest(kinds)} cases", where="cases", value=cases)
    chosen = families(kinds)
    each = sizes(np.random.default_rng([seed, 31]), chosen, cases, len(CLASSES))
    rng = np.random.default_rng([seed, 3])
    orders = [order for family, count in zip(chosen, each) for order in _orders(rng, family, seed, count)]
    return shuffled(rng, orders)
