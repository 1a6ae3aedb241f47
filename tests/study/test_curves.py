"""Curves along the path of contact on request."""

import csv

import numpy as np
import pyarrow.parquet as pq
import pytest

from mixedlub.cli import main
from mixedlub.schema.table_files import write_long
from mixedlub.study import curves, read_study, run_study


def run(file, out, *options):
    return main(["study", str(file), "--no-figures", "--out", str(out), *options])


@pytest.fixture
def path(write_study):
    return write_study(gears__load_sharing={"model": "ldp"}, options={"face_slices": 3, "path_points": 16})


def test_curves_add_up_to_the_loss_of_every_condition(path, tmp_path):
    """Friction times load times sliding speed, summed from the table alone."""
    study = read_study(path)
    write_long(curves.curve_table(study), curves.curve_columns(), tmp_path / "c.csv", tmp_path / "c.parquet")
    points = pq.read_table(tmp_path / "c.parquet").to_pandas()
    assert len(points) == study.conditions * study.plan.points
    points["loss_W"] = (
        points["friction"]
        * points["load_share"]
        * (points["torque_Nm"] / study.pair.base_radius[0])
        * points["sliding_speed_m_s"]
        * points["path_weight"]
    )
    keys = ["pinion_surface", "gear_surface", "torque_Nm", "speed_rpm", "oil_temperature_C"]
    summed = points.groupby(keys)["loss_W"].sum()
    table = run_study(study).to_pandas().set_index(keys)
    assert summed.to_numpy() == pytest.approx(table["mesh_loss_W"].reindex(summed.index).to_numpy(), rel=1e-9)
    hottest = points[points["load_share"] > 1e-6].groupby(keys)["flash_temperature_K"].max()
    assert hottest.to_numpy() == pytest.approx(table["flash_temperature_K"].reindex(summed.index).to_numpy())


def test_curves_of_the_file_are_those_of_python(write_study):
    import mixedlub as ml

    one = {"torque_Nm": [150], "speed_rpm": [1500], "oil_temperature_C": [60]}
    study = read_study(write_study(conditions=one, pairings={"every": ["mid"]}))
    (table,) = curves.curves(study)
    file = study.file
    with pytest.warns(ml.CautionWarning):
        path = ml.along_path(
            file.gears, file.lubricant, file.surfaces["mid"], torque_Nm=150, speed_rpm=1500, oil_temperature_C=60
        )
    for column in curves.ALONG_PATH:
        assert np.array_equal(table[column.name].to_numpy(), path[column.name].to_numpy()), column.name


def test_the_command_writes_them_on_request_alone(path, tmp_path):
    out = tmp_path / "o"
    assert run(path, out) == 0
    assert not (out / "curves.csv").exists()
    assert run(path, out, "--curves") == 0
    with (out / "curves.csv").open(newline="") as file:
        header = next(csv.reader(file))
    assert header == [c.name for c in curves.curve_columns()]
    schema = pq.read_schema(out / "curves.parquet")
    assert schema.field("line_load_N_mm").metadata[b"unit"] == b"N/mm"
    assert all(schema.field(name).metadata[b"meaning"] for name in header)


def test_curves_of_an_earlier_state_are_called_so(write_study, tmp_path, capsys):
    out = tmp_path / "o"
    assert run(write_study(), out, "--curves") == 0
    assert run(write_study(boundary_friction=0.08), out) == 0
    assert "curves.csv and curves.parquet in" in " ".join(capsys.readouterr().err.split())


def test_long_curves_are_parquet_alone(path, tmp_path, monkeypatch):
    monkeypatch.setattr(curves, "MOST_CSV_ROWS", 100)
    assert run(path, tmp_path / "o", "--curves") == 0
    assert (tmp_path / "o" / "curves.parquet").exists()
    assert not (tmp_path / "o" / "curves.csv").exists()


def test_too_many_points_are_refused_before_anything_is_written(path, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(curves, "MOST_ROWS", 100)
    assert run(path, tmp_path / "o", "--curves") == 2
    message = capsys.readouterr().err
    assert "--curves" in message
    assert "rows" in message
    assert not (tmp_path / "o").exists()
