"""What `mixedlub efficiency` and `mixedlub parts` write, print and refuse."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from mixedlub.cli import main
from mixedlub.parts import catalogue, series
from tests.efficiency.gearboxes import AFTER, PARTS, STAGE, gearbox_file, written

TABLES = {"map", "loss_map", "losses", "breakdown", "stages", "mesh_cycle", "tooth_pair"}
DUTY = {"torque_Nm": [150.0, 0.0], "speed_rpm": [1000.0, 3000.0], "duration_h": [10.0, 5.0]}


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("command")
    path = written(folder, gearbox_file(STAGE | PARTS, STAGE | AFTER, duty=DUTY))
    assert main(["efficiency", str(path), "--out", str(folder / "out")]) == 0
    return folder / "out"


def test_it_writes_tables_and_figures(out: Path) -> None:
    assert {path.stem for path in out.glob("*.csv")} == TABLES | {"duty", "duty_summary"}
    assert {path.name for path in (out / "figures").iterdir()} == {
        *("map.svg", "breakdown.svg", "mesh_cycle.svg", "tooth_pair.svg", "efficiency.svg", "loss_torque.svg")
    }


def test_the_page_holds_all_figures_tables_and_inputs(out: Path) -> None:
    page = (out / "index.html").read_text(encoding="utf-8")
    for name in ("map", "breakdown", "efficiency", "loss_torque", "mesh_cycle", "tooth_pair"):
        assert f'<figure id="{name}">' in page
    for text in ("Mesh a", "Mesh b", "Where the input drives", "duty cycle:", "Breakdown"):
        assert text in page
    assert "src=" not in page
    last = pd.read_csv(out / "stages.csv")["stage_loss_W"].iloc[0]
    assert f"<td>{last:.5g}</td>" in page
    assert (out / "efficiency.toml").read_text(encoding="utf-8") == (out.parent / "efficiency.toml").read_text("utf-8")


def test_columns_have_their_unit(out: Path) -> None:
    bare = {"stage", "origin", "part", "law", "driving", "driven", "ratio", "base_pitches", "validity", "mesh_friction"}
    for path in out.glob("*.csv"):
        for name in pd.read_csv(path).columns:
            assert name in bare or name.endswith(("_Nm", "_rpm", "_W", "_percent", "_deg", "_kWh", "_h", "_N")), name


def test_a_mesh_that_does_not_resist_rolling_is_not_shown_with_a_loss_of_zero(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for effects, shown in (({}, False), (STAGE["effects"], True)):
        path = written(tmp_path, gearbox_file(STAGE | PARTS | {"effects": effects}))
        assert main(["efficiency", str(path), "--out", str(tmp_path / f"out_{shown}")]) == 0
        assert ("rolling" in capsys.readouterr().out) == shown
        for name in ("breakdown", "mesh_cycle"):
            assert ("rolling" in (tmp_path / f"out_{shown}" / "figures" / f"{name}.svg").read_text()) == shown


def test_losses_written_add_up(out: Path) -> None:
    parts, table = pd.read_csv(out / "losses.csv"), pd.read_csv(out / "map.csv")
    summed = parts.drop(columns=["torque_Nm", "speed_rpm", "total_loss_W"]).sum(axis=1)
    assert summed.to_numpy() == pytest.approx(table["total_loss_W"].to_numpy(), rel=1e-9)
    breakdown = pd.read_csv(out / "breakdown.csv")
    last = table.iloc[-1]
    assert breakdown["loss_W"].iloc[:-1].sum() == pytest.approx(last["total_loss_W"], rel=1e-9)
    cycle = pd.read_csv(out / "mesh_cycle.csv").groupby("stage")[["sliding_loss_W", "rolling_loss_W"]].mean()
    meshes = breakdown[breakdown["origin"].isin(["sliding", "rolling"])]["loss_W"].sum()
    assert cycle.to_numpy().sum() == pytest.approx(meshes, rel=5e-3)


def test_efficiencies_are_empty_without_torque(out: Path) -> None:
    lines = (out / "map.csv").read_text(encoding="utf-8").splitlines()
    place = lines[0].split(",").index("gearbox_efficiency_percent")
    values = [line.split(",")[place] for line in lines[1:]]
    assert values[:2] == ["", ""]
    assert all(0.0 < float(value) < 100.0 for value in values[2:])


def test_driving_and_driven_side_are_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = written(tmp_path, gearbox_file(STAGE | {"driving": "gear"}))
    assert main(["efficiency", str(path), "--out", str(tmp_path / "out"), "--no-figures"]) == 0
    said = capsys.readouterr().out
    assert "a: the gear drives the pinion" in said
    assert "tooth efficiency" in said
    assert "gearbox: efficiency" in said
    stages = pd.read_csv(tmp_path / "out" / "stages.csv")
    assert stages[["driving", "driven"]].to_numpy().tolist() == [["gear", "pinion"]]


def test_the_template_runs_without_an_assumption(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "efficiency", "--out", str(tmp_path / "new")]) == 0
    path = tmp_path / "new" / "efficiency.toml"
    assert f"mixedlub efficiency {path}" in capsys.readouterr().out
    assert main(["efficiency", str(path), "--out", str(tmp_path / "out"), "--no-figures"]) == 0
    said = capsys.readouterr()
    assert "duty cycle:" in said.out
    assert "typical" not in said.err
    assert "assumed" not in said.err


def test_every_key_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["kinds", "efficiency"]) == 0
    said = capsys.readouterr().out
    for title in ("conditions", "duty", "stages.NAME", "stages.NAME.bearings.NAME", "stages.NAME.churning.NAME"):
        assert f"\n[{title}]" in said
    assert max(map(len, said.splitlines())) <= 80


def test_laws_of_parts_are_listed_and_have_pages(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["parts"]) == 0
    said = capsys.readouterr().out
    assert all(law.name in said for law in catalogue().values())
    assert max(map(len, said.splitlines())) <= 80
    assert main(["parts", "skf_deep_groove"]) == 0
    said = capsys.readouterr().out
    assert all(f"  {name} " in said for name in series()["deep_groove"])
    assert main(["parts", "iso_tr_14179_1"]) == 0
    assert capsys.readouterr().out.count("ISO/TR 14179-1,") == 2
    assert main(["parts", "dawsen"]) == 2
    assert "nearest known: 'dawson'" in capsys.readouterr().err


def changed(place: str, value: Any) -> dict[str, Any]:
    """A file with one entry changed, or left out where the value is None."""
    file = gearbox_file(copy.deepcopy(STAGE | PARTS))
    *tables, last = place.split(".")
    table: Any = file
    for name in tables:
        table = table.setdefault(name, {})
    if value is None:
        del table[last]
    else:
        table[last] = value
    return file


FRONT = "stages.a.bearings.front"


@pytest.mark.parametrize(
    ("place", "value", "said"),
    [
        (f"{FRONT}.series", "6x", f"{FRONT}.series: '6x': no such series of skf_deep_groove; nearest known: '6"),
        (
            f"{FRONT}.law",
            "skf_deepgroove",
            f"{FRONT}.law: 'skf_deepgroove': no such bearing law; nearest known: 'skf_d",
        ),
        (f"{FRONT}.static_rating_N", None, f"{FRONT}: skf_deep_groove needs static_rating_N"),
        (
            f"{FRONT}.series",
            None,
            "needs rolling, rolling_axial, sliding, sliding_axial: give `series` (2, 3, 42, 43 and 16 more)",
        ),
        (f"{FRONT}.coefficients", {"rollin": 1e-7}, "'rollin': no such coefficient of skf_deep_groove; nearest known"),
        (f"{FRONT}.outside_diameter_mm", 20, "outside_diameter_mm 20 must be above bore_mm 35"),
        ("stages.a.bearings.back.static_rating_N", 1e4, "palmgren does not read it; leave it out"),
        ("stages.a.bearings.back.series", "deep_grove", "no such series of palmgren; nearest known: 'deep_groove'"),
        ("stages.a.seals.front.series", "62", "iso_tr_14179_2 has no table of series"),
        ("stages.a.churning.wheel.immersion_mm", None, "changenet_velex needs immersion_mm"),
        (
            "stages.a.churning.wheel.immersion_mm",
            400,
            "immersion_mm: 400.0: is above the pitch diameter of the gear, 109.8 mm",
        ),
        ("stages.a.seals.front.diametre_mm", 35, "key is not known; nearest known: 'diameter_mm'"),
        ("stages.a.effects.windage", {}, "stages.a.effects.windage: is a loss outside the mesh; give the part itself"),
        ("stages.a.options", {"bands": "traces"}, "has no meaning for a stage"),
        ("stages.a.oil_temperature_C", 5000.0, "oil_temperature_C"),
        ("stages.a.boundary_friction", 1e6, "boundary_friction: 1000000.0: must be from"),
        ("stages.a.gears.teeth", [5, 60], "stages.a.gears.centre_distance_mm: 91.5: the centre distance must exceed"),
        ("conditions.torque_Nm", [1e300], "no finite loss at 1e+300 N m"),
        ("stages.a.gears", {"preset": "fzg_z"}, "no such gears; nearest known: 'fzg_"),
        ("conditions.speed_rpm", [0.0, 100.0], "speed_rpm: 0; a shaft at rest has no loss and no efficiency"),
        ("conditions.speed_rpm", [100.0, 100.0], "each level once, but 100.0 appears again"),
        ("conditions.speed_rpm", {"from": 1, "to": 9, "count": 100_000}, "at most 250000 conditions, not 300000"),
        ("conditions.torque_Nm", [0.0], "all torques of the map are 0"),
        ("duty", DUTY | {"duration_h": [1.0]}, "the three lists go together, but have 2, 2 and 1 entries"),
        ("duty", DUTY | {"duration_h": [1.0, -1.0]}, "duration_h"),
        ("stages", {}, "stages"),
        ("stages.a, b", STAGE, "must be a name of one line without commas or quotes"),
    ],
)
def test_bad_input_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], place: str, value: Any, said: str
) -> None:
    path = written(tmp_path, changed(place, value))
    assert main(["efficiency", str(path), "--out", str(tmp_path / "out")]) == 2
    message = capsys.readouterr().err
    assert said in message
    assert "Traceback" not in message
    assert not (tmp_path / "out").exists()


def test_a_map_of_one_condition_is_drawn(tmp_path: Path) -> None:
    path = written(tmp_path, gearbox_file(STAGE, conditions={"torque_Nm": [100.0], "speed_rpm": [1000.0]}))
    assert main(["efficiency", str(path), "--out", str(tmp_path / "out")]) == 0
    assert (tmp_path / "out" / "figures" / "breakdown.svg").is_file()
    assert np.isfinite(pd.read_csv(tmp_path / "out" / "map.csv")["tooth_efficiency_percent"]).all()
