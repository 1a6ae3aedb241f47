"""Thermal balance of a gearbox: sump temperature at which losses equal the heat to the surroundings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mixedlub.efficiency.gearbox import MESH, Gearbox, Losses
from mixedlub.efficiency.heat_paths import HeatPaths
from mixedlub.efficiency.stage import StageModel
from mixedlub.laws.heating import tooth_rise
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.schema.findings import Finding, finding
from profiles.errors import InputError

CLOSED, BALANCED = 1e-7, 1e-6
"""Grid. Largest difference between heat in and heat out, over the heat, that ends the search, and of a balance."""
NARROW = 1e-9
"""Grid. Width (K) of a bracket that is not narrowed any more."""
STEPS = 60
"""Cost limit. Most evaluations of the losses for a balance; a dozen are usual."""
TEETH_STEPS, TEETH_CLOSED = 30, 1e-8
"""Grid. Most steps for the temperature of the teeth, and the relative change of a rise that counts as none."""
WHERE = "thermal"


@dataclass(frozen=True, eq=False)
class Balance:
    """Steady temperatures of N conditions, in K and W.

    ``sump``: temperature of the oil, the highest allowed where no balance exists below it; ``losses``: losses at these
    temperatures; ``rise``: of the teeth over the sump by stage; ``too_hot``: conditions without a balance.
    """

    paths: HeatPaths
    sump: np.ndarray
    losses: Losses
    rise: Mapping[str, np.ndarray]
    too_hot: np.ndarray

    @property
    def found(self) -> np.ndarray:
        """Conditions in balance."""
        return ~self.too_hot & (np.abs(self.gap) <= BALANCED)

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
    def findings(self) -> tuple[Finding, ...]:
        """Finding on conditions without balance."""
        limit, of = self.paths.section.highest_temperature_C, self.found.size
        hot, loose = int(np.count_nonzero(self.too_hot)), int(np.count_nonzero(~self.found & ~self.too_hot))
        texts = []
        if hot:
            why = "their losses exceed the heat that leaves there"
            texts.append(f"{hot} of {of} conditions have no balance up to {limit:g} °C: {why}")
        if loose:
            most = float(np.max(np.abs(self.gap[~self.found & ~self.too_hot])))
            texts.append(
                f"{loose} of {of} conditions did not converge: heat in and heat out differ by up to {most:.1g}"
            )
        return tuple(finding("thermal_no_balance", text, WHERE) for text in texts)


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
        """Losses at sump temperatures (K) by condition, and rise of the teeth by stage where it acts on the film."""
        rise = {name: np.zeros_like(sump) for name in self.section.teeth_W_K}
        for _ in range(TEETH_STEPS):
            found = self._at(sump, rise).losses(torque, speed)
            new = {name: found.total(stage=name, origins=MESH) / g for name, g in self.section.teeth_W_K.items()}
            moved = [np.max(np.abs(new[name] - rise[name]) / (1.0 + new[name])) for name in new]
            rise = new
            if not moved or max(moved) < TEETH_CLOSED:
                break
        return found, rise

    def _at(self, sump: np.ndarray, rise: Mapping[str, np.ndarray]) -> Gearbox:
        """Gearbox with its oil at sump temperatures (K) by condition, and teeth that are warmer."""
        none = np.zeros_like(sump)
        stages = tuple(one.at(sump, rise.get(one.name, none)) for one in self.gearbox.stages)
        return replace(self.gearbox, stages=stages)

    def balance(self, torque: np.ndarray, speed: np.ndarray) -> Balance:
        """Steady balance at torques (N m) and speeds (rad/s) of the input.

        The losses fall or rise with temperature as viscosity and friction make them; a bracket of the temperature is
        narrowed by false position (the Illinois form) until heat in and heat out agree.
        """

        def excess(at: np.ndarray, sump: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            loss = self.losses(torque[at], speed[at], sump)[0].total()
            return self.paths.total(sump) - loss, loss

        every = np.arange(torque.size)
        low, high = (np.full(torque.shape, end) for end in self.ends)
        (below, _), (above, most) = excess(every, low), excess(every, high)
        found = above >= -CLOSED * most
        sump = np.where(found, np.where(below >= 0.0, low, high), high)
        live = every[found & (below < 0.0) & (above > CLOSED * most)]
        side = np.zeros(torque.shape)
        for _ in range(STEPS):
            if not live.size:
                break
            a, b, fa, fb = low[live], high[live], below[live], above[live]
            middle = (a * fb - b * fa) / (fb - fa)
            own, loss = excess(live, middle)
            sump[live] = middle
            left = own < 0.0
            # Illinois: the end that stays twice counts half, so that both ends move.
            below[live] = np.where(left, own, np.where(side[live] < 0.0, 0.5 * fa, fa))
            above[live] = np.where(left, np.where(side[live] > 0.0, 0.5 * fb, fb), own)
            low[live], high[live] = np.where(left, middle, a), np.where(left, b, middle)
            side[live] = np.where(left, 1.0, -1.0)
            live = live[(np.abs(own) > CLOSED * loss) & (high[live] - low[live] > NARROW)]
        losses, rise = self.losses(torque, speed, sump)
        return Balance(self.paths, sump, losses, self._reported(losses, rise), ~found)

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
