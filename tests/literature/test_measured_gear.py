"""The gear with measured loss: its page is what the script writes, and its rows are right where a paper says so."""

from __future__ import annotations

import runpy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

FOLDER = Path(__file__).parents[2] / "examples" / "published"
pytestmark = pytest.mark.literature("Petry-Johnson's gear in a thesis of Seoul National University, tables 3.7 to 3.12")


@pytest.fixture(scope="module")
def script() -> dict[str, Any]:
    return runpy.run_path(str(FOLDER / "measured_gear.py"))


@pytest.fixture(scope="module")
def page(script: dict[str, Any]) -> str:
    return str(script["page"]())


def test_the_page_is_what_the_script_writes(page: str) -> None:
    assert (FOLDER / "measured_gear.md").read_text(encoding="utf-8") == page
    assert "| **measured** | **170 ± 4** | **303 ± 17** | **478 ± 21** | **619 ± 14** | **555 ± 85** |" in page


def test_the_row_of_xu_is_the_column_of_the_thesis(page: str) -> None:
    (row,) = (line for line in page.splitlines() if line.startswith("| Xu and Kahraman"))
    found = np.array([float(cell) for cell in row.split("|")[2:7]])
    assert found[:4] == pytest.approx([112.0, 213.0, 316.0, 399.0], rel=0.04)
    assert abs(found[4] - 424.0) < 70.0


def test_the_measured_loss_is_the_quotient_of_the_printed_errors(script: dict[str, Any]) -> None:
    """Xu's errors in loss, 33.9, 29.7, 33.8, 35.5 and 23.7 %, lead from the measured loss to that of the model."""
    errors = np.array([33.9, 29.7, 33.8, 35.5, 23.7]) / 100.0
    model = np.array(script["MEASURED"]) * (1.0 - errors)
    assert model == pytest.approx([112.0, 213.0, 316.0, 399.0, 424.0], rel=5e-3)
