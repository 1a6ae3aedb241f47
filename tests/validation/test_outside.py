"""Battery of physics outside the catalogue: contents, withheld ends, and the score of found laws."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mixedlub.validation.answers import read_truth, silent
from mixedlub.validation.battery import beyond, drawn_rigs, make, surveyed
from mixedlub.validation.outside import KINDS, LAWS, OUTSIDE_FIGURES, plan_outside, shapes_of
from mixedlub.validation.sample_case import Order
from mixedlub.validation.score import Row
from profiles.errors import InputError


def test_every_form_outside_the_catalogue_is_dealt_and_a_law_is_stated_for_known_forms_only() -> None:
    orders = plan_outside(3, 100)
    dealt = {order.effects[0] for order in orders}
    forms = {name for kind in KINDS for name in surveyed(drawn_rigs(kind, 3))[1]}
    assert dealt == forms
    assert len(forms) >= 20
    assert set(LAWS) <= forms
    assert {order.label for order in orders} == {"unknown"}
    assert 40 <= sum(order.beyond for order in orders) <= 60
    with pytest.raises(InputError, match="tooth_contact"):
        plan_outside(3, 20, ["tooth_contact"])


@pytest.mark.parametrize(
    ("expression", "shapes"),
    [
        ("exp(a*exp(-0.5*(log(speed_rpm/b)/w)^2))", {"resonance"}),
        ("exp(a*(0.5+0.5*tanh((time_s-b)/w)))", {"step"}),
        ("max(load_N/b,1)^a", {"threshold", "power"}),
        ("a*slide_roll_ratio/(slide_roll_ratio+b)", {"saturation"}),
        ("exp(a*(slide_roll_ratio/0.3)^p*exp(-0.5*(log(load_N/b)/w)^2))", {"power", "resonance"}),
    ],
)
def test_shapes_that_an_expression_shows(expression: str, shapes: set[str]) -> None:
    assert shapes_of(expression) == shapes


@pytest.fixture(scope="module")
def case(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("outside")
    return folder / make(5, 0, Order("case_000", "film", "unknown", ("load_squeezes",), "clear", beyond=True), folder)


def test_the_last_level_of_a_condition_is_withheld(case: Path) -> None:
    truth = read_truth(case)
    assert 0 < int(truth.beyond.sum()) < int(truth.withheld.sum())
    assert not (truth.beyond & ~truth.withheld).any()
    assert json.loads((case / "truth.json").read_text(encoding="utf-8"))["rows"]["beyond"][0] in (0, 1)


def test_time_and_order_have_no_range() -> None:
    columns = {"run": np.arange(3), "time_s": np.arange(3.0), "load_N": np.array([1.0, 1.0, 2.0])}
    assert beyond(columns, np.array([True, False, False])).tolist() == [0.0, 0.0, 0.0]


def test_laws_are_scored_by_quantity_and_shape_and_by_the_error_inside_and_beyond(case: Path) -> None:
    truth = read_truth(case)
    nothing = replace(silent(truth), verdict=frozenset({"unknown"}), tied=(frozenset({"unknown"}),))
    away = np.where(truth.beyond, 0.4, 0.1) * (truth.base - truth.values) + truth.values
    half = 1.645 * truth.sd
    good = replace(
        nothing,
        predicted=away,
        low=truth.values - half,
        high=truth.values + half,
        laws=(("viscosity", "(load_N/9)^a"), ("film_thickness", "(load_N/9)^a")),
    )

    def rows(answer: object) -> dict[str, Row]:
        return {f.key: f.row([(truth, answer)]) for f in OUTSIDE_FIGURES}  # type: ignore[list-item]

    found, lost = rows(good), rows(nothing)
    assert [found[key].value for key in ("said", "stage", "shape", "stage_claimed")] == [1.0] * 4
    assert found["inside"].value == pytest.approx(0.1)
    assert found["beyond"].value == pytest.approx(0.4)
    assert found["cover_beyond"].value == pytest.approx(0.9, abs=1e-3)
    assert [lost[key].value for key in ("said", "stage", "shape", "inside")] == [1.0, 0.0, 0.0, 1.0]
    assert lost["stage_claimed"].count == found["none_claimed"].count == 0


def test_a_case_without_effects_counts_in_no_figure_of_laws(case: Path) -> None:
    truth = replace(read_truth(case), group="none", effects=(), label=frozenset({"none"}))
    counted = {f.key for f in OUTSIDE_FIGURES if f.row([(truth, silent(truth))]).count}
    assert counted <= {"false_name", "seconds", "slowest"}
