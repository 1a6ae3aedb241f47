"""Standard deviations in a table: proposed as those of the reading, and never as a condition or the reading itself."""

import pytest

from mixedlub.importers.input_file import InputFile
from mixedlub.importers.likeness import likely_headers
from mixedlub.importers.plain import draft
from mixedlub.schema.findings import Severity

HISTORY = {"kind": "friction_history"}


def offered(told, *headers):
    """The questions and warnings about the sd of the reading."""
    rows = "".join(f"{t},9{',0.1' * len(headers)}{t}\n" for t in range(6))
    found = draft(InputFile("t.csv", f"time_s,load_N,{','.join(headers)}\n{rows}"), {**HISTORY, **told})
    asked = [q for q in found.questions if q.key == "import.columns.friction_coefficient_sd"]
    assert not any(q.needed for q in asked)
    assert "friction_coefficient_sd" not in found.columns
    warned = [note for note in found.notes if note.severity is Severity.CAUTION]
    return [q.example for q in asked], warned


@pytest.mark.parametrize(
    ("reading", "spread"),
    [
        ("friction_mean", "friction_sd"),
        ("COF", "sd_friction"),
        ("COF", "cof std"),
        ("mu (%)", "StDev mu (%)"),
        ("friction_srr_above_15pct", "sd_srr_above_15pct"),
        ("COF", "standard deviation"),
    ],
)
def test_the_sd_beside_a_reading_is_proposed_with_the_setting_that_takes_it(reading, spread):
    told = {"import.columns.friction_coefficient": reading, "import.units.friction_coefficient": "-"}
    examples, (note,) = offered(told, reading, spread)
    assert examples == [f'"{spread}"']
    assert f"'{spread}' is not taken; if it is friction_coefficient_sd: --set" in note.text


@pytest.mark.parametrize("spread", ["sd_speed", "film_sd_nm", "cof sd (rpm)", "sd_repeats"])
def test_the_sd_of_something_else_is_not(spread):
    told = {"import.columns.friction_coefficient": "COF", "import.units.friction_coefficient": "-"}
    assert offered(told, "COF", spread) == ([], [])


def test_of_several_the_one_that_says_most_of_the_reading_is_proposed():
    told = {"import.columns.friction_coefficient": "friction pin", "import.units.friction_coefficient": "-"}
    assert offered(told, "friction pin", "sd friction", "friction pin sd")[0] == ['"friction pin sd"']


@pytest.mark.parametrize(
    ("column", "header"),
    [
        ("slide_roll_ratio", "sd_srr_above_15pct"),
        ("friction_coefficient", "friction_sd"),
        ("load_N", "load std (N)"),
        ("oil_temperature_C", "stdev oil temperature (degC)"),
    ],
)
def test_a_standard_deviation_is_no_condition(column, header):
    assert likely_headers([column], {header: ["0.1", "0.2"]}) == {}


def test_an_sd_that_is_told_is_taken_in_its_unit():
    text = "film sd (um),film (nm),load_N,entrainment_speed_m_s,slide_roll_ratio,oil_temperature_C\n.01,90,9,1,0,40\n"
    told = {"kind": "film", "import.columns.film_thickness_nm_sd": "film sd (um)"}
    assert draft(InputFile("t.csv", text + ".02,80,9,1,0,40\n"), told).columns["film_thickness_nm_sd"].tolist() == [
        10.0,
        20.0,
    ]
