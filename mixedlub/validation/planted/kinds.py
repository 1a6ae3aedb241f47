"""What a concealed effect is: a law with knobs, the stage it acts after, and where it can occur."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from mixedlub.validation.rig import Contact, Hidden, Rig

GEAR = ("gear_pair",)
DISC = ("disc",)
BOTH = ("gear_pair", "disc")


@dataclass(frozen=True)
class Knob:
    """One number of a law: what a rival fit may use (``low`` to ``high``) and what is drawn (``typical``)."""

    name: str
    low: float
    high: float
    typical: tuple[float, float]


@dataclass(frozen=True)
class Concealed:
    """A law that can be slipped in after ``hook``; its first knob is the strength, absent at zero.

    ``sign`` is what it does to the recorded quantity overall: +1, -1, or 0 where it may do both.
    ``rarity`` is its weight when effects are drawn. ``within`` says that the catalogue's law of the same effect can
    become this one, at some values of its parameters or in their limit.
    """

    id: str
    stage: str
    hook: str
    law: Callable[..., Contact]
    knobs: tuple[Knob, ...]
    source: str
    sign: int
    kinds: tuple[str, ...] = BOTH
    rarity: float = 1.0
    possible: Callable[[Rig], bool] = lambda rig: True
    within: bool = False

    def occurs_on(self, rig: Rig) -> bool:
        return rig.kind in self.kinds and self.possible(rig)

    def hide(self, values: Mapping[str, float]) -> Hidden:
        return Hidden(self.hook, lambda contact: self.law(contact, **values))


def strength(low: float, high: float, typical: tuple[float, float] = (0.7, 1.4)) -> Knob:
    return Knob("strength", low, high, typical)
