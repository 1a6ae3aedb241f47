"""`mixedlub friction-laws` lists the laws, shows a page of each, and compares all on the gears of a study."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import mixedlub as ml
from mixedlub.cli import main
from mixedlub.friction import catalogue
from mixedlub.friction.benedict_kelley import benedict_kelley
from mixedlub.report.friction_figures import COLOURS, GREY, figures
from mixedlub.study import read_study, run_study
from mixedlub.study.friction_comparison import compared

STUDY = """
schema = "mixedlub-study/1"
gears = { teeth = [16, 24], normal_module_mm = 4.5, profile_shift = [0.1817, 0.1715], face_width_mm = 14.0 }
lubricant = { temperature_C = [40, 100], kinematic_viscosity_mm2_s = [100, 11] }
surfaces = { ground = { m0_um2 = 0.1, m2 = 0.003, m4_per_um2 = 0.002 } }
conditions = { torque_Nm = [50, 183.4], speed_rpm = [1000, 2165], oil_temperature_C = [90] }
"""


@pytest.fixture
def study(tmp_path: Path) -> Path:
    path = tmp_path / "gears.toml"
    path.write_text(STUDY, encoding="utf-8")
    return path


def test_the_table_names_every_law_in_eighty_columns(capsys):
    assert main(["friction-laws"]) == 0
    said = capsys.readouterr().out
    assert max(map(len, said.splitlines())) <= 80
    assert all(f"\n  {name} " in said for name in catalogue())


@pytest.mark.parametrize("name", catalogue())
def test_a_page_has_equation_range_status_source_and_coefficients(name, capsys):
    assert main(["friction-laws", name]) == 0
    said = capsys.readouterr().out
    assert max(map(len, said.splitlines())) <= 80
    law = catalogue()[name]
    for word in ("equation", "reads", "range", "status", "source", *(c.name for c in law.coefficients)):
        assert f"\n  {word}" in said
    assert "\\" not in said


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["misharn"], "nearest known: 'misharin'"),
        (["misharin", "--study", "gears.toml"], "leave the name out"),
        (["--study", "gears.toml", "--pairing", "ground / groun"], "nearest known: 'ground / ground'"),
        (["--study", "gears.toml", "--coefficients", "laws.toml"], "nearest known: 'limiting_stress_ratio'"),
        (["--study", "gears.toml", "--coefficients", "words.toml"], "limiting_stress_ratio: 'much': must be a number"),
        (["--study", "gears.toml", "--coefficients", "flat.toml"], "must be a table of keys"),
        (["--study", "gears.toml", "--coefficients", "absent.toml"], "absent.toml: no such file"),
        (["--study", "gears.toml", "--format", "gif"], "no such format"),
        (["--study", "gears.toml", "--torque-Nm", "-5"], "torque_Nm"),
        (["--study", "nothing.toml"], "nothing.toml"),
        (["--torque-Nm", "5"], "--study"),
    ],
)
def test_bad_input_is_refused(words, said, study, capsys, monkeypatch):
    monkeypatch.chdir(study.parent)
    (study.parent / "laws.toml").write_text("[arana]\nlimiting_stress_rati = 0.05\n", encoding="utf-8")
    (study.parent / "words.toml").write_text('[arana]\nlimiting_stress_ratio = "much"\n', encoding="utf-8")
    (study.parent / "flat.toml").write_text("arana = 3\n", encoding="utf-8")
    assert main(["friction-laws", *words]) == 2
    assert said in capsys.readouterr().err
    assert not (study.parent / "out").exists()


def test_the_comparison_writes_tables_with_units_and_three_figures(study, tmp_path, capsys):
    (tmp_path / "laws.toml").write_text("[arana]\nlimiting_stress_ratio = 0.047\n", encoding="utf-8")
    out = tmp_path / "out"
    words = ["--study", str(study), "--coefficients", str(tmp_path / "laws.toml"), "--out", str(out)]
    assert main(["friction-laws", *words]) == 0
    assert "doleschel is left out: give film_friction" in capsys.readouterr().err
    for name in ("friction_along_path", "friction_over_ratio", "friction_of_mesh"):
        assert (out / "figures" / f"{name}.svg").read_text(encoding="utf-8").startswith("<svg")
    path, ratio, mesh = (pd.read_csv(out / f"{n}.csv") for n in ("along_path", "over_slide_roll_ratio", "mesh"))
    assert {"arana", "misharin", "schlenk"} <= set(path["law"])
    assert "doleschel" not in set(path["law"])
    assert list(path.columns[:2]) == ["law", "roll_angle_deg"]
    assert {"sliding_speed_m_s", "hertz_pressure_MPa", "validity"} <= set(path.columns)
    assert ratio["slide_roll_ratio"].agg(["min", "max"]).tolist() == [0.0, 2.0]
    assert len(mesh) == mesh["law"].nunique() * 4
    assert (out / "figures" / "captions.txt").read_text(encoding="utf-8").count(
        "183.4 N m, 2165 rpm, oil at 90 °C"
    ) == 3

    of_bk = path[path["law"] == "benedict_kelley"]
    at_pitch = of_bk[of_bk["sliding_speed_m_s"] == 0.0]
    assert at_pitch["validity"].tolist() == ["diverges"]
    assert at_pitch["friction"].isna().all()
    away = of_bk[of_bk["validity"] == "valid"]
    assert (away["slide_roll_ratio"] >= 0.02).all()
    misharin = path[path["law"] == "misharin"].set_index("roll_angle_deg")
    inside = misharin["validity"] == "valid"
    assert (misharin["slide_roll_ratio"][inside] >= 0.8 - 1e-9).all()
    assert (misharin["validity"] == "outside range").any()


def test_figures_are_grey_outside_the_range_of_a_law(study):
    comparison = compared(read_study(study), {})
    path = comparison.along_path()
    made, _ = figures(comparison, path, path.head(0), path.head(0))
    drawn = made["friction_along_path"]()
    (panel,) = (p for p in drawn.axes if p.get_title() == "Misharin")
    shown = {line.get_color(): np.isfinite(line.get_ydata()) for line in panel.lines}
    validity = path[path["law"] == "misharin"]["validity"].to_numpy()
    assert (shown[GREY] == (validity == "outside range")).all()
    assert (shown[COLOURS["contact"]] == (validity == "valid")).all()
    (panel,) = (p for p in drawn.axes if p.get_title() == "ISO TC60")
    assert not any(np.isfinite(line.get_ydata()).any() for line in panel.lines if line.get_color() == GREY)


def test_coefficients_of_the_study_itself_are_compared_with(study):
    text = study.read_text(encoding="utf-8")
    own = 'options = { friction = "constant", friction_coefficients = { friction = 0.04 } }\n'
    study.write_text(text + own, encoding="utf-8")
    comparison = compared(read_study(study), {}, speed_rpm=1500.0)
    path = comparison.along_path()
    assert path[path["law"] == "constant"]["friction"].unique().tolist() == [0.04]
    assert comparison.study.file.conditions.speed_rpm == (1500.0,)
    assert "schlenk" in set(path["law"])


def test_the_mesh_table_is_that_of_studies_with_the_law(study, tmp_path):
    assert main(["friction-laws", "--study", str(study), "--no-figures", "--out", str(tmp_path / "out")]) == 0
    mesh = pd.read_csv(tmp_path / "out" / "mesh.csv")
    for name in ("schlenk", "xu_kahraman"):
        own = tmp_path / f"{name}.toml"
        own.write_text(STUDY + f'options = {{ friction = "{name}" }}\n', encoding="utf-8")
        found = run_study(read_study(own)).to_pandas()
        rows = mesh[mesh["law"] == name]
        assert rows["mesh_loss_W"].to_numpy() == pytest.approx(found["mesh_loss_W"].to_numpy(), rel=1e-8)


def test_friction_along_a_path_in_python_says_where_its_law_holds():
    pair = ml.gear_pair(teeth=(16, 24), normal_module_mm=4.5, face_width_mm=14.0)
    ground = ml.surface(m0_um2=0.1, m2=0.003, m4_per_um2=0.002)
    at = {"torque_Nm": 183.4, "speed_rpm": 2165, "oil_temperature_C": 90}
    path = ml.along_path(pair, ml.oil("mineral"), ground, **at, options={"friction": "benedict_kelley"})
    holds = path["friction_validity"] == "valid"
    slow = path["sliding_speed_m_s"] < 0.02 * path["entrainment_speed_m_s"]
    assert (holds == ~slow).all()
    oil = ml.power_loss(pair, ml.oil("mineral"), ground, **at)
    assert "friction_validity" not in oil
    viscosity = 11.2e-6 * 885.0 * (1 - 6.5e-4 * 85)
    hot = ml.along_path(
        pair, ml.oil("mineral"), ground, **at | {"oil_temperature_C": 100}, options={"friction": "benedict_kelley"}
    )
    expected = benedict_kelley(
        1e3 * hot["line_load_N_mm"].to_numpy(),
        np.sqrt(0.2) * 1e-6,
        viscosity,
        hot["sliding_speed_m_s"].to_numpy(),
        hot["entrainment_speed_m_s"].to_numpy(),
    )
    assert hot["friction"].to_numpy() == pytest.approx(expected, rel=1e-9)
