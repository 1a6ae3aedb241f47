"""Loss and tooth efficiency of a stage over one base pitch of its mesh."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mixedlub.chain.model import Model
from mixedlub.efficiency.gearbox import Gearbox, Losses
from mixedlub.efficiency.meshes import LOCAL, conditioned
from mixedlub.efficiency.stage import StageModel
from mixedlub.gear import GearPair, LdpSharing, Mesh, at_roll_angle
from mixedlub.study.inputs import mesh_inputs
from mixedlub.study.plan import HEAT

FINE = 128
"""Slices of oblique lines without contact problems: cheap, each on the path entirely or not at all."""


@dataclass(frozen=True, eq=False)
class ToothPair:
    """Forces (N) of a tooth pair over the roll angle (rad) of the pinion tooth at the front of the face."""

    roll_angle: np.ndarray
    normal_force: np.ndarray
    friction_force: np.ndarray


@dataclass(frozen=True, eq=False)
class MeshCycle:
    """Loss of a stage over one base pitch, in SI.

    By position: ``phase`` (base pitches), ``sliding`` and ``rolling`` (W), ``sliding_power`` (load times sliding speed,
    W), ``friction_force`` (N) on the pinion, of all pairs in contact, positive if recess outweighs approach. ``pair``:
    one tooth pair over its path.
    """

    stage: StageModel
    torque: float
    speed: float
    phase: np.ndarray
    sliding: np.ndarray
    rolling: np.ndarray
    sliding_power: np.ndarray
    friction_force: np.ndarray
    pair: ToothPair

    @property
    def input_power(self) -> float:
        """Input power at the driving side (W)."""
        return self.torque * self.speed

    @property
    def efficiency(self) -> np.ndarray:
        """Tooth efficiency at each position; its mean is the efficiency of the cycle."""
        return 1.0 - (self.sliding + self.rolling) / self.input_power

    @property
    def friction(self) -> np.ndarray:
        """Friction coefficient of the mesh at each position, weighted with load times sliding speed."""
        return self.sliding / self.sliding_power

    @property
    def roll_angle(self) -> np.ndarray:
        """Roll angle of the pinion (rad), from the start of contact of a tooth pair at the front of the face."""
        pair = self.stage.pair
        return (pair.path_start + self.phase * pair.base_pitch) / pair.base_radius[0]


def mesh_cycle(stage: StageModel, torque: float, speed: float, positions: int) -> MeshCycle:
    r"""Loss of a mesh at equidistant positions over one base pitch; torque (N m) and speed (rad/s) of its driving side.

    .. math:: P(\varphi) = \sum_q \left[\mu W |u_1 - u_2| + F_r' \ell\,(u_1 + u_2)\right],\quad
              \eta(\varphi) = 1 - \frac{P(\varphi)}{T\omega}

    over all slices q of all tooth pairs in contact. Source: H. Xu, PhD thesis, Ohio State University, 2005, chapter 2,
    in the power form.
    """
    pair = stage.pair
    step = pair.base_pitch / positions
    count = math.ceil((pair.path_end - pair.path_start) / step - 0.5 - 1e-9)
    place = pair.path_start + step * (np.arange(count) + 0.5)
    points = at_roll_angle(pair, stage.study.rig.sharing, place / pair.base_radius[0], slices=_slices(stage))
    slices = points.slices
    found = _at_points(stage, torque, speed, points).reshape(-1, count, slices)
    whole = -(-count // positions) * positions
    every = np.zeros((len(found), whole, slices))
    every[:, :count] = found
    every = every.reshape(len(found), -1, positions, slices).sum(axis=1)
    phase = (np.arange(positions) + 0.5) / positions
    # Slices of a helical pair follow the front of the face by whole and broken parts of a base pitch.
    lag = points.lag[:slices]
    total = np.zeros((len(found), positions))
    for index in range(slices):
        for one in range(len(found)):
            total[one] += np.interp((phase + lag[index]) % 1.0, phase, every[one, :, index], period=1.0)
    sliding, rolling, power, force, _ = total
    tooth = _tooth_pair(pair, place, lag * pair.base_pitch, found[3:])
    return MeshCycle(stage, torque, speed, phase, sliding, rolling, power, force, tooth)


def _tooth_pair(pair: GearPair, place: np.ndarray, lag: np.ndarray, forces: np.ndarray) -> ToothPair:
    """Friction and normal force of one pair: sums over slices delayed by ``lag`` (m) along the path."""
    step = place[1] - place[0]
    places, later = np.arange(place.size), lag / step
    front = np.arange(-math.ceil(later[-1]), place.size)
    friction, normal = (
        sum(
            (np.interp(front + late, places, one[:, n], left=0.0, right=0.0) for n, late in enumerate(later)),
            np.zeros(front.size),
        )
        for one in forces
    )
    return ToothPair((place[0] + step * front) / pair.base_radius[0], normal, friction)


def _slices(stage: StageModel) -> int:
    """Slices across the face: as in the study, or more for oblique lines at low cost."""
    study = stage.study
    if study.plan.spur or study.file.options.face_slices or isinstance(study.rig.sharing, LdpSharing):
        return study.mesh.slices
    return FINE


def _at_points(stage: StageModel, torque: float, speed: float, points: Mesh) -> np.ndarray:
    """Losses and forces of one tooth pair at each slice of contact points (5, M).

    Sliding loss, rolling loss and sliding power (W), friction force on the pinion and normal force (N).
    """
    study, plan = stage.study, stage.study.plan
    own, turning = stage.of_pinion(np.array([torque]), np.array([speed]))
    share = points.load_share(own)[None, None, :, None, :]
    with np.errstate(all="ignore"):  # points of no quadrature have no weights for a mean
        # Heat is that of the whole mesh, whichever points are asked for.
        whole = conditioned(study, study.mesh.load_share, own, turning) if HEAT in plan.inputs else plan.inputs
        inputs = {
            **whole,
            **mesh_inputs(points, share, own.reshape(1, 1, 1, 1, 1), turning.reshape(1, 1, 1, 1, 1)),
        }
        model = Model(plan.chain(plan.options), tuple(inputs), (*LOCAL, "load_share"), plan.effects)
        state = model(inputs, plan.parameters)
    friction, resistance = (np.broadcast_to(np.ravel(state[name]), points.position.shape) for name in LOCAL)
    force = np.broadcast_to(np.ravel(state["load_share"] * inputs["transmitted_force"]), points.position.shape)
    oblique = math.cos(stage.pair.base_helix_angle)
    normal = force / oblique
    power = normal * inputs["sliding_speed"].ravel()
    rolling = resistance * points.contact_width * 2.0 * inputs["entrainment_speed"].ravel() / oblique
    return np.array([friction * power, rolling, power, friction * normal * np.sign(points.sliding_per_speed), normal])


def mesh_cycles(gearbox: Gearbox, at: Losses) -> list[MeshCycle]:
    """Cycles of all meshes at one input condition; the input of a stage is the output of the stage before."""
    power, speed = float(at.input_power[0]), float(at.speed[0])
    found = []
    for stage in gearbox.stages:
        if power <= 0.0:
            break
        found += [mesh_cycle(*one, gearbox.file.cycle.positions) for one in stage.cycles(power / speed, speed)]
        power -= float(at.total(stage=stage.name)[0])
        speed /= stage.ratio
    return found
