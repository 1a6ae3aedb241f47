"""Tables of laboratories that need a question before the case is written, another reading, or a refusal."""

import numpy as np
import pytest

from mixedlub.case.folder import read_case
from mixedlub.importers import import_files
from mixedlub.importers.base import Unanswered
from mixedlub.importers.input_file import InputFile
from mixedlub.importers.plain import draft
from mixedlub.importers.text_table import read_sheet
from mixedlub.importers.wizard import read
from mixedlub.schema.findings import codes
from mixedlub.schema.units import split
from profiles.errors import InputError

VISCOSITIES = [(20, 300), (40, 100), (60, 42), (80, 20), (100, 12)]


def table(header, rows, separator=","):
    return "\n".join([header, *(separator.join(map(str, row)) for row in rows)]) + "\n"


def drafted(text, **told):
    return draft(InputFile("t.csv", text), told)


def keys_needed(text, **told):
    return {q.key: q for q in drafted(text, **told).questions if q.needed and q.key not in told}


def test_kinematic_units_are_among_those_of_a_viscosity():
    question = keys_needed(table("Temperature (°C),Viscosity", VISCOSITIES), kind="viscosity")[
        "import.units.viscosity_mPa_s"
    ]
    assert {"mm2/s", "m2/s", "mPa.s"} <= set(question.options)


@pytest.mark.parametrize(
    ("header", "unit"),
    [("nu_m2_s", "m2/s"), ("speed_um_s", "um/s"), ("rate_1_s", "1/s"), ("time_s", "s"), ("n_1_min", "1/min")],
)
def test_a_unit_over_another_in_a_name_is_no_time(header, unit):
    assert split(header)[1] == unit


def test_a_speed_in_rpm_is_not_proposed_as_one_in_metres_a_second():
    text = table(
        "Speed (rpm);Sliding Velocity (m/s);SRR (%);Load (N);COF",
        [(200 + i, "0,5", 5, 20, f"0,1{i}") for i in range(1, 8)],
        ";",
    )
    assert "rpm" not in keys_needed(text, kind="disc")["import.columns.entrainment_speed_m_s"].example


def test_a_stated_uncertainty_is_proposed(tmp_path):
    text = table("Temperature (°C),Viscosity (mPa s),Uncertainty (mPa s)", [(t, v, v / 100) for t, v in VISCOSITIES])
    (note,) = [n for n in drafted(text, kind="viscosity").notes if n.code == "column_not_taken"]
    assert "import.columns.viscosity_mPa_s_sd" in note.text
    share = table("Temperature (°C),Viscosity (mPa s),Uncertainty (%)", [(t, v, 1.5) for t, v in VISCOSITIES])
    (note,) = [n for n in drafted(share, kind="viscosity").notes if n.code == "column_not_taken"]
    assert "recording.noise.relative=0.015" in note.text


def test_a_header_between_blanks_above_tabs_is_read():
    text = table("Time Load Friction COF", [(i, 20, 2 + i, 0.1) for i in range(4)], "\t").replace("Time\t", "Time ")
    assert list(read_sheet(text, "t.txt").cells) == ["Time", "Load", "Friction", "COF"]


HOT = table("Temperature (K),Viscosity (mPa s)", [(t + 273, v) for t, v in VISCOSITIES] + [(680, 0.2)])


def test_a_number_beyond_its_range_is_named_as_it_stands_and_may_be_left_out():
    with pytest.raises(InputError) as caught:
        drafted(HOT, kind="viscosity")
    assert caught.value.value == "680"
    assert "680 K is 406.85 °C" in caught.value.rule
    kept = drafted(HOT, **{"kind": "viscosity", "import.only.Temperature (K)": "..650"})
    assert kept.columns["temperature_C"].size == len(VISCOSITIES)


PRESSED = [(t, p, v * np.exp(0.02 * p)) for t, v in VISCOSITIES for p in (0, 100, 425)]


@pytest.mark.parametrize(
    ("header", "key"), [("P (bar)", "import.columns.pressure_MPa"), ("p", "import.columns.COLUMN")]
)
def test_a_pressure_that_would_be_dropped_is_asked_for_first(tmp_path, header, key):
    text = table(f"Temperature (°C),{header},Viscosity (mPa s)", PRESSED)
    question = keys_needed(text, kind="viscosity")["import.leave"]
    assert key in question.text
    path = tmp_path / "t.csv"
    path.write_text(text)
    with pytest.raises(Unanswered):
        import_files([path], tmp_path / "case", kind="viscosity")
    assert not (tmp_path / "case").exists()
    assert not keys_needed(text, **{"kind": "viscosity", "import.leave": header})
    assert not keys_needed(text, **{"kind": "viscosity", f"import.only.{header}": 0})
    with pytest.raises(InputError, match=r"import\.leave"):
        drafted(text, **{"kind": "viscosity", "import.leave": ["pressure"]})


def test_readings_that_scatter_at_equal_conditions_raise_no_question():
    rng = np.random.default_rng(5)
    rows = [(t, rng.normal(), v + rng.normal()) for t, v in VISCOSITIES for _ in range(4)]
    assert not keys_needed(table("Temperature (°C),Tilt,Viscosity (mPa s)", rows), kind="viscosity")


def test_a_shear_rate_is_taken_by_no_kind():
    rows = [(10**i, 25, 100 / i) for i in range(1, 6)]
    text = table("Shear rate (1/s),Temperature (°C),Viscosity (mPa s)", rows)
    assert "shear rate" in keys_needed(text, kind="viscosity")["import.leave"].text


