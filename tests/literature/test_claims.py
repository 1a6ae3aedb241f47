"""Claims of four papers: the page is what the numbers say, and the formulas' numbers are what the models give."""

from __future__ import annotations

import math
import runpy
import sys
from pathlib import Path
from typing import Any

import pytest

FOLDER = Path(__file__).parents[2] / "examples" / "published"
pytestmark = pytest.mark.literature(
    "Measurement and Modelling of Friction for Cylindrical Gears with Pitch Line Velocities up to 100 m/s; Rebbechi, "
    "Oswald and Townsend (1996); Vaishya and Houser (1999); Xu (2005)"
)


@pytest.fixture(scope="module")
def script() -> dict[str, Any]:
    return runpy.run_path(str(FOLDER / "claims.py"))


@pytest.fixture(scope="module")
def numbers(script: dict[str, Any]) -> Any:
    return script["read"]()


def test_the_page_is_what_the_numbers_say(script: dict[str, Any], numbers: Any) -> None:
    assert (FOLDER / "claims.md").read_text(encoding="utf-8") == script["page"](numbers)


def test_every_claim_has_its_numbers(script: dict[str, Any], numbers: Any) -> None:
    """A value inside its band, but for the point contacts of paper C, which have no full solutions."""
    for claim in script["CLAIMS"]:
        for model in script["MODELS"]:
            found = numbers[claim.paper, claim.words, model]
            if claim.paper == "C" and model != "formulas":
                assert math.isnan(found["value"])
            else:
                assert found["low"] <= found["value"] <= found["high"]


@pytest.mark.parametrize("paper", ["A", "B", "C", "D"])
@pytest.mark.parametrize("model", ["formulas", "formulas, yielding"])
def test_kept_numbers_of_the_formulas_are_those_of_the_models(
    script: dict[str, Any], numbers: Any, paper: str, model: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "path", [str(FOLDER), *sys.path])
    models = runpy.run_path(str(FOLDER / "claim_models.py"))
    found = models["OF"][paper](models["NOMINAL"], False, model.endswith("yielding"))
    kept = [numbers[paper, one.words, model]["value"] for one in script["CLAIMS"] if one.paper == paper]
    assert found == pytest.approx(kept, rel=2e-3, abs=2e-3, nan_ok=True)


SMOOTH = ("A", "speed 20 to 95 m/s, geometry B, superfinished")


def test_superfinished_friction_falls_with_speed_in_full_solutions_alone(numbers: Any) -> None:
    """The paper sees the fall for both finishes; the formulas know no heat, and rise at every corner."""
    assert numbers[*SMOOTH, "formulas"]["low"] > 0.0
    assert numbers[*SMOOTH, "full"]["high"] < 0.0
