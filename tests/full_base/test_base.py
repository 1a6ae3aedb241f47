"""Full solutions as the base of cases and studies: what changes, what stays, and what is refused."""

from __future__ import annotations

import inspect
import pickle
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mixedlub.case.folder import case_of
from mixedlub.case.forward import Forward
from mixedlub.case.simulation import simulate
from mixedlub.full_base.emulator import Emulator
from mixedlub.report.laws import laws_used
from mixedlub.schema.findings import collected
from mixedlub.schema.table import Table
from mixedlub.study import read_study, run_study
from profiles.errors import InputError
from tests.study.conftest import study_file

pytestmark = pytest.mark.filterwarnings("ignore:lubricant")
FULL = "full_solution"
SURFACES = {
    "smooth": {"m0_um2": 1e-6, "m2": 1e-6, "m4_per_um2": 1e-6},
    "ground": {"m0_um2": 0.02, "m2": 0.0025, "m4_per_um2": 0.0036},
}
OIL = {"oil": "atf", "eyring_stress_MPa": 5.0}
DISCS: dict[str, Any] = {
    "kind": "disc",
    "contact": {"radius_mm": (20.0, 20.0), "width_mm": 6.0},
    "lubricant": OIL,
    "surfaces": SURFACES,
    "uncertainty": {"viscosity": 0.06, "pressure_viscosity": 0.06, "eyring_stress": 0.15},
    "recording": {"quantity": "friction_coefficient", "noise": {"relative": 0.01}},
}
ROWS = {
    "load_N": [400.0, 1000.0, 2200.0, 1000.0],
    "entrainment_speed_m_s": [2.0, 4.0, 8.0, 2.0],
    "slide_roll_ratio": [0.05, 0.2, 0.6, 0.0],
    "oil_temperature_C": [60.0, 70.0, 90.0, 60.0],
    "surface_1": ["smooth"] * 4,
    "surface_2": ["smooth"] * 4,
    "friction_coefficient": [0.03, 0.03, 0.02, 0.001],
}


def discs(**changes: Any) -> Any:
    """A case of discs with full solutions as its base."""
    return case_of({**DISCS, "base": FULL, **changes}, ROWS)


def test_smooth_discs_have_the_friction_of_the_emulator(cache: Path) -> None:
    case = discs()
    forward = Forward(case, case.recordings)
    state = {name: forward.base_quantity(name) for name in ("film_thickness", "film_ratio", "stress_ratio")}
    plain = Forward(case_of(DISCS, ROWS), case.recordings)
    assert state["film_thickness"] == pytest.approx(state["film_ratio"] * plain.base_quantity("film_thickness"))
    friction, formulas = forward.predict(), plain.predict()
    assert ((friction[:3] > 0.2 * formulas[:3]) & (friction[:3] < 0.95 * formulas[:3])).all()
    assert friction[3] < 1e-6
    assert [one.code for one in forward.notes].count("full_base") == 1
    assert "full thermal, non-Newtonian solutions" in case.base_model


@pytest.mark.parametrize("factor", [1.0 + 1e-5, 1.1])
def test_a_run_near_another_follows_the_slopes_of_the_emulator(cache: Path, factor: float) -> None:
    case = discs()
    forward = Forward(case, case.recordings)
    moved = {"viscosity": factor, "pressure_viscosity": 1.0 / factor, "full_solution.film": factor}
    base, exact = forward.run(), forward.predict(moved)
    near = forward.run(moved, near=base).prediction
    assert near == pytest.approx(exact, rel=1e-9)
    if factor > 1.01:
        assert (near == exact).all()


