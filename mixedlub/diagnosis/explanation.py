"""What a simulation may lack: nothing, effects of the catalogue, or a discrepancy of a form that none of them has."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, order=True)
class Explanation:
    """Effects of the catalogue by id, in alphabetical order; none of them: nothing is missing, or a ``discrepancy``.

    >>> Explanation.of("stribeck", "seal_drag").ids, NOTHING.ids, DISCREPANCY.ids
    (('seal_drag', 'stribeck'), ('none',), ('unknown',))
    """

    effects: tuple[str, ...] = ()
    is_discrepancy: bool = False

    @classmethod
    def of(cls, *effects: str) -> Explanation:
        """One or more effects, in any order."""
        return cls(tuple(sorted(effects)))

    @property
    def ids(self) -> tuple[str, ...]:
        """The explanation as files of the answer write it."""
        return self.effects or (("unknown",) if self.is_discrepancy else ("none",))


NOTHING = Explanation()
"""The calibrated base model explains the readings."""
DISCREPANCY = Explanation(is_discrepancy=True)
"""A smooth or local function of the conditions, fitted without physics, explains them."""
