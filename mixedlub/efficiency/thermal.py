"""Thermal balance of a gearbox: sump temperature at which losses equal the heat to the surroundings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mixedlub.efficiency.gearbox import MESH, Gearbox, Losses
from mixedlub.efficiency.heat_paths import HeatPaths
from mixedlub.efficiency.stage import StageModel
from mixedlub.efficiency.thermal_root import lowest_root
from mixedlub.laws.heating import tooth_rise
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig.lubricant import LINEAR, Lubricant
from mixedlub.schema.findings import Finding, finding
from profiles.errors import InputError

CLOSED, BALANCED = 1e-7, 1e-6
"""Grid. Largest difference between heat in and heat out, over the heat, that ends the search, and of a balance."""
TEETH_CLOSED = 1e-9
"""Grid. Largest difference between the loss of a mesh and the heat of its teeth, over the loss, that ends a search."""
HOTTEST_TEETH_C = 500.0
"""Judgement. Temperature above which no balance of the teeth is sought; hardened steel is soft there."""
MARGIN = 1.0
"""Grid. Distance (K) of the teeth to the temperature at which the oil has no pressure-viscosity coefficient."""
WHERE = "thermal"
NO_BALANCE = "thermal_no_balance"
"""Definition. Code of conditions without balance, in findings and as their validity."""


@dataclass(frozen=True, eq=False)
class Balance:
    """Steady temperatures of N conditions, in K and W.

    ``sump``: temperature of the oil, the highest allowed where no balance exists below it; ``losses``: losses at these
    temperatures; ``rise``: of the teeth over the sump by stage; ``too_hot``: conditions without a balance;
    ``teeth``: difference between the losses of meshes and the heat of their teeth, over the losses.
    """

    paths: HeatPaths
    sump: np.ndarray
    losses: Losses
    rise: Mapping[str, np.ndarray]
    too_hot: np.ndarray
    teeth: np.ndarray

    @property
    def found(self) -> np.ndarray:
        """Conditions in balance."""
        return ~self.too_hot & (self._apart <= BALANCED)

    @cached_property
    def heat(self) -> Mapping[str, np.ndarray]:
        """Heat (W) by way."""
        return self.paths.heat(self.sump)

    @property
    def gap(self) -> np.ndarray:
        """Heat out less heat in, over heat in; 0 without any."""
        out, loss = np.sum(list(self.heat.values()), axis=0), self.losses.total()
        return np.divide(out - loss, loss, out=np.zeros_like(loss), where=loss > 0.0)

    @property
    def _apart(self) -> np.ndarray:
        """Largest difference of heat in and heat out, of the sump or the teeth, over heat in."""
        return np.maximum(np.abs(self.gap), self.teeth)

    @property
    def findings(self) -> tuple[Finding, ...]:
        """Finding on conditions without balance."""
        limit, of = self.paths.section.highest_temperature_C, self.found.size
        hot, loose = int(np.count_nonzero(self.too_hot)), int(np.count_nonzero(~self.found & ~self.too_hot))
        texts = []
        if hot:
            why = "their losses exceed the heat that leaves there"
            texts.append(f"{hot} of {of} conditions have no balance up to {limit:g} °C: {why}")
        if loose:
            most = float(np.max(self._apart[~self.found & ~self.too_hot]))
            where = "heat in and heat out of sump or teeth differ by up to"
            texts.append(f"{loose} of {of} conditions did not converge: {where} {most:.1g}")
        return tuple(finding(NO_BALANCE, text, WHERE) for text in texts)


class ThermalModel:
    """Losses of a gearbox at any sump temperature, and its balance."""

    def __init__(self, gearbox: Gearbox) -> None:
        section = gearbox.file.thermal
        assert section is not None
        pairs = {one.name: one for one in gearbox.stages if isinstance(one, StageModel)}
        for name in section.teeth_W_K:
            if name not in pairs:
                known = ", ".join(pairs) or "none"
                rule = f"must be a stage of one gear pair ({known})"
                raise InputError(rule, where=f"{WHERE}.teeth_W_K", value=name)
            one = pairs[name].study
            if "bulk_temperature" in one.plan.parameters or one.plan.options.bulk_temperature_rise_K:
                rule = "states the temperature of the teeth, as an effect or option of this stage does; leave one out"
                raise InputError(rule, where=f"{WHERE}.teeth_W_K.{name}")
        self.gearbox, self.section, self.pairs = gearbox, section, pairs
        first = gearbox.stages[0]
        self.paths = HeatPaths(section, (first if isinstance(first, StageModel) else first.meshes[0]).study.oil)

    @property
    def ends(self) -> tuple[float, float]:
        """Lowest and highest temperature (K) of a balance."""
        return self.section.coldest_C + ZERO_CELSIUS, self.section.highest_temperature_C + ZERO_CELSIUS

    def losses(self, torque: np.ndarray, speed: np.ndarray, sump: np.ndarray) -> tuple[Losses, dict[str, np.ndarray]]:
        """Losses at sump temperatures (K) by condition, and rise of the teeth by stage where it acts on the film.

        The loss of a stage depends on the stages before, so the rises are found in the order of the power.
        """
        rise: dict[str, np.ndarray] = {}
        for name in (one.name for one in self.gearbox.stages if one.name in self.section.teeth_W_K):
            conductance = self.section.teeth_W_K[name]

            def excess(
                at: np.ndarray, own: np.ndarray, name: str = name, conductance: float = conductance
            ) -> tuple[np.ndarray, np.ndarray]:
                rises = {known: values[at] for known, values in rise.items()} | {name: own}
                found = self._at(sump[at], rises).losses(torque[at], speed[at])
                mesh = found.total(stage=name, origins=MESH)
                return conductance * own - mesh, mesh

            room = np.maximum(_hottest_teeth(self.pairs[name].study.oil) - sump, 0.0)
            rise[name], _ = lowest_root(excess, np.zeros_like(sump), room, TEETH_CLOSED)
        return self._at(sump, rise).losses(torque, speed), rise

    def teeth_gap(self, losses: Losses, rise: Mapping[str, np.ndarray]) -> np.ndarray:
        """Difference between the losses of meshes and the heat of their teeth, over the losses: the largest."""
        gap = np.zeros_like(losses.torque)
        for name, own in rise.items():
            mesh = losses.total(stage=name, origins=MESH)
            left = np.abs(self.section.teeth_W_K[name] * own - mesh)
            gap = np.maximum(gap, np.divide(left, mesh, out=np.zeros_like(left), where=mesh > 0.0))
        return gap

    def _at(self, sump: np.ndarray, rise: Mapping[str, np.ndarray]) -> Gearbox:
        """Gearbox with its oil at sump temperatures (K) by condition, and teeth that are warmer."""
        none = np.zeros_like(sump)
        stages = tuple(one.at(sump, rise.get(one.name, none)) for one in self.gearbox.stages)
        return replace(self.gearbox, stages=stages)

    def balance(self, torque: np.ndarray, speed: np.ndarray) -> Balance:
        """Steady balance at torques (N m) and speeds (rad/s) of the input.

        The losses fall or rise with temperature as viscosity and friction make them; the lowest balance counts.
        """

        def excess(at: np.ndarray, sump: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            loss = self.losses(torque[at], speed[at], sump)[0].total()
            return self.paths.total(sump) - loss, loss

        low, high = (np.full(torque.shape, end) for end in self.ends)
        sump, found = lowest_root(excess, low, high, CLOSED)
        losses, rise = self.losses(torque, speed, sump)
        return Balance(
            self.paths, sump, losses, self._reported(losses, rise), ~found, teeth=self.teeth_gap(losses, rise)
        )

    def _reported(self, losses: Losses, rise: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
        """Rise of the teeth of every gear pair: by its conductance, else by ISO/TR 15144-1."""
        reported = {}
        for name, one in self.pairs.items():
            first, second = one.pair.operating_radius
            mesh = losses.total(stage=name, origins=MESH)
            size = abs(first) + second, 0.0, one.pair.face_width
            reported[name] = rise.get(name, tooth_rise(mesh, *size))
        return reported

    def at_map(self) -> Balance:
        """Balance at every torque and speed of the file; the speed varies fastest."""
        levels = self.gearbox.file.conditions
        torque, speed = np.meshgrid(levels.torque_Nm, np.array(levels.speed_rpm) * np.pi / 30.0, indexing="ij")
        return self.balance(torque.ravel(), speed.ravel())


def _hottest_teeth(oil: Lubricant) -> float:
    """Highest temperature (K) of the teeth at which the oil has a pressure-viscosity coefficient."""
    (t1, t2), (a1, a2) = oil.temperature, oil.pressure_viscosity
    highest = HOTTEST_TEETH_C + ZERO_CELSIUS
    if oil.carried != LINEAR or a2 >= a1:
        return highest
    return min(highest, t1 + a1 * (t2 - t1) / (a1 - a2) - MARGIN)
