"""Friction of tooth contacts against the roll angle: strain-gauge like recordings of a gear pair."""

from __future__ import annotations

import itertools
from dataclasses import replace
from typing import Any

import numpy as np

from mixedlub.validation.contact import PRIORS, Contact, Inputs, contact_model, contact_theta, friction_chain
from mixedlub.validation.planted import FORMS, OUTSIDE, viscosity_temperature
from mixedlub.validation.planted.film import OF_LOCAL_CONTACTS
from mixedlub.validation.planted.measurement import channel
from mixedlub.validation.rig import Case, Form, Knob, Rig, strength
from mixedlub.validation.rigs import gears
from mixedlub.validation.sample_rig import programme

PAIRS = (
    ("film_heating", "sensor_offset"),
    ("starvation", "limiting_shear_stress"),
    ("inlet_shear_heating", "boundary_speed_dependence"),
    ("tribofilm_growth", "film_heating"),
    ("inlet_shear_thinning", "tribofilm_growth"),
)
LOCAL = (
    "roughness_lay",
    "film_heating",
    "limiting_shear_stress",
    "coating_insulation",
    "skewed_heights",
    "asperity_plasticity",
    "micro_ehl",
    "running_in",
    "surface_defects",
    "boundary_film_temperature",
    "boundary_speed_dependence",
    "tribofilm_growth",
    "misalignment",
    "pressure_viscosity_law",
    "viscosity_drift",
)

FRICTION = friction_chain()


def at_angles(case: Case, angles: np.ndarray) -> Inputs:
    """Inputs of a gear pair with one contact a reading: readings by 1."""
    path = gears.path_of_contact(gears.gears_of(case.settings))
    levels, place = np.unique(angles, return_inverse=True)
    whole = gears.inputs_of(case, positions=np.radians(levels) * path.base_radius[0])
    rows = np.arange(len(angles))

    def own(values: np.ndarray) -> np.ndarray:
        wide = np.broadcast_to(values, (len(angles), len(levels)))
        return np.asarray(wide[rows, place][:, None])

    return replace(
        whole,
        radius=own(whole.radius),
        speed_1=own(whole.speed_1),
        speed_2=own(whole.speed_2),
        share_force=own(whole.share_force),
        phase=own(whole.phase),
    )


def _outside(rig: Inputs, angles: np.ndarray) -> tuple[Form, ...]:
    path = np.ptp(angles)
    place = ((angles - angles.min()) / path)[:, None]
    approaching = (rig.speed_1 < rig.speed_2).astype(float)

    def pitted(c: Contact, strength: float, where: float) -> Contact:
        """A pit on the flank: friction deviates over a tenth of the path."""
        return replace(c, friction=c.friction * (1 + 0.2 * strength * np.exp(-0.5 * ((place - where) / 0.05) ** 2)))

    def biting(c: Contact, strength: float) -> Contact:
        """Friction in approach differs from friction in recess."""
        return replace(c, friction=c.friction * (1 + 0.15 * strength * approaching))

    either = strength(-4.0, 8.0)
    forms = [
        Form("pitted", "friction", pitted, (either, Knob("where", 0.1, 0.9, (0.15, 0.85))), "constructed"),
        Form("biting", "friction", biting, (either,), "constructed"),
    ]
    chosen = ["hot_cavitation"]
    if len(np.unique(rig.moments[:, 0])) > 1:
        chosen.append("pair_chemistry")
    if len(np.unique(rig.conditions["speed_rpm"])) > 3:
        chosen += ["speed_band", "speed_ripple"]
    return (*forms, *(OUTSIDE[name] for name in chosen))


def _programme(rng: np.random.Generator, case: Case, angles: np.ndarray) -> dict[str, np.ndarray]:
    """Some pairings, torques, speeds and temperatures of a gear case, over all roll angles."""
    many = {"torque_Nm": 2, "speed_rpm": 4, "oil_temperature_C": 2}

    def some(name: str) -> list[float]:
        levels = np.unique(case.columns[name])
        count = min(int(rng.integers(1, many[name] + 1)) + (name == "speed_rpm"), len(levels))
        return [float(v) for v in levels[np.unique(np.linspace(0, len(levels) - 1, count).astype(int))]]

    pairs = sorted(set(zip(case.columns["pinion_surface"], case.columns["gear_surface"])))
    chosen = [pairs[i] for i in rng.permutation(len(pairs))[: int(rng.integers(1, 3))]]
    grid = list(itertools.product(chosen, some("torque_Nm"), some("speed_rpm"), some("oil_temperature_C")))
    most = max(int(200 / len(angles)), 1)
    grid = [grid[i] for i in rng.permutation(len(grid))[:most]]
    rows = [(*pair, *row, angle) for pair, *row in grid for angle in angles]
    if len(rows) < 40:
        rows = rows * 2
    names = ("pinion_surface", "gear_surface", "torque_Nm", "speed_rpm", "oil_temperature_C", "roll_angle_deg")
    return programme(names, rows)


def draw(rng: np.random.Generator) -> Rig:
    """A gear pair, a few pairings, torques, speeds and temperatures, 8 to 16 roll angles."""
    coated = rng.random() < 0.2
    case = gears.draw_case(rng, coated)
    path = gears.path_of_contact(gears.gears_of(case.settings))
    ends = np.degrees(np.array([path.start, path.end]) / path.base_radius[0])
    inside = 0.02 * np.ptp(ends)
    angles = np.round(np.linspace(ends[0] + inside, ends[1] - inside, int(rng.integers(8, 17))), 3)
    columns = _programme(rng, case, angles)
    used = {*columns["pinion_surface"], *columns["gear_surface"]}
    settings: dict[str, Any] = {
        **case.settings,
        "surfaces": {name: table for name, table in case.settings["surfaces"].items() if name in used},
        "recording": {"quantity": "friction_coefficient"},
    }
    layers = any("coating" in surface for surface in settings["surfaces"].values())
    case = Case(settings=settings, columns=columns, share=case.share)
    inputs = at_angles(case, columns["roll_angle_deg"])
    shown = [name for name in LOCAL if layers or name != "coating_insulation"]
    usable = tuple(form for name in shown for form in FORMS[name])
    return Rig(
        settings={**settings, "kind": "mesh_friction"},
        columns=columns,
        names=PRIORS,
        model=contact_model(settings, lambda: inputs, FRICTION),
        theta=contact_theta(settings),
        forms=OF_LOCAL_CONTACTS
        + usable
        + viscosity_temperature.of_contacts(inputs)
        + channel(columns["sequence"], True, True, False),
        outside=_outside(inputs, columns["roll_angle_deg"]),
        share=case.share,
    )
