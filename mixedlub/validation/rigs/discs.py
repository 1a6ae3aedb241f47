"""Friction of two discs in line contact: random points of a grid of loads, speeds, slips and temperatures."""

from __future__ import annotations

import itertools
from functools import cache
from typing import Any

import numpy as np

from mixedlub.validation.contact import Inputs, contact_model, friction_chain, oil_of, solid_of, surfaces_of
from mixedlub.validation.rig import Case, Rig
from mixedlub.validation.rigs.gears import COATED, rig_on
from mixedlub.validation.sample_rig import (
    STEEL,
    UNCERTAINTY,
    draw_levels,
    draw_oil,
    draw_pairings,
    draw_surfaces,
    draw_temperatures,
    programme,
    rounded,
)

NOT_HERE = (
    *("dynamic_load", "misalignment", "tip_relief", "windage", "churning", "bearing_drag", "seal_drag"),
    *("bulk_temperature", "heat_leak", "torque_gain", "torque_offset", "square_law_brake"),
)
"""Effects of teeth, wheels, gearboxes and their instruments."""
FRICTION = friction_chain()


def inputs_of(case: Case) -> Inputs:
    """Contact of the discs at each reading."""
    contact = case.settings["contact"]
    r1, r2 = (1e-3 * r for r in contact["radius_mm"])
    mean = case.columns["entrainment_speed_m_s"].astype(float)[:, None]
    half = 0.5 * case.columns["slide_roll_ratio"].astype(float)[:, None] * mean
    return Inputs(
        oil=oil_of(case.settings),
        solid=solid_of(contact),
        radius=np.array([[r1 * r2 / (r1 + r2)]]),
        speed_1=mean + half,
        speed_2=mean - half,
        share_force=case.columns["load_N"].astype(float)[:, None],
        width=1e-3 * contact["width_mm"],
        temperature=case.columns["oil_temperature_C"].astype(float),
        sequence=case.columns.get("sequence", np.zeros(len(mean))).astype(float),
        conditions=case.columns,
        **surfaces_of(case, "surface_1", "surface_2"),
    )


def rig_of(case: Case) -> Rig:
    """Rig of the case."""
    return rig_on(case, contact_model(case.settings, cache(lambda: inputs_of(case)), FRICTION), NOT_HERE)


def draw_case(rng: np.random.Generator, coated: bool) -> Case:
    """Two discs and 150 to 220 random points of the grid of their programme."""
    surfaces = draw_surfaces(rng, coated)
    radii = [float(rng.choice([20.0, 25.4, 30.0, 38.1])), float(rng.choice([25.4, 40.0, 50.0]))]
    width = float(rng.choice([4.0, 6.0, 10.0]))
    modulus = 206e9 / (1 - 0.3**2)
    radius = 1e-3 * radii[0] * radii[1] / sum(radii)
    pressures = np.linspace(rng.uniform(0.55, 0.75), rng.uniform(1.15, 1.5), 3) * 1e9
    loads = [rounded(2 * np.pi * p**2 * radius / modulus * 1e-3 * width, 5) for p in pressures]
    slips = [0.005, 0.02, 0.05, 0.1, 0.3, 0.6, 1.0]
    chosen = sorted(rng.choice(len(slips), int(rng.integers(4, 6)), replace=False))
    levels = (
        draw_pairings(rng, list(surfaces), int(rng.integers(3, 6))),
        loads,
        draw_levels(rng, (0.4, 12.0), int(rng.integers(4, 6))),
        [slips[i] for i in chosen],
        draw_temperatures(rng, 3),
    )
    grid = list(itertools.product(*levels))
    order = rng.permutation(len(grid))[: int(rng.integers(150, 221))]
    rows = [grid[i] for i in order]
    settings: dict[str, Any] = {
        "schema": "mixedlub-case/1",
        "kind": "disc",
        "boundary_friction": 0.1,
        "contact": {
            "geometry": "line",
            "radius_mm": radii,
            "width_mm": width,
            **STEEL,
        },
        "lubricant": draw_oil(rng),
        "surfaces": surfaces,
        "uncertainty": UNCERTAINTY,
        "recording": {"quantity": "friction_coefficient"},
    }
    names = ("surface_1", "surface_2", "load_N", "entrainment_speed_m_s", "slide_roll_ratio", "oil_temperature_C")
    return Case(settings=settings, columns=programme(names, [(*pair, *row) for pair, *row in rows]))


def draw(rng: np.random.Generator) -> Rig:
    return rig_of(draw_case(rng, rng.random() < COATED))
