"""Units: what is written is read as itself, never as one that differs by capitals only, and asked where it is open."""

import numpy as np
import pytest

from mixedlub.importers import import_files
from mixedlub.importers.input_file import InputFile
from mixedlub.importers.likeness import likely_headers, likely_kind
from mixedlub.importers.plain import draft
from mixedlub.importers.vocabulary import BY_NAME, convert
from mixedlub.schema.units import FORMS, UNITS, change_to
from profiles.errors import InputError

KNOWN = sorted({form for forms in FORMS.values() for form in forms})
ALIKE = [(a, b) for a in KNOWN for b in KNOWN if a != b and a.lower() == b.lower()]
FILM = """Rollgeschwindigkeit (mm/s);Schlupf (%);Last (N);Schmierstofftemperatur (°C);Filmdicke (nm);Ordnung
20,0;0,0;19,98;39,9;20,6;1
27,3;0,0;19,98;40,1;25,8;1
37,3;0,0;20,01;39,9;30,5;1
"""


def test_there_are_units_that_differ_by_capitals_only():
    assert ("Nm", "nm") in ALIKE


@pytest.mark.parametrize("written", sorted({a.swapcase() for a, _ in ALIKE} | {a.upper() for a, _ in ALIKE}))
def test_capitals_that_leave_two_units_open_are_none(written):
    assert {w: change_to(written, w) for w in UNITS} == {w: FORMS[w].get(written) for w in UNITS}


@pytest.mark.parametrize(
    ("written", "wanted"),
    [("mPa", "MPa"), ("MN", "N"), ("Mpas", "mPa_s"), ("MW", "W"), ("k", "C"), ("S", "s"), ("H", "s"), ("n", "N")],
)
def test_capitals_that_tell_are_not_overlooked(written, wanted):
    assert change_to(written, wanted) is None


@pytest.mark.parametrize(
    ("written", "wanted", "form"),
    [("RPM", "rpm", "rpm"), ("KN", "N", "kN"), ("Bar", "MPa", "bar"), ("DegC", "C", "degC"), ("NMM", "Nm", "N.mm")],
)
def test_capitals_that_tell_nothing_are_overlooked(written, wanted, form):
    assert change_to(written, wanted) == UNITS[wanted][form]


def test_a_film_in_nm_is_never_offered_as_a_torque():
    rows = [line.split(";") for line in FILM.replace(",", ".").splitlines()]
    cells = dict(zip(rows[0], map(list, zip(*rows[1:], strict=True)), strict=True))
    assert likely_headers(["friction_torque_Nm"], cells) == {}
    assert likely_kind(cells) == "film"


def test_a_film_in_nm_that_is_told_to_be_a_torque_is_refused(tmp_path):
    path = tmp_path / "ehd.csv"
    path.write_text(FILM, encoding="utf-8")
    told = {"kind": "friction_map", "recording.quantity": "friction_torque_Nm"}
    told["import.columns.sliding_speed_m_s"] = "Rollgeschwindigkeit (mm/s)"
    told["import.columns.friction_torque_Nm"] = "Filmdicke (nm)"
    with pytest.raises(InputError, match=r"'nm': unit of friction_torque_Nm is not known"):
        import_files([path], tmp_path / "case", **told)


@pytest.mark.parametrize(("written", "megapascals"), [("kPa", 1e-3), ("KPA", 1e-3), ("MPa", 1.0), ("bar", 0.1)])
def test_pressures(written, megapascals):
    assert convert(np.array([2.0]), written, BY_NAME["pressure_MPa"], "t").tolist() == [2.0 * megapascals]


RPM = {
    **dict.fromkeys(("rpm", "RPM", "1/min", "min-1", "min^-1", "min⁻¹", "r/min", "U/min", "rev/min"), 1.0),
    **dict.fromkeys(("rad/s", "rad s-1", "rad·s⁻¹", "rad s^-1"), 30.0 / np.pi),
    **dict.fromkeys(("deg/s", "°/s", "° / s", "deg s⁻¹"), 1.0 / 6.0),
    **dict.fromkeys(("rev/s", "U/s", "rps"), 60.0),
}


@pytest.mark.parametrize(("written", "rpm"), RPM.items())
def test_speeds_of_a_drive(written, rpm):
    assert convert(np.array([9.0]), written, BY_NAME["speed_rpm"], "t")[0] == pytest.approx(9.0 * rpm, rel=1e-14)


@pytest.mark.parametrize("header", ["velocity [deg/s]", "joint_speed_deg_s"])
def test_degrees_a_second_are_offered_as_the_speed_of_a_drive(header):
    assert likely_headers(["speed_rpm"], {header: ["1.0"]}) == {"speed_rpm": header}


def drive(header):
    return f"{header},friction torque (Nm)\n1,2\n2,2.2\n"


DRIVE = {"kind": "friction_map", "recording.quantity": "friction_torque_Nm"}


@pytest.mark.parametrize("unit", ["1/s", "s^-1", "s⁻¹", "s-1"])
@pytest.mark.parametrize("words", ["Speed", "Joint speed"])
def test_one_over_a_second_is_asked_about(unit, words):
    """It may be revolutions a second; robots mean radians by it."""
    header = f"{words} ({unit})"
    questions = {q.key: q for q in draft(InputFile("t.csv", drive(header)), DRIVE).questions}
    question = questions["import.units.speed_rpm"]
    assert (question.options, question.example) == (("rev/s", "rad/s"), '"UNIT"')
    told = {**DRIVE, "import.columns.speed_rpm": header, "import.units.speed_rpm": "rad/s"}
    found = draft(InputFile("t.csv", drive(header)), told)
    assert found.columns["speed_rpm"].tolist() == pytest.approx([30.0 / np.pi, 60.0 / np.pi])
    assert "taken to be in rad/s, as answered" in " ".join(map(str, found.notes))


def test_one_over_a_second_that_is_told_is_refused_with_what_it_may_mean():
    with pytest.raises(InputError, match=r"'1/s': as unit of speed_rpm leaves open .* say rev/s or rad/s"):
        draft(InputFile("t.csv", drive("speed")), {**DRIVE, "import.units.speed_rpm": "1/s"})


@pytest.mark.parametrize(
    ("unit", "factor"),
    [
        *(
            (unit, 1e3)
            for unit in ("kg/(m s)", "kg/(m·s)", "kg/m/s", "kg m⁻¹ s⁻¹", "N s/m2", "N·s/m²", "N s m^-2", "Pa·s")
        ),
        *(("mN s/m²", 1.0), ("P", 100.0), ("g/(cm s)", 100.0)),
    ],
)
@pytest.mark.parametrize("brackets", ["()", "[]"])
def test_dynamic_viscosity_is_read_in_every_spelling_of_its_units(unit, factor, brackets):
    text = f"Temperature [°C],Dynamic viscosity {brackets[0]}{unit}{brackets[1]}\n20,0.09\n40,0.03\n"
    found = draft(InputFile("t.csv", text), {"kind": "viscosity"})
    assert [q.key for q in found.questions if q.needed] == []
    assert found.columns["viscosity_mPa_s"].tolist() == pytest.approx([0.09 * factor, 0.03 * factor], rel=1e-12)
