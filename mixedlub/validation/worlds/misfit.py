"""Misfit of a law to the base model, and its likeness to other laws, on noise-free readings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mixedlub.validation.rig import Rig
from mixedlub.validation.rivals import Target, best
from mixedlub.validation.worlds.catalogue import Followed, World, following, laws_on

CLEAR = 100.0
"""Chi-square after recalibration above which a law is identifiable."""


@dataclass(frozen=True)
class Seen:
    """A rig in the base model, its recorded rows, the calibration and the standard deviation of each row."""

    rig: Rig
    rows: np.ndarray
    z: np.ndarray
    sd: np.ndarray

    def misfit(self, true: Sequence[Followed], tried: Sequence[Followed]) -> float:
        """Chi-square, with the calibration under its prior, of readings in one world by the laws of another."""
        values = following(self.rig, true).records(self.z, ())[self.rows]
        model = following(self.rig, tried).nature
        chi_square = best(Target(model, self.rows, values, self.sd), (), self.z).chi_square
        return round(max(chi_square - float(self.z @ self.z), 0.0), 4)

    def alone(self, world: World, one: Followed) -> float:
        """Misfit of the base model to a rig that follows one law of a world and the laws that it needs."""
        needed = [other for other in world if other.law.id in one.law.needs]
        return self.misfit([one, *needed], needed)

    def beside(self, world: World, one: Followed) -> float:
        """Misfit without one law, all the others of the world known."""
        return self.misfit(world, without(world, one))

    def exchanged(self, world: World, one: Followed) -> dict[str, float]:
        """Misfit with one law replaced by a law of another step, the others known, by the id of the replacement."""
        followed, others = {other.law.id for other in world}, without(world, one)
        kept = {other.law.id for other in others}
        found: dict[str, float] = {}
        for name, laws in laws_on(self.rig).items():
            for law in laws if name not in followed else ():
                if law.fits(kept) and all(other.law.fits(kept | {name}) for other in others):
                    tried = self.misfit(world, [*others, Followed(law, law.middle)])
                    found[name] = min(tried, found.get(name, np.inf))
        return found


def without(world: World, one: Followed) -> list[Followed]:
    """World without one law and the laws that need it."""
    return [other for other in world if other is not one and one.law.id not in other.law.needs]


def told(seen: Seen, world: World) -> dict[str, Any]:
    """Entries of the truth about the laws: names, knobs, sources, misfits, and misfits of other laws."""
    misfits = {one.law.id: (seen.alone(world, one), seen.beside(world, one)) for one in world}
    return {
        "laws": {one.law.id: one.law.name for one in world},
        "law_info": {one.law.id: {"source": one.law.source, **one.values} for one in world},
        "law_misfit": {name: {"alone": alone, "beside": beside} for name, (alone, beside) in misfits.items()},
        "law_alternatives": {
            one.law.id: seen.exchanged(world, one) for one in world if min(misfits[one.law.id]) > CLEAR
        },
    }
