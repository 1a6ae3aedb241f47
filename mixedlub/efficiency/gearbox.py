"""Stages in series: losses at the input of each stage, and the power left for the next stage."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mixedlub.chain.ranges import VALID, Reached, findings, flags, validity
from mixedlub.efficiency.file import EfficiencyFile
from mixedlub.efficiency.parts import KINDS
from mixedlub.efficiency.planetary import PlanetaryModel
from mixedlub.efficiency.stage import Origin, StageModel
from mixedlub.schema.findings import Finding, gravest_first

MESH = ("sliding", "rolling")
"""Origins of the loss of a mesh."""
ORIGINS = (*MESH, *KINDS)
"""Origins of loss in the order of tables and figures."""
EXCEEDED = "losses_exceed_input"
"""Validity of a condition with losses above its input power: the gearbox needs an external drive."""
StageOfAnyKind = StageModel | PlanetaryModel


@dataclass(frozen=True, eq=False)
class Losses:
    """Losses of a gearbox at N conditions of its input, in SI.

    ``torque``, ``speed``: at the input; ``by_origin``: losses (W); ``reached``: limits with
    values, by place in the file.
    """

    gearbox: Gearbox
    torque: np.ndarray
    speed: np.ndarray
    by_origin: Mapping[Origin, np.ndarray]
    reached: Mapping[str, Reached]

    @cached_property
    def validity(self) -> tuple[str, ...]:
        """Validity codes of each condition; with several stages, each code has the prefix of its stage."""
        found = {
            f"{place.partition('.')[2]}:{code}" if len(self.reached) > 1 else code: grades
            for place, own in self.reached.items()
            for code, grades in flags(own, self.torque.shape).items()
        }
        exceeded = (self.output_power < 0.0) & (self.torque > 0.0)
        words = validity(found, self.torque.shape)
        return tuple(
            "; ".join([*([] if word == VALID else [word]), EXCEEDED]) if over else word
            for word, over in zip(words, exceeded, strict=True)
        )

    @cached_property
    def findings(self) -> tuple[Finding, ...]:
        """Findings on conditions outside the range of the model, by descending severity."""
        each = (findings(own, self.torque.shape, "conditions", place) for place, own in self.reached.items())
        return tuple(gravest_first(one for own in each for one in own))

    @cached_property
    def input_power(self) -> np.ndarray:
        """Input torque times input speed (W)."""
        return self.torque * self.speed

    def total(self, *, stage: str | None = None, origins: tuple[str, ...] = ORIGINS) -> np.ndarray:
        """Sum of losses (W) of given origins, of one or all stages."""
        chosen = [v for (name, origin, _), v in self.by_origin.items() if origin in origins and stage in (None, name)]
        return np.sum(chosen, axis=0) if chosen else np.zeros_like(self.torque)

    @cached_property
    def output_power(self) -> np.ndarray:
        """Output power (W); below 0 the output must be driven."""
        return self.input_power - self.total()

    def efficiency(self, origins: tuple[str, ...] = ORIGINS) -> np.ndarray:
        """Share of the input power left by losses of given origins; NaN without torque or output.

        The origins `MESH` give the tooth efficiency, all origins the gearbox efficiency.
        """
        drives = (self.input_power > 0.0) & (self.output_power > 0.0)
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(drives, 1.0 - self.total(origins=origins) / self.input_power, np.nan)


@dataclass(frozen=True, eq=False)
class Gearbox:
    """Stages in the order of the power."""

    file: EfficiencyFile
    stages: tuple[StageOfAnyKind, ...]

    @property
    def ratio(self) -> float:
        """Input speed over output speed."""
        return float(np.prod([stage.ratio for stage in self.stages]))

    def losses(self, torque: np.ndarray, speed: np.ndarray) -> Losses:
        """Losses at torques (N m) and speeds (rad/s) of the input, by condition.

        The input of a stage is the output of the stage before; without power left, it turns without torque.
        """
        power, turning = torque * speed, speed
        found: dict[Origin, np.ndarray] = {}
        reached: dict[str, Reached] = {}
        for stage in self.stages:
            own, limits = stage.losses(np.maximum(power, 0.0) / turning, turning)
            found |= own
            reached |= limits
            power = power - np.sum(list(own.values()), axis=0)
            turning = turning / stage.ratio
        return Losses(self, torque, speed, found, reached)

    def map(self) -> Losses:
        """Losses at every torque and speed of the file; the speed varies fastest."""
        levels = self.file.conditions
        torque, speed = np.meshgrid(levels.torque_Nm, np.array(levels.speed_rpm) * np.pi / 30.0, indexing="ij")
        return self.losses(torque.ravel(), speed.ravel())

    def at_cycle(self) -> Losses:
        """Losses at the condition of the mesh cycle, with a torque above 0."""
        cycle, levels = self.file.cycle, self.file.conditions
        torque = max(levels.torque_Nm) if cycle.torque_Nm is None else cycle.torque_Nm
        speed = max(levels.speed_rpm) if cycle.speed_rpm is None else cycle.speed_rpm
        return self.losses(np.array([torque]), np.array([speed * np.pi / 30.0]))
