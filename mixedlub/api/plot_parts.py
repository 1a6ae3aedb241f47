"""Figures of gears, oils and surfaces, as their functions return them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.gear import RigidSharing, mesh
from mixedlub.gear.build import gear_pair
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.report.style import panels, styled
from mixedlub.rig import build
from mixedlub.schema.findings import collected
from mixedlub.schema.lubricant_section import Lubricant
from mixedlub.schema.surface_file import SurfaceSection
from mixedlub.schema.system_file import Gears
from profiles.errors import InputError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

TEMPERATURES_C = np.linspace(20.0, 120.0, 101)
"""Judgement: oil temperatures of gearboxes."""
DRAWN = (Gears, Lubricant, SurfaceSection)
"""Parts with a figure."""


def of_part(part: Gears | Lubricant | SurfaceSection) -> Figure:
    """Figure of a part: contact along the path, viscosity over temperature, or the roughness profile."""
    with collected(), styled():
        if isinstance(part, Gears):
            return _gears(part)
        return _oil(part) if isinstance(part, Lubricant) else _surface(part)


def _gears(section: Gears) -> Figure:
    """Equivalent radius and slide-roll ratio of the contact over the roll angle of the pinion."""
    points = mesh(gear_pair(section), RigidSharing())
    angle, order = np.unique(np.degrees(points.roll_angle), return_index=True)
    slide_roll = points.sliding_per_speed / points.entrainment_per_speed
    figure, axes, _ = panels(2, 2, sharey=False)
    names = (("equivalent radius (mm)", 1e3 * points.radius), ("sliding over entrainment speed", slide_roll))
    for panel, (name, values) in zip(axes, names, strict=True):
        panel.plot(angle, values[order])
        panel.set_xlabel("roll angle of the pinion (°)")
        panel.set_ylabel(name)
    return figure


def _oil(section: Lubricant) -> Figure:
    """Dynamic viscosity and pressure-viscosity coefficient over temperature."""
    oil = build.lubricant(section)
    kelvin = TEMPERATURES_C + ZERO_CELSIUS
    figure, axes, _ = panels(2, 2, sharey=False)
    names = (
        ("viscosity (mPa s)", 1e3 * oil.viscosity(kelvin)),
        ("pressure-viscosity coefficient (1/GPa)", 1e9 * oil.pressure_coefficient(kelvin)),
    )
    for panel, (name, values) in zip(axes, names, strict=True):
        panel.plot(TEMPERATURES_C, values)
        panel.set_xlabel("oil temperature (°C)")
        panel.set_ylabel(name)
    axes[0].set_yscale("log")
    axes[0].set_title(section.name or oil.name, loc="left")
    return figure


def _surface(section: SurfaceSection) -> Figure:
    """Roughness profile of the first trace of a surface."""
    if not (section.profile or section.traces) or section.m0_um2 is not None:
        raise InputError("is known by its parameters alone; only a trace in a file is drawn", where="plot: results")
    (trace, *_), where = build.traces("surface", section, Path()), "surface"
    profile = build.flank_profile(where, section, trace)
    figure, (axes, *_), _ = panels(1, 1)
    heights = 1e6 * profile.heights
    axes.plot(1e3 * profile.spacing * np.arange(heights.size), heights, lw=0.6)
    axes.set_xlabel("position (mm)")
    axes.set_ylabel("roughness (µm)")
    axes.set_title(trace.name, loc="left")
    return figure