def test_beside_a_contact_without_a_number_or_a_factor_of_0_the_emulator_is_exact(cache: Path) -> None:
    case = discs()
    forward = Forward(case, case.recordings)
    (law,) = (law for name, law in forward.chain if name == "film_ratio")
    given = [np.broadcast_to(forward.base_quantity(name), (4, 1)) for name in inspect.signature(law).parameters]
    base = law(*given)
    moved = [*given]
    moved[6] = given[6] * np.array([[np.nan], [1.3], [1.3], [1.3]])
    assert law.near(moved, given, base) == pytest.approx(law(*moved), rel=1e-12, nan_ok=True)
    still = [*given[:-1], 0.0]
    assert law.near(given, still, law(*still)) == pytest.approx(base, rel=1e-12)
    assert len(pickle.dumps(law)) < len(pickle.dumps(law.emulator)) + 2000


@pytest.mark.parametrize("shape", [(), (4,), (0,), (1, 4), (2, 2)])
def test_places_may_have_any_shape(emulator: Emulator, shape: tuple[int, ...]) -> None:
    places = np.linspace(-0.5, 0.5, int(np.prod(shape)) * 9).reshape(*shape, 9)
    assert emulator.ratios(emulator.film, places).shape == shape
    assert emulator.slopes(emulator.film, places).shape == (*shape, 9)


def test_calibration_moves_the_oil_of_the_film_and_the_errors_of_the_emulator(cache: Path) -> None:
    case = discs()
    forward = Forward(case, case.recordings)
    names = {c.name for c in forward.calibrations}
    assert {"full_solution.film", "full_solution.stress", "eyring_stress"} <= names
    assert not {name for name in names if name.startswith("film_law")}
    base = forward.predict()[:3]
    softer = forward.predict({"eyring_stress": 0.8})[:3] / base
    assert (softer < 1.0).all()
    assert softer[2] < 0.9
    assert forward.predict({"full_solution.stress": 1.01})[:3] / base == pytest.approx(1.01, rel=1e-6)
    run = forward.run({"eyring_stress": 0.8})
    assert float(run.inputs["entering_stress"]) == pytest.approx(0.8 * float(forward.inputs["entering_stress"]))


def test_effects_that_solutions_contain_are_not_offered(cache: Path) -> None:
    case = discs()
    full, plain = Forward(case, case.recordings), Forward(case_of(DISCS, ROWS), case.recordings)
    gone = {e.id for e in plain.effects()} - {e.id for e in full.effects()}
    assert gone == {"film_heating", "inlet_shear_heating", "film_law", "contact_average"}


def test_the_formulas_are_what_they_were(cache: Path) -> None:
    """No name, no base: chain, inputs and calibration are those of the kind."""
    case, named = case_of(DISCS, ROWS), case_of({**DISCS, "base": "formulas"}, ROWS)
    forward = Forward(case, case.recordings)
    assert forward.chain == case.kind.chain(case.system, case.recordings)
    assert not {name for name in forward.inputs if "ratio_factor" in name}
    assert np.array_equal(forward.predict(), Forward(named, named.recordings).predict())


def test_conditions_beyond_the_range_are_flagged(cache: Path) -> None:
    case = discs()
    fast = {name: values[:2] for name, values in ROWS.items() if name != "friction_coefficient"}
    at = Table({"run": np.array([1, 2]), **{n: np.array(v) for n, v in fast.items()}}, "at")
    at.columns["entrainment_speed_m_s"][:] = [4.0, 80.0]
    with collected():
        found = simulate(case, at)
    assert "full_solution" not in found["validity"][0]
    assert "law_extrapolated:full_solution" in found["validity"][1]


@pytest.fixture
def full_study(tmp_path: Path) -> Callable[..., Path]:
    """Writer of a study with full solutions as its base."""

    def write(**changes: Any) -> Path:
        surfaces = {"ground": SURFACES["ground"], "other": SURFACES["ground"]}
        own = {"lubricant": OIL, "surfaces": surfaces, "options": {"base": FULL}}
        return study_file(tmp_path, **{**own, **changes})

    return write


