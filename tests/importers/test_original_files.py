"""Files as instruments wrote them against their tidy tables."""

import csv

import numpy as np
import pytest

from mixedlub.case.folder import read_case
from mixedlub.importers import import_files
from mixedlub.schema.findings import FindingWarning

BALL = {"radius_mm": [9.525, float("inf")], "youngs_modulus_GPa": [207.0, 75.0], "poisson_ratio": [0.3, 0.22]}


@pytest.fixture
def recordings(shared):
    return shared / "data" / "recordings"


def tidy(path, *names):
    with path.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return [np.array([float(row[n]) for row in rows]) for n in names]


SDS = {"import.columns.film_thickness_nm_sd": "Standard Deviation (nm)"}


@pytest.mark.parametrize(("oil", "told"), [("oil_a_40C_100C", {}), ("oil_b_100C", SDS)])
def test_film_rig(recordings, tmp_path, oil, told):
    folder = recordings / "ehd_film_two_oils_40C_100C"
    out = import_files([folder / f"{oil}_original.txt"], tmp_path / "case", contact=BALL, **told)
    table = read_case(out).recordings
    speed, film, load = tidy(folder / f"{oil}.csv", "rolling_speed_mm_s", "film_thickness_nm", "ball_load_N")
    assert np.allclose(table["entrainment_speed_m_s"], speed * 1e-3, rtol=1e-6)
    assert np.array_equal(table["film_thickness_nm"], film)
    assert np.array_equal(table["load_N"], load)


def test_traction_rig_in_timed_steps_asks_for_the_probe(recordings, tmp_path):
    folder = recordings / "mtm_tribofilm_growth_120C"
    answers = {"import.temperature": "pot"}
    table = read_case(import_files([folder / "original_mtm_output.txt"], tmp_path / "case", **answers)).recordings
    friction, pot = tidy(folder / "friction_1Hz.csv", "friction_coefficient", "pot_temp_degC")
    assert np.array_equal(table["friction_coefficient"], friction)
    assert np.array_equal(table["oil_temperature_C"], pot)
    assert (np.diff(table["time_s"]) > 0).all()


@pytest.mark.long
def test_traction_rig_in_sweeps(recordings, tmp_path):
    folder = recordings / "etm_traction_500_cycles"
    table = read_case(import_files([folder / "original.txt"], tmp_path / "case")).recordings
    friction, slip = tidy(folder / "traction_points.csv", "friction_coefficient", "slide_roll_ratio_percent")
    assert np.array_equal(table["friction_coefficient"], friction)
    assert np.allclose(table["slide_roll_ratio"], slip * 0.01, atol=1e-9)


def test_pin_on_disc(recordings, tmp_path):
    folder = recordings / "mtm_pin_on_disc_ecr_25C"
    table = read_case(import_files([folder / "original.txt"], tmp_path / "case")).recordings
    friction, load = tidy(folder / "friction_ecr_1Hz.csv", "friction_coefficient", "pin_load_N")
    assert np.array_equal(table["friction_coefficient"], friction)
    assert np.array_equal(table["load_N"], load)


def test_rheometer(recordings, tmp_path):
    folder = recordings / "oil_viscosity_temperature_cycle"
    table = read_case(import_files([folder / "original.txt"], tmp_path / "case")).recordings
    viscosity, celsius = tidy(folder / "viscosity_temperature.csv", "viscosity_Pa_s", "temperature_degC")
    assert np.allclose(table["viscosity_mPa_s"], viscosity * 1e3, rtol=1e-6)
    assert np.array_equal(table["temperature_C"], celsius)
    assert (np.diff(table["time_s"]) > 0).all()


def test_plain_table_with_units_as_suffixes(recordings, tmp_path):
    path = recordings / "ehd_film_31C_50N" / "film_vs_speed.csv"
    contact = {**BALL, "geometry": "point"}
    with pytest.warns(FindingWarning, match="'film_sd_nm' is not taken; if it is film_thickness_nm_sd"):
        folder = import_files([path], tmp_path / "case", kind="film", contact=contact)
    table = read_case(folder).recordings
    speed, slip = tidy(path, "rolling_speed_mm_s", "slide_roll_ratio_percent")
    assert np.allclose(table["entrainment_speed_m_s"], speed * 1e-3, rtol=1e-6)
    assert np.allclose(table["slide_roll_ratio"], slip * 0.01, rtol=1e-6)
