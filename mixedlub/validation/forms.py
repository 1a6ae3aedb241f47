"""List of all published forms of every effect, and a battery that deals each in turn."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mixedlub.validation.battery import drawn_rigs, shuffled
from mixedlub.validation.planted import MEASUREMENT
from mixedlub.validation.rig import Form
from mixedlub.validation.rigs import CONTACTS, OTHERS
from mixedlub.validation.sample_case import Order
from profiles.errors import InputError


@dataclass(frozen=True)
class Listed:
    """A published form of an effect, as planted on each kind of rig."""

    effect: str
    source: str
    on: Mapping[str, Form]

    @property
    def kinds(self) -> tuple[str, ...]:
        return tuple(self.on)

    @property
    def within(self) -> tuple[str, ...]:
        """Kinds on which the catalogue's law can become the form."""
        return tuple(kind for kind, form in self.on.items() if form.within)


def every_form(kinds: Sequence[str] = (*CONTACTS, *OTHERS), seed: int = 0) -> list[Listed]:
    """Forms planted on rigs of the kinds, by effect and source; forms that are only rivals are left out."""
    found: dict[tuple[str, str], dict[str, Form]] = {}
    for kind in kinds:
        for form in (form for rig in drawn_rigs(kind, seed) for form in rig.forms if form.rarity > 0):
            found.setdefault((form.id, form.source), {})[kind] = form
    return [Listed(effect, source, on) for (effect, source), on in sorted(found.items())]


def plan_forms(seed: int, cases: int, kinds: Sequence[str] = (*CONTACTS, *OTHERS)) -> list[Order]:
    """Orders of a battery of single effects that covers every form, each on one of its kinds of rig."""
    listed = every_form(kinds)
    if cases < len(listed):
        raise InputError(f"a battery of every form has at least {len(listed)} cases", where="cases", value=cases)
    rng = np.random.default_rng([seed, 41])
    orders = []
    for place in range(cases):
        one = listed[place % len(listed)]
        kind = one.kinds[int(rng.integers(len(one.kinds)))]
        label = "measurement" if one.effect in MEASUREMENT else "single"
        orders.append(Order("", kind, label, (one.effect,), "clear", law=one.on[kind].law.__name__))
    return shuffled(rng, orders)
