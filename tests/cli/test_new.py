"""Templates of `mixedlub new` run as they are, and every line that they leave as a comment is valid."""

import re

import pytest

from mixedlub.cli import main
from mixedlub.kinds import KINDS, NATIVE, kind
from mixedlub.schema import system_file
from mixedlub.schema.section import tables
from mixedlub.schema.toml_file import parse, read_toml
from mixedlub.study.schema import StudyFile

OPTION = re.compile(r"^# (?=\[|\w+ = )", re.MULTILINE)
"""Before a key or the head of a table that is left out."""


def uncommented(path, *but):
    """The file with everything taken that it leaves out, but for some keys."""
    text = path.read_text(encoding="utf-8")
    lines = [line if line[2:].split(" = ")[0] in but else OPTION.sub("", line) for line in text.splitlines()]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def test_a_study_runs_as_it_is(tmp_path, capsys):
    assert main(["new", "study", "--out", str(tmp_path / "mine")]) == 0
    file = tmp_path / "mine" / "study.toml"
    assert f"mixedlub study {file}" in capsys.readouterr().out
    assert main(["study", str(file), "--no-figures", "--out", str(tmp_path / "out")]) == 0
    said = capsys.readouterr()
    assert "54 conditions" in said.out
    assert "assumed" not in said.err
    assert "typical" not in said.err


@pytest.mark.parametrize("name", KINDS)
def test_a_case_of_every_kind_is_understood_as_it_is(tmp_path, capsys, name):
    folder = tmp_path / name
    assert main(["new", "case", "--kind", name, "--out", str(folder)]) == 0
    assert f"mixedlub check {folder}" in capsys.readouterr().out
    assert main(["check", str(folder)]) == 0
    said = capsys.readouterr().out
    assert f"a case of kind {name}, recording {kind(name).quantities[0]}" in said
    assert "Cannot" not in said
    assert not re.search(r"Doubtful:\n(?!  only \d+ readings)", said)


def test_the_readings_of_a_case_are_those_of_its_base_model(tmp_path, capsys):
    folder = tmp_path / "disc"
    main(["new", "case", "--kind", "disc", "--out", str(folder)])
    assert main(["simulate", str(folder), "--out", str(tmp_path / "out")]) == 0
    read, computed = (
        [float(line.split(",")[column]) for line in path.read_text(encoding="utf-8").splitlines()[1:]]
        for path, column in ((folder / "recordings.csv", -1), (tmp_path / "out" / "simulation.csv", 1))
    )
    assert read == pytest.approx(computed, rel=0.05)
    assert read != pytest.approx(computed, rel=1e-4)


OF_A_TRACE = (
    *("profile", "traces", "traces_along", "map", "unit", "spacing", "holes", "Ra_um", "Rq_um", "Rz_um"),
    *("m2_along", "m4_along_per_um2", "lay"),
)
"""Keys of a surface that go with files in place of its moments, or with a known lay."""
IN_PLACE = ("known_pressure_viscosity", "traction")
"""Keys of an oil that take the place of its coefficients of pressure and of its Eyring stress."""
OF_YIELDING = "hardness_GPa"
"""Key that goes with asperities that yield, which are not the default."""


def test_all_that_a_study_leaves_out_is_valid(tmp_path):
    main(["new", "study", "--out", str(tmp_path)])
    file = uncommented(tmp_path / "study.toml", *OF_A_TRACE, "pinion", "gear", OF_YIELDING, *IN_PLACE)
    parsed = parse(StudyFile, read_toml(file), "study.toml")
    for table in tables(StudyFile):
        if table.name in ("", "gears", "lubricant", "conditions", "options"):
            values = parsed if not table.name else getattr(parsed, table.name)
            assert values.model_fields_set == set(table.model.model_fields) - {OF_YIELDING, *IN_PLACE}


@pytest.mark.parametrize("name", NATIVE)
def test_all_that_a_case_leaves_out_is_valid(tmp_path, name):
    main(["new", "case", "--kind", name, "--out", str(tmp_path)])
    file = uncommented(tmp_path / "system.toml", *OF_A_TRACE, "check", "transverse_radius_mm", *IN_PLACE)
    parsed = parse(system_file.System, read_toml(file), "system.toml")
    assert parsed.description
    assert parsed.uncertainty.model_fields_set == set(system_file.Uncertainty.model_fields)
    for section in (*kind(name).sections, *kind(name).uses):
        assert getattr(parsed, section)


def test_nothing_that_is_there_is_replaced(tmp_path, capsys):
    (tmp_path / "study.toml").write_text("mine", encoding="utf-8")
    assert main(["new", "study", "--out", str(tmp_path)]) == 2
    assert "study.toml: exists" in capsys.readouterr().err
    assert (tmp_path / "study.toml").read_text(encoding="utf-8") == "mine"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["studi"], "what: 'studi': no such template; nearest known: 'study'"),
        (["case", "--kind", "disk"], "--kind: 'disk': no such kind; nearest known: 'disc'"),
        (["study", "--kind", "disc"], "--kind: 'disc': only a case has a kind"),
    ],
)
def test_what_is_not_there_is_named(tmp_path, capsys, words, said):
    assert main(["new", *words, "--out", str(tmp_path / "out")]) == 2
    assert said in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


WITH_PAGES = {
    "friction-laws": "mesh.csv",
    "gear": "summary.csv",
    "bevel": "map.csv",
    "worm": "map.csv",
    "efficiency": "map.csv",
    "ehl": "contacts.csv",
    "factors": "results.csv",
    "regression": "terms.csv",
    "calibration": "coefficients.csv",
}


LONG = ("efficiency", "ehl", "factors", "regression")
"""Templates whose command runs in the example of its help too."""


@pytest.mark.parametrize("name", [pytest.param(n, marks=pytest.mark.long if n in LONG else ()) for n in WITH_PAGES])
def test_the_line_that_a_template_prints_runs_elsewhere(tmp_path, capsys, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    assert main(["new", name, "--out", "mine"]) == 0
    command = capsys.readouterr().out.splitlines()[-1].split()
    assert command[0] == "mixedlub"
    assert main(command[1:]) == 0
    assert "Traceback" not in capsys.readouterr().err
    assert list(tmp_path.glob(f"out/**/{WITH_PAGES[name]}"))
    assert main(["kinds", name]) == 0
    assert f"mixedlub {'evaluate ' if name in ('regression', 'calibration') else ''}{name}" in capsys.readouterr().out


def test_coefficients_of_the_template_are_taken(tmp_path, capsys):
    assert main(["new", "friction-laws", "--out", str(tmp_path)]) == 0
    file = tmp_path / "coefficients.toml"
    lines = [OPTION.sub("", line).replace("NUMBER", "0.05") for line in file.read_text("utf-8").splitlines()]
    file.write_text("\n".join(line for line in lines if not line.startswith("condensed")) + "\n", encoding="utf-8")
    given = ["--coefficients", str(file), "--no-figures", "--out", str(tmp_path / "out")]
    assert main(["friction-laws", "--study", str(tmp_path / "study.toml"), *given]) == 0
    assert capsys.readouterr().err.count("is left out") == 1
