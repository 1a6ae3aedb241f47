"""Columns in another unit than their name says, or in two of them: doubted by the column that is off."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mixedlub.case.folder import read_case
from mixedlub.case.forward import Forward
from mixedlub.case.validity import judge_rows
from mixedlub.data_checks.audit import check_readings
from mixedlub.data_checks.mixed_units import of_two_units
from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.importers import write_case
from mixedlub.schema.findings import Finding, Severity, codes, of_severity
from mixedlub.schema.table import Table

BALL = {"geometry": "point", "radius_mm": [9.525, float("inf")], "youngs_modulus_GPa": [207.0, 75.0]}
OIL = {"temperature_C": [40.0, 100.0], "kinematic_viscosity_mm2_s": [30.0, 6.2]}
EXAMPLE = Path(__file__).parents[2] / "examples" / "case"
SPEED = np.tile(np.geomspace(0.05, 2.0, 10), 4)
SCATTER = 1.0 + 0.01 * np.random.default_rng(0).standard_normal(40)
HALF, EVEN = np.arange(40) < 20, np.arange(40) % 2 == 0


def told(folder: Path, system: dict[str, Any], columns: dict[str, Any], quantity: str) -> list[Finding]:
    """The doubts about a recording."""
    case = read_case(write_case(folder / "case", {**system, "recording": {"quantity": quantity}}, columns))
    assert case.recordings is not None
    y = np.asarray(case.recordings[quantity], dtype=float)
    found = check_readings(case, case.recordings, y, Forward(case, case.recordings))
    return list(of_severity(found, Severity.DOUBT))


def film(folder: Path, oil: dict[str, Any] | None = None, **times: Any) -> list[Finding]:
    """Films of a sound rig, each column times a factor."""
    columns = {
        "load_N": np.repeat([10.0, 20.0, 10.0, 20.0], 10),
        "entrainment_speed_m_s": SPEED,
        "slide_roll_ratio": 0.0 * SPEED,
        "oil_temperature_C": 40.0 + 0.0 * SPEED,
        "film_thickness_nm": 200.0 * SPEED**0.67 * SCATTER,
    }
    columns = {name: values * times.get(name, 1.0) for name, values in columns.items()}
    system = {"kind": "film", "contact": {**BALL, "poisson_ratio": [0.3, 0.22]}}
    return told(folder, {**system, "lubricant": oil} if oil else system, columns, "film_thickness_nm")


def oil(folder: Path, factor: Any, celsius: np.ndarray | None = None, **columns: Any) -> list[Finding]:
    celsius = np.tile(np.linspace(20.0, 90.0, 8), 5) if celsius is None else celsius
    viscosity = 200.0 * np.exp(-0.035 * (celsius - 20.0)) * SCATTER * factor
    columns = {"temperature_C": celsius, "viscosity_mPa_s": viscosity, **columns}
    return told(folder, {"kind": "viscosity"}, columns, "viscosity_mPa_s")


@pytest.mark.parametrize("known", [None, OIL])
def test_a_sound_recording_is_not_doubted(tmp_path: Path, known: dict[str, Any] | None) -> None:
    assert film(tmp_path / "film", known) == []
    assert oil(tmp_path / "oil", 1.0) == []


def test_readings_that_are_all_as_far_from_the_model_are_in_one_unit(offset: Diagnosis) -> None:
    """Nothing parts them, as every ratio is the same."""
    problem = offset.search.problem
    base = np.asarray(offset.recorded.base)
    assert of_two_units(offset.case, problem.rows, 7.0 * base, base, 5) == []


@pytest.mark.parametrize("which", [HALF, EVEN])
@pytest.mark.parametrize("factor", [10.0, 0.1, 1000.0])
def test_readings_in_two_units_are_doubted(tmp_path: Path, which: np.ndarray, factor: float) -> None:
    for notes in (
        film(tmp_path / "film", film_thickness_nm=np.where(which, factor, 1.0)),
        oil(tmp_path / "oil", np.where(HALF, factor, 1.0)),
    ):
        (note,) = [note for note in notes if note.code == "readings_in_two_units"]
        assert note.text.startswith("20 readings are ")


def test_readings_ten_times_apart_along_a_condition_are_physics(tmp_path: Path) -> None:
    celsius = np.repeat(np.linspace(20.0, 90.0, 8), 5)
    assert oil(tmp_path, np.where(celsius > 50.0, 0.1, 1.0), celsius) == []


@pytest.mark.parametrize("factor", [1000.0, 0.001])
def test_a_condition_in_two_units_is_doubted_rather_than_the_reading(tmp_path: Path, factor: float) -> None:
    notes = film(tmp_path, entrainment_speed_m_s=np.where(HALF, factor, 1.0))
    (note,) = [note for note in notes if "_in_two_units" in note.code]
    assert (note.code, note.place) == ("condition_in_two_units", "entrainment_speed_m_s")
    assert note.text.startswith("20 of 40 values are 1000 times the others")


def test_a_condition_with_other_levels_in_the_other_unit_is_named_beside_the_reading(tmp_path: Path) -> None:
    """Films follow the speeds as meant: half of them at speeds between those of the others, and in mm/s."""
    between = np.where(HALF, 1.2, 1.0)
    notes = film(tmp_path, entrainment_speed_m_s=between * np.where(HALF, 1000.0, 1.0), film_thickness_nm=between**0.67)
    (note,) = [note for note in notes if note.code == "readings_in_two_units"]
    assert "film_thickness_nm and entrainment_speed_m_s" in note.text


def test_levels_that_come_again_tenfold_with_the_films_they_should_have_are_sound(tmp_path: Path) -> None:
    faster = np.where(HALF, 100.0, 1.0)
    assert film(tmp_path, entrainment_speed_m_s=faster, film_thickness_nm=faster**0.67) == []


def test_speeds_in_millimetres_are_doubted_with_the_unit_they_are_in(tmp_path: Path) -> None:
    notes = film(tmp_path, entrainment_speed_m_s=1000.0)
    (note,) = [note for note in notes if note.code == "value_unusual"]
    assert note.place == "the largest entrainment_speed_m_s"
    assert note.text.startswith("2000, where rigs have 1e-05 to 300 m/s: 2000 mm/s would be 2 m/s")


def test_films_in_micrometres_are_doubted(tmp_path: Path) -> None:
    (note,) = [note for note in film(tmp_path, film_thickness_nm=0.001) if note.code == "value_unusual"]
    assert note.place == "the largest film_thickness_nm"
    assert "where rigs have 0.8 to 100000 nm: 0.3" in note.text
    assert " um would be 3" in note.text


def test_a_load_that_no_contact_bears_is_doubted(tmp_path: Path) -> None:
    assert film(tmp_path, load_N=1000.0) == []
    case = read_case(next(tmp_path.glob("**/system.toml")).parent)
    assert case.recordings is not None
    (told,) = [n for n in judge_rows(Forward(case, case.recordings)).findings if n.code == "pressure_above_yield"]
    assert "here up to 5268 MPa" in told.text
    assert told.severity == Severity.DOUBT


def test_an_oil_thicker_than_oils_is_doubted_where_it_is_warm(tmp_path: Path) -> None:
    (note,) = oil(tmp_path / "warm", 1000.0)
    assert (note.code, note.place) == ("value_unusual", "the smallest viscosity_mPa_s")
    assert oil(tmp_path / "cold", 1000.0, np.tile(np.linspace(-40.0, 10.0, 8), 5)) == []
    pressed = oil(tmp_path / "pressed", 1000.0, pressure_MPa=np.full(40, 800.0))
    assert "value_unusual" not in codes(pressed)


def gears(folder: Path, column: str, change: Any) -> list[Finding]:
    """The cautions and doubts about the example's gears, a column changed."""
    case = read_case(EXAMPLE)
    assert case.recordings is not None
    rows = Table({**case.recordings.columns, column: change(case.recordings[column])}, "recordings.csv")
    case = replace(case, recordings=rows)
    forward = Forward(case, rows)
    found = [*check_readings(case, rows, rows[case.quantity], forward), *judge_rows(forward).findings]
    found = [one for one in found if one.code != "asperities_overloaded"]
    return list(of_severity(found, Severity.CAUTION, Severity.DOUBT))


