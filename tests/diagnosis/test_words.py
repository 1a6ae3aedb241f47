"""The verdict in words says what the answer says."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mixedlub.chain.effect import Parameter
from mixedlub.chain.plain_text import plain_equation
from mixedlub.chain.priors import Normal
from mixedlub.data_checks.audit import SCARCE, audit
from mixedlub.diagnosis.assessment.answer_checks import answer_warnings
from mixedlub.diagnosis.assessment.experiment_design import Batch, NextTest
from mixedlub.diagnosis.assessment.posterior import Posterior
from mixedlub.diagnosis.assessment.power_law import describe_discrepancy as describe
from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.labels import effect_words, number, with_names
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.report import html
from mixedlub.diagnosis.report.text import location_text, tables, words
from mixedlub.diagnosis.report.text.answer import as_json, effect_records
from mixedlub.effects import catalogue
from mixedlub.schema.findings import Severity, codes, finding, of_severity


def told(d: Diagnosis) -> dict[str, str]:
    """Sentences of each section joined."""
    extra = describe(d.search) if DISCREPANCY in d.posterior.tied else None
    return {
        s.title: " ".join([*s.alarms, *s.sentences, *s.items, *(" ".join(row) for row in s.table)])
        for s in words.sections(d, extra)
    }


def section(d: Diagnosis, title: str) -> words.Section:
    """One section."""
    return next(s for s in words.sections(d) if s.title == title)


def judged(d: Diagnosis, weights: dict[Explanation, float], tied: int) -> Diagnosis:
    """The same answer with other probabilities."""
    keys = tuple(weights)
    rest = {k: 1e-6 for k in d.posterior.weights if k not in weights}
    return replace(d, posterior=Posterior({**weights, **rest}, keys[0], keys[:tied]))


def test_nothing_missing_is_said(complete: Diagnosis) -> None:
    said = told(complete)
    assert "nothing needs to be missing" in said[words.ANSWER] or "Nothing is missing" in said[words.ANSWER]
    assert words.LEFT_OUT not in said
    assert words.WHERE not in said


def test_no_mismatch_is_said_with_p_value_and_false_alarm_rate(complete: Diagnosis) -> None:
    said = told(complete)[words.MISMATCH]
    assert said.startswith("None distinguishable from noise")
    assert f"p = {complete.test.p_value:.2g}" in said
    assert "1 % of the cases in which nothing is missing" in said


def test_mismatch_is_said(offset: Diagnosis) -> None:
    assert told(offset)[words.MISMATCH].startswith("Yes (p = ")


def test_instrument_is_not_called_physics(offset: Diagnosis) -> None:
    said = told(judged(offset, {Explanation.of("sensor_offset"): 0.97}, 1))[words.ANSWER]
    assert "No physics is missing; the instrument is at fault: sensor offset (probability 0.97)" in said


def test_physics_and_instrument_are_kept_apart(offset: Diagnosis) -> None:
    said = words.headline(judged(offset, {Explanation.of("inlet_shear_heating", "sensor_offset"): 0.9}, 1))
    assert said.startswith("Missing physics: inlet shear heating; and a fault of the instrument: sensor offset")


def test_another_law_is_not_called_missing_physics(offset: Diagnosis) -> None:
    for law in ("film_law", "pressure_viscosity_law"):
        said = words.headline(judged(offset, {Explanation.of(law): 0.97}, 1))
        assert said.startswith("No physics is missing, but another published law fits in place of that of the base")


def test_left_out_gives_equation_source_strength_and_interval(offset: Diagnosis) -> None:
    left_out = section(offset, words.LEFT_OUT)
    said = " ".join(left_out.sentences)
    assert "Equation: " in said
    assert "Source: " in said
    for _, _, value, span, *_ in left_out.table[1:]:
        low, high = (float(x) for x in span.split(" to "))
        assert low < float(value) < high


def test_tie_is_said_with_the_test_that_separates(offset: Diagnosis) -> None:
    pair = {Explanation.of("sensor_offset"): 0.5, Explanation.of("inlet_shear_heating"): 0.4}
    said = told(judged(offset, pair, 2))
    assert "A tie. Most probable: sensor offset (0.50). Not excluded: inlet shear heating (0.40)." in said[words.ANSWER]
    assert "To separate them: sensor offset: " in said[words.ALIKE]


def test_tests_that_separate_a_tie_are_a_list(offset: Diagnosis) -> None:
    pair = {Explanation.of("sensor_offset"): 0.5, Explanation.of("inlet_shear_heating"): 0.4}
    alike = section(judged(offset, pair, 2), words.ALIKE)
    assert [item.split(":")[0] for item in alike.items] == ["sensor offset", "inlet shear heating"]
    assert alike.sentences[-1] == "To separate them:"
    assert "\n  - sensor offset: " in words.as_text("Diagnosis", [alike])


def test_in_a_tie_what_was_left_out_is_only_the_best_candidate(offset: Diagnosis) -> None:
    pair = {Explanation.of("sensor_offset"): 0.5, Explanation.of("inlet_shear_heating"): 0.4}
    tied = words.as_text("Diagnosis", words.sections(judged(offset, pair, 2)))
    alone = words.as_text("Diagnosis", words.sections(judged(offset, {Explanation.of("sensor_offset"): 0.97}, 1)))
    assert "BEST OF THE TIED CANDIDATES" in tied
    assert "TIED" not in alone


def test_two_probabilities_of_one_effect_are_told_apart(offset: Diagnosis) -> None:
    several = {
        Explanation.of("sensor_offset"): 0.92,
        Explanation.of("inlet_shear_heating", "sensor_offset"): 0.079,
    }
    said = told(judged(offset, several, 1))[words.LEFT_OUT]
    assert "Sensor offset, probability 0.92 alone, above 0.99 alone or with a second effect, in " in said
    alone = told(judged(offset, {Explanation.of("sensor_offset"): 0.92}, 1))[words.LEFT_OUT]
    assert "Sensor offset, probability 0.92, in " in alone


def test_each_effect_of_a_pair_has_its_company_named(offset: Diagnosis) -> None:
    several = {Explanation.of("sensor_offset"): 0.3, Explanation.of("churning"): 0.05}
    key = next(k for k in offset.refined if len(k.effects) == 2 and "sensor_offset" in k.effects)
    other = next(n for n in key.effects if n != "sensor_offset")
    said = told(judged(offset, {key: 0.6, **several}, 1))[words.LEFT_OUT]
    assert f"Sensor offset, probability 0.60 together with {effect_words(other)}, 0.90 overall" in said


def test_doubts_about_the_data_stand_above_the_headline(offset: Diagnosis) -> None:
    slip = finding("readings_in_other_unit", "readings are about a thousandth: check the unit")
    other = finding("noise_estimated", "no noise given")
    found = words.sections(replace(offset, warnings=(slip, other)))
    text = words.as_text("Diagnosis", found)
    assert text.index(f"Doubtful: {slip}.") < text.index(found[0].sentences[0][:40])
    assert text.index(str(other)) > text.index("WARNINGS")
    assert text.count(str(slip)) == 1


@pytest.mark.parametrize(
    ("change", "wanted"),
    [(lambda y: y / 1000.0, "readings_in_other_unit"), (lambda y: -y, "sign_opposite_to_model")],
)
def test_wrong_unit_and_sign_are_doubts(
    offset: Diagnosis, change: Callable[[np.ndarray], np.ndarray], wanted: str
) -> None:
    rows = offset.search.problem.rows
    notes = audit(offset.case, rows, change(offset.recorded.base), offset.search.problem.forward)
    assert codes(of_severity(notes, Severity.DOUBT)) == [wanted]


def test_very_many_wrong_readings_are_a_doubt(offset: Diagnosis) -> None:
    wrong = np.arange(offset.readings.size) % 3 == 0
    rows, predicted = offset.recorded.table, offset.recorded.predicted
    notes = answer_warnings(offset.posterior.verdict, offset.heldout, rows, offset.readings, predicted, wrong)
    assert (notes[0].code, notes[0].severity) == ("outliers_many", Severity.DOUBT)


def test_headline_of_few_readings_is_cautious(teeth: Diagnosis, offset: Diagnosis) -> None:
    assert teeth.readings.size < SCARCE <= offset.readings.size
    assert words.headline(teeth).startswith("Only 28 readings: take this as a hint, not as a finding. ")
    assert "hint" not in words.headline(offset)


def vague(d: Diagnosis, spread: float) -> Diagnosis:
    """The same answer, its effects' parameters known to so many standard deviations of their priors."""
    key = d.posterior.verdict
    fit = d.refined[key]
    variance = fit.variance.copy()
    variance[d.search.problem.calibration_size :] = spread**2
    return replace(d, refined={**d.refined, key: replace(fit, variance=variance)})


