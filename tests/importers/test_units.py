"""Capitals of units: what is written is never read as another unit that differs by capitals only."""

import pytest

from mixedlub.headers import FORMS, UNITS, change_to
from mixedlub.importers import import_files
from mixedlub.importers.likely import likely_headers, likely_kind
from profiles.errors import InputError

KNOWN = sorted({form for forms in FORMS.values() for form in forms})
ALIKE = [(a, b) for a in KNOWN for b in KNOWN if a != b and a.lower() == b.lower()]
FILM = """Rollgeschwindigkeit (mm/s);Schlupf (%);Last (N);Schmierstofftemperatur (°C);Filmdicke (nm);Ordnung
20,0;0,0;19,98;39,9;20,6;1
27,3;0,0;19,98;40,1;25,8;1
37,3;0,0;20,01;39,9;30,5;1
"""


@pytest.mark.parametrize("written", KNOWN)
def test_a_known_unit_is_read_as_itself_and_as_nothing_else(written):
    assert {w: change_to(written, w) for w in UNITS} == {w: FORMS[w].get(written) for w in UNITS}


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
