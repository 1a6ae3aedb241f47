"""Explanations of a mismatch: nothing missing, effects of the catalogue, or a discrepancy of another form."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, order=True)
class Explanation:
    """Effects of the catalogue by id, in alphabetical order; without effects: nothing missing, or a discrepancy.

    >>> Explanation.of("stribeck", "seal_drag").ids, NOTHING.ids, DISCREPANCY.ids
    (('seal_drag', 'stribeck'), ('none',), ('unknown',))
    """

    effects: tuple[str, ...] = ()
    is_discrepancy: bool = False

    @classmethod
    def of(cls, *effects: str) -> Explanation:
        """Explanation by effects, in any order."""
        return cls(tuple(sorted(effects)))

    @property
    def ids(self) -> tuple[str, ...]:
        """Ids of the explanation in the files of the answer."""
        return self.effects or (("unknown",) if self.is_discrepancy else ("none",))


NOTHING = Explanation()
"""The calibrated base model explains the readings."""
DISCREPANCY = Explanation(is_discrepancy=True)
"""A smooth or local function of the conditions, fitted without physics, explains the readings."""
