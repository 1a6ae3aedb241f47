"""Straight lines of the loss over roughness, a row a condition."""

import csv

import numpy as np
import pytest

from mixedlub.cli import main
from mixedlub.schema.table_files import write_long
from mixedlub.study import read_study, run_study
from mixedlub.study.fits import can_be_fitted, fit_columns, fits, fits_table, straight_line


def test_a_known_line_is_found_and_its_square_is_that_of_the_correlation():
    x = np.array([0.1, 0.2, 0.4, 0.7])
    y = 3.0 + 20.0 * x + np.array([0.1, -0.1, 0.2, -0.2])
    line = straight_line(x, y)
    slope, intercept = np.polyfit(x, y, 1)
    assert (line.slope, line.intercept) == pytest.approx((slope, intercept))
    assert line.square == pytest.approx(np.corrcoef(x, y)[0, 1] ** 2)
    assert line.residual == pytest.approx(np.sqrt(np.mean((y - np.polyval((slope, intercept), x)) ** 2)))


def test_every_condition_has_its_line(write_study, tmp_path):
    results = run_study(read_study(write_study()))
    write_long(fits_table(results), fit_columns(), tmp_path / "fits.csv", tmp_path / "fits.parquet")
    with (tmp_path / "fits.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == [c.name for c in fit_columns()]
    assert len(rows) == 2 * 2 * 3
    table = results.to_pandas()
    for row in rows:
        at = (table[list(row)[:3]] == [float(row[name]) for name in list(row)[:3]]).all(axis=1)
        x, y = (table[name][at].to_numpy() for name in ("composite_roughness_um", "power_loss_W"))
        slope, intercept = np.polyfit(x, y, 1)
        found = [float(row[name]) for name in ("slope_W_per_um", "intercept_W", "r_squared", "pairings")]
        assert found == pytest.approx([slope, intercept, np.corrcoef(x, y)[0, 1] ** 2, 6])


def test_too_few_pairings_have_no_lines(write_study, tmp_path):
    path = write_study(pairings={"pinion": ["fine"], "gear": ["mid", "coarse"]})
    assert not can_be_fitted(run_study(read_study(path)))
    assert main(["study", str(path), "--no-figures", "--out", str(tmp_path / "o")]) == 0
    assert (tmp_path / "o" / "fits.csv").read_text().splitlines() == [",".join(c.name for c in fit_columns())]


def test_columns_of_the_lines_have_units_and_meanings(write_study):
    units = {c.name: c.unit for c in fit_columns()}
    assert units["slope_W_per_um"] == "W/µm"
    assert units["intercept_W"] == units["area_ratio_slope_W"] == "W"
    assert all(c.meaning for c in fit_columns())
    assert fits(run_study(read_study(write_study()))).column_names == list(units)
