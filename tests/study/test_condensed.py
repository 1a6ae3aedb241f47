"""A study takes a condensed friction law from its file, flags what is beyond its range, and refuses other files."""

import tomllib
from pathlib import Path
from typing import Any

import pandas as pd
import pytest

from mixedlub.cli import main
from mixedlub.study import checkpoint, read_study, run_study

EXAMPLE = Path(__file__).parents[2] / "examples" / "condensed_m100.toml"


def test_a_study_takes_the_law_from_its_file(write_study: Any, tmp_path: Path) -> None:
    text = EXAMPLE.read_text()
    (tmp_path / "law.toml").write_text(text)
    options = {"friction": "condensed", "friction_coefficients": "law.toml"}
    study = read_study(write_study(options=options))
    found = run_study(study)
    spelt = {"friction": "condensed", "friction_coefficients": tomllib.loads(text)["coefficients"]}
    assert found["mesh_loss"].tolist() == run_study(read_study(write_study(options=spelt)))["mesh_loss"].tolist()
    (tmp_path / "law.toml").write_text(text.replace("c_0 = -", "c_0 = -1"))
    assert checkpoint.fingerprint(read_study(write_study(options=options)).plan) != checkpoint.fingerprint(study.plan)


def test_conditions_beyond_the_solutions_are_flagged(write_study: Any) -> None:
    coefficients = tomllib.loads(EXAMPLE.read_text())["coefficients"]
    options = {"friction": "condensed", "friction_coefficients": coefficients | {"largest_hertz_pressure_GPa": 0.41}}
    assert run_study(read_study(write_study(options=options))).flags["law_extrapolated:condensed"].any()


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
    path = write_study(options={"friction": "condensed", "friction_coefficients": file})
    assert main(["study", str(path), "--no-figures", "--out", str(tmp_path / "out")]) == 2
    message = capsys.readouterr().err
    assert said in message
    assert "Traceback" not in message


def test_the_law_is_compared_from_its_file_with_its_range(write_study: Any, tmp_path: Path) -> None:
    (tmp_path / "laws.toml").write_text(f'condensed = "{EXAMPLE}"\n')
    words = ["friction-laws", "--study", str(write_study()), "--coefficients", str(tmp_path / "laws.toml")]
    assert main([*words, "--format", "png", "--out", str(tmp_path / "out")]) == 0
    table = pd.read_csv(tmp_path / "out" / "over_slide_roll_ratio.csv")
    own = table[table["law"] == "condensed"]
    assert (own["friction"] >= 0.0).all()
    assert (own["validity"][own["slide_roll_ratio"] > 1.2] == "outside range").all()
