"""`mixedlub law-errors`: tables from kept solutions, solving anew, and bad input."""

from pathlib import Path

import pandas as pd
import pytest

from mixedlub.cli import main
from mixedlub.solutions import kept as solutions

pytestmark = pytest.mark.filterwarnings("ignore:lubricant")


@pytest.fixture(scope="module")
def one_oil(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The kept solutions of one oil, as a file."""
    path = tmp_path_factory.mktemp("kept") / "one.csv"
    kept = solutions.read_solutions(solutions.KEPT)
    kept[kept["oil"] == "atf"].to_csv(path, index=False, lineterminator="\n", float_format="%.4g")
    return path


def test_tables_say_how_wrong_each_law_is(one_oil: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["law-errors", "--solutions", str(one_oil), "--no-figures", "--out", str(tmp_path)]) == 0
    laws, fits = (pd.read_csv(tmp_path / f"{name}.csv") for name in ("laws", "fits"))
    central = laws.set_index(["law", "oil"]).loc[("dowson_toyoda_central", "atf")]
    assert 1.1 < central["median_ratio"] < 1.3
    film = fits.set_index(["ratio", "oil"]).loc[("film_over_law", "atf")]
    assert -0.08 < film["load_exponent"] < -0.03
    assert pd.read_csv(tmp_path / "solutions.csv").equals(pd.read_csv(one_oil))
    assert "dowson_toyoda_central" in capsys.readouterr().out
    assert not (tmp_path / "figures").exists()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["no_such_oil"], "pao"),
        (["m100", "--solutions", "any.csv"], "leave the oils out"),
        (["--solutions", "any.csv"], "no such file"),
        (["--rigs", "3"], "is for oils that are solved"),
        (["--scheduler", "tcp://localhost:8786"], "is for oils that are solved"),
    ],
)
def test_bad_input_is_said_in_one_line(
    words: list[str], message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["law-errors", *words, "--out", str(tmp_path / "out")]) == 2
    said = capsys.readouterr().err
    assert message in said
    assert "Traceback" not in said
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("spoiled", ["column", "number"])
def test_a_table_that_is_not_of_solutions_is_refused(
    spoiled: str, one_oil: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    table = pd.read_csv(one_oil)
    table = table.drop(columns="radius_mm") if spoiled == "column" else table.astype({"radius_mm": object})
    if spoiled == "number":
        table.loc[3, "radius_mm"] = "wide"
    table.to_csv(tmp_path / "bad.csv", index=False)
    assert main(["law-errors", "--solutions", str(tmp_path / "bad.csv"), "--out", str(tmp_path / "out")]) == 2
    said = capsys.readouterr().err
    assert "radius_mm" in said
    assert spoiled == "column" or "line 5" in said


@pytest.mark.parametrize(
    ("column", "value", "said"),
    [
        ("line_load_N_mm", -1.0, "line 2: line_load_N_mm: -1.0: must be above 0"),
        ("entrainment_speed_m_s", float("nan"), "entrainment_speed_m_s: nan: must be above 0"),
        ("thermal_status", "yes", "thermal_status: 'yes': must be 'converged' or 'no solution'"),
        ("oil", 3, "'3': no such oil"),
        (None, None, "has no rows"),
    ],
)
def test_values_that_are_none_of_a_contact_are_refused(
    column: str | None, value: object, said: str, one_oil: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    table = pd.read_csv(one_oil)
    table = table.head(0) if column is None else table.assign(**{column: value})
    table.to_csv(tmp_path / "bad.csv", index=False)
    assert main(["law-errors", "--solutions", str(tmp_path / "bad.csv"), "--out", str(tmp_path / "out")]) == 2
    assert said in capsys.readouterr().err