@pytest.mark.parametrize(("spread", "marked"), [(0.95, True), (0.3, False)])
def test_parameters_that_readings_do_not_tell_are_marked(offset: Diagnosis, spread: float, marked: bool) -> None:
    left_out = section(vague(judged(offset, {Explanation.of("sensor_offset"): 0.97}, 1), spread), words.LEFT_OUT)
    assert len(left_out.table) == 2
    assert all(row[-1].startswith(f"[{tables.UNDETERMINED}] ") == marked for row in left_out.table[1:])
    assert any(tables.UNDETERMINED in s for s in left_out.sentences) == marked


def test_of_several_vague_parameters_only_their_combined_effect_is_known() -> None:
    heating, offset = catalogue()["boundary_film_temperature"], catalogue()["sensor_offset"]
    assert tables._undetermined(heating, []) == []
    assert tables._undetermined(heating, ["drop", "width"]) == [
        "Boundary film temperature: drop and width are about as uncertain as before the readings. Only the combined "
        "effect of the parameters is known."
    ]
    assert "combined" not in tables._undetermined(offset, ["offset"])[0]


def test_sensor_offset_has_the_size_that_it_is_a_share_of(offset: Diagnosis) -> None:
    rows = section(judged(offset, {Explanation.of("sensor_offset"): 0.97}, 1), words.LEFT_OUT).table
    size = float(np.median(np.abs(offset.search.problem.forward.predict())))
    assert rows[1][-1].startswith(f"offset of every reading, relative to the typical reading ({number(size)} W)")


