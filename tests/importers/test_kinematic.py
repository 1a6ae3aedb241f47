"""Kinematic viscosities: turned into dynamic ones where the density of the oil is told, else refused."""

import pytest

from mixedlub.importers.input_file import InputFile
from mixedlub.importers.plain import draft
from mixedlub.schema import system_file
from profiles.errors import InputError

VISCOSITY = {"kind": "viscosity"}
DENSE = {**VISCOSITY, "lubricant.density_15C_kg_m3": 900.0, "lubricant.density_change_per_K": 8e-4}
ROWS = "15,100\n40,40\n100,7\n"
EXPECTED = [90.0, 40.0 * 0.9 * (1 - 8e-4 * 25.0), 7.0 * 0.9 * (1 - 8e-4 * 85.0)]


def read(header, answers, rows=ROWS):
    return draft(InputFile("t.csv", f"{header}\n{rows}"), answers)


@pytest.mark.parametrize(
    ("header", "factor"),
    [
        ("Temperature [C],Kinematic viscosity [mm2/s]", 1.0),
        ("Temperature [C],Viscosity (cSt)", 1.0),
        ("temperature_C,kinematic_viscosity_mm2_s", 1.0),
        ("temperature_C,Kinematic Viscosity [m²/s]", 1e6),
        ("temperature_C,kinematic viscosity [St]", 100.0),
    ],
)
def test_with_a_density_they_are_converted_and_that_is_said(header, factor):
    found = read(header, DENSE)
    assert [q.key for q in found.questions if q.needed] == []
    assert found.columns["viscosity_mPa_s"].tolist() == pytest.approx([factor * v for v in EXPECTED], rel=1e-12)
    said = " ".join(map(str, found.notes))
    assert "viscosity_mPa_s: kinematic, so multiplied by the density, 900 kg/m³ at 15 °C that falls by 0.0008" in said
    assert "838.8 to 900 kg/m³" in said


def test_the_density_may_be_that_of_a_named_oil():
    found = read("Temperature [C],Viscosity [cSt]", {**VISCOSITY, "lubricant.oil": "n100"})
    density = system_file.Lubricant(oil="n100").density_15C_kg_m3
    assert found.columns["viscosity_mPa_s"][0] == pytest.approx(0.1 * density, rel=1e-12)


def test_the_spread_is_converted_with_the_reading():
    found = read("temperature_C,viscosity [mm2/s],viscosity_mPa_s_sd", DENSE, "15,100,1\n40,40,1\n")
    assert found.columns["viscosity_mPa_s_sd"].tolist() == [1.0, 1.0]
    told = {**DENSE, "import.units.viscosity_mPa_s_sd": "mm2/s"}
    found = read("temperature_C,viscosity [mm2/s],viscosity_mPa_s_sd", told, "15,100,1\n40,40,1\n")
    assert found.columns["viscosity_mPa_s_sd"].tolist() == pytest.approx([0.9, 0.9 * (1 - 8e-4 * 25.0)])


@pytest.mark.parametrize("answers", [VISCOSITY, {**VISCOSITY, "lubricant.base": "pao"}])
@pytest.mark.parametrize("header", ["Kinematic viscosity [mm2/s]", "Viscosity [cSt]"])
def test_without_a_density_they_are_refused_with_what_would_do(header, answers):
    with pytest.raises(InputError) as caught:
        read(f"Temperature [C],{header}", answers)
    assert caught.value.where == f"t.csv: {header}"
    assert "viscosity_mPa_s is one of kinematic viscosity: in mm²/s, times the density in g/cm³, it is in mPa s" in str(
        caught.value
    )
    assert "lubricant.density_15C_kg_m3" in str(caught.value)


def test_a_dynamic_viscosity_beside_is_taken_first():
    found = read("temperature_C,Kinematic viscosity [mm2/s],Viscosity [mPa s]", DENSE, "15,100,91\n40,40,35\n")
    assert found.columns["viscosity_mPa_s"].tolist() == [91.0, 35.0]
    assert "kinematic, so" not in " ".join(map(str, found.notes))


def test_their_spread_is_told():
    (note,) = (
        n
        for n in read("temperature_C,Viscosity [cSt],Viscosity sd [cSt]", DENSE, "15,100,1\n40,40,1\n").notes
        if n.code == "column_not_taken"
    )
    assert "'Viscosity sd [cSt]' is not taken; if it is viscosity_mPa_s_sd: --set" in note.text


def test_without_a_unit_the_key_of_the_unit_is_told():
    told = {**DENSE, "import.columns.viscosity_mPa_s": "Kinematic viscosity"}
    with pytest.raises(InputError, match=r'give its unit, import\.units\.viscosity_mPa_s = "mm2/s", and'):
        read("temperature_C,Kinematic viscosity", told)


def test_the_unit_may_be_an_answer():
    told = {**DENSE, "import.columns.viscosity_mPa_s": "Kinematic viscosity", "import.units.viscosity_mPa_s": "cSt"}
    found = read("temperature_C,Kinematic viscosity", told)
    assert found.columns["viscosity_mPa_s"].tolist() == pytest.approx(EXPECTED, rel=1e-12)


def test_the_kind_of_kinematic_viscosities_is_offered():
    asked = {q.key: q.example for q in read("Temperature [C],Kinematic viscosity [mm2/s]", {}).questions if q.needed}
    assert asked == {"kind": '"viscosity"'}
