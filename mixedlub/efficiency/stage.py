"""Stage of one gear pair: losses at its driving side."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mixedlub.chain.ranges import Reached
from mixedlub.efficiency.meshes import mesh_losses
from mixedlub.efficiency.parts import StagePart, oil_state
from mixedlub.gear import GearPair
from mixedlub.study import Study
from profiles.errors import InputError

Origin = tuple[str, str, str]
"""Stage, origin, and name of the part or of the mesh (empty for the one mesh of a stage)."""


def check_finite(place: str, loss: np.ndarray, torque: np.ndarray, speed: np.ndarray) -> None:
    """Raise an error for losses that are not finite, outside the domain of a law."""
    wrong = np.flatnonzero(~np.isfinite(loss))
    if wrong.size:
        at = f"{torque[wrong[0]]:.4g} N m and {speed[wrong[0]] * 30.0 / np.pi:.4g} rpm of its driving side"
        rule = f"no finite loss at {at}; look for a number far out of range"
        raise InputError(rule, where=place)


@dataclass(frozen=True, eq=False)
class StageModel:
    """Gear pair with oil and parts, in SI; ``warm``: oil temperature (K) of the mesh by condition, by default that of
    the file."""

    name: str
    driving: str
    study: Study
    oil: Mapping[str, Any]
    parts: tuple[StagePart, ...]
    warm: np.ndarray | None = None

    def at(self, sump: np.ndarray, rise: np.ndarray) -> StageModel:
        """Stage with oil temperatures (K) by condition; the oil of the mesh is warmer by a rise (K)."""
        return replace(self, warm=sump + rise, oil=oil_state(self.study.oil, sump))

    @property
    def pair(self) -> GearPair:
        """Gear pair of the stage."""
        return self.study.pair

    @property
    def ratio(self) -> float:
        """Speed of the driving over speed of the driven side."""
        return self.pair.gear_ratio if self.driving == "pinion" else 1.0 / self.pair.gear_ratio

    @property
    def driven(self) -> str:
        """Driven side."""
        return "gear" if self.driving == "pinion" else "pinion"

    def of_pinion(self, torque: np.ndarray, speed: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Torque and speed of the pinion from torque and speed of the driving side."""
        if self.driving == "pinion":
            return torque, speed
        return torque / self.pair.gear_ratio, speed * self.pair.gear_ratio

    @property
    def all_parts(self) -> tuple[StagePart, ...]:
        """Parts with losses outside the mesh."""
        return self.parts

    def mesh_of(self, part: str) -> StageModel:
        """The only mesh of the stage."""
        return self

    def cycles(self, torque: float, speed: float) -> list[tuple[StageModel, float, float]]:
        """The mesh with torque and speed of its driving side."""
        return [(self, torque, speed)]

    def losses(self, torque: np.ndarray, speed: np.ndarray) -> tuple[dict[Origin, np.ndarray], dict[str, Reached]]:
        """Losses (W) by origin at torques (N m) and speeds (rad/s) of the driving side, and limits by place."""
        own = self.of_pinion(torque, speed)
        sliding, rolling, reached = mesh_losses(self.study, *own, self.warm)
        found = {(self.name, "sliding", ""): sliding, (self.name, "rolling", ""): rolling}
        for part in self.parts:
            found[self.name, part.table, part.name] = part.loss(self.pair, self.oil, *own)
        for (_, origin, name), value in found.items():
            place = ".".join(filter(None, (origin, name)))
            check_finite(f"stages.{self.name}.{place}", value, torque, speed)
        of_parts = [one for part in self.parts for one in part.reached(self.pair, own[1])]
        return found, {f"stages.{self.name}": [*reached, *of_parts]}