def test_the_place_is_told_in_the_same_words_everywhere(offset: Diagnosis) -> None:
    assert section(offset, words.WHERE).sentences[0] == as_json(offset)["location"]["text"]


def test_where_says_which_base_model_is_meant(offset: Diagnosis) -> None:
    assert location_text.SPREAD in section(offset, words.WHERE).sentences


def test_name_keeps_its_letters_at_the_start_of_a_sentence() -> None:
    assert with_names(effect_words("micro_ehl")) == "Micro-EHL"
    assert effect_words("stribeck") == "Stribeck"


def test_temperature_of_an_answer_is_in_celsius(offset: Diagnosis, monkeypatch: pytest.MonkeyPatch) -> None:
    one = judged(offset, {Explanation.of("sensor_offset"): 0.97}, 1)
    kelvin = Parameter("offset", "K", Normal(350.0, 10.0), "temperature")
    warm = [replace(catalogue()["sensor_offset"], parameters=(kelvin,))]
    monkeypatch.setattr(Problem, "effects", lambda problem, key: warm)
    value = effect_records(one)[0]["parameters"][0]["value"]
    row = tables.parameters(one)[1][1]
    assert (row[2], row[4]) == (number(value - 273.15), "°C")


@pytest.mark.parametrize("p", [1e-304, 3e-7, 0.004, 0.3])
def test_page_and_text_have_the_same_p_value(offset: Diagnosis, p: float) -> None:
    d = replace(offset, test=replace(offset.test, p_value=p, noise_adapted=False))
    card = html._cards(d)[0][0]
    assert f"(p {'' if 'below' in card else '= '}{card}; " in told(d)[words.MISMATCH]


