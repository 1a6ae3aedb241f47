"""Speeds of two surfaces: neither is taken, or offered, as the speed of both."""

import math

import pytest

from mixedlub.importers.input_file import InputFile
from mixedlub.importers.plain import draft
from mixedlub.importers.surface_speeds import other_surface
from profiles.errors import InputError

DISC = {"kind": "disc", "import.columns.load_N": "Fn (kN)", "import.columns.oil_temperature_C": "Toel (C)"}


def discs(one="v1 (m/s)", two="v2 (m/s)", slower=0.9):
    rows = "".join(f"{30 * i};1.5;{2 + i};{slower * (2 + i)};60.{i};0.0{i};steel;steel\n" for i in range(1, 6))
    return f"Zeit (s);Fn (kN);{one};{two};Toel (C);mu (-);s1;s2\n{rows}"


PAIRS = [
    ("v1 (m/s)", "v2 (m/s)"),
    ("u_1 (mm/s)", "u_2 (mm/s)"),
    ("Speed 1", "Speed 2"),
    ("v_a [m/s]", "v_b [m/s]"),
    ("Disc Speed (m/s)", "Ball Speed (m/s)"),
    ("lower disc (m/s)", "upper disc (m/s)"),
    ("Geschwindigkeit Scheibe (m/s)", "Geschwindigkeit Kugel (m/s)"),
]


@pytest.mark.parametrize(("one", "two"), PAIRS)
def test_the_speed_of_one_surface_is_refused_as_that_of_both(one, two):
    told = {**DISC, "import.columns.slide_roll_ratio": "mu (-)", "import.columns.friction_coefficient": "mu (-)"}
    told |= {"import.columns.surface_1": "s1", "import.columns.surface_2": "s2"}
    told["import.columns.entrainment_speed_m_s"] = two
    if "(" not in one and "[" not in one:
        told["import.units.entrainment_speed_m_s"] = "m/s"
    with pytest.raises(InputError, match="is the speed of one surface; entrainment is the mean with that of") as caught:
        draft(InputFile("t.csv", discs(one, two)), told)
    assert repr(one) in str(caught.value)


def test_the_speed_of_one_surface_is_refused_as_the_sliding_speed_unless_the_other_rests():
    told = {"kind": "friction_map", "recording.quantity": "friction_coefficient"}
    told |= {"import.columns.sliding_speed_m_s": "v1 (m/s)", "import.columns.friction_coefficient": "mu (-)"}
    with pytest.raises(InputError, match="sliding is the difference to that of 'v2"):
        draft(InputFile("t.csv", discs()), told)
    assert draft(InputFile("t.csv", discs(slower=0.0)), told).columns["sliding_speed_m_s"].tolist() == [
        3.0,
        4.0,
        5.0,
        6.0,
        7.0,
    ]


@pytest.mark.parametrize(("one", "two"), [pair for pair in PAIRS if pair[0] != "Speed 1"])
def test_entrainment_is_the_mean_of_both_speeds_and_slip_their_difference_over_it(one, two):
    found = draft(InputFile("t.csv", discs(one, two)), DISC)
    assert not any(q.key.endswith(("entrainment_speed_m_s", "slide_roll_ratio")) for q in found.questions)
    factor = 1e-3 if "mm/s" in one else 1.0
    means = [0.95 * (2 + i) * factor for i in range(1, 6)]
    assert found.columns["entrainment_speed_m_s"] == pytest.approx(means, rel=1e-12)
    ratio = 0.1 / 0.95 if found.columns["slide_roll_ratio"][0] > 0 else -0.1 / 0.95
    assert found.columns["slide_roll_ratio"] == pytest.approx([ratio] * 5, rel=1e-12)


def test_speeds_without_units_are_not_offered():
    asked = draft(InputFile("t.csv", discs("Speed 1", "Speed 2")), DISC).questions
    (question,) = (q for q in asked if q.key.endswith("entrainment_speed_m_s"))
    assert question.example == '"HEADER"'
    assert "Speed 1, Speed 2: speeds of single surfaces, entrainment is the mean, add a column of it" in question.text


def test_neither_is_offered_as_the_speed_of_a_map():
    told = {"kind": "friction_map", "recording.quantity": "friction_coefficient"}
    questions = draft(InputFile("t.csv", discs()), told).questions
    assert not any("v1" in q.example or "v2" in q.example for q in questions)


