"""Thermal balance of a gearbox: heat in equals heat out, closed forms, the same losses by another way, bad input."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from scipy.optimize import brentq

import mixedlub as ml
from mixedlub.cli import main
from mixedlub.efficiency import PLANETARY_EXAMPLE, Gearbox, read_gearbox
from mixedlub.efficiency.heat_paths import HeatPaths
from mixedlub.efficiency.thermal import ThermalModel
from mixedlub.efficiency.thermal_cycle import HOUR, cycle
from mixedlub.efficiency.thermal_file import Thermal
from mixedlub.efficiency.thermal_table import TABLES, thermal_lines, thermal_tables
from mixedlub.schema.toml_file import parse
from profiles.errors import InputError
from tests.efficiency.gearboxes import PARTS, STAGE, gearbox, written

HOUSING = {"area_m2": 0.3, "coefficient_W_m2K": 12.0, "emissivity": 0.85, "oil_side_W_m2K": 200.0}
THERMAL: dict[str, Any] = {"ambient_temperature_C": 25.0, "housing": HOUSING, "foundation_W_K": 1.5}
FIXED: dict[str, Any] = {
    **STAGE,
    "effects": {},
    "options": {"friction": "constant", "friction_coefficients": {"friction": 0.05}},
}
"""A stage whose loss does not depend on temperature."""
DUTY = {"torque_Nm": [100.0, 0.0], "speed_rpm": [1500.0, 1500.0], "duration_h": [0.5, 1.0]}
LEVELS = {"torque_Nm": [0.0, 100.0, 200.0], "speed_rpm": [500.0, 1500.0]}


def model(folder: Path, *stages: dict[str, Any], **tables: Any) -> ThermalModel:
    return ThermalModel(gearbox(folder, *stages, **{"conditions": LEVELS, **tables}))


def test_heat_in_is_heat_out_and_the_losses_are_those_of_that_oil_temperature(tmp_path: Path) -> None:
    balance = model(tmp_path, STAGE | PARTS, thermal=THERMAL).at_map()
    assert balance.found.all()
    loss = balance.losses.total()
    assert np.abs(sum(balance.heat.values()) / loss - 1.0).max() < 1e-6
    assert np.all(np.diff(balance.sump.reshape(3, 2), axis=1) > 0.0)
    hottest = int(np.argmax(balance.sump))
    warm = {**STAGE, **PARTS, "oil_temperature_C": float(balance.sump[hottest] - 273.15)}
    again: Gearbox = gearbox(tmp_path, warm, conditions=LEVELS)
    assert again.map().total()[hottest] == pytest.approx(loss[hottest], rel=1e-9)


def test_constant_loss_and_conductance_give_the_closed_form(tmp_path: Path) -> None:
    """T = T_a + P/(k A + G), the form of ISO/TR 14179-1."""
    thermal = {"housing": {"area_m2": 0.4, "coefficient_W_m2K": 15.0}, "foundation_W_K": 2.0}
    found = model(tmp_path, FIXED, thermal=thermal)
    balance = found.at_map()
    loss = found.gearbox.map().total()
    assert balance.sump - 273.15 == pytest.approx(20.0 + loss / 8.0, rel=1e-6)


def test_wall_passes_the_same_heat_on_both_sides() -> None:
    section = parse(Thermal, THERMAL, "x")
    paths, sump = HeatPaths(section, None), np.array([350.0, 400.0])  # type: ignore[arg-type]
    for kelvin, wall in zip(sump, paths.wall(sump), strict=True):

        def left(t: float, oil: float = kelvin) -> float:
            return 200.0 * (oil - t) - 12.0 * (t - 298.15) - 0.85 * 5.670374419e-8 * (t**4 - 298.15**4)

        assert wall == pytest.approx(brentq(left, 298.15, kelvin, xtol=1e-10), abs=1e-7)
    heat = paths.heat(sump)
    through = 0.3 * 200.0 * (sump - paths.wall(sump))
    assert heat["housing_convection"] + heat["housing_radiation"] == pytest.approx(through, rel=1e-10)


def test_oil_flow_and_cooler_carry_what_their_numbers_say(tmp_path: Path) -> None:
    thermal = {
        "cooler": {"conductance_W_K": 30.0, "coolant_temperature_C": 15.0},
        "oil_flow": {"flow_l_min": 3.0, "return_temperature_C": 50.0},
    }
    found = model(tmp_path, FIXED, thermal=thermal)
    balance = found.at_map()
    mass = 3.0 / 60e3 * float(found.paths.oil.density(np.array(323.15)))
    rate = mass * found.paths.oil.heat_capacity
    expected = (found.gearbox.map().total() + 30.0 * 15.0 + rate * 50.0) / (30.0 + rate)
    assert balance.sump - 273.15 == pytest.approx(expected, rel=1e-6)


def test_warm_teeth_have_the_loss_of_a_stage_with_that_rise(tmp_path: Path) -> None:
    box = model(tmp_path, STAGE, thermal={**THERMAL, "teeth_W_K": {"a": 20.0}})
    balance = box.balance(np.array([150.0]), np.array([150.0]))
    rise = float(balance.rise["a"][0])
    assert rise > 2.0
    mesh = balance.losses.total(origins=("sliding", "rolling"))[0]
    assert rise == pytest.approx(mesh / 20.0, rel=1e-6)
    stage = {
        **STAGE,
        "oil_temperature_C": float(balance.sump[0] - 273.15),
        "options": {"bulk_temperature_rise_K": rise},
    }
    again = gearbox(tmp_path, stage, conditions=LEVELS)
    assert again.losses(np.array([150.0]), np.array([150.0])).total()[0] == pytest.approx(mesh, rel=1e-6)


def test_planetary_stages_take_part(tmp_path: Path) -> None:
    given = tomllib.loads(Path(str(PLANETARY_EXAMPLE)).read_text(encoding="utf-8"))
    given |= {"conditions": {"torque_Nm": [0.0, 60.0], "speed_rpm": [1000.0, 3000.0]}, "thermal": THERMAL}
    balance = ThermalModel(read_gearbox(written(tmp_path, given))[0]).at_map()
    assert balance.found.all()
    assert np.abs(balance.gap).max() < 1e-6
    assert balance.sump[3] > balance.sump[0] + 10.0


def test_no_balance_is_flagged(tmp_path: Path) -> None:
    weak = {"housing": {"area_m2": 0.01, "coefficient_W_m2K": 5.0}}
    balance = model(tmp_path, STAGE, thermal=weak).at_map()
    assert not balance.found.all()
    assert balance.sump[~balance.found] == pytest.approx(150.0 + 273.15)
    assert "no balance up to 150 °C" in balance.findings[0].text
    tables, _ = thermal_tables(model(tmp_path, STAGE, thermal=weak), balance)
    table = tables["thermal"]
    assert set(table["balance"]) == {"converged", "none up to the highest temperature"}
    empty = table[table["balance"] != "converged"].drop(columns=["torque_Nm", "speed_rpm", "balance"])
    assert set(empty.pop("validity")) == {"thermal_no_balance"}
    assert empty.shape[1] >= 6
    assert empty.isna().all(axis=None)
    assert table[table["balance"] == "converged"]["sump_temperature_C"].max() < 150.0


def test_warming_follows_the_exponential_of_one_heat_capacity(tmp_path: Path) -> None:
    thermal = {"foundation_W_K": 8.0, "heat_capacity_kJ_K": 20.0, "start_temperature_C": 20.0}
    found = model(tmp_path, FIXED, thermal=thermal, duty=DUTY)
    seconds = np.array(DUTY["duration_h"]) * HOUR
    over = cycle(found, np.array(DUTY["torque_Nm"]), np.array(DUTY["speed_rpm"]) * np.pi / 30.0, seconds)
    loss = found.gearbox.losses(np.array([100.0]), np.array([50.0 * np.pi])).total()[0]
    time, first = over.time[over.point == 1], over.sump[over.point == 1]
    assert first - 293.15 == pytest.approx(loss / 8.0 * (1.0 - np.exp(-time * 8.0 / 20e3)), rel=1e-6, abs=1e-6)
    after = (over.end[0] - 293.15) * np.exp(-seconds[1] * 8.0 / 20e3)
    assert over.end[1] - 293.15 == pytest.approx(after, rel=1e-6)
    assert abs(over.gap) < 1e-6
    assert over.lost[0] == pytest.approx(loss * seconds[0], rel=1e-8)


def test_repeated_cycle_closes_and_keeps_no_heat(tmp_path: Path) -> None:
    found = model(tmp_path, STAGE | PARTS, thermal={**THERMAL, "heat_capacity_kJ_K": 40.0}, duty=DUTY)
    tables, notes = thermal_tables(found, found.balance(np.array([100.0]), np.array([157.0])))
    duty = tables["thermal_duty"]
    assert not notes
    assert duty["end_temperature_C"].iloc[-1] == pytest.approx(duty["start_temperature_C"].iloc[0], abs=2e-3)
    assert duty["removed_energy_kWh"].sum() == pytest.approx(duty["loss_energy_kWh"].sum(), rel=1e-4)
    balance = duty["loss_energy_kWh"] - duty["removed_energy_kWh"] - duty["stored_energy_kWh"]
    assert np.abs(balance).max() < 1e-6 * duty["loss_energy_kWh"].sum()


@pytest.mark.parametrize("seconds", [0.1, 1.0, 3600.0])
def test_a_cycle_of_any_length_closes_at_the_steady_temperature(tmp_path: Path, seconds: float) -> None:
    """Half the time at the constant loss P, half without: the closed form of one capacity over two exponentials."""
    thermal = {"foundation_W_K": 8.0, "heat_capacity_kJ_K": 200.0}
    found = model(tmp_path, FIXED, thermal=thermal)
    torque, speed = np.array([100.0, 0.0]), np.full(2, 50.0 * np.pi)
    over = cycle(found, torque, speed, np.full(2, 0.5 * seconds))
    loss = found.gearbox.losses(torque, speed).total()[0]
    kept = np.exp(-0.5 * seconds * 8.0 / 200e3)
    assert over.closed
    assert loss / 8.0 * kept / (1.0 + kept) > 5.0
    assert over.start[0] - 293.15 == pytest.approx(loss / 8.0 * kept / (1.0 + kept), rel=1e-5)


def test_a_cycle_that_closes_nowhere_is_flagged(tmp_path: Path) -> None:
    thermal = {"foundation_W_K": 0.5, "heat_capacity_kJ_K": 200.0}
    found = model(tmp_path, FIXED, thermal=thermal)
    over = cycle(found, np.array([200.0]), np.array([150.0]), np.array([1.0]))
    assert not over.closed
    assert "closes at no start temperature up to 150 °C" in next(over.findings(found)).text


def test_hot_teeth_have_the_balance_of_a_search_by_hand(tmp_path: Path) -> None:
    """The teeth of a cold sump would pass the temperature at which the oil has laws; the balance does not."""
    box = model(tmp_path, STAGE, thermal={**THERMAL, "teeth_W_K": {"a": 1.0}})
    at = np.array([200.0]), np.array([50.0 * np.pi])
    balance = box.balance(*at)
    assert balance.found.all()

    def mesh(sump: float, rise: float) -> float:
        warm = {"a": np.array([rise])}
        return float(box._at(np.array([sump]), warm).losses(*at).total()[0])

    def excess(sump: float) -> float:
        rise = brentq(lambda own: own - mesh(sump, own), 0.0, 200.0, xtol=1e-10)
        return float(box.paths.total(np.array([sump]))[0]) - rise

    assert balance.sump[0] == pytest.approx(brentq(excess, 300.0, 350.0, xtol=1e-8), abs=1e-4)
    assert balance.rise["a"][0] == pytest.approx(mesh(float(balance.sump[0]), float(balance.rise["a"][0])), rel=1e-6)


def test_teeth_without_a_temperature_are_not_in_balance(tmp_path: Path) -> None:
    thermal = {**THERMAL, "teeth_W_K": {"a": 0.05}, "heat_capacity_kJ_K": 20.0}
    box = model(tmp_path, FIXED, thermal=thermal, duty=DUTY)
    balance = box.balance(np.array([0.0, 200.0]), np.array([150.0, 150.0]))
    assert list(balance.found) == [True, False]
    assert balance.teeth[1] > 0.1
    tables, notes = thermal_tables(box, balance)
    assert list(tables["thermal"]["total_loss_W"].isna()) == [False, True]
    assert ["1 of 2 conditions did not converge" in notes[0].text, "teeth do not pass" in notes[1].text] == [True, True]


def test_conditions_without_balance_have_no_numbers_and_reach_the_page(tmp_path: Path) -> None:
    weak = {"housing": {"area_m2": 0.1, "coefficient_W_m2K": 10.0}}
    gearbox(tmp_path, FIXED, conditions=LEVELS, thermal=weak)
    path = str(tmp_path / "efficiency.toml")
    with pytest.warns(UserWarning, match="no balance up to 150 °C"):
        found = ml.gearbox_efficiency(path)
    sump, loss = found["sump_temperature_C"], found["balanced_loss_W"]
    none = np.isnan(sump.to_numpy())
    assert 0 < none.sum() < none.size
    assert np.array_equal(np.isnan(loss.to_numpy()), none)
    assert np.isnan(found["balanced_efficiency_percent"].to_numpy()[none]).all()
    assert main(["efficiency", path, "--out", str(tmp_path / "out")]) == 0
    page = (tmp_path / "out" / "index.html").read_text(encoding="utf-8")
    assert "have no balance up to 150 °C" in page
    table = pd.read_csv(tmp_path / "out" / "thermal.csv")
    line = next(thermal_lines({"thermal": table}))
    assert f"sump {float(sump.min()):.4g} to {float(sump.max()):.4g} °C" in line
    assert float(sump.max()) < 149.0


def test_python_and_command_give_the_same_temperatures(tmp_path: Path) -> None:
    gearbox(tmp_path, FIXED, conditions=LEVELS, thermal=THERMAL)
    path = str(tmp_path / "efficiency.toml")
    found = ml.gearbox_efficiency(path)
    assert main(["efficiency", path, "--out", str(tmp_path / "out")]) == 0
    table = pd.read_csv(tmp_path / "out" / "thermal.csv")
    assert found["sump_temperature_C"].to_numpy().ravel() == pytest.approx(table["sump_temperature_C"])
    assert list(table["balance"].unique()) == ["converged"]
    declared = {one.name for one in TABLES["thermal"]} - {"STAGE_tooth_temperature_C", "WAY_heat_W"}
    assert declared <= set(table)
    assert (tmp_path / "out" / "figures" / "thermal.svg").stat().st_size > 2000


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"housing": None, "foundation_W_K": 0.0}, "no way for the heat: give housing, foundation_W_K, cooler"),
        ({"housing": {"area_m2": 0.3, "coefficient_W_m2K": 0.0}}, "neither coefficient_W_m2K nor emissivity"),
        ({"housing": {**HOUSING, "area_m2": -1.0}}, "area_m2: -1.0"),
        ({"highest_temperature_C": 20.0}, "highest_temperature_C: 20: must be above 25"),
        ({"start_temperature_C": 30.0}, "start_temperature_C needs heat_capacity_kJ_K"),
        ({"ambient_temperatur_C": 20.0}, "nearest known: 'ambient_temperature_C'"),
        ({"teeth_W_K": {"frist": 20.0}}, "must be a stage of one gear pair (a)"),
    ],
)
def test_a_table_that_is_wrong_is_refused(change: dict[str, Any], said: str, tmp_path: Path) -> None:
    thermal = {name: value for name, value in {**THERMAL, **change}.items() if value is not None}
    with pytest.raises(InputError) as error:
        model(tmp_path, STAGE, thermal=thermal)
    assert said in str(error.value)