def test_calibration_says_what_is_a_factor_and_what_a_value(complete: Diagnosis) -> None:
    meanings = [row[-1] for row in section(complete, words.CALIBRATION).table[1:]]
    assert meanings[0].startswith("value: ")
    assert all(text.startswith("factor on ") for text in meanings[1:])
    assert "1 sd is the uncertainty of the input, stated by the case" in told(complete)[words.CALIBRATION]


def test_bits_and_nats_are_explained(offset: Diagnosis, unnamed: Diagnosis) -> None:
    assert "1 bit decides" in advised(offset, batch_of(0.5))
    assert "A nat is a factor 2.7 in the odds" in told(unnamed)[words.UNNAMED]


def test_long_ties_are_cut_short(offset: Diagnosis) -> None:
    names = ("sensor_offset", "sensor_gain", "churning", "inlet_shear_heating")
    every = {DISCREPANCY: 0.3, NOTHING: 0.2, **{Explanation.of(n): 0.1 for n in names}}
    said = words.headline(judged(offset, every, 6))
    assert said.endswith("; 1 less probable one.")
    assert "inlet shear heating" not in said


def test_what_tied_explanations_share_is_said(offset: Diagnosis) -> None:
    pair = {
        Explanation.of("sensor_offset"): 0.6,
        Explanation.of("inlet_shear_heating", "sensor_offset"): 0.39,
    }
    said = told(judged(offset, pair, 2))[words.ANSWER]
    assert "In every explanation left: sensor offset (0.99)." in said
    assert "A tie in what acts as well: nothing else (0.60); inlet shear heating (0.39)." in said


def test_unknown_is_said_with_place_and_stage(unnamed: Diagnosis) -> None:
    said = told(unnamed)
    assert "Something is missing that no one effect" in said[words.ANSWER]
    assert "speed 1500 rpm" in said[words.WHERE]
    assert "which quantity could take it up" in said[words.UNNAMED]
    assert words.LEFT_OUT not in said


def test_empirical_form_is_marked_as_such(teeth: Diagnosis) -> None:
    extra = describe(teeth.search)
    assert extra.law is not None
    form = next(s for s in words.sections(teeth, extra) if s.title == words.UNNAMED)
    assert any("empirical (a description, not physics)" in s for s in form.sentences)


def test_extrapolation_is_warned_of_where_held_out_levels_are_no_better(unnamed: Diagnosis) -> None:
    worse = replace(unnamed, heldout=replace(unnamed.heldout, before=2.0, after=2.1))
    assert told(worse)[words.GAIN].startswith("Not better: from 2.00")


def test_outliers_are_listed_by_run(offset: Diagnosis) -> None:
    rows = next(s for s in words.sections(offset) if s.title == words.OUTLIERS).table
    assert [row[0] for row in rows[1:]] == ["7", "31"]


def test_calibration_lists_every_movable_input(complete: Diagnosis) -> None:
    rows = next(s for s in words.sections(complete) if s.title == words.CALIBRATION).table
    assert [row[0] for row in rows[1:]] == [
        "boundary friction",
        "viscosity",
        "pressure viscosity",
        "Eyring stress",
        "roughness",
    ]


def test_text_is_short_and_no_wider_than_a_terminal(complete: Diagnosis, offset: Diagnosis, unnamed: Diagnosis) -> None:
    for d in (complete, offset, unnamed):
        text = words.as_text("Diagnosis", words.sections(d))
        assert max(map(len, text.splitlines())) <= words.WIDTH == 80
        assert text.count("\n") < 102


