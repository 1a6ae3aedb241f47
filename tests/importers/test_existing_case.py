"""A case that is there already: nothing of it is lost unless the user says so."""

import numpy as np
import pytest

from mixedlub.case.folder import read_case
from mixedlub.cli import main
from mixedlub.importers import import_files, write_case
from mixedlub.importers.wizard import run
from mixedlub.schema import toml_file
from profiles.errors import InputError

TABLE = "temperature_C,viscosity_mPa_s\n40,30\n100,5\n"
VISCOSITY = {"kind": "viscosity", "recording": {"quantity": "viscosity_mPa_s"}}
READINGS = {"temperature_C": np.array([20.0, 40.0]), "viscosity_mPa_s": np.array([9.0, 5.0])}


@pytest.fixture
def table(tmp_path, monkeypatch):
    """A table in the current folder."""
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "table.csv"
    path.write_text(TABLE, encoding="utf-8")
    return path


def imported(*more):
    return main(["import", "table.csv", "--out", "rig", "--set", 'kind="viscosity"', *more])


def contents(folder):
    return {p.name: (p.read_bytes(), p.stat().st_mtime_ns) for p in folder.iterdir()}


def test_an_edited_system_file_is_refused_in_one_line_and_nothing_is_touched(table, tmp_path, capsys):
    assert imported() == 0
    system = tmp_path / "rig/system.toml"
    system.write_text(system.read_text(encoding="utf-8") + '\n[lubricant]\nname = "ours"\n', encoding="utf-8")
    before = contents(tmp_path / "rig")
    capsys.readouterr()
    assert imported() == 2
    captured = capsys.readouterr()
    assert captured.err.count("\n") == 1
    for word in ("rig/system.toml", "differs", "--overwrite", "--answers rig/system.toml --overwrite", "--out"):
        assert word in captured.err
    assert captured.out == ""
    assert contents(tmp_path / "rig") == before
    assert sorted(p.name for p in tmp_path.iterdir()) == ["rig", "table.csv"]


def test_edited_readings_are_refused_and_named(table, tmp_path, capsys):
    imported()
    readings = tmp_path / "rig/recordings.csv"
    readings.write_text(readings.read_text(encoding="utf-8") + "3,120,3\n", encoding="utf-8")
    assert imported() == 2
    assert "rig/recordings.csv" in capsys.readouterr().err
    assert readings.read_text(encoding="utf-8").endswith("3,120,3\n")


def test_the_same_import_again_is_no_problem_and_writes_nothing(table, tmp_path):
    assert imported() == 0
    before = contents(tmp_path / "rig")
    assert imported() == 0
    assert contents(tmp_path / "rig") == before


def test_whoever_is_asked_is_told_first_that_the_case_is_there(table, tmp_path):
    imported()
    said = []
    run([table], tmp_path / "rig", ["kind=viscosity"], ask=lambda text: "", say=said.append)
    assert "is a case already" in said[0]


def test_overwrite_replaces_what_differs(table, tmp_path):
    imported()
    first = (tmp_path / "rig/system.toml").read_bytes()
    (tmp_path / "rig/system.toml").write_text("nonsense", encoding="utf-8")
    assert imported("--overwrite") == 0
    assert (tmp_path / "rig/system.toml").read_bytes() == first


def test_the_way_out_of_the_help_keeps_what_the_user_wrote(table, tmp_path):
    imported()
    system = tmp_path / "rig/system.toml"
    edit = '\n[lubricant]\nname = "ours"\n\n[surfaces."Ra 0.4"]\nm0_um2 = 0.1\nm2 = 0.002\nm4_per_um2 = 0.003\n'
    system.write_text(system.read_text(encoding="utf-8") + edit, encoding="utf-8")
    table.write_text(TABLE + "120,3\n", encoding="utf-8")
    words = ["import", "table.csv", "--out", "rig", "--answers", "rig/system.toml", "--overwrite"]
    assert main(words) == 0
    case = read_case(tmp_path / "rig")
    assert case.system.lubricant.name == "ours"
    assert case.system.surfaces["Ra 0.4"].m2 == 0.002
    assert case.recordings["viscosity_mPa_s"].tolist() == [30.0, 5.0, 3.0]


def test_the_help_shows_the_way_out(capsys):
    main(["import", "--help"])
    assert "--answers rig/system.toml --overwrite" in " ".join(capsys.readouterr().out.split())


def test_files_that_the_import_does_not_write_stay(tmp_path):
    folder = write_case(tmp_path / "case", VISCOSITY, READINGS)
    (folder / "conditions.csv").write_text("run,temperature_C\n1,30\n", encoding="utf-8")
    write_case(folder, {**VISCOSITY, "description": "again"}, READINGS)
    assert sorted(p.name for p in folder.iterdir()) == ["conditions.csv", "recordings.csv", "system.toml"]
    assert read_case(folder).system.description == "again"


def test_from_python_too_a_case_that_differs_is_refused(table, tmp_path):
    folder = import_files([table], tmp_path / "case", kind="viscosity")
    with pytest.raises(InputError, match="differs"):
        import_files([table], folder, kind="viscosity", description="another")
    import_files([table], folder, overwrite=True, kind="viscosity", description="another")
    assert read_case(folder).system.description == "another"


def test_a_write_that_fails_leaves_the_case_as_it_was(table, tmp_path, monkeypatch):
    imported()
    before = contents(tmp_path / "rig")

    def full(path, content):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.write_bytes", full)
    assert imported("--overwrite", "--set", 'description="new"') == 2
    assert contents(tmp_path / "rig") == before


def test_names_that_toml_must_quote_are_read_back(tmp_path):
    surface = {"m0_um2": 0.1, "m2": 0.002, "m4_per_um2": 0.003}
    folder = write_case(tmp_path / "case", {**VISCOSITY, "surfaces": {"Ra 0.4 ground": surface}}, READINGS)
    assert "Ra 0.4 ground" in toml_file.read_toml(folder / "system.toml")["surfaces"]
