"""State of planted rigs under the names of the glossary, as the catalogue's laws read it."""

from typing import Any

import numpy as np

from mixedlub.laws import heating
from mixedlub.validation.contact import Contact, mix, summits
from mixedlub.validation.planted.histories import Track
from mixedlub.validation.rigs import drives, viscosities
from mixedlub.validation.sample_rig import progress

from .helpers import readings

KELVIN = 273.15
Values = dict[str, Any]


def _column(values: np.ndarray) -> np.ndarray:
    return np.asarray(values, dtype=float)[:, None]


def of_contact(c: Contact, columns: Values) -> Values:
    """State of a contact under the names of the glossary; readings of films in metres."""
    rig, solid, warm, s = c.rig, c.rig.solid, c.temperature, summits(c)
    found: Values = {
        "film_thickness": c.film,
        "viscosity": c.viscosity,
        "pressure_viscosity": c.pressure_viscosity,
        "entrainment_speed": c.entrainment,
        "sliding_speed": c.sliding,
        "slide_roll_ratio": c.sliding / c.entrainment,
        "hertz_pressure": c.pressure,
        "hertz_half_width": c.half_width,
        "reduced_modulus": rig.solid.reduced,
        "radius": rig.radius,
        "oil_conductivity": rig.oil.conductivity,
        "oil_density": rig.oil.density_at(warm),
        "temperature_viscosity": rig.oil.thinning_at(warm),
        "coefficient_fall": 1.0 - rig.oil.pressure_viscosity_at(warm + 1.0) / rig.oil.pressure_viscosity_at(warm),
        "composite_roughness": c.roughness,
        "oil_temperature": warm + KELVIN,
        "shear_stress": c.stress,
        "eyring_stress": c.eyring_stress,
        "contact_viscosity": np.sinh(c.stress / c.eyring_stress) * c.eyring_stress * c.film / c.sliding,
        "flash_per_friction": heating.flash_per_friction(
            c.pressure, c.half_width, c.entrainment, c.sliding, solid.conductivity, solid.density, solid.specific_heat
        ),
        "fluid_friction": c.stress / c.pressure,
        "coating_thickness": rig.coating_resistance * (0.0 * warm if rig.coated is None else rig.coated),
        "coating_conductivity": 1.0,
        "boundary_friction": c.boundary_friction,
        "area_ratio": c.area,
        "friction": mix(c).friction if c.stress.ndim == 2 else c.friction,
        "line_load": c.line_load,
        "m0": c.m0,
        "m2": c.m2,
        "m4": c.m4,
        **{f"{name}_share": rig.shares[:, 0, i : i + 1] for i, name in enumerate(("height", "slope", "curvature"))},
        "separation": (c.film - s.offset) / s.spread,
        "summit_density": s.density,
        "summit_radius": s.radius,
        "summit_sigma": s.spread,
        "sequence": _column(rig.sequence),
        "ageing": _column(rig.sequence),
        "rolling_force": 0.0,
        "reading": _column(c.recorded) * (1e-9 if "film_thickness_nm" in columns else 1.0),
        "reading_scale": float(np.median(np.abs(c.recorded))) * (1e-9 if "film_thickness_nm" in columns else 1.0),
        "face_width": rig.width,
        "contact_width": rig.width,
        "gears_fitted": 1.0,
    }
    found["power_loss"] = found["reading"]
    first, second = rig.oil.viscosity_at(np.array(rig.oil.temperature))
    found |= _of_oil(rig.oil.temperature, (first, second), c.viscosity)
    if "load_N" in rig.conditions:
        found["inverse_load"] = _inverse(rig.conditions["load_N"])
    if rig.extras:
        found |= _of_gears(c)
    if "fringe_order" in columns:
        found["fringe_order"] = _column(columns["fringe_order"])
        found["first_fringe_order"] = np.min(columns["fringe_order"])
    return found


def _of_oil(celsius: tuple[float, float], known: tuple[float, float], viscosity: np.ndarray) -> Values:
    """What is known of an oil, beside a viscosity at hand."""
    return {
        "first_known_temperature": celsius[0] + KELVIN,
        "second_known_temperature": celsius[1] + KELVIN,
        "known_fall": np.log(known[0] / known[1]),
        "fall_from_first": np.log(known[0] / viscosity),
    }


