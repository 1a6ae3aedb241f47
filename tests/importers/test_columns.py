"""Which header is which column: answers are checked, every column is taken, two candidates are asked about."""

import shlex

import pytest

from mixedlub.case.folder import read_case
from mixedlub.cli import main
from mixedlub.importers import import_files
from mixedlub.importers.input_file import InputFile
from mixedlub.importers.likeness import likely_headers, likely_kind
from mixedlub.importers.matching import wanted
from mixedlub.importers.plain import draft
from mixedlub.kinds import NATIVE as KINDS
from mixedlub.kinds import kind as kind_of
from mixedlub.schema.toml_file import toml_value
from profiles.errors import InputError

DRIVE = {"kind": "friction_map", "recording.quantity": "friction_torque_Nm"}
BALL = {"geometry": "point", "radius_mm": [9.5, 20.0], "youngs_modulus_GPa": [206.0, 206.0]}
BALL["poisson_ratio"] = [0.3, 0.3]
SCREW = "drive,nominal_speed_rpm,mean_speed_rpm,mean_motor_torque_percent,mean_motor_torque_mNm,recorded\n" + "".join(
    f"1,{s},{s + 0.4},{0.1 * s + 3},{0.01 * s + 0.3 * s / abs(s)},2020-07-08 21:10:1{i}\n"
    for i, s in enumerate((-200, -100, -50, 50, 100, 200))
)


