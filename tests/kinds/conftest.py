"""Small cases of each kind, and plain least squares on them."""

import importlib.util
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from mixedlub.case.folder import Case, read_case
from mixedlub.case.forward import Forward
from mixedlub.effects import catalogue
from mixedlub.importers import write_case

BALL = {"geometry": "point", "radius_mm": [9.525, float("inf")], "youngs_modulus_GPa": [207.0, 75.0]}
BALL["poisson_ratio"] = [0.3, 0.22]
OIL = {
    "temperature_C": [40.0, 100.0],
    "kinematic_viscosity_mm2_s": [67.0, 18.9],
    "pressure_viscosity_per_GPa": [20.0, 15.0],
    "density_15C_kg_m3": 870.0,
    "density_change_per_K": 7e-4,
    "eyring_stress_MPa": 5.0,
    "thermal_conductivity_W_mK": 0.14,
    "specific_heat_J_kgK": 2000.0,
}
TIME = np.linspace(60.0, 7200.0, 60)

SCRIPT = Path(__file__).resolve().parents[2] / "examples" / "real" / "build.py"


@pytest.fixture(scope="session")
def builder() -> ModuleType:
    """The script that writes the cases of real recordings."""
    spec = importlib.util.spec_from_file_location("real_build", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(SCRIPT.parent)
        spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="session")
def typed_in(builder: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Cases of the typed-in tables."""
    out = tmp_path_factory.mktemp("real")
    builder.build(out)
    return out


@pytest.fixture(scope="session")
def from_files(builder: ModuleType, shared: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Cases of the larger files."""
    out = tmp_path_factory.mktemp("files")
    for make in builder.FROM_FILES:
        for name, system, columns in make(shared / "data" / "recordings"):
            builder.write_case(out / name, system, columns)
    return out


@pytest.fixture
def make(tmp_path: Path) -> Callable[..., Case]:
    """A case from sections and columns."""

    def build(system: Mapping[str, Any], columns: Mapping[str, Any]) -> Case:
        return read_case(write_case(tmp_path / "case", system, columns))

    return build


def system(kind: str, quantity: str, **sections: Any) -> dict[str, Any]:
    """Sections of a case of a kind, with the noise of a good rig."""
    recording = {"quantity": quantity, "noise": {"relative": 0.01}}
    return {"kind": kind, "recording": recording, **sections}


def least_squares(
    case: Case, ids: Sequence[str], sd: np.ndarray, starts: int = 4, held: Mapping[str, float] | None = None
) -> tuple[float, dict[str, Any], np.ndarray]:
    """Smallest chi-square with prior of some effects: its value, their parameters, the prediction."""
    from scipy.optimize import least_squares as solve

    assert case.recordings is not None
    forward = Forward(case, case.recordings)
    y = case.recordings[case.quantity]
    effects = [catalogue()[e].fixing(held or {}) for e in ids]
    sizes = [len(forward.calibrations), *(len(e.parameters) for e in effects)]

    def predicted(z: np.ndarray) -> tuple[np.ndarray, dict[str, Any]]:
        parts = np.split(z, np.cumsum(sizes)[:-1])
        moved = {c.name: c.parameter.prior.value(x) for c, x in zip(forward.calibrations, parts[0], strict=True)}
        values = {e.id: e.values(part) for e, part in zip(effects, parts[1:], strict=True)}
        return forward.predict(moved, values), values

    rng = np.random.default_rng(1)
    tries = [np.zeros(sum(sizes)), *(0.7 * rng.standard_normal((starts - 1, sum(sizes))))]
    found = [
        solve(lambda z: np.concatenate([(y - predicted(z)[0]) / sd, z]), start, bounds=(-5.0, 5.0)) for start in tries
    ]
    best = min(found, key=lambda f: f.cost)
    prediction, values = predicted(best.x)
    return 2.0 * float(best.cost), values, prediction


def noisy(clean: Any, relative: float = 0.01, seed: int = 3) -> np.ndarray:
    """Readings with normal scatter in proportion."""
    return clean * (1.0 + relative * np.random.default_rng(seed).standard_normal(np.size(clean)))


def drive(friction: Any, **columns: Any) -> tuple[dict[str, Any], dict[str, Any]]:
    """Sections and columns of a drive whose friction scatters by a hundredth."""
    return system("friction_map", "friction_torque_Nm"), {"friction_torque_Nm": noisy(friction), **columns}
