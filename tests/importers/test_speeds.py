"""Speeds of two surfaces: neither is taken, or offered, as the speed of both."""

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


@pytest.mark.parametrize(("one", "two"), PAIRS)
def test_the_speed_of_one_surface_is_not_offered(one, two):
    (question,) = (
        q for q in draft(InputFile("t.csv", discs(one, two)), DISC).questions if q.key.endswith("entrainment_speed_m_s")
    )
    assert question.example == '"HEADER"'
    assert f"{one}, {two}: speeds of single surfaces, entrainment is the mean, add a column of it" in question.text


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
def test_speeds_of_two_turning_discs_are_asked_for_with_the_way_to_the_speeds_of_the_contact(unit):
    found = draft(InputFile("t.csv", discs(f"n1 [{unit}]", f"n2 [{unit}]")), DISC)
    asked = {q.key.rpartition(".")[2]: q for q in found.questions}
    for column in ("entrainment_speed_m_s", "slide_roll_ratio"):
        assert f"n1 [{unit}], n2 [{unit}]: surface speeds are pi n R/30" in asked[column].text
        assert not asked[column].offered


@pytest.mark.parametrize("name", ["Reibungszahl", "Reibwert", "Reibungskoeffizient", "Haftreibung", "Haftreibungszahl"])
def test_german_names_of_friction_are_readings_and_need_no_unit_in_an_answer(name):
    text = discs().replace("mu (-)", f"{name} [-]")
    assert "friction_coefficient" in draft(InputFile("t.csv", text), DISC).columns
    told = {**DISC, "import.columns.friction_coefficient": name}
    assert draft(InputFile("t.csv", text), told).columns["friction_coefficient"].size == 5
