"""A bevel or hypoid pair made ready from its file."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from mixedlub import friction
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig.build import check_bandwidth
from mixedlub.rig.rig import Rig
from mixedlub.schema.findings import Finding, collected, finding, report
from mixedlub.schema.system_file import RigFile
from mixedlub.schema.toml_file import parse, read_toml
from mixedlub.skew_gears.blank import Blank, blank
from mixedlub.skew_gears.contact_lines import ContactLines, contact_lines
from mixedlub.skew_gears.file import BevelFile, altered
from mixedlub.skew_gears.losses import Losses, Mesh
from mixedlub.skew_gears.pitch_cones import Basic, NoPitchConesError, largest_offset
from mixedlub.study.friction_options import check_coefficients, check_oil, check_viscosity
from mixedlub.study.inputs import surface_inputs
from mixedlub.study.schema import Options
from profiles.errors import InputError

UNREAD = (
    *("base", "balance", "bands", "conditions_of", "averaging", "film_roughness", "heights"),
    *("flattening", "short_cutoff_over_half_width"),
    *("bulk_temperature_rise_K", "path_points", "face_slices"),
)
"""Options of a study without use here."""
RPM = math.pi / 30.0


@dataclass(frozen=True, eq=False)
class Pair:
    """A pair of a file, with its blank and mesh."""

    file: BevelFile
    blank: Blank
    mesh: Mesh

    def map(self) -> Losses:
        """Losses at every torque, speed and oil temperature, torque slowest."""
        levels = self.file.conditions
        grid = np.meshgrid(levels.torque_Nm, levels.speed_rpm, levels.oil_temperature_C, indexing="ij")
        torque, speed, temperature = (axis.ravel() for axis in grid)
        return self.mesh.losses(torque, speed * RPM, temperature + ZERO_CELSIUS)

    def at_largest(self) -> Losses:
        """Losses at the largest torque and speed and the last oil temperature."""
        levels = self.file.conditions
        torque, speed = (np.array([max(values)]) for values in (levels.torque_Nm, levels.speed_rpm))
        return self.mesh.losses(torque, speed * RPM, np.array([levels.oil_temperature_C[-1] + ZERO_CELSIUS]))

    def points_at_largest(self) -> dict[str, np.ndarray]:
        """State of every contact point at that condition."""
        levels = self.file.conditions
        temperature = levels.oil_temperature_C[-1] + ZERO_CELSIUS
        return self.mesh.points(max(levels.torque_Nm), max(levels.speed_rpm) * RPM, temperature)

    def varied(self) -> Iterator[tuple[str, float, Blank | None, Losses | None, str]]:
        """Number, value, blank, losses, and reason why there are none, of every value of [vary]."""
        for name, values in (self.file.vary.model_dump() if self.file.vary else {}).items():
            for value in values or ():
                try:
                    own = self._with(name, value)
                    yield name, value, own.blank, own.at_largest(), ""
                except InputError as error:
                    yield name, value, None, None, error.rule

    def _with(self, name: str, value: float) -> Pair:
        if name == "roughness_factor":
            if value <= 0.0:
                raise InputError("a roughness factor is above 0", where="vary.roughness_factor", value=value)
            rough = {key: self.mesh.surfaces[key] * value**2 for key in ("m0", "m2", "m4")}
            return replace(self, mesh=replace(self.mesh, surfaces={**self.mesh.surfaces, **rough}))
        if name == "offset_mm" and value > 0.0 and self.file.gears.method == 0:
            raise InputError("method 0 is of gears without offset", where="vary.offset_mm", value=value)
        own = _blank(altered(self.blank.basic, name, value), self.file, "vary." + name)
        return replace(self, blank=own, mesh=replace(self.mesh, lines=_lines(own, self.file)))


def read_pair(path: Path) -> tuple[Pair, tuple[Finding, ...]]:
    """Pair of a file, checked, and findings for its user."""
    file = parse(BevelFile, read_toml(path), str(path))
    try:
        with collected() as findings:
            pair = _pair(path, file)
    except InputError as error:
        raise InputError(error.rule, where=f"{path}: {error.where}".rstrip(": "), value=error.value) from None
    return pair, tuple(findings)


def _pair(path: Path, file: BevelFile) -> Pair:
    for option in UNREAD:
        if getattr(file.options, option) != getattr(Options(), option):
            rule = "has no meaning for bevel gears; leave it out"
            raise InputError(rule, where=f"options.{option}", value=getattr(file.options, option))
    check_coefficients(file.options)
    sides = {"pinion": file.surfaces.pinion, "gear": file.surfaces.gear}
    given = {"lubricant": file.lubricant, "surfaces": sides, "boundary_friction": file.boundary_friction}
    rig = Rig(parse(RigFile, given, str(path)), path.parent.resolve())
    oil = rig.oil()
    if oil.traction is not None:
        text = f"bevel gears do not read the traction part of the oil; Eyring stress {oil.eyring_stress * 1e-6:g} MPa"
        report(finding("traction_unread", text, "lubricant"))
    check_oil(friction.find(file.options.friction), file.options.friction_coefficients, oil)
    check_viscosity(file.options, oil)
    surfaces = [rig.surface(name) for name in sides]
    for one in surfaces:
        check_bandwidth(one, rig.file.surfaces[one.name])
    inputs = surface_inputs([(surfaces[0], surfaces[1])])
    own = _blank(file.gears.basic, file, "gears")
    (e1, e2), (n1, n2) = file.gears.youngs_modulus_GPa, file.gears.poisson_ratio
    mesh = Mesh(
        lines=_lines(own, file),
        options=file.options,
        oil=oil,
        surfaces={name: float(np.ravel(value)[0]) for name, value in inputs.items()},
        boundary_friction=file.boundary_friction,
        reduced_modulus=2e9 / ((1.0 - n1**2) / e1 + (1.0 - n2**2) / e2),
        pinion_drives=file.driving == "pinion",
    )
    return Pair(file, own, mesh)


def _lines(own: Blank, file: BevelFile) -> ContactLines:
    return contact_lines(
        own, drive=file.flank == "drive", crowning=file.gears.crowning, face_share=file.gears.face_share
    )


def _blank(basic: Basic, file: BevelFile, where: str) -> Blank:
    """Blank of basic data; raise an error for data without pitch cones, with the largest offset that has some."""
    try:
        return blank(basic, file.gears.tooth_data)
    except NoPitchConesError as error:
        offset = basic.offset * 1e3
        if offset == 0.0:
            raise InputError(f"there are no pitch cones: {error}", where=where) from None
        most = largest_offset(basic) * 1e3
        rule = f"there are no pitch cones with this offset: {error}"
        rule += f"; the largest that has them is {most:.4g} mm" if most > 0.0 else "; nor was a smaller one found"
        raise InputError(rule, where=where if where.endswith("_mm") else "gears.offset_mm", value=offset) from None
    except ValueError:
        raise InputError("the numbers give no blank; look for one far out of range", where=where) from None
