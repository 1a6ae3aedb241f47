"""Every maker of numbers says of each row how far it is outside the range of its laws."""

import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

import mixedlub as ml
from mixedlub.case.folder import read_case
from mixedlub.case.forward import Forward
from mixedlub.case.validity import judge_rows
from mixedlub.chain.ranges import GRADES, Limit, findings, flags
from mixedlub.importers import write_case
from mixedlub.schema.findings import Severity, codes
from mixedlub.study import read_study, run_study
from mixedlub.study.validity import flags_of
from tests.efficiency.gearboxes import STAGE, gearbox
from tests.study.conftest import StudyWriter

EXAMPLE = Path(__file__).parents[2] / "examples" / "case"
ROWS = {
    "run": [1001, 1002, 1003, 1004, 1005],
    "torque_Nm": [100.0, 15_000.0, 100.0, 1e7, 2_000.0],
    "speed_rpm": [1500.0, 1500.0, 100_000.0, 1500.0, 1500.0],
    "oil_temperature_C": [60.0] * 5,
    "pinion_surface": ["polished"] * 5,
    "gear_surface": ["polished"] * 5,
}


@pytest.fixture(scope="module")
def simulated() -> tuple[pd.DataFrame, list[str]]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = ml.simulate(EXAMPLE, at=ROWS)
    return found, [str(one.message) for one in caught]


def test_a_simulation_grades_each_row(simulated: tuple[pd.DataFrame, list[str]]) -> None:
    """16.7 GPa, a pitch line at 380 m/s, 430 GPa, and 4.6 GPa where hard steel is rated to 4.1."""
    words = simulated[0]["validity"].str.split("; ")
    assert [one[0] for one in words] == ["valid", "impossible", "not_quantitative", "impossible", "not_quantitative"]
    assert "pressure_above_yield" in words[1]
    assert "law_extrapolated:dowson_toyoda" in words[2]


def test_a_simulation_warns_of_the_worst_first(simulated: tuple[pd.DataFrame, list[str]]) -> None:
    found, texts = simulated
    assert texts[0].startswith("doubt: ")
    assert "of 5 rows 2 impossible, 1 not quantitative" in texts[0]
    assert found.attrs["findings"][: len(texts)] == texts


@pytest.mark.parametrize(
    ("torque_Nm", "grade"), [(200.0, "valid"), (2_500.0, "not_quantitative"), (30_000.0, "impossible")]
)
def test_an_efficiency_says_how_far_outside(torque_Nm: float, grade: str, tmp_path: Path) -> None:
    """1.4, 5.1 and 17.7 GPa."""
    smooth = {"m0_um2": 1e-6, "m2": 1e-6, "m4_per_um2": 3e-6}
    box = gearbox(tmp_path, STAGE | {"surfaces": {"pinion": smooth, "gear": smooth}})
    found = box.losses(np.array([torque_Nm]), np.array([150.0]))
    assert found.validity[0].split("; ")[0] == grade
    assert all(one.place == "stages.a" for one in found.findings)


def test_churning_that_goes_over_to_another_law_is_remarked_in_its_row(tmp_path: Path) -> None:
    """Oil on the rim has 750 m/s^2 at one speed and 1250 m/s^2 at the root of 5/3 times that."""
    bath = {"law": "changenet_velex", "wheel": "gear", "immersion_mm": 15.0, "oil_volume_l": 3.0}
    smooth = {"m0_um2": 1e-6, "m2": 1e-6, "m4_per_um2": 3e-6}
    box = gearbox(tmp_path, STAGE | {"surfaces": {"pinion": smooth, "gear": smooth}, "churning": {"bath": bath}})
    pair = box.stages[0].pair
    limit = np.sqrt(750.0) * (pair.operating_radius[1] * pair.face_width * pair.normal_module) ** (-1 / 6)
    speeds = limit * pair.gear_ratio * np.array([0.5, 0.99, 1.01, 2.0])
    found = box.losses(np.full(4, 200.0), speeds)
    assert ["churning_law_changes" in words for words in found.validity] == [False, False, True, True]
    assert "churning_law_changes" in codes(found.findings)


def test_a_row_has_its_worst_grade_and_a_code_its_own() -> None:
    pressure = Limit("pressure_above_yield", "hertz_pressure", (0.0, 4e9), "", (0.0, 4e9), (0.0, 5.7e9))
    film = Limit("law_extrapolated:a", "moes_load", (2.0, np.inf), "")
    reached = [(film, np.array([np.nan, 1.5, 0.5])), (pressure, np.array([5e9, 1e9, 6e9]))]
    found = flags(reached, (3,))
    assert {code: grades.tolist() for code, grades in found.items()} == {
        "pressure_above_yield": [2, 0, 3],
        "law_extrapolated:a": [0, 1, 2],
    }
    first, second = findings(reached, (3,))
    assert (first.code, first.severity, second.severity) == ("pressure_above_yield", Severity.DOUBT, Severity.CAUTION)
    assert "here up to 6000 MPa" in first.text
    assert "of at least 2, here down to 0.5" in second.text
    assert len(GRADES) == 4


