"""Base of a case: chain of laws, with the inputs and calibrations of the base itself."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from mixedlub.chain.model import Chain
from mixedlub.kinds.calibration import Calibration


@dataclass(frozen=True, eq=False)
class Base:
    """Chain with its additional inputs and calibrations.

    ``contained``: effects that the chain has already. ``moves``: changes of the calibrations of the case, by name.
    """

    chain: Chain
    inputs: Mapping[str, Any] = field(default_factory=dict)
    calibrations: tuple[Calibration, ...] = ()
    contained: tuple[str, ...] = ()
    moves: Mapping[str, Callable[[Calibration], Calibration]] = field(default_factory=dict)

    def moved(self, one: Calibration) -> Calibration:
        """A calibration of the case, as this base needs it."""
        return self.moves[one.name](one) if one.name in self.moves else one
