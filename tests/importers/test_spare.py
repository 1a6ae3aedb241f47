"""Columns that a kind would take into account and nothing is taken from: asked about, and warned of."""

import pytest

from mixedlub.case.folder import read_case
from mixedlub.importers import import_files
from mixedlub.importers.input_file import InputFile
from mixedlub.importers.plain import draft
from mixedlub.schema.findings import FindingWarning, Severity

FALLING_BODY = """# falling-body viscometer
T (degC),p (bar),density (kg/m3),viscosity (Pa s),remark
40,1,850,0.0078811,
40,500,870,0.022324,
75,1,830,0.0032238,slow
75,500,850,0.0072074,
"""
TOLD = {"kind": "viscosity", "import.columns.temperature_C": "T (degC)"}
HISTORY = {"kind": "friction_history", "import.units.friction_coefficient": "-"}


@pytest.fixture
def path(tmp_path):
    (tmp_path / "t.csv").write_text(FALLING_BODY, encoding="utf-8")
    return tmp_path / "t.csv"


def test_a_pressure_that_is_not_taken_is_warned_of_with_the_setting_that_takes_it(path, tmp_path):
    setting = 'import.columns.pressure_MPa="p (bar)"'
    with pytest.warns(FindingWarning, match="'p .bar.' is not taken; if it is pressure_MPa: --set") as caught:
        import_files([path], tmp_path / "case", **TOLD)
    assert setting in str(caught[0].message)
    assert len(caught) == 1
    told = {**TOLD, "import.columns.pressure_MPa": "p (bar)"}
    assert read_case(import_files([path], tmp_path / "all", **told)).recordings["pressure_MPa"].tolist() == [
        0.1,
        50.0,
        0.1,
        50.0,
    ]


@pytest.mark.parametrize(("reply", "taken"), [('"p (bar)"', True), ("", False)])
def test_the_wizard_asks_whether_to_take_it(path, tmp_path, reply, taken, at_terminal):
    told = [f"{k}={v}" for k, v in TOLD.items()]
    user = at_terminal(path, tmp_path / "case", told, {"pressure_MPa": [reply]})
    (question,) = (text for text in user.forms[0].values() if "pressure_MPa" in text)
    assert 'for example "p (bar)"; may stay open' in question
    assert ("pressure_MPa" in read_case(tmp_path / "case").recordings) == taken
    assert any("'p (bar)' is not taken" in line for line in user.said) != taken


@pytest.mark.parametrize(
    ("header", "column"),
    [
        ("Fn (kN)", "load_N"),
        ("Schlupf (%)", "slide_roll_ratio"),
        ("u (m/s)", "entrainment_speed_m_s"),
        ("Toel (°C)", "oil_temperature_C"),
    ],
)
def test_conditions_of_a_history_are_warned_of_by_their_units(header, column):
    text = f"time_s,cof,{header}\n1,0.1,1\n2,0.2,2\n3,0.15,3\n"
    (warned,) = (note for note in draft(InputFile("t.csv", text), HISTORY).notes if note.severity is Severity.CAUTION)
    assert warned.code == "column_not_taken"
    assert f"'{header}' is not taken; if it is {column}: --set" in warned.text


@pytest.mark.parametrize("header", ["Shear stress (Pa)", "Schubspannung (Pa)"])
def test_a_stress_is_no_pressure(header):
    text = f"temperature_C,viscosity_mPa_s,{header}\n40,30,3\n60,12,1.2\n"
    assert not any(
        note.severity is Severity.CAUTION for note in draft(InputFile("t.csv", text), {"kind": "viscosity"}).notes
    )


@pytest.mark.parametrize("header", ["density (kg/m3)", "remark", "wear (um)", "voltage", "friction_srr_3_to_8pct"])
def test_what_no_column_is_like_is_no_warning(header):
    text = f"time_s,cof,{header}\n1,0.1,1\n2,0.2,2\n3,0.15,3\n"
    assert not any(note.severity is Severity.CAUTION for note in draft(InputFile("t.csv", text), HISTORY).notes)


@pytest.mark.parametrize("header", ["OelPump Speed (%)", "Humidity (%)", "Controller (%)"])
def test_a_percentage_of_something_else_is_no_slip(header):
    text = f"time_s,cof,{header}\n1,0.1,100\n2,0.2,90\n3,0.15,100\n"
    assert not any(note.severity is Severity.CAUTION for note in draft(InputFile("t.csv", text), HISTORY).notes)


@pytest.mark.parametrize(
    "header",
    ["Fz (g)", "Fz [N]", "Fn (kgf)", "Fn1", "Normal force Fn (N)", "DAQ.Fz (kg)", "Fz_g", "normal load Fn [g]"],
)
def test_normal_forces_are_offered_as_the_load(header):
    text = f"time_s;cof;{header};Fx (g);OelPump Speed (%)\n1;0.1;199;20;100\n2;0.2;200;21;100\n3;0.15;201;20;90\n"
    (warned,) = (note for note in draft(InputFile("t.csv", text), HISTORY).notes if note.severity is Severity.CAUTION)
    assert warned.code == "column_not_taken"
    assert f"'{header}' is not taken; if it is load_N: --set" in warned.text


@pytest.mark.parametrize("header", ["Wear (g)", "Mass (kg)", "weight loss [g]", "Mass (Kg)"])
def test_what_is_weighed_is_not_offered_as_the_load(header):
    text = f"time_s,cof,{header}\n1,0.1,1\n2,0.2,2\n3,0.15,3\n"
    assert not any(note.severity is Severity.CAUTION for note in draft(InputFile("t.csv", text), HISTORY).notes)


@pytest.mark.parametrize(
    ("header", "newton", "said"),
    [("Load (g)", 9.80665e-3, "grams-force of 9.80665 mN"), ("Load [Kg]", 9.80665, "kilograms-force of 9.80665 N")],
)
def test_a_load_in_units_of_mass_is_one_of_force_and_that_is_said(header, newton, said):
    found = draft(InputFile("t.csv", f"time_s,cof,{header}\n1,0.1,200\n2,0.2,100\n3,0.15,1\n"), HISTORY)
    assert found.columns["load_N"].tolist() == pytest.approx([200.0 * newton, 100.0 * newton, newton], rel=1e-14)
    assert f"'{header}' is taken to be a load in {said}" in " ".join(map(str, found.notes))
