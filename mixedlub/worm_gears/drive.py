"""A worm drive made ready from its file, with friction, film and efficiency at its conditions."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from mixedlub.base_model.limits import contact_limits
from mixedlub.chain.ranges import findings
from mixedlub.laws.contact import reduced_modulus
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig.lubricant import Lubricant
from mixedlub.rig.rig import Rig
from mixedlub.schema.findings import Finding, collected, finding, report
from mixedlub.schema.ranges import unusual
from mixedlub.schema.system_file import RigFile
from mixedlub.schema.toml_file import parse, read_toml
from mixedlub.worm_gears import laws
from mixedlub.worm_gears.file import AGMA, CONSTANT, FACTORS, Friction, WormFile
from profiles.errors import InputError

RPM = math.pi / 30.0


@dataclass(frozen=True, eq=False)
class Losses:
    """Results at N conditions in SI; angles in rad; ``film`` is NaN without [film]."""

    torque: np.ndarray
    speed: np.ndarray
    temperature: np.ndarray
    lead: float
    ratio: float
    sliding: np.ndarray
    film: np.ndarray
    friction: np.ndarray
    angle: np.ndarray

    @property
    def locks(self) -> np.ndarray:
        """Whether the wheel cannot drive the worm."""
        return self.angle >= self.lead

    @property
    def driving(self) -> np.ndarray:
        """Efficiency where the worm drives."""
        return laws.driving_efficiency(self.lead, self.angle)

    @property
    def driven(self) -> np.ndarray:
        """Efficiency where the wheel drives, NaN if the drive locks itself."""
        return np.where(self.locks, np.nan, laws.driven_efficiency(self.lead, self.angle))

    @property
    def wheel_power(self) -> np.ndarray:
        """Power of the wheel (W)."""
        return self.torque * self.speed / self.ratio


@dataclass(frozen=True, eq=False)
class Drive:
    """A worm drive of a file."""

    file: WormFile
    oil: Lubricant | None

    @property
    def lead(self) -> float:
        """Lead angle (rad)."""
        gears = self.file.gears
        return laws.lead_angle(gears.threads, gears.axial_module_mm, gears.worm_diameter_mm)

    @property
    def ratio(self) -> float:
        """Speed of the worm over the speed of the wheel."""
        return self.file.gears.wheel_teeth / self.file.gears.threads

    @property
    def pressure_angle(self) -> float:
        """Normal pressure angle (rad)."""
        return math.radians(self.file.pressure_angle_deg)

    @property
    def locking_friction(self) -> float:
        """Friction coefficient from which the drive locks itself."""
        return math.tan(self.lead) * math.cos(self.pressure_angle)

    @property
    def jamming_friction(self) -> float:
        """Friction coefficient from which the worm cannot drive either."""
        return math.cos(self.pressure_angle) / math.tan(self.lead)

    @cached_property
    def factor(self) -> float:
        """Product of the factors on the base friction."""
        friction, gears = self.file.friction, self.file.gears
        film = None if self.file.film is None else self.file.film.parameter
        values = {"size": gears.distance_mm, "geometry": film, "roughness": gears.worm_roughness_Ra_um}
        product = friction.material
        for name in FACTORS:
            chosen, value = getattr(friction, name), values[name]
            if chosen is not None and value is not None:
                product *= laws.power_factor(value, chosen.reference, chosen.exponent)
        return product

    def map(self) -> Losses:
        """Film, friction and efficiency at every torque, speed and oil temperature, torque slowest."""
        levels = self.file.conditions
        grid = np.meshgrid(levels.wheel_torque_Nm, levels.worm_speed_rpm, levels.oil_temperature_C, indexing="ij")
        torque, speed, temperature = (axis.ravel() for axis in grid)
        return self.losses(torque, speed * RPM, temperature + ZERO_CELSIUS)

    def losses(self, torque: np.ndarray, speed: np.ndarray, temperature: np.ndarray) -> Losses:
        """Results at wheel torques (N m), worm speeds (rad/s) and oil temperatures (K)."""
        sliding = laws.sliding_speed(speed, 1e-3 * self.file.gears.worm_diameter_mm, self.lead)
        friction = self.factor * mean_friction(self.file.friction, sliding)
        angle = laws.friction_angle(friction, self.pressure_angle)
        if self.lead + float(np.max(angle)) >= 0.5 * math.pi:
            rule = (
                f"the worm jams: no torque turns the wheel from a friction of {self.jamming_friction:.3g} on, here up "
                f"to {float(np.max(friction)):.3g}"
            )
            raise InputError(rule, where="friction")
        film = self._film(torque, speed, temperature)
        return Losses(torque, speed, temperature, self.lead, self.ratio, sliding, film, friction, angle)

    def _film(self, torque: np.ndarray, speed: np.ndarray, temperature: np.ndarray) -> np.ndarray:
        film, gears = self.file.film, self.file.gears
        if film is None or self.oil is None:
            return np.full(torque.shape, np.nan)
        oil = self.oil.inputs(temperature)
        moduli = 1e9 * np.array(gears.youngs_modulus_GPa)
        return laws.mean_film(
            torque,
            speed,
            np.asarray(oil["viscosity"]),
            np.asarray(oil["pressure_viscosity"]),
            parameter=film.parameter,
            coefficient=film.coefficient,
            centre_distance=1e-3 * gears.distance_mm,
            modulus=float(reduced_modulus((moduli[0], moduli[1]), gears.poisson_ratio)),
        )


def mean_friction(chosen: Friction, sliding: np.ndarray) -> np.ndarray:
    """Friction coefficient at sliding speeds (m/s), without factors."""
    if chosen.law == AGMA:
        return laws.agma_6034(sliding)
    if chosen.law == CONSTANT:
        return np.full(np.shape(sliding), chosen.base["constant"])
    return laws.base_friction(sliding, **chosen.base)


def read_drive(path: Path) -> tuple[Drive, tuple[Finding, ...]]:
    """Drive of a file, checked, and findings for its user."""
    file = parse(WormFile, read_toml(path), str(path))
    try:
        with collected() as found:
            for one in unusual(file):
                report(one)
            oil = None
            if file.lubricant is not None:
                oil = Rig(parse(RigFile, {"lubricant": file.lubricant}, str(path)), path.parent.resolve()).oil()
    except InputError as error:
        raise InputError(error.rule, where=f"{path}: {error.where}".rstrip(": "), value=error.value) from None
    return Drive(file, oil), tuple(found)


def locking(drive: Drive, losses: Losses) -> tuple[Finding, ...]:
    """Finding of conditions at which the drive locks itself."""
    locked = losses.locks
    if not locked.any():
        return ()
    worst = int(np.argmax(losses.angle))
    text = (
        f"self-locking at {int(locked.sum())} of {locked.size} conditions: the wheel drives only below a friction of "
        f"{drive.locking_friction:.3g}, here up to {losses.friction[worst]:.3g} (lead angle "
        f"{math.degrees(losses.lead):.3g} deg, friction angle {math.degrees(losses.angle[worst]):.3g} deg); a drive "
        "that locks may still creep under vibration"
    )
    return (finding("worm_locks", text, "conditions"),)


def extrapolated_oil(drive: Drive, losses: Losses) -> tuple[Finding, ...]:
    """Findings of conditions whose film has a viscosity outside the range of the oil."""
    if drive.file.film is None or drive.oil is None:
        return ()
    state = {**drive.oil.inputs(losses.temperature), "oil_temperature": losses.temperature}
    state["kinematic_viscosity"] = np.asarray(state["viscosity"]) / np.asarray(state["oil_density"])
    limits = [one for one in contact_limits(state) if one.code.startswith("viscosity_") and one.quantity in state]
    return findings(
        [(one, np.asarray(state[one.quantity])) for one in limits], losses.temperature.shape, "conditions", "lubricant"
    )
