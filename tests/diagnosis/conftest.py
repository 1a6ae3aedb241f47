"""Small rigs whose recordings are the base model's values, changed by hand."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from pathlib import Path

import numpy as np
import pytest

from mixedlub.case.folder import read_case, read_conditions
from mixedlub.case.forward import Forward
from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case
from mixedlub.diagnosis.report.files import files
from mixedlub.effects import catalogue

OIL = """
[lubricant]
temperature_C = [40.0, 100.0]
kinematic_viscosity_mm2_s = [30.0, 6.2]
pressure_viscosity_per_GPa = [18.0, 14.0]
density_15C_kg_m3 = 850.0
density_change_per_K = 7e-4
eyring_stress_MPa = 5.0
thermal_conductivity_W_mK = 0.14
specific_heat_J_kgK = 2000.0
[surfaces.ground]
m0_um2 = 0.137
m2 = 0.0031
m4_per_um2 = 0.0021
[surfaces.polished]
m0_um2 = 0.0025
m2 = 0.00045
m4_per_um2 = 0.00045
[uncertainty]
boundary_friction = 0.012
viscosity = 0.06
pressure_viscosity = 0.06
eyring_stress = 0.15
roughness = 0.04
"""
GEARS = """
[gears]
teeth = [17, 26]
normal_module_mm = 4.2333333
pressure_angle_deg = 22.5
tip_diameter_mm = [80.5, 118.4]
face_width_mm = 14.0
youngs_modulus_GPa = [206.0, 206.0]
poisson_ratio = [0.3, 0.3]
load_sharing = { model = "rigid" }
"""
DISCS = """
[contact]
geometry = "line"
radius_mm = [20.0, 25.4]
width_mm = 6.0
youngs_modulus_GPa = [206.0, 206.0]
poisson_ratio = [0.3, 0.3]
"""
HEAD = 'schema = "mixedlub-case/1"\nkind = "{kind}"\nboundary_friction = 0.1\n'
RECORDING = '[recording]\nquantity = "{quantity}"\nnoise = {{ relative = {relative}, absolute = {absolute} }}\n'

RIGS = {
    "gear_pair": (GEARS, "power_loss_W", 0.01, 0.3),
    "mesh_friction": (GEARS, "friction_coefficient", 0.02, 0.0003),
    "disc": (DISCS, "friction_coefficient", 0.02, 0.0002),
    "viscosity": ("", "viscosity_mPa_s", 0.02, 0.0),
}
GRIDS = {
    "gear_pair": {
        "torque_Nm": (50.0, 100.0, 150.0),
        "speed_rpm": (500.0, 1000.0, 1500.0, 2000.0, 2500.0),
        "oil_temperature_C": (60.0, 90.0),
        "pinion_surface": ("ground", "polished"),
        "gear_surface": ("ground",),
    },
    "mesh_friction": {
        "torque_Nm": (100.0,),
        "speed_rpm": (1000.0, 2000.0),
        "oil_temperature_C": (60.0, 90.0),
        "pinion_surface": ("ground",),
        "gear_surface": ("ground",),
        "roll_angle_deg": (16.0, 18.0, 20.0, 23.0, 25.0, 27.0, 29.0),
    },
    "disc": {
        "load_N": (1500.0, 6000.0),
        "entrainment_speed_m_s": (1.0, 3.0, 9.0),
        "slide_roll_ratio": (0.03, 0.1, 0.3),
        "oil_temperature_C": (40.0, 80.0),
        "surface_1": ("ground", "polished"),
        "surface_2": ("polished",),
    },
    "viscosity": {
        "temperature_C": (30.0, 50.0, 70.0, 90.0),
        "pressure_MPa": (0.1, 100.0, 200.0, 300.0, 400.0, 500.0),
    },
}
CANDIDATES = ("inlet_shear_heating", "churning", "sensor_offset", "sensor_gain")
"""Effects left in, to keep the tests short."""

Change = Callable[[dict[str, np.ndarray], np.ndarray], np.ndarray]


def unchanged(conditions: dict[str, np.ndarray], base: np.ndarray) -> np.ndarray:
    """Nothing is missing."""
    return base


def write_case(folder: Path, kind: str, change: Change = unchanged, outliers: tuple[int, ...] = ()) -> Path:
    """A case folder whose readings are the base model's, changed by hand, with noise and outliers (run numbers)."""
    section, quantity, relative, absolute = RIGS[kind]
    folder.mkdir(parents=True, exist_ok=True)
    system = HEAD.format(kind=kind) + section + OIL
    system += RECORDING.format(quantity=quantity, relative=relative, absolute=absolute)
    (folder / "system.toml").write_text(system, encoding="utf-8")
    grid = GRIDS[kind]
    rows = list(product(*grid.values()))
    names = ["run", "sequence", *grid]
    lines = [[i + 1, i / (len(rows) - 1), *row] for i, row in enumerate(rows)]
    conditions = folder / "conditions.csv"
    conditions.write_text(_csv(names, lines), encoding="utf-8")
    case = read_case(folder, need_recordings=False)
    table = read_conditions(case, conditions)
    conditions.unlink()
    value = change({n: table[n] for n in names}, Forward(case, table).predict())
    rng = np.random.default_rng(1)
    sd = np.hypot(relative * value, absolute)
    value = value + sd * rng.standard_normal(value.size)
    value[[run - 1 for run in outliers]] += 25.0 * sd[[run - 1 for run in outliers]]
    recorded = [[*line, f"{v:.8g}"] for line, v in zip(lines, value, strict=True)]
    (folder / "recordings.csv").write_text(_csv([*names, quantity], recorded), encoding="utf-8")
    return folder


