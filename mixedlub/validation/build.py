"""From what is written in a case folder to the arrays of a rig, and back."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.validation.involute import ContactPath, Gears, path_of_contact
from mixedlub.validation.rig import Calibration, Oil, Rig, Solid
from profiles.errors import InputError

QUANTITY = {"gear_pair": "power_loss_W", "disc": "friction_coefficient"}
SURFACE_COLUMNS = {"gear_pair": ("pinion_surface", "gear_surface"), "disc": ("surface_1", "surface_2")}
PRIORS = ("boundary_friction", "viscosity", "pressure_viscosity", "eyring_stress", "roughness")


@dataclass(frozen=True)
class Case:
    """A case folder in memory: the settings as written, the columns of its readings, its load-share rows."""

    settings: dict[str, Any]
    columns: dict[str, np.ndarray]
    share: np.ndarray | None = None

    @property
    def kind(self) -> str:
        return str(self.settings["kind"])

    @property
    def nominal(self) -> Calibration:
        return Calibration(boundary_friction=float(self.settings["boundary_friction"]))

    @property
    def priors(self) -> dict[str, float]:
        given = self.settings.get("uncertainty", {})
        return {name: float(given.get(name, 0.0)) for name in PRIORS}


def oil_of(settings: Mapping[str, Any]) -> Oil:
    table = settings["lubricant"]
    return Oil(
        temperature=tuple(table["temperature_C"]),
        kinematic=tuple(1e-6 * v for v in table["kinematic_viscosity_mm2_s"]),
        pressure_viscosity=tuple(1e-9 * v for v in table["pressure_viscosity_per_GPa"]),
        density_15=table["density_15C_kg_m3"],
        expansion=table["density_change_per_K"],
        eyring_stress=1e6 * table["eyring_stress_MPa"],
        conductivity=table["thermal_conductivity_W_mK"],
        specific_heat=table["specific_heat_J_kgK"],
    )


def gears_of(settings: Mapping[str, Any]) -> Gears:
    table = settings["gears"]
    if table.get("helix_angle_deg", 0.0) != 0.0:
        raise InputError(
            "the proof's rigs are spur gears", where="gears.helix_angle_deg", value=table["helix_angle_deg"]
        )
    centre = table.get("centre_distance_mm")
    return Gears(
        teeth=tuple(table["teeth"]),
        module=1e-3 * table["normal_module_mm"],
        pressure_angle=float(np.radians(table["pressure_angle_deg"])),
        tip=tuple(0.5e-3 * d for d in table["tip_diameter_mm"]),
        face_width=1e-3 * table["face_width_mm"],
        shift=tuple(table.get("profile_shift", (0.0, 0.0))),
        centre=None if centre is None else 1e-3 * centre,
    )


def share_at(path: ContactPath, rows: np.ndarray | None, torque: np.ndarray, position: np.ndarray) -> np.ndarray:
    """Load share, readings by points: from rows of (torque, roll angle in degrees, share); None is equal."""
    if rows is None:
        single = (position > path.low_single) & (position < path.high_single)
        return np.broadcast_to(np.where(single, 1.0, 0.5), (len(torque), len(position)))
    angle = np.degrees(position / path.base_radius[0])
    known = np.unique(rows[:, 0])
    curves = np.array([np.interp(angle, *rows[rows[:, 0] == level][:, 1:].T) for level in known])
    nearest = np.argmin(np.abs(torque[:, None] - known[None, :]), axis=1)
    return np.asarray(curves[nearest])


def _moments(case: Case) -> tuple[np.ndarray, np.ndarray]:
    """Composite moments (readings by 3, SI) and whether a reading has a coated surface."""
    first, second = (case.columns[name] for name in SURFACE_COLUMNS[case.kind])
    units = np.array([1e-12, 1.0, 1e12])
    table = {
        name: np.array([s["m0_um2"], s["m2"], s["m4_per_um2"]]) * units for name, s in case.settings["surfaces"].items()
    }
    coated = {name: "coating" in s for name, s in case.settings["surfaces"].items()}
    both = np.array([table[a] + table[b] for a, b in zip(first, second)])
    return both, np.array([float(coated[a]) + float(coated[b]) for a, b in zip(first, second)])


def _solid(table: Mapping[str, Any]) -> Solid:
    return Solid(tuple(1e9 * e for e in table["youngs_modulus_GPa"]), tuple(table["poisson_ratio"]))


def _coating_resistance(settings: Mapping[str, Any]) -> float:
    """Thickness over conductivity of the first coating (m2 K/W)."""
    for surface in settings["surfaces"].values():
        if "coating" in surface:
            layer = surface["coating"]
            return float(1e-6 * layer["thickness_um"] / layer["thermal_conductivity_W_mK"])
    return 0.0


def rig_of(case: Case, points: int = 240, positions: np.ndarray | None = None) -> Rig:
    """The rig a case describes: gears on ``points`` midpoints of the path, or at ``positions`` in m."""
    moments, coated = _moments(case)
    common = {
        "kind": case.kind,
        "oil": oil_of(case.settings),
        "temperature": case.columns["oil_temperature_C"].astype(float),
        "moments": moments,
        "sequence": case.columns.get("sequence", np.zeros(len(moments))).astype(float),
        "conditions": case.columns,
        "coated": coated[:, None],
        "coating_resistance": _coating_resistance(case.settings),
    }
    return _gear(case, common, points, positions) if case.kind == "gear_pair" else _disc(case, common)


def _gear(case: Case, common: dict[str, Any], points: int, positions: np.ndarray | None) -> Rig:
    gears = gears_of(case.settings)
    path = path_of_contact(gears)
    length = (path.end - path.start) / points
    position = path.start + length * (np.arange(points) + 0.5) if positions is None else positions
    torque = case.columns["torque_Nm"].astype(float)
    pinion = case.columns["speed_rpm"].astype(float)[:, None] * np.pi / 30
    wheel = pinion * gears.teeth[0] / gears.teeth[1]
    share = share_at(path, case.share, torque, position)
    ambient = case.settings["recording"].get("ambient_temperature_C", 25.0)
    return Rig(
        solid=_solid(case.settings["gears"]),
        radius=(position * (path.tangent_length - position) / path.tangent_length)[None, :],
        speed_1=pinion * position,
        speed_2=wheel * (path.tangent_length - position),
        share_force=share * torque[:, None] / path.base_radius[0],
        width=gears.face_width,
        step=length / path.base_pitch,
        phase=(position - path.start)[None, :] / path.base_pitch,
        extras={
            "contact_ratio": path.contact_ratio,
            "ambient": ambient,
            "teeth": gears.teeth[0],
            "module": gears.module,
            "pitch_diameter": gears.module * gears.teeth[0],
            "wheel_diameter": gears.module * gears.teeth[1],
            "ratio": gears.teeth[0] / gears.teeth[1],
            "base_radius": path.base_radius[0],
            "centre": float(np.hypot(path.tangent_length, sum(path.base_radius))),
        },
        **common,
    )


def _disc(case: Case, common: dict[str, Any]) -> Rig:
    contact = case.settings["contact"]
    r1, r2 = (1e-3 * r for r in contact["radius_mm"])
    mean = case.columns["entrainment_speed_m_s"].astype(float)[:, None]
    half = 0.5 * case.columns["slide_roll_ratio"].astype(float)[:, None] * mean
    load = case.columns["load_N"].astype(float)[:, None]
    return Rig(
        solid=_solid(contact),
        radius=np.array([[r1 * r2 / (r1 + r2)]]),
        speed_1=mean + half,
        speed_2=mean - half,
        share_force=load,
        width=1e-3 * contact["width_mm"],
        step=1.0,
        **common,
    )


def read_columns(file: Path) -> dict[str, np.ndarray]:
    """Columns of a CSV file by name."""
    import pandas as pd

    frame = pd.read_csv(file)
    return {str(name): frame[name].to_numpy(dtype=object if "surface" in str(name) else None) for name in frame}


def read_case(folder: Path, table: str = "recordings.csv") -> Case:
    """A case folder with the columns of one of its tables."""
    with open(folder / "system.toml", "rb") as stream:
        settings = tomllib.load(stream)
    share = folder / "load_share.csv"
    rows = np.loadtxt(share, delimiter=",", skiprows=1) if share.exists() else None
    return Case(settings, read_columns(folder / table), rows)


def chosen(case: Case, rows: np.ndarray) -> Case:
    """The same case with some of its readings."""
    return Case(case.settings, {name: column[rows] for name, column in case.columns.items()}, case.share)
