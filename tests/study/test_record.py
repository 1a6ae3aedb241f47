"""What is kept beside a result, and what a run refuses to replace."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest

from mixedlub.cli import main
from mixedlub.schema.toml_file import parse
from mixedlub.study import read_study, run_study
from mixedlub.study.record import running
from mixedlub.study.schema import StudyFile
from profiles.errors import InputError


def run(file, out, *options, status=0):
    assert main(["study", str(file), "--no-figures", "--out", str(out), *options]) == status


def state(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_the_study_file_as_given_lies_beside_the_result(write_study, tmp_path):
    file = write_study()
    run(file, tmp_path / "o")
    assert (tmp_path / "o" / "study.toml").read_bytes() == file.read_bytes()


def test_resolved_inputs_are_a_study_that_gives_the_same_result(write_study, tmp_path):
    traced = {"few": {"profile": "shipped:0122"}, "mid": {"m0_um2": 0.1, "m2": 0.0025, "m4_per_um2": 0.0036}}
    file = write_study(
        surfaces=traced,
        lubricant__eyring_stress_MPa=None,
        gears__profile_shift=[0.1, 0.05],
        effects={"inlet_shear_heating": {}},
    )
    run(file, tmp_path / "o")
    record = json.loads((tmp_path / "o" / "resolved.json").read_text(encoding="utf-8"))
    again = run_study(read_study(file, parse(StudyFile, record["inputs"], "resolved.json")))
    assert again["power_loss"] == pytest.approx(run_study(read_study(file))["power_loss"], rel=1e-9)


def test_every_default_taken_is_listed_with_its_value(write_study, tmp_path):
    run(write_study(lubricant__eyring_stress_MPa=None, effects={"inlet_shear_heating": {}}), tmp_path / "o")
    record = json.loads((tmp_path / "o" / "resolved.json").read_text(encoding="utf-8"))
    listed = {"gears.tip_diameter_mm", "gears.centre_distance_mm", "lubricant.eyring_stress_MPa", "lubricant.base"}
    listed |= {"boundary_friction", "options.film", "effects.inlet_shear_heating.strength"}
    assert listed <= set(record["assumed"])
    assert "gears.teeth" not in record["assumed"]
    for key in listed:
        value = record["inputs"]
        for part in key.split("."):
            value = value[part]
        assert value is not None, key
    assert record["derived"]["gears"]["contact_ratio"] == pytest.approx(1.49, abs=0.05)


def test_a_result_is_replaced_by_a_rerun_without_a_word(write_study, tmp_path, capsys):
    file = write_study()
    run(file, tmp_path / "o")
    before = state(tmp_path / "o")
    capsys.readouterr()
    run(file, tmp_path / "o")
    assert "replaced" not in capsys.readouterr().err
    assert state(tmp_path / "o") == before


def test_an_edited_study_replaces_its_earlier_result_and_says_so(write_study, tmp_path, capsys):
    run(write_study(), tmp_path / "o")
    run(write_study(boundary_friction=0.12), tmp_path / "o")
    assert "earlier state" in capsys.readouterr().err


def test_another_study_is_refused_with_the_way_out_and_replaces_when_asked(write_study, tmp_path, capsys):
    run(write_study("first"), tmp_path / "o")
    before = state(tmp_path / "o")
    other = write_study("other", gears__face_width_mm=20.0)
    run(other, tmp_path / "o", status=2)
    err = capsys.readouterr().err
    assert "another study, ../first.toml" in err
    assert "--replace" in err
    assert state(tmp_path / "o") == before
    run(other, tmp_path / "o", "--replace")
    assert state(tmp_path / "o") != before


@pytest.mark.parametrize("name", ["results.csv", "study.toml", "index.html"])
def test_a_file_that_no_run_wrote_is_never_replaced_unasked(name, write_study, tmp_path, capsys):
    (tmp_path / "o").mkdir()
    (tmp_path / "o" / name).write_text("mine", encoding="utf-8")
    run(write_study(), tmp_path / "o", status=2)
    assert name in capsys.readouterr().err
    assert state(tmp_path / "o") == {name: b"mine"}


def test_a_result_that_was_edited_is_not_replaced_unasked(write_study, tmp_path):
    file = write_study()
    run(file, tmp_path / "o")
    with (tmp_path / "o" / "results.csv").open("a", encoding="utf-8") as table:
        table.write("a row of mine\n")
    run(file, tmp_path / "o", status=2)


def test_a_study_may_write_into_its_own_folder_and_never_over_itself(write_study, tmp_path):
    file = write_study("study")
    text = file.read_bytes()
    inode = file.stat().st_ino
    for _ in range(2):
        run(file, tmp_path)
    assert (file.read_bytes(), file.stat().st_ino) == (text, inode)


def test_a_run_of_another_study_in_the_folder_is_said(write_study, tmp_path):
    first, other = read_study(write_study()), read_study(write_study("other", boundary_friction=0.2))
    folder = tmp_path / "o"
    folder.mkdir()
    living = subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE)
    try:
        with running(folder, first):
            (mark,) = folder.iterdir()
            mark.rename(folder / mark.name.replace(str(os.getpid()), str(living.pid)))
            with pytest.raises(InputError, match=f"process {living.pid}"), running(folder, other):
                pass
            with running(folder, first):
                pass
    finally:
        living.communicate(b"\n")
    with running(folder, other):
        pass
    assert list(folder.iterdir()) == []


def test_parquet_carries_units_meanings_and_versions(write_study, tmp_path):
    import pyarrow.parquet as pq

    from mixedlub.running.version import installed_version

    run(write_study(title="Named"), tmp_path / "o")
    schema = pq.read_schema(tmp_path / "o" / "results.parquet")
    assert schema.field("film_thickness_um").metadata[b"unit"] == "µm".encode()
    assert schema.field("torque_Nm").metadata[b"unit"] == b"N m"
    assert all(schema.field(name).metadata[b"meaning"] for name in schema.names)
    assert schema.metadata[b"title"] == b"Named"
    assert schema.metadata[b"mixedlub"].decode() == installed_version()
    assert np.isfinite(pq.read_table(tmp_path / "o" / "results.parquet")["power_loss_W"].to_numpy()).all()
