"""Stages in series: losses at the input of each stage, and the power left for the next stage."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mixedlub.chain.ranges import VALID, Reached, findings, flags, validity
from mixedlub.efficiency.file import EfficiencyFile
from mixedlub.efficiency.meshes import mesh_losses
from mixedlub.efficiency.parts import KINDS, StagePart
from mixedlub.gear import GearPair
from mixedlub.schema.findings import Finding, gravest_first
from mixedlub.study import Study
from profiles.errors import InputError

MESH = ("sliding", "rolling")
"""Origins of the loss of a mesh."""
ORIGINS = (*MESH, *KINDS)
"""Origins of loss in the order of tables and figures."""
EXCEEDED = "losses_exceed_input"
"""Validity of a condition with losses above its input power: the gearbox needs an external drive."""
Origin = tuple[str, str, str]
"""Stage, origin, and name of the part (empty for the mesh)."""


@dataclass(frozen=True, eq=False)
class StageModel:
    """Gear pair with oil and parts, in SI."""

    name: str
    driving: str
    study: Study
    oil: Mapping[str, float]
    parts: tuple[StagePart, ...]

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

    def losses(self, torque: np.ndarray, speed: np.ndarray) -> tuple[dict[Origin, np.ndarray], Reached]:
        """Losses (W) by origin at torques (N m) and speeds (rad/s) of the driving side, and limits with values."""
        own = self.of_pinion(torque, speed)
        sliding, rolling, reached = mesh_losses(self.study, *own)
        found = {(self.name, "sliding", ""): sliding, (self.name, "rolling", ""): rolling}
        for part in self.parts:
            found[self.name, part.table, part.name] = part.loss(self.pair, self.oil, *own)
        for (_, origin, name), value in found.items():
            self._check_finite(".".join(filter(None, (origin, name))), value, torque, speed)
        of_parts = [one for part in self.parts for one in part.reached(self.pair, own[1])]
        return found, [*reached, *of_parts]

    def _check_finite(self, place: str, loss: np.ndarray, torque: np.ndarray, speed: np.ndarray) -> None:
        """Raise an error for losses that are not finite, outside the domain of a law."""
        wrong = np.flatnonzero(~np.isfinite(loss))
        if wrong.size:
            at = f"{torque[wrong[0]]:.4g} N m and {speed[wrong[0]] * 30.0 / np.pi:.4g} rpm of its driving side"
            rule = f"no finite loss at {at}; look for a number far out of range"
            raise InputError(rule, where=f"stages.{self.name}.{place}")


@dataclass(frozen=True, eq=False)
class Losses:
    """Losses of a gearbox at N conditions of its input, in SI.

    ``torque``, ``speed``: at the input; ``by_origin``: losses (W); ``reached``: limits of each stage with values.
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
            f"{name}:{code}" if len(self.reached) > 1 else code: grades
            for name, own in self.reached.items()
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
        places = ((f"stages.{name}", own) for name, own in self.reached.items())
        each = (findings(own, self.torque.shape, "conditions", place) for place, own in places)
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
    stages: tuple[StageModel, ...]

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
            own, reached[stage.name] = stage.losses(np.maximum(power, 0.0) / turning, turning)
            found |= own
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
