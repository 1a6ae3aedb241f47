"""A study takes a condensed friction law from its file, flags what is beyond its range, and refuses other files."""

import tomllib
from pathlib import Path
from typing import Any

import pandas as pd
import pytest

from mixedlub.cli import main
from mixedlub.study import checkpoint, read_study, run_study

EXAMPLE = Path(__file__).parents[2] / "examples" / "condensed_m100.toml"


OF_OIL = {"lubricant": {"oil": "m100"}}


def test_a_study_takes_the_law_from_its_file(write_study: Any, tmp_path: Path) -> None:
    text = EXAMPLE.read_text()
    (tmp_path / "law.toml").write_text(text)
    options = {"friction": "condensed", "friction_coefficients": "law.toml"}
    study = read_study(write_study(**OF_OIL, options=options))
    found = run_study(study)
    spelt = {"friction": "condensed", "friction_coefficients": tomllib.loads(text)["coefficients"]}
    again = run_study(read_study(write_study(**OF_OIL, options=spelt)))
    assert found["mesh_loss"].tolist() == again["mesh_loss"].tolist()
    (tmp_path / "law.toml").write_text(text.replace("c_0 = -", "c_0 = -1"))
    other = read_study(write_study(**OF_OIL, options=options))
    assert checkpoint.fingerprint(other.plan) != checkpoint.fingerprint(study.plan)


@pytest.mark.parametrize(
    ("oil", "said"),
    [
        (
            {"oil": "atf"},
            "oil_viscosity_40C: the law is made from an oil of 83.3 mPa s, that of the study, Automatic transmission",
        ),
        (
            {"oil": "m100", "eyring_stress_MPa": 8.0},
            "oil_eyring_stress: the law is made from an oil of 4.9 MPa, that of the study, M100",
        ),
        ({"oil": "m100", "pressure_viscosity_per_GPa": [12.0, 9.0]}, "oil_pressure_viscosity_40C"),
    ],
)
def test_the_law_of_another_oil_is_refused(
    oil: dict[str, Any], said: str, write_study: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    own = {"friction": "condensed", "friction_coefficients": str(EXAMPLE)}
    out = ["--no-figures", "--out", str(tmp_path / "out")]
    assert main(["study", str(write_study(lubricant=oil, options=own)), *out]) == 2
    assert said in capsys.readouterr().err
    assert not (tmp_path / "out").exists()
    (tmp_path / "laws.toml").write_text(f'condensed = "{EXAMPLE}"\n')
    words = ["friction-laws", "--study", str(write_study(lubricant=oil)), "--coefficients", str(tmp_path / "laws.toml")]
    assert main([*words, *out[1:]]) == 2
    assert f"--coefficients: condensed: {said}" in capsys.readouterr().err


def test_an_oil_as_it_is_measured_again_is_the_same_oil(write_study: Any) -> None:
    oil = {"oil": "m100", "eyring_stress_MPa": 4.7}
    own = {"friction": "condensed", "friction_coefficients": str(EXAMPLE)}
    assert run_study(read_study(write_study(lubricant=oil, options=own)))["mesh_loss"].min() > 0.0


def test_conditions_beyond_the_solutions_are_flagged(write_study: Any) -> None:
    coefficients = tomllib.loads(EXAMPLE.read_text())["coefficients"]
    options = {"friction": "condensed", "friction_coefficients": coefficients | {"largest_hertz_pressure_GPa": 0.41}}
    results = run_study(read_study(write_study(**OF_OIL, options=options)))
    assert results.flags["law_extrapolated:condensed"].any()
    (told,) = (one.text for one in results.findings if one.code == "law_extrapolated")
    most = 1e-6 * results["hertz_pressure"].max()
    assert f"to 410 MPa, here up to {most:.4g} MPa" in told


@pytest.mark.parametrize(
    ("file", "content", "said"),
    [
        ("lw.toml", None, "nearest known: 'law.toml'"),
        ("law.toml", 'schema = "mixedlub-frictin/1"\n', "schema"),
        ("law.toml", "", "schema"),
        ("law.toml", EXAMPLE.read_text().replace('law = "condensed"', 'law = "crook"'), "law"),
    ],
)
def test_a_file_that_is_no_law_is_refused(
    file: str, content: str | None, said: str, write_study: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "law.toml").write_text(EXAMPLE.read_text() if content is None else content)
    path = write_study(**OF_OIL, options={"friction": "condensed", "friction_coefficients": file})
    assert main(["study", str(path), "--no-figures", "--out", str(tmp_path / "out")]) == 2
    message = capsys.readouterr().err
    assert said in message
    assert "Traceback" not in message


def test_the_law_is_compared_from_its_file_with_its_range(write_study: Any, tmp_path: Path) -> None:
    (tmp_path / "laws.toml").write_text(f'condensed = "{EXAMPLE}"\n')
    words = ["friction-laws", "--study", str(write_study(**OF_OIL)), "--coefficients", str(tmp_path / "laws.toml")]
    assert main([*words, "--format", "png", "--out", str(tmp_path / "out")]) == 0
    table = pd.read_csv(tmp_path / "out" / "over_slide_roll_ratio.csv")
    own = table[table["law"] == "condensed"]
    assert (own["friction"] >= 0.0).all()
    assert (own["validity"][own["slide_roll_ratio"] > 1.2] == "outside range").all()
