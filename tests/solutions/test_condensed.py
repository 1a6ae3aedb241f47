"""Condensed friction: the regression, its file, and fresh solutions within its stated error."""

import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from mixedlub.cli import main
from mixedlub.ehl import example_oil, read_oil
from mixedlub.ehl.solve import CONVERGED, Way
from mixedlub.friction.condensed import COEFFICIENTS, INPUTS, condensed
from mixedlub.solutions import condensed_points as points
from mixedlub.solutions import regression
from mixedlub.solutions.law_file import against_published, law_file
from profiles.errors import InputError, RunError

EXAMPLE = Path(__file__).parents[2] / "examples" / "condensed_m100.toml"
COUNT = 300
OF_OIL = points.properties_of(example_oil())


def planted(noise: float) -> pd.DataFrame:
    """Solutions whose friction is a power law with scatter."""
    random = np.random.default_rng(1)
    found = points.draw(example_oil(), COUNT, seed=2)
    values = points.inputs_of(example_oil(), found)
    table = pd.DataFrame({one.column: values[one.name] / one.factor for one in INPUTS})
    table["friction"] = 0.02 * table["hertz_pressure_GPa"] ** 0.5 * table["viscosity_mPa_s"] ** 0.1
    table["friction"] *= np.exp(noise * random.standard_normal(COUNT))
    table["sliding"] = np.where(found.sliding < 0.0, "first faster", "second faster")
    table["status"] = CONVERGED
    return table


def test_a_power_law_is_found_and_scatter_is_the_stated_error() -> None:
    exact = regression.regression(planted(0.0), OF_OIL)
    assert exact.coefficients["c_p"] == pytest.approx(0.5)
    assert exact.coefficients["c_v"] == pytest.approx(0.1)
    assert exact.fit["left_out_rms_of_log"] == pytest.approx(0.0, abs=1e-9)
    scattered = regression.regression(planted(0.05), OF_OIL)
    assert scattered.fit["left_out_rms_of_log"] == pytest.approx(0.05, rel=0.25)
    error = scattered.standard_errors["c_p"]
    assert abs(scattered.coefficients["c_p"] - 0.5) < 4.0 * error
    assert scattered.table["left_out"].sum() == COUNT // regression.EVERY


def test_too_few_solutions_say_how_many_are_needed() -> None:
    table = planted(0.0)
    table.loc[60:, "status"] = "no solution"
    with pytest.raises(RunError, match="60 contacts have a solution; the regression needs"):
        regression.regression(table, OF_OIL)


def test_contacts_slide_both_ways_at_all_pressures() -> None:
    found = points.draw(example_oil(), 200, seed=1)
    backwards = found.sliding < 0.0
    assert backwards.mean() == pytest.approx(0.5, abs=0.1)
    assert found.pressure[backwards].mean() == pytest.approx(found.pressure[~backwards].mean(), rel=0.1)
    with pytest.raises(InputError, match="of 20 contacts"):
        points.draw(replace(example_oil(), largest_pressure=0.3e9), 20, seed=1)


@pytest.mark.long
@pytest.mark.filterwarnings("ignore:lubricant")
def test_fresh_solutions_are_within_the_stated_error() -> None:
    file = tomllib.loads(EXAMPLE.read_text())
    oil = read_oil("m100")
    found = points.draw(oil, 8, seed=777)
    table = points.solved_table(oil, found, Way())
    table = table[table["status"] == CONVERGED]
    law = condensed(*(table[one.column].to_numpy() * one.factor for one in INPUTS), **file["coefficients"])
    off = np.log(table["friction"].to_numpy() / law)
    stated = file["fit"]["left_out_rms_of_log"]
    assert stated < 0.1
    assert len(off) >= 6
    assert np.sqrt(np.mean(off**2)) < 1.6 * stated


def test_the_file_has_every_coefficient_and_the_published_law_is_compared_over_its_range() -> None:
    found = regression.regression(planted(0.02), OF_OIL)
    file = tomllib.loads(law_file('an "oil"', found))
    assert file["coefficients"].keys() == {c.name for c in COEFFICIENTS}
    assert file["oil"] == 'an "oil"'
    against = against_published(found)
    assert against["hertz_pressure_GPa"].max() == pytest.approx(file["coefficients"]["largest_hertz_pressure_GPa"])
    ratio = against["published_friction"] / against["condensed_friction"]
    assert against["published_over_condensed"].to_numpy() == pytest.approx(ratio.to_numpy())


def test_the_command_writes_law_tables_and_figures(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("mixedlub.solutions.condensed_points.solved_table", lambda oil, found, way: planted(0.03))
    assert main(["condense", "atf", "--solutions", "150", "--out", str(tmp_path)]) == 0
    written = {path.name for path in tmp_path.iterdir()}
    tables = {f"{name}.{end}" for name in ("solutions", "terms", "against_published") for end in ("csv", "parquet")}
    assert written == {"atf_friction.toml", "origin.json", *tables, "figures"}
    assert {path.suffix for path in (tmp_path / "figures").iterdir()} == {".svg"}
    assert "300 contacts solved" in capsys.readouterr().out
    assert main(["condense", "no_oil", "--out", str(tmp_path / "none")]) == 2
    assert not (tmp_path / "none").exists()
