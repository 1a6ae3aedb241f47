"""Gears and their load sharing from the sections of a file, in SI."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mixedlub.gear.geometry import GearPair
from mixedlub.gear.mesh import Sharing
from mixedlub.schema import system_file
from mixedlub.schema.findings import finding, report
from mixedlub.schema.gear_file import stated_otherwise


def gear_pair(section: system_file.Gears) -> GearPair:
    """The gear pair of a ``[gears]`` section."""
    tips = section.tip_diameter_mm
    other = {} if section.preset is None else stated_otherwise(section.model_dump())
    if other:
        text = ", ".join(f"{name} in place of {value}" for name, value in other.items())
        report(finding("gears_overridden", f"{text} of the gears {section.preset}", "gears"))
    return GearPair(
        teeth=section.teeth,
        normal_module=section.normal_module_mm * 1e-3,
        pressure_angle=float(np.radians(section.pressure_angle_deg)),
        helix_angle=float(np.radians(section.helix_angle_deg)),
        profile_shift=section.profile_shift,
        tip_radius=None if tips is None else (tips[0] * 0.5e-3, tips[1] * 0.5e-3),
        centre_distance=None if section.centre_distance_mm is None else section.centre_distance_mm * 1e-3,
        face_width=section.face_width_mm * 1e-3,
        youngs_modulus=(section.youngs_modulus_GPa[0] * 1e9, section.youngs_modulus_GPa[1] * 1e9),
        poisson_ratio=section.poisson_ratio,
        dedendum=section.dedendum,
    )


def sharing(section: system_file.LoadSharing, folder: Path) -> Sharing:
    """Load sharing between tooth pairs, by ``load_sharing``."""
    return section.chosen.build(section, folder)
