"""Friction, losses and efficiency of a pair: the load along its contact lines, and a friction law at each point."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from mixedlub import friction
from mixedlub.base_model.limits import contact_limits, law_limits
from mixedlub.chain.model import Chain, Model
from mixedlub.chain.ranges import Limit, Reached, farthest_beyond, of_law
from mixedlub.laws.load import carries_load
from mixedlub.rig.lubricant import Lubricant
from mixedlub.skew_gears.contact_lines import ContactLines, mean_contact
from mixedlub.study.options import study_chain
from mixedlub.study.schema import Options
from profiles.errors import InputError

ROUNDS = 4
"""Cost limit. Rounds between line load and friction, which changes the load by a few per cent at most."""
WANTED = ("friction", "hertz_pressure", "film_thickness", "composite_roughness", "area_ratio", "line_load")
MOST_POINTS = 1_000_000
"""Cost limit. Contact points computed at a time."""


@dataclass(frozen=True, eq=False)
class Losses:
    """Results at N conditions of the pinion, in SI; ``reached``: limits of the laws with values of each condition."""

    torque: np.ndarray
    speed: np.ndarray
    temperature: np.ndarray
    values: Mapping[str, np.ndarray]
    reached: Reached

    def __getitem__(self, name: str) -> np.ndarray:
        """Values of a quantity by condition."""
        return self.values[name]


@dataclass(frozen=True, eq=False)
class Mesh:
    """Contact lines with laws, oil and surfaces; ``surfaces``: chain inputs of both flanks."""

    lines: ContactLines
    options: Options
    oil: Lubricant
    surfaces: Mapping[str, float]
    boundary_friction: float
    reduced_modulus: float
    pinion_drives: bool = True

    @cached_property
    def _of_pair(self) -> dict[str, Any]:
        """Chain inputs without conditions; sizes of the mesh as of its virtual cylindrical pair."""
        blank, cones = self.lines.blank, self.lines.blank.cones
        mean = mean_contact(blank, drive=self.lines.drive)
        virtual = [radius / np.cos(angle) for radius, angle in zip(cones.radius, cones.angle, strict=True)]
        spiral = sum(cones.spiral) / 2
        pressure = blank.effective_angle[0 if self.lines.drive else 1]
        return {
            **self.surfaces,
            "boundary_friction": self.boundary_friction,
            "reduced_modulus": self.reduced_modulus,
            "radius": self.lines.contact.radius,
            "pitch_radius": float(mean.radius[0]),
            "face_width": blank.basic.face_width,
            "gear_module": cones.normal_module,
            "helix_angle": spiral,
            "base_helix_angle": float(np.arcsin(np.sin(spiral) * np.cos(pressure))),
            "working_pressure_angle": float(np.arctan(np.tan(pressure) / np.cos(spiral))),
            "pinion_radius": virtual[0],
            "gear_radius": virtual[1],
            "pinion_teeth": float(cones.teeth[0]),
            "gear_teeth": float(cones.teeth[1]),
            "contact_ratio": self.lines.contact_ratio,
            "gears_fitted": 1.0,
            "_mean_entrainment": float(mean.entrainment[0]),
            "_mean_lever": float(np.abs(np.sum(mean.normal * mean.velocity[0]))),
            "_mean_length": float(self.lines.over_positions(self.lines.length).mean()),
            **({} if self.options.hardness_GPa is None else {"hardness": self.options.hardness_GPa * 1e9}),
        }

    @cached_property
    def _given(self) -> tuple[str, ...]:
        return tuple(self._inputs(*(np.ones((1, 1)),) * 3, np.ones((1, self.lines.position.size))))

    @cached_property
    def _chain(self) -> Chain:
        """Chain of the options from film to friction."""
        chain = study_chain(self.options)
        last = [name for name, _ in chain].index("friction")
        return tuple((name, law) for name, law in chain[: last + 1] if name not in self._given)

    @cached_property
    def model(self) -> Model:
        """Model of a contact point."""
        wanted = dict.fromkeys((*WANTED, *(limit.quantity for limit in self.limits)))
        return Model(self._chain, self._given, tuple(wanted))

    @property
    def friction_law(self) -> friction.FrictionLaw | None:
        """Friction law that takes the place of the base model's."""
        if self.options.friction == friction.BASE:
            return None
        return friction.find(self.options.friction).bounded(self.options.friction_coefficients)

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """Ranges of the laws on which friction depends."""
        modulus = {"reduced_modulus": self.reduced_modulus}
        pressed = [limit for limit in contact_limits(modulus) if limit.quantity == "hertz_pressure"]
        own = Model(self._chain, self._given, ("friction",))
        found = (*pressed, *law_limits(own.steps, (), {}))
        chosen = self.friction_law
        return found + (() if chosen is None else of_law(chosen.name, chosen.valid))

    def _inputs(self, torque: np.ndarray, speed: np.ndarray, temperature: np.ndarray, line_load: np.ndarray) -> Any:
        pair, contact = dict(self._of_pair), self.lines.contact
        entrainment, lever, length = (pair.pop(f"_mean_{name}") for name in ("entrainment", "lever", "length"))
        force = torque / lever
        return {
            **pair,
            **self.oil.inputs(temperature),
            "oil_temperature": temperature,
            "line_load": line_load,
            "entrainment_speed": contact.entrainment * speed,
            "sliding_speed": contact.sliding_speed * speed,
            "torque": torque,
            "pinion_speed": speed,
            "transmitted_force": force,
            "mesh_line_load": force / length,
            "pitch_line_speed": self.lines.blank.cones.radius[0] * speed,
            "pitch_entrainment_speed": entrainment * speed,
        }

    def losses(self, torque: np.ndarray, speed: np.ndarray, temperature: np.ndarray) -> Losses:
        """Losses at pinion torques (N m), pinion speeds (rad/s) and oil temperatures (K), each of N conditions."""
        step = max(1, MOST_POINTS // self.lines.position.size)
        parts = [
            self._at(*(one[start : start + step, None] for one in (torque, speed, temperature)))
            for start in range(0, torque.size, step)
        ]
        values = {name: np.concatenate([part[0][name] for part in parts]) for name in parts[0][0]}
        reached = [(limit, np.concatenate([part[1][i] for part in parts])) for i, limit in enumerate(self.limits)]
        return Losses(torque, speed, temperature, values, reached)

    def points(self, torque: float, speed: float, temperature: float) -> dict[str, np.ndarray]:
        """Line load, friction and state of every contact point at one condition, and its loss (W)."""
        load, mu, state = self._solved(*(np.array([[one]]) for one in (torque, speed, temperature)))
        found = {name: np.broadcast_to(state[name], load.shape)[0] for name in WANTED}
        lost = mu * load * self.lines.length * self.lines.contact.sliding_speed * speed
        return {**found, "line_load": load[0], "friction": np.broadcast_to(mu, load.shape)[0], "power_loss": lost[0]}

    def _solved(
        self, torque: np.ndarray, speed: np.ndarray, temperature: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, dict[str, Any]]:
        """Line load (N/m), friction and state of the model, with conditions in rows."""
        lines, mu = self.lines, np.zeros((1, 1))
        for _ in range(ROUNDS):
            load = lines.at_position(torque / self._levers(mu)) * lines.shape
            with np.errstate(all="ignore"):
                state = self.model(self._inputs(torque, speed, temperature, np.maximum(load, np.finfo(float).tiny)))
            # Without sliding no friction law matters, though some diverge.
            mu = np.where(lines.contact.sliding_speed > 0.0, state["friction"], 0.0)
        self._levers(mu)
        return load, mu, state

    def _at(
        self, torque: np.ndarray, speed: np.ndarray, temperature: np.ndarray
    ) -> tuple[dict[str, np.ndarray], list[np.ndarray]]:
        """Results of conditions in rows, and the values farthest beyond the limits."""
        lines, contact = self.lines, self.lines.contact
        load, mu, state = self._solved(torque, speed, temperature)
        sliding = contact.sliding_speed * speed
        weight = load * lines.length / lines.positions
        power, lost = (weight * sliding).sum(axis=-1), (mu * weight * sliding).sum(axis=-1)
        if not np.all(np.isfinite(lost)):
            raise InputError("the numbers give no finite friction; look for one far out of range", where="conditions")
        of_pinion = (torque * speed)[:, 0]
        taken = of_pinion if self.pinion_drives else of_pinion + lost
        along = lines.lengthwise_sliding**2 / np.maximum(contact.sliding_speed**2, np.finfo(float).tiny)
        carries = carries_load(load)
        loaded = {name: np.broadcast_to(state[name], load.shape) for name in WANTED}
        values = {
            "input_power": taken,
            "power_loss": lost,
            "efficiency": 1.0 - lost / taken,
            "output_torque": (taken - lost) / speed[:, 0] * (lines.blank.cones.ratio if self.pinion_drives else 1.0),
            "mean_friction": lost / power,
            "loss_factor": power / of_pinion,
            "lengthwise_share": (mu * weight * sliding * along).sum(axis=-1) / lost,
            "hertz_pressure": loaded["hertz_pressure"].max(axis=-1),
            "line_load": load.max(axis=-1),
            "film_thickness": _mean(loaded["film_thickness"], lines.length),
            "film_parameter": _mean(loaded["film_thickness"] / loaded["composite_roughness"], lines.length),
            "area_ratio": _mean(loaded["area_ratio"], lines.length),
        }
        beyond = [
            farthest_beyond(np.asarray(state[limit.quantity]), limit.ends, carries)[..., 0] for limit in self.limits
        ]
        return values, beyond

    def _levers(self, mu: np.ndarray) -> np.ndarray:
        """Torque on the pinion over the largest line load, by position; raise an error for a pair that locks itself."""
        lines, sign = self.lines, 1.0 if self.pinion_drives else -1.0
        free = lines.over_positions(lines.weight * lines.drive_speed)
        rubbed = lines.over_positions(lines.weight * mu * lines.pinion_slip)
        if self.pinion_drives:
            held = lines.over_positions(lines.weight * mu * (lines.contact.sliding_speed - lines.pinion_slip))
        else:
            held = rubbed
        if np.any(held >= free):
            at = np.unravel_index(int(np.argmax(held / free)), held.shape)
            worst = float(np.max(mu))
            driver, driven = ("pinion", "wheel") if self.pinion_drives else ("wheel", "pinion")
            rule = (
                f"the pair locks itself: the {driver} cannot drive the {driven} at a friction coefficient of "
                f"{worst:.3g}, only below {worst * float((free / held)[at]):.3g}"
            )
            raise InputError(rule, where="driving", value="pinion" if self.pinion_drives else "gear")
        return np.asarray(free + sign * rubbed)


def _mean(values: np.ndarray, length: np.ndarray) -> np.ndarray:
    return np.asarray((values * length).sum(axis=-1) / length.sum())