def test_warnings_come_last(teeth: Diagnosis) -> None:
    last = words.sections(teeth)[-1]
    assert last.title == "Warnings"
    assert any("28 readings" in s for s in last.sentences)


RIVALS = ((Explanation.of("sensor_offset"), 0.6), (Explanation.of("sensor_gain"), 0.4))


def advised(d: Diagnosis, batch: Batch) -> str:
    """The words on the next tests where they are this batch."""
    sound = {Explanation.of("sensor_offset"): 0.9}
    return told(replace(judged(d, sound, 1), batch=batch))[words.NEXT]


def batch_of(bits: float, **settings: Any) -> Batch:
    test = NextTest({"speed_rpm": 1500.0}, ("sensor_offset", "sensor_gain"), bits)
    return Batch((test,), RIVALS, **settings)


def test_a_batch_says_its_information_and_the_readings_it_takes(offset: Diagnosis) -> None:
    said = advised(offset, batch_of(0.5, readings=14))
    assert "together 0.50 bit" in said
    assert "About 14 such readings" in said
    assert "--add next_tests.csv" in said
    assert "eyond" not in said


def test_a_test_beyond_the_recording_says_its_needs(offset: Diagnosis) -> None:
    needs = ("speed 4000 rpm (recorded up to 3000 rpm)",)
    far = NextTest({"speed_rpm": 4000.0}, ("sensor_offset", "sensor_gain"), 0.9, needs)
    said = advised(offset, batch_of(0.5, beyond=(far,)))
    assert "Beyond the recording a single reading could tell 0.90 bit" in said
    assert said.rstrip().endswith("It needs speed 4000 rpm (recorded up to 3000 rpm).")


def test_a_settled_answer_has_one_test_that_could_refute_it(offset: Diagnosis) -> None:
    said = advised(offset, batch_of(0.02, settled=True, readings=0))
    assert "it could refute the answer best, in favour of sensor gain" in said


def test_no_useful_test_is_said(offset: Diagnosis) -> None:
    assert advised(offset, batch_of(0.001)).startswith("No useful test: no readings")
    assert advised(offset, Batch()).startswith("No useful test: there is no second explanation")


@pytest.mark.parametrize(
    ("latex", "plain"),
    [
        (r"\tau \leftarrow \tau/(1 + \beta)", "τ ← τ/(1 + β)"),
        (r"\frac{\eta_0 u}{E'}", "(η_0 u)/E'"),
        (r"\mathrm{asinh}(x)^{-1/2}", "asinh(x)^(-1/2)"),
        (r"\dfrac{a}{\frac{b}{c}}", "a/(b/c)"),
        (r"\sqrt{x} \cdot y_{max}", "√(x) · y_max"),
        (r"\pi D R_s\sigma_s", "π D R_s σ_s"),
        (r"\beta\eta_0\Delta\theta", "β η_0 Δθ"),
        (r"\tfrac12\rho\,\bigl[1 + s\operatorname{sgn}\omega\bigr]", "½ρ [1 + s sgn ω]"),
        (r"x = \frac{a}{b}\,c,\ y = \frac{a}{b}", "x = (a/b) c, y = a/b"),
        (r"\max\left(a,\ 20\,\text{mm}^2/\text{s}\right)", "max(a, 20 mm^2/s)"),
    ],
)
def test_equations_are_readable_without_latex(latex: str, plain: str) -> None:
    assert plain_equation(latex) == plain


def test_every_equation_of_the_catalogue_reads_as_text() -> None:
    for e in catalogue().values():
        assert "\\" not in plain_equation(e.equation), e.id
        assert "frac" not in plain_equation(e.equation), e.id


def test_the_gain_says_what_was_not_refitted(offset: Diagnosis, complete: Diagnosis) -> None:
    assert any(words.REFITTED in text for text in told(offset).values())
    assert not any(words.REFITTED in text for text in told(complete).values())