@pytest.mark.parametrize(
    "header", ["Specimen,Distance (m),Weight loss (mg)", "Load (N),Distance (m),Wear volume (mm3)", "Alpha,Beta,Gamma"]
)
def test_a_table_without_a_reading_is_refused_with_what_is_taken(header):
    with pytest.raises(InputError, match=r"nothing here is recognised.*friction_coefficient.*viscosity_mPa_s"):
        drafted(table(header, [(i, 100 * i, 1.2 * i) for i in range(1, 6)]))


@pytest.mark.parametrize("header", ["Weight loss", "Wear (-)", "Mass loss (%)"])
def test_wear_is_no_friction(header):
    text = table(f"Time (s),{header}", [(i, 0.1 * i) for i in range(1, 6)])
    with pytest.raises(InputError, match="is wear"):
        drafted(text, **{"kind": "friction_history", "import.columns.friction_coefficient": header})


@pytest.mark.parametrize(("header", "doubted"), [("lnviscosity (mPa s)", True), ("Viscosity (mPa s)", False)])
def test_a_logarithm_of_a_viscosity_is_doubted(header, doubted):
    text = table(f"Temperature (°C),{header}", [(t, np.log(v)) for t, v in VISCOSITIES])
    told = {"kind": "viscosity", "import.columns.viscosity_mPa_s": header}
    assert ("viscosity_logarithm" in codes(drafted(text, **told).notes)) == doubted


def stroke(turn=""):
    """Position 5 mm cos(2 pi t), so that the speed is -10 pi mm/s sin(2 pi t)."""
    times = np.arange(0.0, 1.005, 0.01)
    place, force = 5 * np.cos(2 * np.pi * times), -2 * np.sign(np.sin(2 * np.pi * times))
    return times, table(
        f"Time (s),Position (mm),Friction force (N),Load (N){turn}", zip(times, place, force, 0 * times + 20)
    )


def test_the_speed_of_a_map_may_be_the_change_of_a_position(tmp_path):
    times, text = stroke()
    told = {"kind": "friction_map", "recording.quantity": "friction_coefficient"}
    (question,) = keys_needed(text, **told).values()
    assert "import.speed_from=Position (mm)" in question.text
    found = drafted(text, **told, **{"import.speed_from": "Position (mm)"}).columns
    inner = slice(1, -1)
    expected = -1e-2 * np.pi * np.sin(2 * np.pi * times)
    assert np.allclose(found["sliding_speed_m_s"][inner], expected[inner], atol=1e-4)
    with pytest.raises(InputError, match="position"):
        drafted(text, **told, **{"import.speed_from": "Load (N)"})


def test_a_dropped_column_that_changes_with_the_reading_is_said():
    rows = [(0.1 * i, i if i < 20 else 10 * i, 0.1 if i < 20 else 0.2) for i in range(40)]
    told = {"kind": "friction_history", "import.units.friction_coefficient": "-"}
    notes = drafted(table("Time (s),Displacement (um),COF", rows), **told).notes
    (note,) = [n for n in notes if n.code == "column_changes_with_reading"]
    assert "Displacement (um)" in note.text


def test_tables_under_one_repeated_header_are_one_table():
    rows = [(100 * i, 0.5 * i) for i in range(1, 5)]
    part = table("Speed (rpm),Friction torque (Nm)", rows)
    found = drafted(f"{part}\n{part}", kind="friction_map", **{"recording.quantity": "friction_torque_Nm"})
    assert found.columns["speed_rpm"].size == 8
    assert any("repeats the header" in str(note) for note in found.notes)


LVM = """LabVIEW Measurement\t
Writer_Version\t2
Separator\tTab
Decimal_Separator\t.
X_Columns\tOne
Time\t10:00:00.1
***End_of_Header***\t
\t
Channels\t2\t\t
Samples\t3\t3\t
Y_Unit_Label\t-\tN
X_Dimension\tTime\tTime
X0\t0.0\t0.0
Delta_X\t0.1\t0.1
***End_of_Header***\t\t\t
X_Value\tCOF\tLoad\tComment
0.0\t0.10\t20.5
0.1\t0.11\t20.5
0.2\t0.12\t20.5
"""
SECOND = LVM[LVM.index("Channels") : LVM.index("0.0\t0.10")] + "0.3\t0.12\t20.5\n0.4\t0.13\t20.5\n0.5\t0.14\t20.5\n"
TIMES = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5]


@pytest.mark.parametrize(("text", "times"), [(LVM, TIMES[:3]), (f"{LVM}\n{SECOND}", TIMES)])
def test_labview_measurements_are_read(text, times):
    found = read([InputFile("t.lvm", text)], {"kind": "friction_history"})
    assert found.columns["time_s"].tolist() == times
    assert found.columns["load_N"].tolist() == [20.5] * len(times)


def test_labview_measurements_without_a_column_of_times_have_them_by_the_clock(tmp_path):
    text = LVM.replace("X_Columns\tOne", "X_Columns\tNo")
    for row in ("0.0\t0.10", "0.1\t0.11", "0.2\t0.12"):
        text = text.replace(f"\n{row}", "\n\t" + row.partition("\t")[2])
    found = read([InputFile("t.lvm", text)], {"kind": "friction_history"})
    assert np.allclose(found.columns["time_s"], [0.0, 0.1, 0.2])


def test_the_question_on_a_dropped_column_may_be_answered_at_a_terminal(tmp_path, at_terminal):
    (tmp_path / "t.csv").write_text(table("Temperature (°C),p,Viscosity (mPa s)", PRESSED))
    user = at_terminal(tmp_path / "t.csv", tmp_path / "case", ["kind=viscosity"], {"'p' would be left out": ["p"]})
    assert len(user.forms) == 1
    assert len(read_case(tmp_path / "case").recordings) == len(PRESSED)
