"""Load shares of asperities beside published ones: the page is what the script writes, and how far they are apart."""

from __future__ import annotations

import runpy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

FOLDER = Path(__file__).parents[2] / "examples" / "published"
pytestmark = pytest.mark.literature(
    "Aihara, J. Tribol. 109 (1987) 471, eq. 13; Zhou and Hoeprich, J. Tribol. 113 (1991) 590, eq. 29; "
    "Arana, Larranaga and Ulacia, Proc. IMechE J 233 (2019) 303, eq. 14"
)


@pytest.fixture(scope="module")
def script() -> dict[str, Any]:
    return runpy.run_path(str(FOLDER / "asperity_shares.py"))


@pytest.fixture(scope="module")
def found(script: dict[str, Any]) -> dict[tuple[str, str], np.ndarray]:
    return dict(script["computed"]())


def test_the_page_is_what_the_script_writes(script: dict[str, Any], found: dict[tuple[str, str], np.ndarray]) -> None:
    script["page"].__globals__["computed"] = lambda: found
    assert (FOLDER / "asperity_shares.md").read_text(encoding="utf-8") == script["page"]()


def test_published_curves_are_as_printed(script: dict[str, Any]) -> None:
    """1 - erf(0.5) and 1 - erf(1), as printed in the table of Arana's law; Diab's quarter."""
    laws = list(script["PUBLISHED"].values())
    assert laws[3](np.array([0.5, 1.0])) == pytest.approx([0.4795, 0.1573], abs=1e-4)
    assert next(iter(script["FRICTION"].values()))(0.5) == pytest.approx(0.1543, abs=1e-4)


@pytest.mark.parametrize(
    ("surface", "model", "factor"),
    [
        ("0302", "flattened", 1.8),
        ("0258", "flattened", 1.8),
        ("0302", "flattened, cut-off 8 µm", 1.3),
        ("0302", "flattened, cut-off b/50", 1.3),
        ("0036", "flattened", 1.5),
    ],
)
def test_flattened_shares_are_near_the_published_ones(script, found, surface, model, factor) -> None:
    assert script["beyond"](found[surface, model]) <= factor


def test_waves_as_measured_carry_far_too_much(script, found) -> None:
    assert script["beyond"](found["0302", "as measured"]) > 4.0
