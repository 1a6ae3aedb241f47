"""The page of a study of traces shows how its fits move with the short cut-off."""

from pathlib import Path

import pytest

from mixedlub.report.cutoff_table import cutoff_rows
from mixedlub.report.page import findings
from mixedlub.schema.findings import codes
from mixedlub.study import read_study, run_study

EXAMPLE = Path(__file__).parents[2] / "examples" / "study_21_pairings.toml"


@pytest.fixture(scope="module")
def shipped():
    return run_study(read_study(EXAMPLE))


def test_fits_of_the_shipped_study_move_with_the_short_cutoff(shipped):
    """An independent computation has the same R^2 and area ratios at 2.5 and 8 um."""
    rows = {row[0]: row[1:] for row in cutoff_rows(shipped)}
    assert rows["2.5"] == ("0.959", "0.989", "0.33")
    assert rows["8"] == ("0.703", "0.979", "0.20")


def test_the_page_says_where_the_line_fits_least(shipped):
    assert any("0.959" in text and "500 rpm" in text for text in findings(shipped))


def test_the_page_says_what_is_left_above_a_film_parameter_of_one(shipped):
    """A mean of 0.22 over the conditions, most at speed."""
    (told,) = (text for text in findings(shipped) if "left above a film parameter of 1" in text)
    assert "30 % at 3000 rpm" in told


def test_the_shipped_study_says_what_was_chosen_and_what_it_misses(shipped):
    description = shipped.study.file.description
    assert "chosen" in description
    assert "500 rpm" in description
    assert "2500 and 3000 rpm" in description


def test_shipped_traces_are_told_to_be_synthetic(shipped):
    assert "trace_synthetic" in codes(shipped.study.notes)


def test_moments_have_no_cutoff(write_study):
    assert cutoff_rows(run_study(read_study(write_study()))) == []
