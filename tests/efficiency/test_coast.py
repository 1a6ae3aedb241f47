"""Coast and oil temperature in one map: the numbers of a gearbox turned round, and of files at each temperature."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from matplotlib.collections import PathCollection

import mixedlub as ml
from mixedlub.cli import main
from mixedlub.efficiency import read_gearbox
from mixedlub.efficiency.table import duty_summary, loss_map, map_table
from mixedlub.report.efficiency import _efficiency, _loss_torque, breakdown_figure, map_figure
from profiles.errors import InputError
from tests.efficiency.gearboxes import AFTER, PARTS, STAGE, gearbox, gearbox_file, written
from tests.efficiency.planetary import SIMPLE, mesh, planetary_box

COAST = {"torque_Nm": [-200.0, -50.0, 0.0, 50.0, 200.0], "speed_rpm": [500.0, 3000.0]}


def test_in_coast_the_losses_are_those_of_the_gearbox_turned_round(tmp_path: Path) -> None:
    there = gearbox(tmp_path, STAGE | PARTS, STAGE | AFTER, conditions=COAST).map()
    turned = gearbox_file(STAGE | AFTER | {"driving": "gear"}, STAGE | PARTS | {"driving": "gear"})
    back = read_gearbox(written(tmp_path, turned))[0]
    coast = there.torque < 0.0
    speed = there.speed[coast] / there.gearbox.ratio
    found = back.losses(-there.output_power[coast] / speed, speed)
    assert found.total() == pytest.approx(there.total()[coast], rel=1e-5)
    assert found.output_power == pytest.approx(-there.input_power[coast], rel=1e-5)
    assert there.efficiency()[coast] == pytest.approx(found.efficiency(), rel=1e-6)
    drive = gearbox(tmp_path, STAGE | PARTS, STAGE | AFTER, conditions=COAST | {"torque_Nm": [0.0, 50.0, 200.0]}).map()
    assert there.total()[~coast] == pytest.approx(drive.total(), rel=1e-12)


def helical(**thrust: str) -> dict[str, Any]:
    """A stage on placed bearings: one fixed on the pinion's shaft, one for each side on the gear's."""
    place = {"pinion": ("fixed", None), "gear": ("negative", "positive")}
    bearings = {
        f"{shaft}_{at}": {"law": "palmgren", "coefficients": {"f0": 2.0, "f1": 4e-4}, "shaft": shaft}
        | {"bore_mm": 35, "outside_diameter_mm": 72, "position_mm": at}
        | ({} if axial is None else {"axial": axial})
        for shaft, both in place.items()
        for at, axial in zip((-30.0, 40.0), both, strict=True)
    }
    gears = {"teeth": [23, 67], "normal_module_mm": 2.0, "helix_angle_deg": 20.0, "face_width_mm": 26.0}
    return STAGE | {"gears": gears, "bearings": bearings, "pinion_thrust": "positive"} | thrust


def test_in_coast_the_thrust_is_on_the_other_bearing(tmp_path: Path) -> None:
    box = gearbox(tmp_path, helical(), conditions=COAST)
    assert box.coasting is not None
    loads = [{part.name: part.load for part in one.stages[0].parts} for one in (box, box.coasting)]
    thrust = [{name: axial for name, (_, axial) in one.items()} for one in loads]
    assert thrust[0]["gear_-30.0"] > 0.0 == thrust[0]["gear_40.0"]
    assert thrust[1]["gear_40.0"] == pytest.approx(thrust[0]["gear_-30.0"])
    assert thrust[1]["gear_-30.0"] == 0.0
    other = gearbox(tmp_path, helical(pinion_thrust="negative") | {"driving": "gear"})
    radial = {part.name: part.load[0] for part in other.stages[0].parts}
    for name, (load, _) in loads[1].items():
        assert load == pytest.approx(radial[name])


def test_a_thrust_that_coast_leaves_uncarried_is_one_sentence(tmp_path: Path) -> None:
    stage = copy.deepcopy(helical())
    del stage["bearings"]["gear_40.0"]["axial"]
    gearbox(tmp_path, stage)
    with pytest.raises(
        InputError, match="no bearing takes the axial force, which points to the positive side in coast"
    ):
        gearbox(tmp_path, stage, conditions=COAST)


def test_a_planetary_stage_coasts_with_input_and_output_exchanged(tmp_path: Path) -> None:
    box = planetary_box(tmp_path, SIMPLE, conditions=COAST)
    found = box.losses(np.array([-100.0]), np.array([200.0]))
    section = SIMPLE | {"input": box.stages[0].driven, "output": box.stages[0].driving}
    turned = planetary_box(tmp_path, section)
    speed = found.speed / box.ratio
    there = turned.losses(-found.output_power / speed, speed)
    assert there.total() == pytest.approx(found.total(), rel=1e-5)
    assert there.output_power == pytest.approx(np.array([100.0 * 200.0]), rel=1e-5)


def test_a_train_that_locks_in_coast_is_one_sentence(tmp_path: Path) -> None:
    meshes = {
        "first": mesh("a", "planet", teeth=(50, 49), normal_module_mm=1.0),
        "second": mesh("planet", "b", teeth=(50, 51), normal_module_mm=0.98, centre_distance_mm=49.5),
    }
    stage = SIMPLE | {
        "input": "carrier",
        "output": "a",
        "fixed": "b",
        "planet_count": 1,
        "meshes": meshes,
        "others": {},
    }
    box = planetary_box(tmp_path, stage, conditions=COAST)
    with pytest.raises(InputError, match="in coast the losses take all power of the output"):
        box.losses(np.array([-0.002]), np.array([125.0]))


def test_an_axis_of_oil_temperature_has_the_numbers_of_a_file_at_each(tmp_path: Path) -> None:
    box = gearbox(tmp_path, STAGE | PARTS, conditions=COAST | {"oil_temperature_C": [40.0, 90.0]})
    found = map_table(box.map())
    assert found["oil_temperature_C"].tolist() == [40.0] * 10 + [90.0] * 10
    for oil in (40.0, 90.0):
        alone = gearbox(tmp_path, STAGE | PARTS | {"oil_temperature_C": oil}, conditions=COAST).map()
        here = found[found["oil_temperature_C"] == oil]
        assert here["total_loss_W"].to_numpy() == pytest.approx(alone.total(), rel=1e-12)
        assert here["validity"].tolist() == list(alone.validity)
    table = loss_map(box.map())
    assert list(table)[:3] == ["input_speed_rpm", "input_torque_Nm", "oil_temperature_C"]
    assert (table["power_loss_W"] > 0.0).all()


def test_python_has_the_axis_of_oil_temperature(tmp_path: Path) -> None:
    path = written(tmp_path, gearbox_file(STAGE, conditions=COAST | {"oil_temperature_C": [40.0, 90.0]}))
    found = ml.gearbox_efficiency(path)["total_loss_W"]
    assert found.dims == ("oil_temperature_C", "torque_Nm", "speed_rpm")
    cold, hot = (found.sel(oil_temperature_C=oil, torque_Nm=-50.0, speed_rpm=3000.0).item() for oil in (40.0, 90.0))
    assert cold > hot > 0.0


def test_energy_of_coast_is_taken_in_at_the_output(tmp_path: Path) -> None:
    box = gearbox(tmp_path, STAGE | PARTS, conditions=COAST)
    found = box.losses(np.array([100.0, -100.0]), np.array([100.0, 100.0]))
    row = duty_summary(found, np.array([1.0, 1.0])).iloc[0]
    taken = 100.0 * 100.0 + 100.0 * 100.0 + found.total()[1]
    assert row["input_energy_kWh"] == pytest.approx(taken / 1000.0)
    assert row["mean_gearbox_efficiency_percent"] == pytest.approx(100.0 * (1.0 - found.total().sum() / taken))


def test_the_command_draws_both_ends_of_the_oil(tmp_path: Path) -> None:
    path = written(tmp_path, gearbox_file(STAGE, conditions=COAST | {"oil_temperature_C": [40.0, 60.0, 90.0]}))
    assert main(["efficiency", str(path), "--out", str(tmp_path / "out"), "--xlsx"]) == 0
    names = {path.stem for path in (tmp_path / "out" / "figures").iterdir()}
    assert {"map_40C", "map_90C", "loss_torque_40C", "oil_temperature"} <= names
    assert "map_60C" not in names
    page = (tmp_path / "out" / "index.html").read_text(encoding="utf-8")
    assert "Where the output drives, the gearbox efficiency lies between" in page
    assert "Oil at 90 °C." in page
    sheet = pd.read_excel(tmp_path / "out" / "results.xlsx", sheet_name="map")
    assert len(sheet) >= 30


@pytest.mark.parametrize(
    ("conditions", "rule"),
    [
        ({"oil_temperature_C": [40.0, 40.0]}, "oil_temperature_C: each level once, but 40.0 appears again"),
        ({"torque_Nm": [0.0]}, "all torques of the map are 0"),
        ({"oil_temperature_C": []}, "oil_temperature_C"),
        ({"oil_temp_C": [40.0]}, "'oil_temperature_C'"),
    ],
)
def test_wrong_conditions_are_refused(tmp_path: Path, conditions: dict[str, Any], rule: str) -> None:
    with pytest.raises(InputError, match=rule):
        gearbox(tmp_path, STAGE, conditions=COAST | conditions)


CONSTANT = STAGE | {"effects": {}, "options": {"friction": "constant", "friction_coefficients": {"friction": 0.05}}}


def test_a_map_of_coast_alone_has_the_cycle_of_its_strongest_torque(tmp_path: Path) -> None:
    """The cycle is of the gearbox driven at its output, whose input power is that of the output plus all losses."""
    levels = {"torque_Nm": [-200.0, -50.0], "speed_rpm": [500.0, 3000.0]}
    box = gearbox(tmp_path, STAGE | PARTS, STAGE | AFTER, conditions=levels)
    losses, at = box.map(), box.at_cycle()
    chosen = (losses.torque == -200.0) & (losses.speed == losses.speed.max())
    assert at.total() == pytest.approx(losses.total()[chosen], rel=1e-6)
    assert at.input_power == pytest.approx(-losses.output_power[chosen], rel=1e-6)
    assert main(["efficiency", str(tmp_path / "efficiency.toml"), "--out", str(tmp_path / "out"), "--no-figures"]) == 0
    tables = {name: pd.read_csv(tmp_path / "out" / f"{name}.csv") for name in ("stages", "breakdown", "mesh_cycle")}
    assert list(tables["stages"]["stage"]) == ["b", "a"]
    assert set(tables["mesh_cycle"]["driving"]) == {"gear"}
    assert tables["breakdown"]["loss_W"].iloc[-1] == pytest.approx(losses.total()[chosen][0], rel=1e-6)


@pytest.mark.parametrize(
    ("torques", "points", "panels"),
    [([0.0, 100.0], 3, ["input speed (rpm)"]), ([-100.0, 0.0, 100.0], 6, ["input speed (rpm)"])],
)
def test_single_levels_of_efficiency_are_points_of_the_map(
    tmp_path: Path, torques: list[float], points: int, panels: list[str]
) -> None:
    """No torque beside 0 has an efficiency in between, so that areas of the map have no colour."""
    conditions = {"torque_Nm": torques, "speed_rpm": [500.0, 1500.0, 2000.0]}
    losses = gearbox(tmp_path, CONSTANT, conditions=conditions).map()
    figure = map_figure("", losses)
    assert figure is not None
    shown = [axis for axis in figure.axes if axis.get_xlabel() == "input speed (rpm)"]
    drawn = [
        sum(len(one.get_offsets()) for one in axis.collections if isinstance(one, PathCollection)) for axis in shown
    ]
    assert drawn == [0, points, points]
    assert [panel.across for panel in _efficiency(map_table(losses))] == panels


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_single_condition_has_its_point_and_its_bars(tmp_path: Path, sign: float) -> None:
    conditions = {"torque_Nm": [sign * 100.0], "speed_rpm": [1500.0]}
    losses = gearbox(tmp_path, CONSTANT, conditions=conditions).map()
    table = map_table(losses)
    (panel,) = _efficiency(table)
    (only,) = panel.curves
    assert only.y == pytest.approx([table["tooth_efficiency_percent"][0]])
    assert 98.0 < only.y[0] < 100.0
    ((lost,),) = (panel.curves for panel in _loss_torque(table))
    assert (lost.style, lost.y) == ("o", pytest.approx([table["total_loss_W"][0] / (1500.0 * np.pi / 30.0)]))
    for axis in breakdown_figure("", losses).axes:
        assert sum(bar.get_height() for bar in axis.patches) == pytest.approx(losses.total()[0])
        assert axis.get_ylim()[1] > losses.total()[0]
