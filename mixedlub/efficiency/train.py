"""Planetary trains: speeds, torques and the power that rolls through the meshes, for any number of members.

Speeds relative to the carrier obey the teeth (Willis); a wheel of a ring counts below zero. Torques balance on every
planet and on every member that turns freely; the members together keep the carrier in balance.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from profiles.errors import InputError

CARRIER = "carrier"
SMALL = 1e-9
"""Judgement. Speed over the largest speed of a train below which a member stands still."""


@dataclass(frozen=True)
class Coupling:
    """Mesh of two wheels by the names of their bodies, with numbers of teeth (below zero for a ring)."""

    name: str
    wheels: tuple[str, str]
    teeth: tuple[int, int]


@dataclass(frozen=True, eq=False)
class Flow:
    """Equilibrium of a train at N conditions.

    ``force``: torque of each mesh over the teeth of its first wheel, all planets together, before friction (M, N);
    ``first_drives`` (M, N); ``torque``: external torque (N m) by member; ``holds``: whether the train turns under its
    load, without self-locking.
    """

    force: np.ndarray
    first_drives: np.ndarray
    torque: Mapping[str, np.ndarray]
    holds: np.ndarray


@dataclass(frozen=True)
class PlanetaryTrain:
    """Train of wheels on central shafts, planets on a carrier, and meshes between them; one member is fixed.

    Source: R. Willis, Principles of Mechanism, for speeds; H. W. Mueller, Epicyclic Drive Trains, for torques, rolling
    and coupling power.

    A simple train with its ring fixed: ratio 1 + z_r/z_s, and the efficiency (1 - i0 eta0)/(1 - i0) with i0 = -z_r/z_s:

    >>> train = PlanetaryTrain((Coupling("inner", ("sun", "planet"), (18, 27)),
    ...                         Coupling("outer", ("planet", "ring"), (27, -72))),
    ...                        ("planet",), "sun", "carrier", "ring")
    >>> round(1 / train.speeds["carrier"], 9)
    5.0
    >>> print(train.efficiency([0.98, 0.99]).round(6), round((1 + 4 * 0.98 * 0.99) / 5, 6))
    0.97616 0.97616
    """

    couplings: tuple[Coupling, ...]
    planets: tuple[str, ...]
    input: str
    output: str
    fixed: str

    @cached_property
    def centrals(self) -> tuple[str, ...]:
        """Wheels about the main axis."""
        wheels = dict.fromkeys(wheel for one in self.couplings for wheel in one.wheels)
        return tuple(wheel for wheel in wheels if wheel not in self.planets)

    @property
    def members(self) -> tuple[str, ...]:
        """Bodies about the main axis: wheels and carrier."""
        return (*self.centrals, CARRIER)

    @property
    def free(self) -> tuple[str, ...]:
        """Members without external torque other than drag."""
        return tuple(one for one in self.members if one not in (self.input, self.output, self.fixed))

    @cached_property
    def speeds(self) -> Mapping[str, float]:
        """Speed of every body over the speed of the input."""
        bodies = (*self.members, *self.planets)
        if len(self.couplings) != len(bodies) - 2:
            rule = (
                f"{len(bodies)} bodies ({', '.join(bodies)}) with one fixed need {len(bodies) - 2} meshes to turn "
                "in one way"
            )
            raise InputError(rule, where="meshes", value=len(self.couplings))
        matrix, right = np.zeros((len(bodies), len(bodies))), np.zeros(len(bodies))
        for row, one in zip(matrix, self.couplings, strict=False):
            for wheel, teeth in zip(one.wheels, one.teeth, strict=True):
                row[bodies.index(wheel)] += teeth
                row[bodies.index(CARRIER)] -= teeth
        matrix[-2, bodies.index(self.fixed)] = 1.0
        matrix[-1, bodies.index(self.input)], right[-1] = 1.0, 1.0
        if np.linalg.matrix_rank(matrix) < len(bodies):
            raise InputError(
                f"with {self.fixed} fixed, {self.input} does not turn in one way: no ratio exists", where="fixed"
            )
        found = np.linalg.solve(matrix, right)
        found[np.abs(found) < SMALL * np.abs(found).max()] = 0.0
        return dict(zip(bodies, found.tolist(), strict=True))

    def check(self) -> None:
        """Raise an error for a train without a ratio."""
        if self.speeds[self.output] == 0.0:
            raise InputError(
                f"does not turn with {self.fixed} fixed: no ratio exists", where="output", value=self.output
            )

    @cached_property
    def relative(self) -> np.ndarray:
        """Speeds of both wheels of each mesh relative to the carrier, over the speed of the input (M, 2)."""
        own = self.speeds
        return np.array([[own[wheel] - own[CARRIER] for wheel in one.wheels] for one in self.couplings])

    @cached_property
    def teeth(self) -> np.ndarray:
        """Numbers of teeth (M, 2)."""
        return np.array([one.teeth for one in self.couplings], dtype=float)

    def flow(
        self,
        torque: np.ndarray,
        efficiency: np.ndarray,
        before: Flow | None = None,
        *,
        drag: Mapping[str, np.ndarray] | None = None,
    ) -> Flow:
        """Equilibrium at torques of the input (N,), with efficiencies (M, N) of the meshes at rest of the carrier.

        ``before``: a flow whose directions of power hold, by default the flow without losses; ``drag``: braking torques
        (N m, above zero) on planets, relative to the carrier, and on free members.
        """
        if before is None and np.any(efficiency < 1.0):
            before = self.flow(torque, np.ones_like(efficiency))
        factors = np.ones((*self.teeth.shape, torque.size))
        if before is not None:
            factors[:, 1] = np.where(before.first_drives, efficiency, 1.0)
            factors[:, 0] = np.where(before.first_drives, 1.0, efficiency)
        on_wheels = self.teeth[..., None] * factors
        equations = {planet: self._on(planet, on_wheels) for planet in self.planets}
        known = {planet: np.zeros(torque.size) for planet in self.planets}
        for member in (self.input, *self.free):
            equations[member] = -self._on(member, on_wheels)
            known[member] = torque if member == self.input else np.zeros(torque.size)
        for body, braking in (drag or {}).items():
            turns = self.speeds[body] - (self.speeds[CARRIER] if body in self.planets else 0.0)
            side = 1.0 if body in self.planets else -1.0
            known[body] = known[body] + side * braking * np.sign(turns)
        matrix = np.stack([equations[body] for body in equations], axis=0).transpose(2, 0, 1)
        right = np.stack([known[body] for body in equations], axis=-1)[..., None]
        force = np.linalg.solve(matrix, right)[..., 0].T
        gives = -force * (self.teeth[:, 0] * self.relative[:, 0])[:, None]
        external = {one: -np.sum(self._on(one, on_wheels) * force, axis=0) for one in self.members}
        holds = np.ones(torque.size, dtype=bool)
        if before is not None:
            # Power that turns round under friction, in a mesh or at the output, would need a drive from outside.
            driven = external[self.output] * self.speeds[self.output] < 0.0
            holds = (np.all((gives >= 0.0) == before.first_drives, axis=0) & driven) | (torque <= 0.0)
            holds = self.flow(torque, efficiency, before).holds if drag else holds
        return Flow(force, gives >= 0.0, external, holds)

    def _on(self, body: str, on_wheels: np.ndarray) -> np.ndarray:
        """Torque on a body per force of each mesh (M, N); on the carrier the reaction of all central wheels."""
        if body == CARRIER:
            return -np.sum([self._on(one, on_wheels) for one in self.centrals], axis=0)
        mine = np.array([[wheel == body for wheel in one.wheels] for one in self.couplings])
        return np.asarray(np.sum(np.where(mine[..., None], on_wheels, 0.0), axis=1))

    def rolling_power(self, flow: Flow) -> np.ndarray:
        """Power (W at an input speed of 1 rad/s) that each mesh takes in, relative to the carrier (M, N)."""
        return np.abs(flow.force * (self.teeth[:, 0] * self.relative[:, 0])[:, None])

    def efficiency(self, efficiencies: Sequence[float]) -> np.float64:
        """Efficiency of the train with constant efficiencies of its meshes at rest of the carrier; 0 when it locks."""
        each = np.array(efficiencies, dtype=float)[:, None]
        flow = self.flow(np.ones(1), each)
        power = -flow.torque[self.output] * self.speeds[self.output]
        return np.float64(max(power[0], 0.0) if flow.holds[0] else 0.0)
