"""An answer that takes every reading for wrong is written all the same, and says that it says nothing."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from mixedlub.diagnosis.assessment.answer_checks import outlier_levels
from mixedlub.diagnosis.assessment.mismatch_test import beyond_noise
from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.report.files import files
from mixedlub.diagnosis.report.text import words
from mixedlub.schema.table import Table


@pytest.fixture(scope="module")
def written(teeth: Diagnosis) -> dict[str, str]:
    """Everything written for a recording whose every reading counts as wrong."""
    return files(replace(teeth, outlier_chance=np.ones(teeth.readings.size)))


@pytest.mark.long
def test_every_figure_is_drawn(written: dict[str, str], teeth: Diagnosis) -> None:
    assert "figures/empirical_form.svg" in written
    assert set(written) == set(files(teeth))
    assert "nan" not in written["figures/recorded_against_simulated.svg"]


@pytest.mark.long
def test_no_number_is_told_of_no_reading(written: dict[str, str], teeth: Diagnosis) -> None:
    assert np.isfinite(json.loads(written["diagnosis.json"])["fit"]["noise_rms"])
    assert f"for {teeth.readings.size} readings after calibration" in written["report.txt"].replace("\n  ", " ")


def test_that_nothing_is_missing_is_not_said_where_every_reading_counts_as_wrong(teeth: Diagnosis) -> None:
    lost = replace(teeth.search.null_fit, residual=np.full(teeth.readings.size, 50.0))
    found = replace(teeth.search, null_fit=lost)
    test = beyond_noise(found, 10.0, replace(teeth.test, p_value=0.5, detected=False))
    assert test.detected
    assert 0.0 < test.p_value < 1e-300


def test_the_headline_begins_with_it(written: dict[str, str], teeth: Diagnosis) -> None:
    said = words.headline(replace(teeth, outlier_chance=np.ones(teeth.readings.size)))
    assert said.startswith("No answer: every reading counts as wrong")
    assert "No answer" not in words.headline(teeth)


def test_levels_are_not_told_one_by_one_where_nearly_all_is_wrong() -> None:
    table = Table({"run": np.arange(1, 41), "speed_rpm": np.repeat([100.0, 200.0], 20)})
    assert outlier_levels(table, np.arange(40) < 20, np.ones(40))
    assert not outlier_levels(table, np.arange(40) < 36, np.ones(40))
