"""A law that takes the place of a quantity: found where a factor would have to undo the base model."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mixedlub.api.diagnosis import Answer
from mixedlub.case.files import case_files
from mixedlub.case.folder import read_case
from mixedlub.case.simulation import simulate
from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case
from mixedlub.diagnosis.discovery.files import as_effect, law_data
from mixedlub.diagnosis.discovery.laws import _distinct, _leading_replacements
from mixedlub.diagnosis.discovery.screening import REPLACE, Candidate, Target, constant_term
from mixedlub.diagnosis.discovery.terms import Variable, single_terms
from mixedlub.diagnosis.report.files import write
from mixedlub.schema.findings import collected


@pytest.fixture(scope="module")
def plain(
    make_case: Callable[..., Path], excluded: tuple[str, ...], tmp_path_factory: pytest.TempPathFactory
) -> Diagnosis:
    """Discs whose friction knows no film and no oil: 0.05 (load/3000 N)^-0.6."""

    def change(conditions: dict[str, np.ndarray], base: np.ndarray) -> np.ndarray:
        return 0.05 * (conditions["load_N"] / 3000.0) ** -0.6 + 0.0 * base

    return diagnose_case(make_case(tmp_path_factory.mktemp("plain"), "disc", change), exclude=excluded)


def test_a_power_law_in_place_of_the_friction_is_found(plain: Diagnosis) -> None:
    law = Answer(plain).record["law"]
    assert (law["acts_on"], law["form"]) == ("friction", "replace")
    (exponent,) = [p for p in law["parameters"] if f"^{p['name']}" in law["expression"]]
    assert exponent["low90"] < -0.6 < exponent["high90"]
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
    assert simulated == pytest.approx(0.05 * (rows["load_N"] / 3000.0) ** -0.6, rel=0.02)


def _replacement(*variables: Variable, score: float = 0.0, target: Target | None = None) -> Candidate:
    powers = [next(t for t in single_terms(v) if t.shape == "power") for v in variables]
    terms = (constant_term(3), *powers)
    return Candidate(target or Target("viscosity", REPLACE, np.ones(3), 0.1), terms, (0.1,) * len(terms), score)


def test_a_replacement_is_bounded_by_columns_beside_the_glossary_and_not_by_time() -> None:
    c = _replacement(Variable("pressure_MPa", np.array([1.0, 10.0, 100.0])))
    ranges = {"pressure_MPa": [1.0, 100.0], "temperature_C": [40.0, 100.0], "time_s": [0.0, 9.0]}
    data = law_data("found_law", c, c.target.column, ranges)
    law = as_effect(data, ["temperature_C", "pressure_MPa", "time_s"])
    assert law.valid == {"pressure_MPa": (1.0, 100.0), "temperature_C": (40.0, 100.0)}


def test_only_the_best_replacement_with_fewer_powers_is_fitted_too() -> None:
    load, speed = (Variable(name, np.array([1.0, 2.0, 4.0])) for name in ("load_N", "entrainment_speed_m_s"))
    target = Target("friction", REPLACE, np.ones(3), 0.05)
    both = [_replacement(load, speed, score=s, target=target) for s in (50.0, 49.0, 48.0)]
    fewer = [_replacement(load, score=s, target=target) for s in (30.0, 20.0, -90.0)]
    assert _leading_replacements([*both, *fewer], 8.0) == [*both, fewer[0]]
    assert _leading_replacements([both[0], fewer[2]], 8.0) == both[:1]
    assert _leading_replacements(fewer, 40.0) == []


def test_a_replacement_may_read_a_quantity_with_the_name_of_its_own_in_it() -> None:
    coefficient = single_terms(Variable("pressure_viscosity", np.array([1.0, 2.0, 4.0])))[0]
    assert "pressure_viscosity" in coefficient.read
    assert "viscosity" not in coefficient.read


def test_laws_of_one_form_on_quantities_that_look_alike_count_once() -> None:
    from types import SimpleNamespace

    load = Variable("load_N", np.array([1.0, 2.0, 4.0]))
    alike = [Target("friction", REPLACE, np.ones(3)), Target("reading", REPLACE, 2.0 * np.ones(3))]
    other = Target("film_thickness", REPLACE, np.array([1.0, -1.0, 0.0]))
    laws: list[Any] = [SimpleNamespace(candidate=_replacement(load, target=one)) for one in (*alike, other)]
    assert _distinct(laws) == [laws[0], laws[2]]
