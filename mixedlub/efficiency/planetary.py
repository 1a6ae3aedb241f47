"""Planetary stage of a gearbox: equilibrium with the losses of its meshes, and losses of its other parts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import product
from typing import Any

import numpy as np

from mixedlub.chain.ranges import Limit, Reached
from mixedlub.efficiency.meshes import mesh_losses
from mixedlub.efficiency.parts import StagePart
from mixedlub.efficiency.planetary_file import PlanetaryStage
from mixedlub.efficiency.planets import PlanetSet
from mixedlub.efficiency.stage import Origin, StageModel, check_finite
from mixedlub.efficiency.train import CARRIER, Flow, PlanetaryTrain

ROUNDS = 8
"""Cost limit. Most evaluations of the meshes in the search for the equilibrium; friction hardly depends on load: two or
three do."""
SETTLED = 1e-4
"""Judgement. Relative change of mesh forces between two evaluations that ends the search: friction changes by less than
its tenth."""
LOCKS = Limit(
    "self_locking",
    "power_of_output_over_input",
    (0.0, np.inf),
    "friction in its meshes takes all power of the input: the train does not turn",
    little=(0.0, np.inf),
)


@dataclass(frozen=True, eq=False)
class PlanetaryState:
    """Planetary stage at N conditions of its input, in SI.

    By mesh (M, N): ``sliding``, ``rolling`` (W, all planets) and ``rolled`` (W), the power that the mesh takes in
    relative to the carrier; ``pin`` (K, N): radial load (N) of each kind of planet in one group, on the mean planet.
    """

    flow: Flow
    sliding: np.ndarray
    rolling: np.ndarray
    rolled: np.ndarray
    pin: Mapping[str, np.ndarray]
    found: Mapping[Origin, np.ndarray]
    reached: Mapping[str, Reached]


@dataclass(frozen=True, eq=False)
class PlanetaryModel:
    """Planetary train with oil and parts, in SI; ``meshes`` in the order of the couplings of the train.

    ``finished``: meshes by name and by the finishes of their wheels ("" for the surface of the mesh).
    """

    name: str
    section: PlanetaryStage
    train: PlanetaryTrain
    planets: PlanetSet
    meshes: tuple[StageModel, ...]
    oil: Mapping[str, Any]
    parts: tuple[StagePart, ...]
    planet_parts: Mapping[str, tuple[StagePart, ...]]
    finished: Mapping[str, Mapping[tuple[str, str], StageModel]] = field(default_factory=dict)

    def at(self, sump: np.ndarray, rise: np.ndarray) -> PlanetaryModel:
        """Stage with oil temperatures (K) by condition; the oil of the meshes is warmer by a rise (K)."""
        meshes = tuple(one.at(sump, rise) for one in self.meshes)
        return replace(self, meshes=meshes, oil=meshes[0].oil)

    @property
    def driving(self) -> str:
        """Member that drives."""
        return self.train.input

    @property
    def driven(self) -> str:
        """Member that is driven."""
        return self.train.output

    @property
    def ratio(self) -> float:
        """Speed of the input over speed of the output, without its sign."""
        return 1.0 / abs(self.train.speeds[self.train.output])

    @property
    def all_parts(self) -> tuple[StagePart, ...]:
        """Parts of members and planets."""
        return (*self.parts, *(part for own in self.planet_parts.values() for part in own))

    @cached_property
    def loads(self) -> tuple[np.ndarray, np.ndarray]:
        """Different loads of the planets over the mean, and how many planets have each."""
        return np.unique(self.section.planet_loads or (1.0,) * self.section.planet_count, return_counts=True)

    def combinations(self) -> Iterator[tuple[dict[str, str], PlanetaryModel]]:
        """Finishes of wheels in all combinations, each with the stage that has them."""
        tried = self.section.pairings
        for names in product(*tried.values()) if tried else ():
            finish = dict(zip(tried, names, strict=True))
            own = [tuple(finish.get(wheel, "") for wheel in one.wheels) for one in self.train.couplings]
            meshes = (self.finished[one.name][a, b] for one, (a, b) in zip(self.train.couplings, own, strict=True))
            yield finish, replace(self, meshes=tuple(meshes))

    def mesh_of(self, part: str) -> StageModel:
        """Mesh by its name in the file."""
        return self.meshes[[one.name for one in self.train.couplings].index(part)]

    def losses(self, torque: np.ndarray, speed: np.ndarray) -> tuple[dict[Origin, np.ndarray], dict[str, Reached]]:
        """Losses (W) by origin at torques (N m) and speeds (rad/s) of the input, and limits by place in the file."""
        state = self.state(torque, speed)
        return dict(state.found), dict(state.reached)

    def cycles(self, torque: float, speed: float) -> list[tuple[StageModel, float, float]]:
        """Meshes with torque and speed of their pinion, relative to the carrier, on the planet of the largest load."""
        flow = self.state(np.array([torque]), np.array([speed])).flow
        share = self.loads[0].max() / self.section.planet_count
        pinion = np.abs(flow.force[:, 0] * self.train.teeth[:, 0]) * share
        turning = np.abs(self.train.relative[:, 0]) * speed
        return [
            one for one in zip(self.meshes, pinion.tolist(), turning.tolist(), strict=True) if one[1] * one[2] > 0.0
        ]

    def state(self, torque: np.ndarray, speed: np.ndarray) -> PlanetaryState:
        """Equilibrium in which every mesh has the efficiency at its load and relative speed."""
        shape = (len(self.meshes), torque.size)
        frictionless = self.train.flow(torque, np.ones(shape))
        flow, lost, pin, gain = frictionless, np.zeros(shape), self._pins(frictionless, speed), np.ones(torque.size)
        size = np.abs(frictionless.force)
        for _ in range(ROUNDS):
            losses = [self._mesh(index, flow, speed) for index in range(shape[0])]
            sliding, rolling = (np.array([one[part] for one in losses]) for part in (0, 1))
            rolled = self.train.rolling_power(flow) * speed
            lost = np.divide(sliding, rolled, out=np.zeros(shape), where=rolled > 0.0)
            pin = self._pins(flow, speed)
            drag = self._drags(rolling, pin, speed)
            before, flow = flow, self.train.flow(torque, 1.0 - np.minimum(lost, 1.0), frictionless, drag=drag)
            given = -flow.torque[self.driven] * self.train.speeds[self.driven]
            gain = np.divide(given, torque, out=np.ones_like(given), where=torque > 0.0)
            flow = replace(flow, force=np.where(flow.holds, flow.force, frictionless.force))
            scale = np.maximum(np.maximum(size, 0.01 * size.max(axis=1, keepdims=True)), 1e-300)
            if np.all(np.abs(flow.force - before.force) <= SETTLED * scale):
                break
        rolled = self.train.rolling_power(flow) * speed
        sliding = lost * rolled
        found = self._found(sliding, rolling, pin, speed)
        # A train that locks holds all power: the meshes take what the other losses leave.
        missing = np.where(flow.holds, 0.0, np.maximum(torque * speed - sum(found.values()), 0.0)) * (1.0 + 1e-9)
        if np.any(missing > 0.0):
            sliding = sliding + missing * rolled / np.maximum(rolled.sum(axis=0), 1e-300)
            found = self._found(sliding, rolling, pin, speed)
        for (_, origin, part), value in found.items():
            check_finite(f"planetary.{self.name}.{origin}.{part}", value, torque, speed)
        reached: dict[str, Reached] = {
            f"planetary.{self.name}.meshes.{one.name}": losses[index][2]
            for index, one in enumerate(self.train.couplings)
        }
        reached[f"planetary.{self.name}"] = [(LOCKS, np.where(flow.holds, np.nan, np.minimum(gain, -1e-6)))]
        return PlanetaryState(flow, sliding, rolling, rolled, pin, found, reached)

    def _mesh(self, index: int, flow: Flow, speed: np.ndarray) -> tuple[np.ndarray, np.ndarray, Reached]:
        """Sliding and rolling loss (W) of a mesh over all planets, and its limits on the planet of the largest load."""
        loads, counts = self.loads
        of_mean = np.abs(flow.force[index] * self.train.teeth[index, 0]) / self.section.planet_count
        turning = np.broadcast_to(np.abs(self.train.relative[index, 0]) * speed, of_mean.shape)
        at = np.concatenate([of_mean * load for load in loads])
        warm = self.meshes[index].warm
        warm = None if warm is None else np.tile(warm, loads.size)
        sliding, rolling, reached = mesh_losses(self.meshes[index].study, at, np.tile(turning, loads.size), warm)
        totals = [np.sum(counts[:, None] * values.reshape(loads.size, -1), axis=0) for values in (sliding, rolling)]
        last = [(limit, values.reshape(loads.size, -1)[-1]) for limit, values in reached]
        return totals[0], totals[1], last

    def _pins(self, flow: Flow, speed: np.ndarray) -> dict[str, np.ndarray]:
        """Loads (N) of the pins of each kind of planet, a row a load of `loads`."""
        carrier = self.train.speeds[CARRIER] * speed
        mass = {name: planet.mass_kg for name, planet in self.section.planets.items()}
        each = [
            self.planets.pin_forces(flow.force * load / self.section.planet_count, carrier, mass)
            for load in self.loads[0]
        ]
        return {name: np.array([np.abs(one[name]) for one in each]) for name in mass}

    def _planet_bearings(self, pin: Mapping[str, np.ndarray], speed: np.ndarray) -> dict[Origin, np.ndarray]:
        """Losses (W) of the bearings of all planets."""
        found: dict[Origin, np.ndarray] = {}
        for planet, parts in self.planet_parts.items():
            turning = np.abs(self.train.speeds[planet] - self.train.speeds[CARRIER]) * speed
            for part in parts:
                share = part.section.model_dump()["radial_share"]
                each = [part.at(turning, self.oil, share * load) for load in pin[planet]]
                found[self.name, part.table, part.name] = np.sum(self.loads[1][:, None] * np.array(each), axis=0)
        return found

    def _on_members(self, speed: np.ndarray) -> dict[Origin, np.ndarray]:
        """Losses (W) of parts on members."""
        turning = {part: np.abs(self.train.speeds[part.shaft]) * speed for part in self.parts}
        return {(self.name, part.table, part.name): part.at(turning[part], self.oil, 0.0) for part in self.parts}

    def _drags(self, rolling: np.ndarray, pin: Mapping[str, np.ndarray], speed: np.ndarray) -> dict[str, np.ndarray]:
        """Braking torques (N m) on planets, by their bearings and by rolling in meshes, and on free members."""
        drag: dict[str, np.ndarray] = {}
        bearings = self._planet_bearings(pin, speed)
        for planet, parts in self.planet_parts.items():
            turning = np.abs(self.train.speeds[planet] - self.train.speeds[CARRIER]) * speed
            lost = sum((bearings[self.name, part.table, part.name] for part in parts), np.zeros_like(speed))
            own = [i for i, one in enumerate(self.train.couplings) if self._bears_rolling(one.wheels) == planet]
            lost = lost + rolling[own].sum(axis=0)
            drag[planet] = np.divide(lost, turning, out=np.zeros_like(lost), where=turning > 0.0)
        for part, lost in zip(self.parts, self._on_members(speed).values(), strict=True):
            turning = np.abs(self.train.speeds[part.shaft]) * speed
            if part.shaft in self.train.free and turning.any():
                drag[part.shaft] = drag.get(part.shaft, 0.0) + lost / turning
        return drag

    def _bears_rolling(self, wheels: tuple[str, str]) -> str:
        """Planet that bears the rolling resistance of a mesh."""
        return wheels[0] if wheels[0] in self.train.planets else wheels[1]

    def _found(
        self, sliding: np.ndarray, rolling: np.ndarray, pin: Mapping[str, np.ndarray], speed: np.ndarray
    ) -> dict[Origin, np.ndarray]:
        """Losses (W) by origin."""
        found: dict[Origin, np.ndarray] = {}
        for origin, values in (("sliding", sliding), ("rolling", rolling)):
            found |= {(self.name, origin, one.name): row for one, row in zip(self.train.couplings, values, strict=True)}
        return found | self._planet_bearings(pin, speed) | self._on_members(speed)
