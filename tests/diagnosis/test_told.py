"""The answer does not contradict itself, and says what its numbers are of and what it rests on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mixedlub.case.forward import Forward
from mixedlub.data_checks.audit import check_readings
from mixedlub.diagnosis.assessment.identifiability import confusion
from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.report.text import words
from mixedlub.diagnosis.report.text.alternatives import alternatives
from mixedlub.diagnosis.report.text.answer import as_json
from mixedlub.diagnosis.report.text.nearest_effect import nearest
from mixedlub.diagnosis.report.text.tables import _interval_with_null
from mixedlub.effects import catalogue
from mixedlub.schema.findings import codes, finding
from mixedlub.schema.table import Table

from .test_words import judged, told


def test_what_is_called_nearest_is_neither_rejected_nor_untestable(unnamed: Diagnosis) -> None:
    best = nearest(unnamed)
    assert best is not None
    alike = confusion(unnamed.search)
    every = tuple(Explanation.of(name) for name in alike.ids)
    others = {
        name: replace(unnamed.search.fits[name], residual=0.0 * unnamed.search.null_fit.residual) for name in every
    }
    for name in alike.ids:
        kept = {**unnamed.search.fits, Explanation.of(name): others[Explanation.of(name)]}
        d = replace(unnamed, search=replace(unnamed.search, fits=kept))
        found = nearest(d)
        assert found is not None
        assert found.explanation == Explanation.of(name)
        said = " ".join(alternatives(d, alike)[0])
        assert name.replace("_", " ") not in said


def test_effects_left_out_on_request_are_said(unnamed: Diagnosis) -> None:
    assert "windage" in unnamed.excluded
    assert "grease_shear_thinning" not in unnamed.excluded, "a drive alone has grease"
    (said,) = [record["text"] for record in as_json(unnamed)["findings"] if record["code"] == "effects_left_out"]
    assert "windage" in said
    assert said in words.as_text("", words.sections(unnamed)).replace("\n  ", " ")
    assert f"({len(unnamed.excluded)} left out on request)" in told(unnamed)[words.ANSWER]


def test_unknown_does_not_say_what_the_catalogue_lacks(unnamed: Diagnosis) -> None:
    whole = told(replace(unnamed, excluded=()))[words.ANSWER]
    assert "no one effect of the catalogue explains, nor any two tried together" in whole
    assert "of the catalogue" not in told(unnamed)[words.ANSWER]


def test_contradicting_readings_come_before_an_unnamed_mismatch(unnamed: Diagnosis, offset: Diagnosis) -> None:
    doubt = (finding("repeats_contradictory", "they scatter by 135 nm"),)
    assert words.headline(replace(unnamed, warnings=doubt)).startswith("Readings at equal conditions contradict")
    assert "Readings at equal" not in words.headline(unnamed)
    assert "Readings at equal" not in words.headline(replace(offset, warnings=doubt))


def test_readings_that_contradict_each_other_are_found(offset: Diagnosis) -> None:
    rows = offset.search.problem.rows
    twice = {name: np.tile(values, 2) for name, values in rows.columns.items()}
    y = np.concatenate([offset.recorded.base, 2.0 * offset.recorded.base])
    table = Table({**twice, offset.case.quantity: y}, "recordings.csv")
    case = replace(offset.case, recordings=table)
    assert "repeats_contradictory" in codes(check_readings(case, table, y, Forward(offset.case, table)))


def test_probability_of_the_answer_and_of_its_effects_stand_side_by_side(offset: Diagnosis) -> None:
    several = {Explanation.of("sensor_offset"): 0.87, Explanation.of("inlet_shear_heating", "sensor_offset"): 0.128}
    clause = "Sensor offset: probability 0.87 alone, above 0.99 alone or with a second effect."
    assert clause in told(judged(offset, several, 1))[words.ANSWER]
    assert "alone" not in told(judged(offset, {Explanation.of("sensor_offset"): 0.97}, 1))[words.ANSWER]
    both = Explanation.of("churning", "sensor_offset")
    pair = {Explanation.of("sensor_offset"): 0.5, Explanation.of("churning"): 0.2, both: 0.1}
    said = told(judged(offset, pair, 2))[words.ANSWER]
    assert "Sensor offset: probability 0.50 alone, 0.60 alone or with a second effect." in said


def test_what_the_nearest_leaves_is_never_called_noise_alone(unnamed: Diagnosis) -> None:
    name = next(key for key in unnamed.search.fits if len(key.effects) == 1)
    perfect = replace(unnamed.search.fits[name], residual=0.0 * unnamed.search.null_fit.residual)
    fits = {**unnamed.search.fits, name: perfect}
    said = told(replace(unnamed, search=replace(unnamed.search, fits=fits)))[words.UNNAMED]
    assert "no more than noise" not in said
    assert "It is not the answer (probability below 0.01): its fit alone would do" in said
    assert "100 %" not in said


def test_the_nearest_has_its_chi_square_in_the_noise_of_a_reading(unnamed: Diagnosis) -> None:
    lasting = replace(unnamed.search, problem=unnamed.search.problem.with_n_per_effective(9.0))
    one, nine = nearest(unnamed), nearest(replace(unnamed, search=lasting))
    assert one is not None
    assert nine is not None
    np.testing.assert_allclose(nine.before, 9.0 * one.before)


def test_chi_square_says_which_noise_it_is_of(unnamed: Diagnosis, complete: Diagnosis) -> None:
    assert "estimated" not in told(unnamed)[words.MISMATCH]
    assert (
        "noise was estimated together with the missing part"
        in told(replace(unnamed, noise_stated=False))[words.MISMATCH]
    )
    assert "noise was estimated as if nothing" in told(replace(complete, noise_stated=False))[words.MISMATCH]


def test_what_would_show_rests_on_the_noise(complete: Diagnosis) -> None:
    assert "Would show here" in told(complete)[words.ALIKE]
    assert "estimated" not in told(complete)[words.ALIKE]
    said = told(replace(complete, noise_stated=False))[words.ALIKE]
    assert "(probability below 0.01 each; the noise was estimated as if nothing were missing" in said


def test_what_is_less_probable_and_not_rejected_is_listed(offset: Diagnosis) -> None:
    left = {
        Explanation.of("sensor_offset"): 0.9,
        Explanation.of("churning"): 0.03,
        DISCREPANCY: 0.02,
        NOTHING: 0.012,
    }
    said = told(judged(offset, left, 1))[words.ALIKE]
    assert "Less probable, not excluded: churning (0.03), something unknown (0.02), nothing missing (0.01)." in said
    sure = {Explanation.of("sensor_offset"): 0.999}
    assert "not excluded: " not in told(judged(offset, sure, 1))[words.ALIKE].replace("nor excluded: ", "")


@pytest.mark.parametrize(("off", "strained"), [(-2.04, False), (-2.06, True)])
def test_strained_is_what_the_table_shows_so(complete: Diagnosis, off: float, strained: bool) -> None:
    null_fit = complete.refined[NOTHING]
    z = np.where(np.arange(null_fit.z.size) == 0, off, 0.0)
    said = told(replace(complete, refined={**complete.refined, NOTHING: replace(null_fit, z=z)}))[words.CALIBRATION]
    assert ("Strained" in said) == strained


@pytest.mark.parametrize(("low", "chance", "said"), [(-0.006, 0.99, True), (0.02, 0.99, False), (-0.006, 0.5, False)])
def test_a_sure_effect_whose_size_may_be_nothing_is_no_contradiction(low: float, chance: float, said: bool) -> None:
    e = catalogue()["boundary_film_temperature"]
    ends = {"drop": (low, 0.29), "flash": (0.005, 0.64)}
    fitted = [(p, dict(zip(("low90", "high90"), ends.get(p.name, (1.0, 2.0)), strict=True))) for p in e.parameters]
    notes = _interval_with_null(e, fitted, chance)
    assert bool(notes) == said
    assert all("interval of drop contains the value without effect" in note for note in notes)