def test_an_oil_far_from_its_two_viscosities_is_told() -> None:
    case = read_case(EXAMPLE)
    assert case.recordings is not None
    rows = case.recordings.take(np.arange(4))
    rows.columns["oil_temperature_C"][:] = [60.0, 125.0, 145.0, 175.0]
    forward = Forward(case, rows)
    grades = flags(judge_rows(forward).reached, (4,))["viscosity_extrapolated"]
    assert grades.tolist() == [0, 0, 1, 2]


THIN_OIL = {"temperature_C": [40.0, 100.0], "kinematic_viscosity_mm2_s": [2.0, 0.8]}
"""An oil of 0.223 mm2/s at 280 °C and 0.2096 mm2/s at 300 °C, by the formula of ASTM D341 continued."""


@pytest.mark.literature("ASTM D341: from 0.21 mm2/s")
def test_a_study_with_an_oil_below_the_range_of_d341_is_not_quantitative(write_study: StudyWriter) -> None:
    oil = {f"lubricant__{name}": value for name, value in THIN_OIL.items()}
    hot = {"conditions__oil_temperature_C": [60.0, 280.0, 300.0]}
    found = run_study(read_study(write_study(**oil, **hot)))
    assert flags_of(found.study.plan, found.values)["viscosity_below_d341"][0, :, 0, 0].tolist() == [0, 0, 2]


def test_a_recording_of_an_oil_below_the_range_of_d341_is_not_quantitative(tmp_path: Path) -> None:
    system = {"kind": "viscosity", "lubricant": THIN_OIL, "recording": {"quantity": "viscosity_mPa_s"}}
    rows = {"temperature_C": np.array([60.0, 280.0, 300.0]), "viscosity_mPa_s": np.array([1.2, 0.15, 0.14])}
    case = read_case(write_case(tmp_path / "oil", system, rows))
    assert case.recordings is not None
    grades = flags(judge_rows(Forward(case, case.recordings)).reached, (3,))["viscosity_below_d341"]
    assert grades.tolist() == [0, 0, 2]


COARSE = {"coarse": {"m0_um2": 0.3, "m2": 0.02, "m4_per_um2": 0.03}}
"""Slopes of 0.14, at which elastic asperities bear about 13 GPa."""
HARDNESS = "asperities_above_hardness"


@pytest.mark.parametrize(
    ("change", "judged"),
    [
        ({}, True),
        ({"options": {"asperities": "greenwood_tripp"}}, True),
        ({"options": {"asperities": "kogut_etsion", "hardness_GPa": 6.0}}, False),
        ({"effects": {"asperity_plasticity": {"hardness": 6e9}}}, False),
    ],
)
def test_elastic_asperities_pressed_beyond_the_hardness_of_steel_are_told(
    change: dict[str, Any], judged: bool, write_study: StudyWriter
) -> None:
    found = run_study(read_study(write_study(surfaces=COARSE, **change)))
    pressure = found["asperity_real_pressure"]
    grades = flags_of(found.study.plan, found.values).get(HARDNESS, np.zeros(pressure.shape, int))
    expected = np.where(pressure > 16e9, 2, np.where(pressure > 8e9, 1, 0)) if judged else 0 * grades
    assert np.array_equal(grades, np.where(found["asperity_load_ratio"] < 0.05, 0, expected))
    assert grades.any() == judged


def test_a_recording_of_rough_flanks_notes_their_real_pressure() -> None:
    case = read_case(EXAMPLE)
    assert case.recordings is not None
    judged = judge_rows(Forward(case, case.recordings))
    (values,) = (values for limit, values in judged.reached if limit.code == HARDNESS)
    assert np.nanmax(values, initial=9e9) > 8e9
    assert all(one.severity == Severity.NOTE for one in judged.findings if one.code == HARDNESS)


def test_a_far_number_and_the_quantity_behind_it_are_in_plain_words() -> None:
    film, pressure = (
        Limit("a", "share_lacking", (0.0, 1.0), "", meaning="one over another"),
        Limit("b", "hertz_pressure", (0.0, 4e9), ""),
    )
    assert film.reach(np.array([2.9e6])) == "one over another 0 to 1, here over 1000"
    assert pressure.reach(np.array([17.4e9])).endswith("dry contact 0 to 4000 MPa, here up to 17400 MPa")