def test_torque_in_newton_millimetres_presses_the_flanks_too_hard() -> None:
    found = gears(EXAMPLE, "torque_Nm", lambda t: 1000.0 * t)
    (note,) = [note for note in found if note.code == "pressure_above_yield"]
    assert "here up to 39780 MPa" in note.text
    assert "pressure_above_yield" not in codes(gears(EXAMPLE, "torque_Nm", lambda t: 2.0 * t))


@pytest.mark.parametrize(
    ("column", "factor", "unit"),
    [("speed_rpm", 30.0 / np.pi, "rad/s"), ("speed_rpm", 60.0, "rev/s")],
)
def test_a_condition_that_puts_all_readings_a_common_factor_off_is_asked_about(
    column: str, factor: float, unit: str
) -> None:
    found = gears(EXAMPLE, column, lambda values: values / factor)
    (note,) = [one for one in found if one.code == "condition_in_other_unit"]
    assert note.place == column
    assert f"in {unit}:" in note.text
    assert "condition_in_other_unit" not in codes(gears(EXAMPLE, column, lambda values: values * 1.5))


def test_temperatures_in_fahrenheit_are_far_from_those_of_the_oil() -> None:
    (note,) = gears(EXAMPLE, "oil_temperature_C", lambda t: 1.8 * t + 32.0)
    assert note.code == "temperature_in_fahrenheit"
    assert "104 to 158 °F would be 40 to 70 °C" in note.text
    (note,) = gears(EXAMPLE, "oil_temperature_C", lambda t: 40.0 + 5.0 * (t - 40.0))
    assert note.code == "viscosity_extrapolated"
    assert not gears(EXAMPLE, "oil_temperature_C", lambda t: t + 20.0)