def test_a_study_runs_in_less_than_a_second_with_a_kept_emulator(cache: Path, full_study: Callable[..., Path]) -> None:
    levels = {
        "torque_Nm": [50, 100, 150],
        "speed_rpm": list(range(500, 3500, 500)),
        "oil_temperature_C": list(range(50, 92, 6)),
    }
    read_study(full_study(conditions=levels))
    start = time.process_time()
    results = run_study(read_study(full_study(conditions=levels)), threads=1)
    assert time.process_time() - start < 1.5
    assert results.study.conditions == 378
    formulas = run_study(read_study(full_study(conditions=levels, options={})), threads=1)
    ratio = results["film_thickness"] / formulas["film_thickness"]
    assert 0.6 < ratio.min() < ratio.max() < 0.95
    assert {"full_base"} <= {one.code for one in results.findings}
    said = {law.gives: law.says for law in laws_used(results.study.plan.model())}
    assert "full thermal, non-Newtonian solutions" in said["film ratio"]


def test_film_and_asperities_share_the_load_with_the_solved_film(cache: Path, full_study: Callable[..., Path]) -> None:
    options = {"base": FULL, "balance": "johnson_greenwood_poon", "mixture": "load_weighted"}
    found = run_study(read_study(full_study(options=options)), threads=1)
    assert float(found["balance_error"].max()) < 1e-8
    assert (found["film_over_unbalanced"] > 1.0).all()


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"options": {"base": FULL, "film": "moes"}}, 'film = "moes": base = "full_solution" has its own'),
        ({"options": {"base": FULL, "friction": "xu_kahraman"}}, "has its own"),
        ({"effects": {"film_heating": {}}}, 'effects.film_heating: is part of base = "full_solution"'),
        ({"lubricant": None}, 'lubricant: base = "full_solution" needs an oil'),
        ({"conditions": {"torque_Nm": [50], "speed_rpm": [500], "oil_temperature_C": [170]}}, "170"),
    ],
)
def test_studies_that_are_refused(
    changes: dict[str, Any], said: str, cache: Path, full_study: Callable[..., Path]
) -> None:
    with pytest.raises(InputError, match=said.replace(".", r"\.")):
        read_study(full_study(**changes))


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"contact": {"geometry": "point", "radius_mm": (20.0, 20.0)}}, "is of line contacts"),
        ({"effects": {"inlet_shear_heating": {}}}, "inlet_shear_heating: is part of base"),
        (
            {"lubricant": {"temperature_C": (40.0, 100.0), "kinematic_viscosity_mm2_s": (34.0, 7.2)}},
            "needs eyring_stress_MPa, pressure_viscosity_per_GPa, density_15C_kg_m3",
        ),
    ],
)
def test_cases_that_are_refused(changes: dict[str, Any], said: str, cache: Path) -> None:
    with pytest.raises(InputError, match=said):
        discs(**changes)


def test_discs_of_two_materials_are_refused(cache: Path) -> None:
    other = {**SURFACES, "ground": SURFACES["ground"] | {"thermal_conductivity_W_mK": 20.0}}
    rows = {**ROWS, "surface_2": ["smooth", "ground", "smooth", "smooth"]}
    case = case_of({**DISCS, "base": FULL, "surfaces": other}, rows)
    with pytest.raises(InputError, match="surfaces of one material; solid_conductivity is"):
        Forward(case, case.recordings)


def test_other_kinds_are_refused() -> None:
    film = {"kind": "film", "base": FULL, "recording": {"quantity": "film_thickness_nm"}}
    film |= {"contact": {"geometry": "point", "radius_mm": (10.0, 1e9)}, "lubricant": {"oil": "atf"}}
    rows = {"load_N": [20.0], "entrainment_speed_m_s": [1.0], "slide_roll_ratio": [0.0], "oil_temperature_C": [40.0]}
    with pytest.raises(InputError, match="is a base of the kinds gear_pair, mesh_friction, disc, not of film"):
        case_of(film, {**rows, "film_thickness_nm": [100.0]})