@pytest.mark.parametrize(
    ("header", "cells"),
    [
        ("v1 (m/s)", {"v1 (m/s)": ["1", "2"], "v2 (m/s)": ["1", "2"]}),
        ("v1 (m/s)", {"v1 (m/s)": ["1", "2"], "v2 (mm/s)": ["2", "3"]}),
        ("v1 (m/s)", {"v1 (m/s)": ["1", "2"], "v3 (m/s)": ["2", "3"]}),
        ("load 1 (N)", {"load 1 (N)": ["1", "2"], "load 2 (N)": ["2", "3"]}),
        ("load 1", {"load 1": ["1", "2"], "load 2": ["2", "3"]}),
    ],
)
def test_what_is_no_pair_of_different_speeds_is_left_alone(header, cells):
    assert other_surface(header, cells) is None


@pytest.mark.parametrize("header", ["Summengeschwindigkeit [m/s]", "Sum speed (m/s)", "u1+u2 [m/s]", "v_sum (m/s)"])
def test_a_sum_of_both_speeds_is_halved_and_said(header):
    told = {**DISC, "import.columns.entrainment_speed_m_s": header}
    text = discs().replace("v1 (m/s);v2 (m/s)", f"{header};extra")
    found = draft(InputFile("t.csv", text), told)
    assert found.columns["entrainment_speed_m_s"].tolist() == [1.5, 2.0, 2.5, 3.0, 3.5]
    assert any(repr(header) in str(note) and "half of it" in str(note) for note in found.notes)


@pytest.mark.parametrize("unit", ["U/min", "1/min", "min-1", "min^-1", "rpm"])
def test_speeds_of_two_turning_discs_need_their_radii_alone(unit):
    """Both discs of 30 mm at 100 and 90 rpm: 0.314 and 0.283 m/s."""
    text = discs(f"n1 [{unit}]", f"n2 [{unit}]")
    asked = {q.key: q for q in draft(InputFile("t.csv", text), DISC).questions if q.needed}
    assert asked["import.running_radius_mm"].placeholder == "[RADIUS, RADIUS]"
    assert "surface speeds are pi n R/30" in asked["import.running_radius_mm"].text
    assert not any("speed_m_s" in key or "slide_roll" in key for key in asked)
    told = {**DISC, "import.running_radius_mm": [30.0, 40.0]}
    found = draft(InputFile("t.csv", text), told).columns
    first, second = math.pi * 3 * 30e-3 / 30, math.pi * 2.7 * 40e-3 / 30
    assert found["entrainment_speed_m_s"][0] == pytest.approx((first + second) / 2, rel=1e-12)
    assert found["slide_roll_ratio"] == pytest.approx([2 * (first - second) / (first + second)] * 5, rel=1e-12)


def test_radii_of_two_discs_are_their_running_radii_and_opposite_signs_are_said():
    text = discs("n1 [rpm]", "n2 [rpm]", slower=-0.9)
    found = draft(InputFile("t.csv", text), {**DISC, "contact.radius_mm": [30.0, 30.0]})
    assert found.columns["slide_roll_ratio"] == pytest.approx([0.1 / 0.95] * 5, rel=1e-12)
    assert sum("opposite signs are those of bodies that turn against each other" in n.text for n in found.notes) == 2


@pytest.mark.parametrize("radii", [20.0, [20.0], [20.0, -1.0], ["a", "b"]])
def test_radii_that_are_none_are_refused(radii):
    with pytest.raises(InputError, match="must be two radii in mm"):
        draft(InputFile("t.csv", discs("n1 [rpm]", "n2 [rpm]")), {**DISC, "import.running_radius_mm": radii})


@pytest.mark.parametrize("name", ["Reibungszahl", "Reibwert", "Reibungskoeffizient", "Haftreibung", "Haftreibungszahl"])
def test_german_names_of_friction_are_readings_and_need_no_unit_in_an_answer(name):
    text = discs().replace("mu (-)", f"{name} [-]")
    assert "friction_coefficient" in draft(InputFile("t.csv", text), DISC).columns
    told = {**DISC, "import.columns.friction_coefficient": name}
    assert draft(InputFile("t.csv", text), told).columns["friction_coefficient"].size == 5
