"""The verdict in words says what the answer says."""

from __future__ import annotations

from dataclasses import replace

import pytest

from mixedlub.diagnosis import page, words
from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.empirical import unnamed as describe
from mixedlub.diagnosis.nexttest import NextTest
from mixedlub.diagnosis.posterior import Key, Posterior
from mixedlub.effect import catalogue
from mixedlub.report.equations import equation
from mixedlub.report.plain import plain_equation


def told(d: Diagnosis) -> dict[str, str]:
    """Sentences of each section joined."""
    extra = describe(d.found) if "unknown" in d.posterior.tied else None
    return {s.title: " ".join([*s.sentences, *(" ".join(row) for row in s.table)]) for s in words.sections(d, extra)}


def judged(d: Diagnosis, weights: dict[Key, float], tied: int) -> Diagnosis:
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
    assert said.startswith("None that can be told from noise")
    assert f"p = {complete.test.p_value:.2g}" in said
    assert "1 % of the cases in which nothing is missing" in said


def test_mismatch_is_said(offset: Diagnosis) -> None:
    assert told(offset)[words.MISMATCH].startswith("Yes (p = ")


def test_instrument_is_not_called_physics(offset: Diagnosis) -> None:
    said = told(judged(offset, {("sensor_offset",): 0.97}, 1))[words.ANSWER]
    assert "No physics is missing; the instrument is at fault: sensor offset (probability 0.97)" in said


def test_physics_and_instrument_are_kept_apart(offset: Diagnosis) -> None:
    said = words.headline(judged(offset, {("inlet_shear_heating", "sensor_offset"): 0.9}, 1))
    assert said.startswith("Missing physics: inlet shear heating; and a fault of the instrument: sensor offset")


def test_left_out_gives_equation_source_strength_and_interval(offset: Diagnosis) -> None:
    section = next(s for s in words.sections(offset) if s.title == words.LEFT_OUT)
    said = " ".join(section.sentences)
    assert "Equation: " in said
    assert "Source: " in said
    for _, _, value, span, *_ in section.table[1:]:
        low, high = (float(x) for x in span.split(" to "))
        assert low < float(value) < high


def test_tie_is_said_with_the_test_that_separates(offset: Diagnosis) -> None:
    pair: dict[Key, float] = {("sensor_offset",): 0.5, ("inlet_shear_heating",): 0.4}
    said = told(judged(offset, pair, 2))
    assert (
        "A tie: the readings cannot decide between sensor offset (0.50); and inlet shear heating (0.40)."
        in said[words.ANSWER]
    )
    assert "To separate them: sensor offset: " in said[words.ALIKE]


def test_long_ties_are_cut_short(offset: Diagnosis) -> None:
    names = ("sensor_offset", "sensor_gain", "churning", "inlet_shear_heating")
    every: dict[Key, float] = {("unknown"): 0.3, (): 0.2, **{(n,): 0.1 for n in names}}
    said = words.headline(judged(offset, every, 6))
    assert said.endswith("; and 1 less probable one.")
    assert "inlet shear heating" not in said


def test_what_tied_explanations_share_is_said(offset: Diagnosis) -> None:
    pair: dict[Key, float] = {("sensor_offset",): 0.6, ("inlet_shear_heating", "sensor_offset"): 0.39}
    assert "In every one of them: sensor offset (0.99)." in told(judged(offset, pair, 2))[words.ANSWER]


def test_unknown_is_said_with_place_and_stage(unnamed: Diagnosis) -> None:
    said = told(unnamed)
    assert "the catalogue does not have" in said[words.ANSWER]
    assert "speed 1500 rpm" in said[words.WHERE]
    assert "absorbs it best" in said[words.UNNAMED]
    assert words.LEFT_OUT not in said


def test_empirical_form_is_marked_as_such(teeth: Diagnosis) -> None:
    extra = describe(teeth.found)
    assert extra.law is not None
    section = next(s for s in words.sections(teeth, extra) if s.title == words.UNNAMED)
    assert any("empirical (a description, not physics)" in s for s in section.sentences)


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
        "eyring stress",
        "roughness",
    ]


def test_text_fits_one_page(complete: Diagnosis, offset: Diagnosis, unnamed: Diagnosis) -> None:
    for d in (complete, offset, unnamed):
        text = words.as_text("Diagnosis", words.sections(d))
        prose = [line for line in text.splitlines() if not line.startswith("    ")]
        assert max(map(len, prose)) <= words.WIDTH
        assert text.count("\n") < 80


def test_warnings_come_last(teeth: Diagnosis) -> None:
    last = words.sections(teeth)[-1]
    assert last.title == "Warnings"
    assert any("28 readings" in s for s in last.sentences)


def advised(d: Diagnosis, bits: float, **conditions: float | str) -> str:
    """The words on the next test where it is this one."""
    sound: dict[Key, float] = {("sensor_offset",): 0.9}
    test = NextTest(conditions, ("sensor_offset", "none"), bits)
    return told(replace(judged(d, sound, 1), next_tests=(test,)))[words.NEXT]


def test_a_next_test_outside_the_recording_says_so(offset: Diagnosis) -> None:
    high = float(offset.recorded.table["speed_rpm"].max())
    said = advised(offset, 0.5, speed_rpm=high + 1000.0, oil_temperature_C=60.0)
    assert f"Beyond the recorded range: speed {high + 1000:g} rpm (recorded up to {high:g} rpm)." in said
    assert "oil temperature" not in said.split("Beyond")[1]


def test_a_next_test_within_the_recording_does_not(offset: Diagnosis) -> None:
    assert "eyond" not in advised(offset, 0.5, speed_rpm=float(offset.recorded.table["speed_rpm"].min()))


def test_no_useful_test_is_said(offset: Diagnosis) -> None:
    assert advised(offset, 0.001, speed_rpm=1000.0).startswith("No useful test: no single reading")
    alone = replace(judged(offset, {("sensor_offset",): 0.9}, 1), next_tests=())
    assert told(alone)[words.NEXT].startswith("No useful test: there is no second explanation")


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


def test_every_equation_of_the_catalogue_is_drawn() -> None:
    for e in catalogue().values():
        assert equation(page.bare(e.equation)).startswith("<svg"), e.id


def test_the_gain_says_what_was_not_refitted(offset: Diagnosis, complete: Diagnosis) -> None:
    assert any(words.REFITTED in text for text in told(offset).values())
    assert not any(words.REFITTED in text for text in told(complete).values())
