"""Friction coefficient of two discs, or of a ball on a disc."""

from __future__ import annotations

import numpy as np

from mixedlub.base_model.chains import LINE, POINT
from mixedlub.chain.model import Chain
from mixedlub.kinds import columns, oil_priors
from mixedlub.kinds.calibration import Calibration
from mixedlub.kinds.kind import MIXED_FRICTION, Inputs, Kind, bookkeeping_inputs, column, inverse_load
from mixedlub.kinds.standard import DISCS, OIL, ROUGHNESS_UM, StandardRig
from mixedlub.kinds.surfaces import pair_of_surfaces
from mixedlub.laws import load, loss
from mixedlub.laws.contact import reduced_modulus
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig.rig import Rig
from mixedlub.schema import system_file
from mixedlub.schema.table import Table
from profiles.errors import InputError

COLUMNS = (columns.LOAD, columns.ENTRAINMENT_SPEED, columns.SLIDE_ROLL_RATIO, columns.OIL_TEMPERATURE)
SURFACES = (columns.surface("surface_1"), columns.surface("surface_2"))


def reading(tangential_friction: np.ndarray) -> np.ndarray:
    """The rig reads the tangential force over the load (-).

    >>> float(reading(0.05))
    0.05
    """
    return tangential_friction


def point_reading(friction: np.ndarray) -> np.ndarray:
    """The rig reads the friction coefficient (-).

    >>> float(point_reading(0.05))
    0.05
    """
    return friction


def reduced_radius(radii_mm: tuple[float, float], key: str) -> float:
    """Reduced radius (m) of two bodies, from the sum of their curvatures; raises an error for two planes.

    >>> round(reduced_radius((25.4, 38.1), "radius_mm") * 1e3, 2)
    15.24
    """
    curvature = sum(1.0 / (r * 1e-3) for r in radii_mm)
    if curvature <= 0:
        raise InputError("one of the two bodies must be curved", where=f"contact.{key}", value=radii_mm)
    return 1.0 / curvature


def contact_inputs(contact: system_file.Contact, table: Table) -> Inputs:
    """Chain inputs of the bodies and their motion."""
    first, second = contact.youngs_modulus_GPa
    modulus = reduced_modulus((first * 1e9, second * 1e9), contact.poisson_ratio)
    radius = reduced_radius(contact.radius_mm, "radius_mm")
    across = contact.transverse_radius_mm
    speed = column(table["entrainment_speed_m_s"])
    inputs: Inputs = {
        "radius": radius,
        "transverse_radius": radius if across is None else reduced_radius(across, "transverse_radius_mm"),
        "reduced_modulus": modulus,
        "load": column(table["load_N"]),
        "entrainment_speed": speed,
        "sliding_speed": np.abs(column(table["slide_roll_ratio"])) * speed,
    }
    if contact.width_mm is not None:
        inputs["contact_width"] = contact.width_mm * 1e-3
    return inputs


def inputs(system: system_file.System, rig: Rig, table: Table, recorded: Table) -> Inputs:
    """Chain inputs of the rows of a table."""
    assert system.contact is not None
    temperature = column(table["oil_temperature_C"]) + ZERO_CELSIUS
    return {
        **contact_inputs(system.contact, table),
        **rig.oil().inputs(temperature),
        **pair_of_surfaces(rig, table, "surface_1", "surface_2"),
        **bookkeeping_inputs(system, table),
        **inverse_load(system, table, recorded),
        "oil_temperature": temperature,
        "boundary_friction": system.boundary_friction,
    }


def extra_calibration(system: system_file.System, recorded: Table) -> tuple[Calibration, ...]:
    """Broad priors for an unspecified oil."""
    return oil_priors.calibrations(system, recorded["oil_temperature_C"] + ZERO_CELSIUS)


def chain(system: system_file.System, table: Table) -> Chain:
    """The chain of a line contact, or of a point contact for a ball."""
    if system.contact is not None and system.contact.geometry == "point":
        return (*POINT, ("reading", point_reading))
    tangential = ("tangential_friction", loss.tangential_friction)
    return (("line_load", load.disc_line_load), *LINE, tangential, ("reading", reading))


STANDARD = StandardRig(
    sections={"contact": DISCS, "lubricant": OIL},
    noise=2e-4,
    conditions={
        "load": ("load_N", (400.0, 1000.0, 2200.0)),
        "speed": ("entrainment_speed_m_s", (1.0, 2.5, 6.0, 12.0)),
        "slide_roll_ratio": ("slide_roll_ratio", (0.05, 0.2, 0.6)),
        "oil_temperature": ("oil_temperature_C", (50.0, 70.0, 90.0)),
        "surfaces": ("surface_1", tuple(ROUGHNESS_UM)),
    },
)

KIND = Kind(
    name="disc",
    subject="contact",
    readings=(columns.FRICTION,),
    columns=(*COLUMNS, *SURFACES),
    sections=("contact", "lubricant", "surfaces"),
    base_model=(
        f"Dowson-Toyoda film of a line contact or Hamrock-Dowson film of a point contact, {MIXED_FRICTION}. No heat."
    ),
    chain=chain,
    inputs=inputs,
    extra_calibration=extra_calibration,
    asks_for_oil=True,
    standard=STANDARD,
)