@pytest.fixture
def table(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def write(text, name="t.csv"):
        (tmp_path / name).write_text(text, encoding="utf-8")
        return tmp_path / name

    return write


def asked(words, capsys):
    """The settings suggested on standard error, and all of it."""
    assert main(words) == 2
    said = capsys.readouterr().err
    settings = [shlex.split(line.split("  (")[0])[1] for line in said.splitlines() if line.startswith("  --set")]
    return dict(s.split("=", 1) for s in settings), said


@pytest.mark.parametrize(
    ("key", "near"),
    [
        ("import.colums.speed_rpm", "import.columns.speed_rpm"),
        ("import.columns.spead_rpm", "import.columns.speed_rpm"),
        ("import.units.spead_rpm", "import.units.speed_rpm"),
        ("import.evry", "import.every"),
        ("import.decimals", "import.decimal"),
    ],
)
@pytest.mark.parametrize("kind", [{}, DRIVE])
def test_a_misspelt_import_key_is_refused_with_the_nearest(key, near, kind):
    with pytest.raises(InputError) as caught:
        draft(InputFile("t.csv", "speed_rpm,friction_torque_Nm\n1,2\n3,4\n"), {**kind, key: "x"})
    assert str(caught.value) == f"{key}: key is not known for this file; nearest known: {near!r}"


def test_instrument_files_refuse_keys_that_do_nothing_there(table):
    path = table("[step]\nHold\nViscosity\tStep time\tTemperature\nPa.s\ts\tdegC\n1\t1\t20\n2\t2\t20\n", "r.txt")
    with pytest.raises(InputError, match=r"import\.columns\.time_s: key is not known for this file"):
        import_files([path], path.parent / "case", **{"import.columns.time_s": "Step time"})


@pytest.mark.parametrize("header", ["speed_rpm", "speed [1/min]", "speed"])
def test_a_unit_that_a_column_cannot_have_is_refused_with_those_it_can(header):
    with pytest.raises(InputError) as caught:
        draft(InputFile("t.csv", f"{header},friction_torque_Nm\n1,2\n3,4\n"), {**DRIVE, "import.units.speed_rpm": "Hz"})
    assert str(caught.value) == (
        "import.units.speed_rpm: 'Hz': unit of speed_rpm is not known; it could be rpm, rad/s, deg/s, rev/s"
    )


def test_a_unit_for_a_column_that_nothing_is_taken_as_is_refused():
    with pytest.raises(InputError, match="no column is taken as torque_Nm"):
        draft(
            InputFile("t.csv", "speed_rpm,friction_torque_Nm\n1,2\n3,4\n"), {**DRIVE, "import.units.torque_Nm": "N.m"}
        )


def test_a_unit_that_is_told_goes_before_that_of_the_header_and_is_said():
    found = draft(
        InputFile("t.csv", "speed_rpm,friction_torque_Nm\n1,2\n3,4\n"), {**DRIVE, "import.units.speed_rpm": "rev/s"}
    )
    assert found.columns["speed_rpm"].tolist() == [60.0, 180.0]
    assert "'speed_rpm' is taken to be in rev/s, as answered" in " ".join(map(str, found.notes))


@pytest.mark.parametrize("kind", KINDS)
def test_every_column_of_a_kind_is_taken(kind):
    for quantity in kind_of(kind).quantities:
        answers = {"kind": kind, "recording.quantity": quantity, "recording.check": "coverage_percent"}
        answers["contact.geometry"] = "point"
        columns = [c for c in wanted(kind_of(kind), quantity, answers) if c.name != "sliding_speed_m_s"]
        row = ",".join("ground" if c.dtype == "name" else "0.5" for c in columns)
        header = ",".join(c.name for c in columns)
        found = draft(InputFile("t.csv", f"{header}\n{row}\n{row}\n"), answers)
        assert list(found.columns) == [c.name for c in columns]


@pytest.mark.parametrize("column", ["fringe_order", "time_s", "rig", "setup", "sequence", "film_thickness_nm_sd"])
def test_optional_columns_are_taken_from_headers_that_are_told(column):
    text = "load_N,entrainment_speed_m_s,slide_roll_ratio,oil_temperature_C,film_thickness_nm,mine (nm)\n"
    cell = "a" if column in ("rig", "setup") else "0.5"
    unit = {"import.units.time_s": "s"} if column == "time_s" else {}
    header = text if column == "film_thickness_nm_sd" else text.replace("mine (nm)", "mine")
    told = {"kind": "film", f"import.columns.{column}": header.strip().split(",")[-1], **unit}
    found = draft(InputFile("t.csv", f"{header}20,1,0,40,100,{cell}\n20,2,0,40,160,{cell}\n"), told)
    assert str(found.columns[column][0]) == cell


def test_the_sd_of_a_reading_is_in_the_unit_of_its_header():
    text = "speed_rpm,friction_torque_Nm,sd (N.mm)\n1,2,50\n3,4,\n"
    found = draft(InputFile("t.csv", text), {**DRIVE, "import.columns.friction_torque_Nm_sd": "sd (N.mm)"})
    assert found.columns["friction_torque_Nm_sd"][0] == 0.05


def test_additive_content_may_be_a_share():
    text = "speed_rpm,friction_torque_Nm,additive\n1,2,0.02\n3,4,0\n"
    found = draft(InputFile("t.csv", text), {**DRIVE, "import.units.additive_percent": "-"})
    assert found.columns["additive_percent"].tolist() == [2.0, 0.0]


def test_a_check_channel_that_the_file_lacks_is_refused():
    with pytest.raises(InputError, match=r"recording\.check: 'coverge': no such header.*'coverage'"):
        draft(
            InputFile("t.csv", "speed_rpm,friction_torque_Nm,coverage\n1,2,3\n"),
            {**DRIVE, "recording.check": "coverge"},
        )


def test_a_map_without_a_speed_is_asked_for_one_and_told_of_all_that_are_near(table, capsys):
    table(SCREW)
    words = ["import", "t.csv", "--out", "rig", "--set", "kind=friction_map"]
    words += ["--set", "recording.quantity=friction_torque_Nm"]
    suggested, said = asked(words, capsys)
    assert suggested["import.columns.speed_rpm"] == '"HEADER"'
    assert "equally likely: nominal_speed_rpm, mean_speed_rpm" in said
    suggested["import.columns.speed_rpm"] = '"mean_speed_rpm"'
    told = [w for key, value in suggested.items() for w in ("--set", f"{key}={value}")]
    assert main([*words, *told]) == 0
    assert main(["check", "rig"]) == 0


def test_a_map_with_both_speeds_is_asked_which(table, capsys):
    table("speed_rpm,sliding_speed_m_s,friction_torque_Nm\n1,1,2\n3,3,4\n4,4,5\n5,5,6\n6,6,7\n")
    words = ["import", "t.csv", "--out", "rig", "--set", "kind=friction_map"]
    words += ["--set", "recording.quantity=friction_torque_Nm"]
    suggested, said = asked(words, capsys)
    assert "speed_rpm and sliding_speed_m_s" in said
    assert suggested == {"import.columns.speed_rpm": '"speed_rpm"'}
    assert main([*words, "--set", 'import.columns.sliding_speed_m_s="sliding_speed_m_s"']) == 0
    assert "speed_rpm" not in read_case(table("", "x").parent / "rig").recordings


def test_two_headers_for_a_needed_column_are_asked_about(table, capsys):
    table("Motor speed (rpm),temperature (degC),Temp (degC),viscosity_mPa_s\n1,40,41,30\n1,60,61,12\n")
    suggested, said = asked(["import", "t.csv", "--out", "rig", "--set", "kind=viscosity"], capsys)
    assert suggested == {"import.columns.temperature_C": '"HEADER"'}
    assert "more than one could: one of temperature (degC), Temp (degC)" in said


def test_two_headers_that_hold_the_same_are_no_question():
    text = "temperature (degC),Temp (degC),viscosity_mPa_s\n40,40,30\n60,60,12\n"
    assert draft(InputFile("t.csv", text), {"kind": "viscosity"}).columns["temperature_C"].tolist() == [40.0, 60.0]


def test_the_choice_between_headers_of_a_column_that_is_not_needed_is_said():
    text = "temperature_C,viscosity_mPa_s,Test Time (s),Step Time (s)\n40,30,1,1\n60,12,9,1\n"
    found = draft(InputFile("t.csv", text), {"kind": "viscosity"})
    assert found.columns["time_s"].tolist() == [1.0, 9.0]
    assert "'Test Time (s)' taken as time_s, not 'Step Time (s)'" in " ".join(map(str, found.notes))


def test_a_header_that_is_told_serves_one_column_only():
    text = "speed_rpm,motor torque (Nm)\n1,2\n3,4\n"
    found = draft(InputFile("t.csv", text), {**DRIVE, "import.columns.friction_torque_Nm": "motor torque (Nm)"})
    assert list(found.columns) == ["speed_rpm", "friction_torque_Nm"]


def test_a_lead_screw_is_taken_for_a_map():
    header, *rows = [line.split(",") for line in SCREW.splitlines()]
    assert likely_kind(dict(zip(header, map(list, zip(*rows, strict=True)), strict=True))) == "friction_map"


@pytest.mark.parametrize(
    "header", ["ln_kinematic_viscosity", "ln viscosity", "log10(viscosity)", "kinematic_viscosity"]
)
def test_what_is_no_viscosity_in_mpas_is_never_offered(header):
    assert likely_headers(["viscosity_mPa_s"], {header: ["1.0"]}) == {}


def test_a_logarithm_is_refused_in_words():
    text = "temperature_C,ln_viscosity\n40,3.1\n60,2.5\n"
    told = {"kind": "viscosity", "import.columns.viscosity_mPa_s": "ln_viscosity"}
    with pytest.raises(InputError, match=r"import\.columns\.viscosity_mPa_s: 'ln_viscosity': is a logarithm"):
        draft(InputFile("t.csv", text), told)
    (question,) = (q for q in draft(InputFile("t.csv", text), {"kind": "viscosity"}).questions if "columns" in q.key)
    assert question.example == '"HEADER"'
    assert "ln_viscosity: a logarithm cannot be taken" in question.text


def test_a_kinematic_viscosity_is_refused_in_words():
    text = "temperature_C,kinematic_viscosity\n40,30\n60,12\n"
    told = {"kind": "viscosity", "import.columns.viscosity_mPa_s": "kinematic_viscosity"}
    with pytest.raises(InputError, match="times the density"):
        draft(InputFile("t.csv", text), told)


def test_remarks_and_empty_columns_are_not_offered_as_surfaces():
    remarks = ["pump on", "noisy", "restarted", "oil added", "noisy again", "stopped"]
    free = {"Bemerkung": remarks, "note": ["", "", "", "restarted"], "left over": ["", "-", ""]}
    assert likely_headers(["pinion_surface"], free) == {}
    assert likely_headers(["pinion_surface"], {**free, "flanks": ["ground", "fine"] * 3}) == {
        "pinion_surface": "flanks"
    }


def test_dates_are_not_offered_as_surfaces():
    assert likely_headers(["surface_1"], {"recorded": ["2020-07-08 21:10:13"], "clock": ["21:10"]}) == {}


@pytest.mark.parametrize(
    ("header", "column", "value"), [("Temp_F", "temperature_C", 37.8), ("temp [°F]", "temperature_C", 37.8)]
)
def test_fahrenheit_in_a_header_is_read(header, column, value):
    found = draft(InputFile("t.csv", f"{header},viscosity_mPa_s\n100,30\n120,12\n"), {"kind": "viscosity"})
    assert found.columns[column][0] == pytest.approx(value, abs=0.05)


def test_pound_feet_in_a_header_are_read():
    found = draft(InputFile("t.csv", "speed_rpm,friction_torque_lbft\n1,2\n3,4\n"), DRIVE)
    assert found.columns["friction_torque_Nm"][0] == pytest.approx(2.7116, rel=1e-4)


def test_no_unit_is_offered_where_the_header_may_end_in_one_that_is_not_known():
    def offered(header):
        text = f"speed_rpm,{header}\n1,2\n3,4\n"
        found = draft(InputFile("t.csv", text), {**DRIVE, "import.columns.friction_torque_Nm": header})
        (question,) = (q for q in found.questions if q.key == "import.units.friction_torque_Nm")
        return question.example

    assert offered("friction_torque_kpm") == '"UNIT"'
    assert offered("friction torque") == '"N.m"'


def test_capitals_tell_milli_from_mega():
    text = "temperature_C,pressure_mPa,viscosity_mPa_s\n40,1,30\n60,1,12\n"
    assert (
        "pressure_MPa"
        not in draft(InputFile("t.csv", text), {"kind": "viscosity", "import.units.temperature_C": "C"}).columns
    )


def test_a_unit_may_be_told_before_the_header_is():
    found = draft(InputFile("t.csv", "a,friction_torque_Nm\n1,2\n"), {**DRIVE, "import.units.speed_rpm": "rev/s"})
    assert "import.columns.speed_rpm" in {q.key for q in found.questions}


@pytest.mark.parametrize(
    "header", ["mu", "µ", "μ", "COF", "CoF", "friction coeff.", "Mu (-)", "Coefficient of friction", "DAQ.COF ()"]
)
def test_friction_coefficients_as_they_are_written(header):
    cells = {"Time (s)": ["1", "2"], header: ["0.1", "0.2"]}
    assert likely_kind(cells) == "friction_history"
    told = {"kind": "friction_history", "import.units.friction_coefficient": "-"}
    found = draft(InputFile("t.csv", f"Time (s);{header}\n1;0.1\n2;0.2\n"), told)
    assert found.columns["friction_coefficient"].tolist() == [0.1, 0.2]


def test_a_mu_in_a_unit_of_viscosity_is_no_friction_coefficient():
    cells = {"T (K)": ["300", "310"], "mu (Pa s)": ["0.1", "0.2"]}
    assert likely_headers(["friction_coefficient"], cells) == {}
    assert likely_headers(["viscosity_mPa_s"], cells) == {"viscosity_mPa_s": "mu (Pa s)"}
    assert likely_kind(cells) == "viscosity"


HISTORY = {"kind": "friction_history"}


def test_a_friction_in_the_unit_of_a_viscosity_is_none():
    text = "Time (s);mu [mPa s];COF [-]\n1;100;.1\n2;100;.2\n3;90;.1\n"
    found = draft(InputFile("t.csv", text), HISTORY)
    assert found.columns["friction_coefficient"].tolist() == [0.1, 0.2, 0.1]
    assert not [q.key for q in found.questions if q.needed and q.key not in HISTORY]


def test_a_reading_beside_a_unit_of_another_quantity_is_asked_for():
    text = "Time (s);mu [mPa s];Friction force ratio\n1;100;.1\n2;100;.2\n3;90;.1\n"
    asked = {q.key: q.example for q in draft(InputFile("t.csv", text), HISTORY).questions if q.needed}
    assert asked["import.columns.friction_coefficient"] == '"Friction force ratio"'


def test_a_position_along_a_screw_is_no_angle():
    text = "speed_rpm;Position [mm];friction_torque_Nm\n1;5;.1\n2;6;.2\n3;7;.1\n"
    assert "position_deg" not in draft(InputFile("t.csv", text), DRIVE).columns


def test_a_time_counted_in_cycles_is_still_the_time():
    text = "Time (cycles);COF [-]\n1;.1\n2;.2\n3;.1\n"
    found = draft(InputFile("t.csv", text), {**HISTORY, "import.seconds_a_cycle": 2.0})
    assert found.columns["time_s"].tolist() == [2.0, 4.0, 6.0]


def test_a_unit_that_is_not_known_is_refused_with_those_that_could_be():
    with pytest.raises(InputError, match="'ft/min': unit of sliding_speed_m_s is not known"):
        draft(InputFile("t.csv", "Sliding speed (ft/min);friction_torque_Nm\n1;.1\n2;.2\n3;.1\n"), DRIVE)


@pytest.mark.parametrize(
    "loss", ["Torque Loss [Nm]", "Loss torque [Nm]", "Drag torque (Nm)", "Loss [Nm]", "Verlust [Nm]"]
)
def test_the_torque_that_loads_a_drive_is_not_offered_as_its_friction(loss, table, capsys):
    table(
        f"Input Speed [rpm],Input Torque [Nm],{loss}\n" + "".join(f"{600 + i},{200 * i},{20 + i}\n" for i in range(6))
    )
    cells = {"Input Torque [Nm]": ["0", "200"], loss: ["19.6", "23.5"]}
    assert likely_headers(["friction_torque_Nm"], cells) == {"friction_torque_Nm": loss}
    settings = [f"--set={key}={toml_value(value)}" for key, value in DRIVE.items()]
    main(["import", "t.csv", "--out", "rig", *settings])
    said = capsys.readouterr().err
    assert 'friction_torque_Nm="Input Torque' not in said


def test_other_columns_that_may_hold_the_reading_are_told_with_the_setting_that_takes_each(table, capsys):
    path = table(
        "Time (s),Friction COF effective value,Friction absolute integral,COF,Friction force,COF hysteresis (1/µm)\n"
        + "".join(f"{i},0.12{i},0.11{i},0.16{i},2{i},0.01{i}\n" for i in range(9))
    )
    told = ["import", str(path), "--set", "kind=friction_history", "--set", "import.units.friction_coefficient=-"]
    assert main([*told, "--out", "one"]) == 0
    (line,) = [line for line in "".join(capsys.readouterr()).splitlines() if "if another is meant" in line]
    assert line == (
        "caution: t.csv: 'COF' is taken as friction_coefficient; if another is meant, "
        "'Friction COF effective value': --set 'import.columns.friction_coefficient=\"Friction COF effective value\"', "
        "or 'Friction absolute integral': --set 'import.columns.friction_coefficient=\"Friction absolute integral\"'"
    )
    setting = shlex.split(line)[-1]
    assert main([*told, "--set", setting, "--out", "two"]) == 0
    assert "if another is meant" not in "".join(capsys.readouterr())
    assert read_case(table("", "x").parent / "two").recordings["friction_coefficient"][1] == 0.111
