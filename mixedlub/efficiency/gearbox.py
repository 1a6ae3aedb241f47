"""Stages in series: losses at the input of each stage, and the power left for the next stage.

In coast the input torque is below zero: the output drives the same stages in reverse order.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from mixedlub.chain.ranges import VALID, Limit, Reached, findings, flags, validity
from mixedlub.efficiency.file import EfficiencyFile
from mixedlub.efficiency.parts import KINDS
from mixedlub.efficiency.planetary import PlanetaryModel
from mixedlub.efficiency.stage import Origin, StageModel
from mixedlub.schema.findings import Finding, gravest_first
from profiles.errors import InputError

MESH = ("sliding", "rolling")
"""Origins of the loss of a mesh."""
ORIGINS = (*MESH, *KINDS)
"""Origins of loss in the order of tables and figures."""
ROUNDS = 60
"""Cost limit. Rounds in which the power of the output settles in coast; its losses are a few percent, so five do."""
SETTLED = 1e-7
"""Grid. Relative change of that power in a round at which it has settled."""
EXCEEDED = "losses_exceed_input"
"""Validity of a condition with losses above its input power: the gearbox needs an external drive."""
StageOfAnyKind = StageModel | PlanetaryModel
Found = tuple[Mapping[Origin, np.ndarray], Mapping[str, Reached]]
"""Losses by origin, and limits by place."""


@dataclass(frozen=True, eq=False)
class Losses:
    """Losses of a gearbox at N conditions of its input, in SI.

    ``torque``, ``speed``: at the input, torque below zero in coast; ``by_origin``: losses (W); ``reached``: limits with
    values, by place in the file; ``oil``: temperature of the oil of all stages (degC), None if stages differ.
    """

    gearbox: Gearbox
    torque: np.ndarray
    speed: np.ndarray
    by_origin: Mapping[Origin, np.ndarray]
    reached: Mapping[str, Reached]
    oil: np.ndarray | None = None

    def where(self, chosen: np.ndarray) -> Losses:
        """Losses at some of the conditions."""
        return replace(
            self,
            torque=self.torque[chosen],
            speed=self.speed[chosen],
            by_origin={origin: values[chosen] for origin, values in self.by_origin.items()},
            reached={place: [(limit, v[chosen]) for limit, v in own] for place, own in self.reached.items()},
            oil=None if self.oil is None else self.oil[chosen],
        )

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
        """Output power (W); below 0 the output must be driven, as in coast."""
        return self.input_power - self.total()

    @cached_property
    def power_taken(self) -> np.ndarray:
        """Power (W) of the side that drives: the output in coast."""
        return np.where(self.torque < 0.0, -self.output_power, self.input_power)

    def efficiency(self, origins: tuple[str, ...] = ORIGINS) -> np.ndarray:
        """Share of the power taken in that losses of given origins leave; NaN without torque or power delivered.

        The origins `MESH` give the tooth efficiency, all origins the gearbox efficiency.
        """
        taken = self.power_taken
        drives = (taken > 0.0) & (taken > self.total()) & (self.torque != 0.0)
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(drives, 1.0 - self.total(origins=origins) / taken, np.nan)


@dataclass(frozen=True, eq=False)
class Gearbox:
    """Stages in the order of the power.

    ``coasting``: the same gearbox driven at its output; ``at_oil``: the gearbox by oil temperature (degC) of the map.
    """

    file: EfficiencyFile
    stages: tuple[StageOfAnyKind, ...]
    coasting: Gearbox | None = None
    at_oil: Mapping[float, Gearbox] = field(default_factory=dict)

    @property
    def ratio(self) -> float:
        """Input speed over output speed."""
        return float(np.prod([stage.ratio for stage in self.stages]))

    def losses(self, torque: np.ndarray, speed: np.ndarray) -> Losses:
        """Losses at torques (N m), below zero in coast, and speeds (rad/s) of the input, by condition."""
        coast = torque < 0.0
        parts = [(~coast, self._driving(torque[~coast], speed[~coast]))] if not coast.all() else []
        parts += [(coast, self._coasting(torque[coast], speed[coast]))] if coast.any() else []
        return Losses(self, torque, speed, *_joined(parts))

    def _coasting(self, torque: np.ndarray, speed: np.ndarray) -> Found:
        """Losses where the output drives: it takes in the power of the input plus all losses, which depend on it."""
        if self.coasting is None:
            raise InputError("below 0, where the output drives; name them in the file", where="torque of the input")
        delivered, turning = -torque * speed, speed / self.ratio
        power = delivered
        for _ in range(ROUNDS):
            found = self.coasting._driving(power / turning, turning)
            before, power = power, delivered + np.sum(list(found[0].values()), axis=0)
            if np.all(np.abs(power - before) <= SETTLED * power):
                return found
        rule = "in coast the losses take all power of the output, so that the gearbox locks; leave torques below 0 out"
        raise InputError(rule, where="conditions.torque_Nm")

    def _driving(self, torque: np.ndarray, speed: np.ndarray) -> Found:
        """Losses where the input drives.

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
        return found, reached

    def map(self) -> Losses:
        """Losses at every oil temperature, torque and speed of the file; the speed varies fastest."""
        levels = self.file.conditions
        torque, speed = np.meshgrid(levels.torque_Nm, np.array(levels.speed_rpm) * np.pi / 30.0, indexing="ij")
        if not self.at_oil:
            return self.losses(torque.ravel(), speed.ravel())
        oil = np.repeat(list(self.at_oil), torque.size)
        each = [box.losses(torque.ravel(), speed.ravel()) for box in self.at_oil.values()]
        found = _joined([(oil == at, (one.by_origin, one.reached)) for at, one in zip(self.at_oil, each, strict=True)])
        return Losses(self, np.tile(torque.ravel(), len(each)), np.tile(speed.ravel(), len(each)), *found, oil)

    def at_cycle(self) -> Losses:
        """Losses at the condition of the mesh cycle; in coast of the gearbox driven at its output."""
        cycle, levels = self.file.cycle, self.file.conditions
        torque = strongest(levels.torque_Nm) if cycle.torque_Nm is None else cycle.torque_Nm
        speed = max(levels.speed_rpm) if cycle.speed_rpm is None else cycle.speed_rpm
        at = self.losses(np.array([torque]), np.array([speed * np.pi / 30.0]))
        if self.coasting is None or torque >= 0.0:
            return at
        turning = at.speed / self.ratio
        return self.coasting.losses(at.power_taken / turning, turning)


def strongest(torques: Sequence[float]) -> float:
    """Largest torque; of coast alone the lowest.

    >>> strongest([-200.0, 50.0, 100.0]), strongest([-200.0, -100.0, 0.0])
    (100.0, -200.0)
    """
    return max(torques) if max(torques) > 0.0 else min(torques)


def _joined(parts: Sequence[tuple[np.ndarray, Found]]) -> Found:
    """Losses and limits of all conditions, from those where each mask holds; other values of a limit are NaN."""
    size = parts[0][0].size
    by_origin: dict[Origin, np.ndarray] = {}
    reached: dict[str, list[tuple[Limit, np.ndarray]]] = {}
    for where, (found, limits) in parts:
        for origin, values in found.items():
            by_origin.setdefault(origin, np.zeros(size))[where] = values
        for place, own in limits.items():
            known = reached.setdefault(place, [])
            if [limit.code for limit, _ in known] != [limit.code for limit, _ in own]:
                known += [(limit, np.full(size, np.nan)) for limit, _ in own]
            for (_, whole), (_, values) in zip(known[len(known) - len(own) :], own, strict=True):
                whole[where] = values
    return by_origin, reached
