"""A battery of rigs of full physics: discs and gears, each with one thing concealed or nothing."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mixedlub.validation.battery import deck, fewest, shuffled
from mixedlub.validation.sample_case import Order
from mixedlub.validation.solved.world import ALWAYS, SWITCHES
from profiles.errors import InputError

DISCS = 2 / 3
"""Share of discs where both kinds are dealt."""
FULL_BASE = 3
"""Every third case declares full solutions as its base, unless they contain the concealed part."""


def plan_solved(seed: int, cases: int, kinds: Sequence[str] = ALWAYS) -> list[Order]:
    """Orders of a battery of rigs of full physics, in random order under neutral names."""
    if others := [kind for kind in kinds if kind not in ALWAYS]:
        raise InputError(f"full solutions are made of {' and '.join(ALWAYS)} alone", where="kinds", value=others)
    if cases < fewest(kinds):
        raise InputError(f"a battery of these kinds has at least {fewest(kinds)} cases", where="cases", value=cases)
    rng = np.random.default_rng([seed, 4])
    orders: list[Order] = []
    for kind in kinds:
        share = 1.0 if len(kinds) == 1 else DISCS if kind == "disc" else 1 - DISCS
        count = round(share * cases)
        dealt = {name: switch for name, switch in SWITCHES.items() if kind in switch.kinds}
        names = deck(rng, list(dealt), [switch.weight for switch in dealt.values()], count)
        for place, name in enumerate(names):
            switch = dealt[name]
            orders.append(
                Order(
                    name="",
                    kind=kind,
                    label="single" if switch.effect else "none",
                    effects=(switch.effect,) if switch.effect else (),
                    level="clear",
                    outliers=bool(rng.random() < 0.2),
                    solved=name,
                    full_base=place % FULL_BASE == 0 and not switch.contained,
                )
            )
    return shuffled(rng, orders)
