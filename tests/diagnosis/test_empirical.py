"""The power law finds what was put in, and finds nothing where nothing simple is."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from mixedlub.diagnosis.assessment.power_law import absorbing_stages, features, power_law
from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case
from mixedlub.effects import catalogue

pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def lawful(make_case: Callable[..., Path], tmp_path_factory: pytest.TempPathFactory) -> Diagnosis:
    """A gear rig that loses 12 W more at 1000 rpm, growing with the square of speed, less with torque's root."""

    def change(conditions: dict[str, np.ndarray], base: np.ndarray) -> np.ndarray:
        return base + 12.0 * (conditions["speed_rpm"] / 1000.0) ** 2 * (conditions["torque_Nm"] / 100.0) ** -0.5

    folder = make_case(tmp_path_factory.mktemp("lawful"), "gear_pair", change)
    return diagnose_case(folder, exclude=tuple(catalogue()))


def test_law_that_was_put_in_is_found(lawful: Diagnosis) -> None:
    law = power_law(lawful.search)
    assert law is not None
    assert dict(law.factors) == {"speed_rpm": Fraction(2), "torque_Nm": Fraction(-1, 2)}
    assert not law.relative


def test_coefficient_of_the_law_is_right(lawful: Diagnosis) -> None:
    law = power_law(lawful.search)
    assert law is not None
    middle = dict(zip((name for name, _ in law.factors), law.middles, strict=True))
    put_in = 12.0 * (middle["speed_rpm"] / 1000.0) ** 2 * (middle["torque_Nm"] / 100.0) ** -0.5
    assert law.coefficient == pytest.approx(put_in, rel=0.05)


def test_law_is_written_with_units(lawful: Diagnosis) -> None:
    law = power_law(lawful.search)
    assert law is not None
    assert law.text.startswith("missing part = ")
    assert " W × " in law.text
    assert "rpm)^2" in law.text
    assert "N m)^(-1/2)" in law.text


def test_law_predicts_levels_left_out(lawful: Diagnosis) -> None:
    law = power_law(lawful.search)
    assert law is not None
    assert law.heldout_after < 0.3 * law.heldout_before


@pytest.mark.long
def test_no_simple_law_for_a_bump(unnamed: Diagnosis) -> None:
    assert power_law(unnamed.search) is None


def test_no_simple_law_where_nothing_is_missing(complete: Diagnosis) -> None:
    assert power_law(complete.search) is None


def test_features_are_positive_and_differ(unnamed: Diagnosis) -> None:
    values = features(unnamed.search)
    logs = np.array([np.log(v) for v in values.values()])
    assert np.isfinite(logs).all()
    alike = np.corrcoef(logs) - np.eye(len(logs))
    assert np.abs(alike).max() < 0.9999


def test_film_ratio_is_offered_where_there_is_a_film(unnamed: Diagnosis) -> None:
    assert "film_ratio" in features(unnamed.search)


def test_stage_that_was_changed_absorbs_best(
    make_case: Callable[..., Path], tmp_path_factory: pytest.TempPathFactory
) -> None:
    """Boundary friction that halves in hot oil is best absorbed by boundary friction."""
    from mixedlub.case.folder import read_case
    from mixedlub.case.forward import Forward

    folder = make_case(tmp_path_factory.mktemp("boundary"), "gear_pair")

    def change(conditions: dict[str, np.ndarray], base: np.ndarray) -> np.ndarray:
        case = read_case(folder)
        assert case.recordings is not None
        low = Forward(case, case.recordings).predict({"boundary_friction": 0.05})
        return np.where(conditions["oil_temperature_C"] > 80.0, low, base)

    spoilt = make_case(tmp_path_factory.mktemp("boundary_low"), "gear_pair", change)
    found = diagnose_case(spoilt, exclude=tuple(catalogue())).search
    assert absorbing_stages(found)[0].stage == "boundary"
