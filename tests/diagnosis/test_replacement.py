"""A law that takes the place of a quantity: found where a factor would have to undo the base model."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from mixedlub.api.diagnosis import Answer
from mixedlub.case.files import case_files
from mixedlub.case.folder import read_case
from mixedlub.case.simulation import simulate
from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case
from mixedlub.diagnosis.report.files import write
from mixedlub.schema.findings import collected


@pytest.fixture(scope="module")
def plain(
    make_case: Callable[..., Path], excluded: tuple[str, ...], tmp_path_factory: pytest.TempPathFactory
) -> Diagnosis:
    """Discs whose friction knows no film and no oil: 0.05 (load/3000 N)^-0.3."""

    def change(conditions: dict[str, np.ndarray], base: np.ndarray) -> np.ndarray:
        return 0.05 * (conditions["load_N"] / 3000.0) ** -0.3 + 0.0 * base

    return diagnose_case(make_case(tmp_path_factory.mktemp("plain"), "disc", change), exclude=excluded)


def test_a_power_law_in_place_of_the_friction_is_found(plain: Diagnosis) -> None:
    law = Answer(plain).record["law"]
    assert (law["acts_on"], law["form"]) == ("friction", "replace")
    (exponent,) = [p for p in law["parameters"] if f"^{p['name']}" in law["expression"]]
    assert exponent["low90"] < -0.3 < exponent["high90"]
    assert exponent["high90"] - exponent["low90"] < 0.05
    assert law["heldout_after"] < 1.2 < 5.0 < law["heldout_before"]
    assert "in place of the friction" in str(Answer(plain))


def test_a_replacement_holds_where_all_conditions_were_recorded(plain: Diagnosis, tmp_path: Path) -> None:
    assert plain.law is not None
    assert set(plain.law.conditions) >= {"load_N", "entrainment_speed_m_s", "slide_roll_ratio", "oil_temperature_C"}
    write(case_files(Answer(plain).improved), tmp_path / "improved")
    case = read_case(tmp_path / "improved")
    rows = plain.search.problem.rows
    with collected():
        simulated = simulate(case)[case.quantity].to_numpy()
    assert simulated == pytest.approx(0.05 * (rows["load_N"] / 3000.0) ** -0.3, rel=0.02)
