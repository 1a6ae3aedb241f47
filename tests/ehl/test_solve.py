"""`ml.ehl.solve` and `mixedlub ehl`: results with a status and an error, and what is refused."""

import sys
from functools import partial

import numpy as np
import pandas as pd
import pytest

import mixedlub as ml
from mixedlub.cli import main
from mixedlub.ehl.levels import solve_levels
from mixedlub.ehl.newton import SHORT
from profiles.errors import InputError

STANDARD = {"radius": 8.69e-3, "line_load": 215e3, "speed": 2.24, "sliding_speed": 0.75, "oil_temperature": 333.15}
GEARS = """schema = "mixedlub-ehl/1"
oil = "oil.toml"
[gears]
teeth = [16, 24]
normal_module_mm = 4.5
profile_shift = [0.1817, 0.1715]
face_width_mm = 14.0
[path]
torque_Nm = 100
speed_rpm = 1500
oil_temperature_C = 60
points = 9
"""


@pytest.fixture
def oil():
    return ml.ehl.example_oil()


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "ehl", "--out", "."]) == 0
    return tmp_path


def test_arrays_become_contacts_each_with_status_and_error(oil):
    found = ml.ehl.solve(oil, **STANDARD | {"line_load": [50e3, 100e3, 215e3], "thermal": False})
    assert list(found["status"].values) == ["converged"] * 3
    assert np.all(np.diff(found["central_film"]) < 0.0)
    assert np.all((found["central_film_error"] > 0.0) & (found["central_film_error"] < 0.01))
    assert found["central_film"].attrs["units"] == "m"


def test_the_error_is_that_of_a_finer_grid(oil, monkeypatch):
    coarse = ml.ehl.solve(oil, **STANDARD)
    module, nodes = sys.modules["mixedlub.ehl.solve"], (61, 121, 241, 481)
    monkeypatch.setattr(module, "solve_levels", partial(solve_levels, nodes=nodes))
    fine = ml.ehl.solve(oil, **STANDARD)
    off = abs(float(coarse["central_film"][0] / fine["central_film"][0]) - 1.0)
    assert 0.5 * off < float(coarse["central_film_error"][0]) < 2.0 * off


def test_a_contact_without_a_solution_has_no_numbers(oil, monkeypatch):
    monkeypatch.setattr("mixedlub.ehl.newton.HOT_PRESSURE_TOLERANCE", 0.0)
    monkeypatch.setattr("mixedlub.ehl.again.PATIENT", SHORT)
    found = ml.ehl.solve(oil, **STANDARD)
    assert found["status"].values[0] == "no solution"
    assert all(np.all(np.isnan(found[name])) for name in ("central_film", "friction_coefficient_error", "pressure"))


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"line_load": [1e5, 0.0]}, "contact 2: line_load: 0.0: must be above zero"),
        ({"radius": -1.0}, "contact 1: radius: -1.0"),
        ({"speed": 0.0}, "speed: 0.0: must be above zero"),
        ({"inlet": 1e-4}, "the oil starts inside the contact"),
        ({"sliding_speed": 4.48}, "slide less"),
        ({"oil_temperature": 250.0}, "250.0: must be from 293.15 to 423.15 K"),
        ({"bulk_temperature": (333.0, 500.0)}, "second surface: bulk_temperature: 500.0"),
        ({"line_load": 5e6}, "must be up to 2 GPa"),
        ({"line_load": np.nan}, "line_load: nan"),
        ({"speed": np.inf}, "speed: inf"),
    ],
)
def test_bad_input_is_refused_by_its_number(oil, change, said):
    with pytest.raises(InputError) as error:
        ml.ehl.solve(oil, **STANDARD | change)
    assert said in str(error.value)


def test_the_command_writes_tables_and_figures(folder):
    assert main(["ehl", "contacts.toml", "--out", "found"]) == 0
    table, profiles = (pd.read_csv(folder / "found" / f"{name}.csv") for name in ("contacts", "profiles"))
    assert list(table["status"]) == ["converged"] * 2
    assert table["central_film_um"].between(0.1, 0.3).all()
    pressed = profiles[profiles["contact"] == 2]
    load = np.trapezoid(pressed["pressure_GPa"], pressed["position_mm"]) * 1e3
    assert load == pytest.approx(215.0, rel=1e-4)
    assert {path.name for path in (folder / "found/figures").iterdir()} >= {"contact_1.svg", "contacts.svg"}


def test_places_along_the_path_of_a_gear_pair(folder):
    (folder / "gear.toml").write_text(GEARS)
    assert main(["ehl", "gear.toml", "--out", "found", "--no-figures"]) == 0
    table = pd.read_csv(folder / "found/contacts.csv")
    assert list(table["status"]) == ["converged"] * len(table)
    assert table["friction_coefficient"].iloc[0] > 0.0 > table["friction_coefficient"].iloc[-1]
    base = 4.5 * 16 / 2 * np.cos(np.radians(20.0))
    alone = table["line_load_N_mm"].max()
    assert alone == pytest.approx(100e3 / base / 14.0, rel=1e-5)
    speeds = table["entrainment_speed_m_s"] * (1.0 - table["slide_roll_ratio"] / 2.0)
    assert speeds.to_numpy() == pytest.approx(1500 * np.pi / 30 * table["position_mm"] * 1e-3, rel=1e-4)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("radius_mm = 8.69", "radius_mm = [1, 2, 3]", "give one, or one for each"),
        ("line_load_N_mm = [100.0, 215.0]", "", "needs either line_load_N_mm or hertz_pressure_GPa"),
        ('oil = "oil.toml"', 'oil = "oill.toml"', "oil.toml"),
        ("slide_roll_ratio = 0.34", "slide_roll_ratio = 2", "slide less"),
        ("# thermal = true", "thermal = 1.5", "thermal"),
        ("[contacts]", "[contact]", "nearest known"),
        ("[contacts]", "[bodies]\npoisson_ratio = [1.0, 0.3]\n[contacts]", "1.0: must be at most 0.5"),
    ],
)
def test_a_file_that_is_wrong_is_refused(folder, capsys, old, new, said):
    path = folder / "contacts.toml"
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    assert main(["ehl", "contacts.toml", "--out", "found"]) == 2
    shown = capsys.readouterr().err
    assert said in shown
    assert "Traceback" not in shown
    assert not (folder / "found" / "contacts.csv").exists()