def _csv(names: list[str], rows: list[list[object]]) -> str:
    return "\n".join(",".join(str(cell) for cell in row) for row in [names, *rows]) + "\n"


def left_out() -> tuple[str, ...]:
    """Ids of the effects that the tests leave out."""
    return tuple(name for name in catalogue() if name not in CANDIDATES)


@pytest.fixture(scope="session")
def excluded() -> tuple[str, ...]:
    """Ids of the effects that the tests leave out."""
    return left_out()


@pytest.fixture(scope="session")
def make_case() -> Callable[..., Path]:
    """Writes a case folder."""
    return write_case


@pytest.fixture(scope="session")
def complete(tmp_path_factory: pytest.TempPathFactory) -> Diagnosis:
    """A disc rig of which nothing is missing, with one outlier at run 20."""
    return diagnose_case(write_case(tmp_path_factory.mktemp("complete"), "disc", outliers=(20,)), exclude=left_out())


@pytest.fixture(scope="session")
def offset_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A gear rig whose wattmeter reads 9 W too much, with outliers at runs 7 and 31."""
    folder = tmp_path_factory.mktemp("offset")
    return write_case(folder, "gear_pair", lambda conditions, base: base + 9.0, outliers=(7, 31))


@pytest.fixture(scope="session")
def offset(offset_folder: Path) -> Diagnosis:
    """The answer to the offset rig."""
    return diagnose_case(offset_folder, exclude=left_out())


@pytest.fixture(scope="session")
def unnamed(tmp_path_factory: pytest.TempPathFactory) -> Diagnosis:
    """A gear rig that loses a quarter less in the middle of its speeds: no law of the catalogue does that."""

    def change(conditions: dict[str, np.ndarray], base: np.ndarray) -> np.ndarray:
        return base * (1.0 - 0.25 * np.exp(-(((conditions["speed_rpm"] - 1500.0) / 400.0) ** 2)))

    return diagnose_case(write_case(tmp_path_factory.mktemp("unnamed"), "gear_pair", change), exclude=left_out())


def _bumped(folder: Path, name: str, degrees: float) -> Diagnosis:
    """Diagnosis of tooth friction over roll angle, up to 30 % too high about a place."""

    def change(conditions: dict[str, np.ndarray], base: np.ndarray) -> np.ndarray:
        return base * (1.0 + 0.3 * np.exp(-(((conditions["roll_angle_deg"] - degrees) / 2.0) ** 2)))

    return diagnose_case(write_case(folder / name, "mesh_friction", change), exclude=left_out())


@pytest.fixture(scope="session")
def teeth(tmp_path_factory: pytest.TempPathFactory) -> Diagnosis:
    """A bump near the pitch point: sliding over rolling describes it."""
    return _bumped(tmp_path_factory.mktemp("bumped"), "teeth", 23.0)


@pytest.fixture(scope="session")
def lawless_teeth(tmp_path_factory: pytest.TempPathFactory) -> Diagnosis:
    """A bump beside the pitch point, which no law describes."""
    return _bumped(tmp_path_factory.mktemp("bumped"), "beside", 20.0)


@pytest.fixture(scope="session")
def thickening(tmp_path_factory: pytest.TempPathFactory) -> Diagnosis:
    """A viscometer whose oil is a quarter thinner at the highest pressures than exponential growth says."""

    def change(conditions: dict[str, np.ndarray], base: np.ndarray) -> np.ndarray:
        return base * np.exp(-0.3 * (conditions["pressure_MPa"] / 500.0) ** 2)

    return diagnose_case(
        write_case(tmp_path_factory.mktemp("thickening"), "viscosity", change), exclude=("sensor_offset",)
    )


@pytest.fixture(scope="session")
def offset_files(offset: Diagnosis) -> dict[str, str]:
    """Everything written for the offset rig."""
    return files(offset)


@pytest.fixture(scope="session")
def unnamed_files(unnamed: Diagnosis) -> dict[str, str]:
    """Everything written for the rig with a mismatch that has no name."""
    return files(unnamed)