def _inverse(load: Any) -> np.ndarray:
    return _column(np.min(load) / load)


def _of_gears(c: Contact) -> Values:
    extras, speed = c.rig.extras, _column(c.rig.conditions["speed_rpm"]) * np.pi / 30
    torque = _column(c.rig.conditions["torque_Nm"])
    whole = torque / extras["base_radius"]
    loss = readings(c.rig)
    wheel, gear_speed = extras["wheel_diameter"] / 2, speed * extras["ratio"]
    return {
        "torque": torque,
        "nominal_loss": _column(loss),
        "reading_scale": float(np.median(np.abs(c.recorded if c.recorded.any() else loss))),
        "pinion_speed": speed,
        "gear_speed": gear_speed,
        "pinion_radius": extras["pitch_diameter"] / 2,
        "gear_radius": wheel,
        "bath_acceleration": gear_speed**2 * (wheel * c.rig.width * extras["module"]) ** (1 / 3),
        "pinion_teeth": extras["teeth"],
        "gear_teeth": extras["teeth"] / extras["ratio"],
        "gear_module": extras["module"],
        "helix_angle": 0.0,
        "transmitted_force": whole if c.force is c.rig.share_force else whole * c.force / c.rig.share_force,
        "load_share": c.force / whole,
        "contact_ratio": extras["contact_ratio"],
        "path_fraction": c.rig.phase / extras["contact_ratio"],
        "mesh_phase": c.rig.phase,
        "ambient_temperature": extras["ambient"] + KELVIN,
        "largest_torque": 1.0,
    }


def of_drive(d: drives.Drive, columns: Values) -> Values:
    motor = columns.get("motor_torque_Nm", d.recorded)
    celsius, load, content = (
        columns.get(name, np.ones(len(d.sign))) for name in ("oil_temperature_C", "load_N", "additive_percent")
    )
    unmoved = d.running is d.constant or np.ptp(d.running) == 0.0
    return {
        "running_friction": d.dry * d.sign + d.drag if unmoved else d.running,
        "friction_torque": d.running,
        "coulomb_torque": d.dry,
        "viscous_torque": d.drag / d.speed,
        "drive_speed": d.speed,
        "reference_speed": 1.0,
        "temperature_difference": celsius - np.mean(celsius),
        "log_load": np.log(load) - np.mean(np.log(load)),
        "oil_temperature": celsius + KELVIN,
        "load_fraction": load / load.max(),
        "inverse_load": load.min() / load,
        "additive_fraction": content / content.max(),
        "drive_angle": np.radians(columns.get("position_deg", 0.0)),
        "motor_torque": motor,
        "reference_torque": np.abs(motor).max(),
        "sequence": columns["sequence"],
        "reading": d.recorded,
        "reading_scale": 1.0,
    }


def of_track(t: Track, columns: Values) -> Values:
    place, whole = progress(len(t.level)), np.ones(len(t.level))
    return {
        "boundary_friction": t.level,
        "friction": t.recorded,
        "area_ratio": whole,
        "slide_roll_ratio": columns.get("slide_roll_ratio", whole),
        "inverse_load": _inverse(columns.get("load_N", whole))[:, 0],
        "hertz_pressure": 1e9,
        "sequence": place,
        "reading": t.recorded,
        "reading_scale": 1.0,
    }


def of_sample(s: viscosities.Sample, columns: Values) -> Values:
    place = columns.get("sequence", progress(len(s.celsius)))
    done = np.cumsum(np.exp2((s.celsius - 40.0) / 10.0))
    return {
        "viscosity": s.resting,
        "contact_viscosity": s.resting * np.exp(s.rise),
        "hertz_pressure": s.pressure,
        "oil_temperature": s.celsius + KELVIN,
        **_of_oil(*s.known, s.resting),
        "sequence": place,
        "ageing": done / done[-1],
        "reading": s.recorded,
        "reading_scale": 1.0,
    }


READERS = {Contact: of_contact, drives.Drive: of_drive, Track: of_track, viscosities.Sample: of_sample}
