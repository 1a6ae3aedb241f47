"""What a table leaves open is asked all at once, one question a line, with the likely answer."""

import shlex

import pytest

from mixedlub.cli import main
from mixedlub.importers import import_files
from mixedlub.importers.input_file import InputFile
from mixedlub.importers.likeness import likely_headers, likely_kind
from mixedlub.importers.plain import draft
from mixedlub.importers.vocabulary import TARGETS
from profiles.errors import InputError

RIG8 = """# rig 8, campaign 3
Power loss [kW];Pinion torque [Nm];Pinion speed [1/min];Oil sump temp [°C];Pinion flank;Wheel flank

0,0175;50;500;40;ground;polished
0,0275;50;1000;40;ground;ground
0,05;100;1000;60;polished;ground
"""


@pytest.fixture
def rig8(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "rig8.csv"
    path.write_text(RIG8, encoding="utf-8")
    return path


def asked(capsys):
    """The settings suggested on standard error, one a line, and the last line."""
    *lines, last = capsys.readouterr().err.splitlines()
    settings = [shlex.split(line.split("  (")[0])[1] for line in lines]
    return dict(s.split("=", 1) for s in settings), last


def test_everything_is_asked_at_once_with_the_likely_answers(rig8, capsys):
    assert main(["import", "rig8.csv", "--out", "rig"]) == 2
    suggested, last = asked(capsys)
    assert suggested == {
        "kind": '"gear_pair"',
        "import.columns.speed_rpm": '"Pinion speed [1/min]"',
        "import.columns.oil_temperature_C": '"Oil sump temp [°C]"',
        "import.columns.pinion_surface": '"Pinion flank"',
        "import.columns.gear_surface": '"Wheel flank"',
    }
    assert last.startswith("mixedlub: import: 5 answers are missing")


def test_the_suggested_settings_are_all_that_is_needed(rig8, capsys):
    main(["import", "rig8.csv", "--out", "rig"])
    suggested, _ = asked(capsys)
    words = [word for key, value in suggested.items() for word in ("--set", f"{key}={value}")]
    assert main(["import", "rig8.csv", "--out", "rig", *words]) == 0
    text = (rig8.parent / "rig/recordings.csv").read_text(encoding="utf-8")
    assert text.splitlines()[1] == "1,50,500,40,ground,polished,17.5"


def test_one_answer_missing_is_not_a_plural(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "t.csv").write_text("temperature_C,viscosity_mPa_s\n40,30\n100,5\n", encoding="utf-8")
    assert main(["import", "t.csv", "--out", "rig"]) == 2
    suggested, last = asked(capsys)
    assert suggested == {"kind": '"viscosity"'}
    assert "1 answer is missing" in last


def test_the_unit_of_a_likely_column_is_asked_with_the_column(rig8, capsys):
    rig8.write_text(RIG8.replace("Pinion speed [1/min]", "Pinion speed"), encoding="utf-8")
    main(["import", "rig8.csv", "--out", "rig"])
    suggested, _ = asked(capsys)
    assert suggested["import.columns.speed_rpm"] == '"Pinion speed"'
    assert suggested["import.units.speed_rpm"] == '"rpm"'


def test_headers_with_quotes_are_suggested_as_they_must_be_typed(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "t.csv").write_text("temp's 'T' (degC)\tviscosity_mPa_s\n40\t30\n100\t5\n", encoding="utf-8")
    main(["import", "t.csv", "--out", "rig", "--set", "kind=viscosity"])
    suggested, _ = asked(capsys)
    assert suggested == {"import.columns.temperature_C": "\"temp's 'T' (degC)\""}


def test_a_header_in_another_unit_is_never_suggested():
    cells = {"Load speed [m/s]": ["1"], "Belastung [kN]": ["2"]}
    assert likely_headers(["load_N"], cells) == {"load_N": "Belastung [kN]"}


def test_where_no_header_is_near_none_is_suggested(tmp_path):
    path = tmp_path / "t.csv"
    path.write_text("Ort,viscosity_mPa_s\nx,30\ny,5\n", encoding="utf-8")
    with pytest.raises(InputError, match=r'temperature_C="HEADER"'):
        import_files([path], tmp_path / "case", kind="viscosity")


@pytest.mark.parametrize(
    ("headers", "kind"),
    [
        ("Load [N],Rolling speed [m/s],SRR [%],Oil temp [degC],Film [nm]", "film"),
        ("Load [N],Rolling speed [m/s],SRR [%],Oil temp [degC],Body 1,Body 2,Traction coeff [-]", "disc"),
        ("Time [s],COF", "friction_history"),
        ("Motor speed [rpm],Friction torque [Nm]", "friction_map"),
        ("Temperature [degC],Viscosity [mPa.s]", "viscosity"),
        ("time_s,load_N,speed_mm_s,srr_percent,lube_probe_temp_degC,friction_coefficient", "friction_history"),
        ("Test no.,T1 [Nm],n1 [1/min],Oil sump temp. [°C],Pv total [kW]", "gear_pair"),
        ("M1 [Nm],n1 [rpm],Oil temp [°C],Loss [W]", "gear_pair"),
        ("output_speed_rad_s,ideal_drive_torque_Nm,torque_sensor_Nm,motor_temp_degC", "friction_map"),
        (
            "Torque [Nm],Speed [rpm],Roll angle [deg],Oil temp [degC],Flank 1,Flank 2,Friction coefficient",
            "mesh_friction",
        ),
    ],
)
def test_the_likely_kind(headers, kind):
    cells = {h: ["ground"] if h.startswith(("Body", "Flank")) else ["1.0"] for h in headers.split(",")}
    assert likely_kind(cells) == kind


def test_every_column_is_nearest_to_the_words_instruments_use_for_it():
    cells = {f"{t.spoken[0]} ": ["1.0"] for t in TARGETS}
    assert likely_headers([t.name for t in TARGETS], cells) == {t.name: f"{t.spoken[0]} " for t in TARGETS}


def test_a_disc_is_asked_whether_line_or_point(tmp_path):
    path = tmp_path / "t.csv"
    headers = "load_N,entrainment_speed_m_s,slide_roll_ratio,oil_temperature_C,surface_1,surface_2"
    path.write_text(f"{headers},friction_coefficient\n20,1,0.1,40,a,b,0.05\n40,1,0.1,40,a,b,0.04\n", encoding="utf-8")
    contact = {"radius_mm": [20.0, 25.4], "youngs_modulus_GPa": [206.0, 206.0], "poisson_ratio": [0.3, 0.3]}
    with pytest.raises(InputError, match=r"contact\.geometry=.*\n.*contact\.width_mm="):
        import_files([path], tmp_path / "case", kind="disc", contact=contact)
    with pytest.raises(InputError, match=r"1 answer is missing[^\n]*\n.*contact\.width_mm="):
        import_files([path], tmp_path / "case", kind="disc", contact={**contact, "geometry": "line"})
    import_files([path], tmp_path / "point", kind="disc", contact={**contact, "geometry": "point"})
    import_files([path], tmp_path / "line", kind="disc", contact={**contact, "width_mm": 6.0})


def test_a_bad_cell_is_named_with_its_line(rig8):
    rig8.write_text(RIG8.replace("0,0275;", "abc;"), encoding="utf-8")
    columns = {"speed_rpm": "Pinion speed [1/min]", "oil_temperature_C": "Oil sump temp [°C]"}
    told = {f"import.columns.{k}": v for k, v in columns.items()}
    with pytest.raises(InputError, match="must be a number") as caught:
        import_files([rig8], rig8.parent / "rig", kind="gear_pair", **told)
    assert str(caught.value).startswith("rig8.csv: line 5, Power loss [kW]: 'abc': ")


def test_a_row_with_other_cells_is_named_with_its_line(rig8):
    rig8.write_text(RIG8.replace("0,05;100;", "0,05;"), encoding="utf-8")
    with pytest.raises(InputError, match=r"rig8\.csv: line 6: has not as many cells"):
        import_files([rig8], rig8.parent / "rig", kind="gear_pair")


LOSS = "torque [Nm];speed [rpm];oil_temperature_C;power_loss_W\n50;500;40;17\n100;500;40;30\n"


def test_surfaces_that_are_the_same_in_all_rows_are_told_once(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "t.csv").write_text(LOSS, encoding="utf-8")
    words = ["import", "t.csv", "--out", "rig", "--set", "kind=gear_pair"]
    assert main(words) == 2
    assert "or import.values.pinion_surface=... if all rows have the same" in capsys.readouterr().err
    values = [f"import.values.{side}_surface=ground" for side in ("pinion", "gear")]
    assert main([*words, "--set", values[0], "--set", values[1]]) == 0
    assert "t.csv: the same in all rows, as answered: pinion_surface, gear_surface" in capsys.readouterr().out
    assert (tmp_path / "rig/recordings.csv").read_text(encoding="utf-8").splitlines()[
        1
    ] == "1,50,500,40,17,ground,ground"


def test_one_value_is_checked_and_needs_no_header_beside_it(tmp_path):
    path = tmp_path / "t.csv"
    path.write_text(LOSS.replace("oil_temperature_C", "sump"), encoding="utf-8")
    told = {"kind": "gear_pair", "import.values.pinion_surface": "a", "import.values.gear_surface": "a"}
    for value, header, wrong in (
        (900, {}, "must lie between"),
        (40, {"import.columns.oil_temperature_C": "sump"}, "too"),
    ):
        with pytest.raises(InputError, match=wrong) as error:
            import_files([path], tmp_path / "c", **told, **{"import.values.oil_temperature_C": value}, **header)
        assert error.value.where == "import.values.oil_temperature_C"


def test_a_surface_is_found_under_its_name_with_a_blank(tmp_path):
    path = tmp_path / "t.csv"
    rows = LOSS.replace("power_loss_W", "power_loss_W;pinion surface;Gear-Surface").replace("17\n", "17;a;b\n")
    path.write_text(rows.replace("30\n", "30;b;a\n"), encoding="utf-8")
    folder = import_files([path], tmp_path / "c", kind="gear_pair")
    assert (
        (folder / "recordings.csv")
        .read_text(encoding="utf-8")
        .startswith("run,torque_Nm,speed_rpm,oil_temperature_C,p")
    )


def test_settings_pasted_with_their_blanks_are_refused(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    rows = "load_N,entrainment_speed_m_s,slide_roll_ratio,oil_temperature_C,film_thickness_nm\n20,1,0,40,90\n"
    (tmp_path / "t.csv").write_text(rows, encoding="utf-8")
    assert main(["import", "t.csv", "--out", "rig", "--set", "kind=film"]) == 2
    suggested, _ = asked(capsys)
    assert set(suggested) == {
        f"contact.{key}" for key in ("geometry", "width_mm", "radius_mm", "youngs_modulus_GPa", "poisson_ratio")
    }
    words = [word for key, value in suggested.items() for word in ("--set", f"{key}={value}")]
    assert main(["import", "t.csv", "--out", "rig", "--set", "kind=film", *words]) == 2
    assert "contact.geometry: 'LINE OR POINT': must be 'line' or 'point'" in capsys.readouterr().err
    assert not (tmp_path / "rig").exists()


@pytest.mark.parametrize(
    ("column", "header"),
    [
        ("time_s", "duration_s"),
        ("time_s", "time constant (s)"),
        ("load_N", "load_damping"),
        ("load_N", "Load damping (N)"),
        ("load_N", "load cell zero (N)"),
        ("friction_coefficient", "initial_slope_friction_coefficient"),
        ("friction_coefficient", "initial_slope_mu"),
        ("friction_torque_Nm", "initial_slope_Nm"),
        ("oil_temperature_C", "oil temperature rise (K)"),
        ("viscosity_mPa_s", "viscosity index"),
        ("film_thickness_nm", "film gradient (nm)"),
    ],
)
def test_a_header_of_another_thing_is_not_proposed_for_the_word_in_it(column, header):
    assert likely_headers([column], {header: ["1", "2"]}) == {}
    assert likely_headers([column], {header: ["1", "2"], column: ["1", "3"]}) == {column: column}


def test_a_needed_column_that_only_another_thing_is_near_is_asked_without_a_proposal():
    found = draft(InputFile("t.csv", "duration_s,mu\n1,0.1\n2,0.2\n"), {"kind": "friction_history"})
    (question,) = [q for q in found.questions if q.key == "import.columns.time_s"]
    assert question.example == '"HEADER"'
    assert question.options == ("duration_s", "mu")


GERMAN = """Test no.;T1 [Nm];n1 [1/min];Oil sump temp. [°C];Pv total [kW]
1;50,0;500;40,0;0,0175
2;50,0;1000;40,0;0,0275
3;100,5;1000;60,0;0,0505
"""


def test_torque_speed_and_a_loss_in_kilowatts_are_a_gear_loss(tmp_path, monkeypatch, capsys):
    """By the words of the oil's temperature alone it would be a viscosity."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rig.csv").write_text(GERMAN, encoding="utf-8")
    assert main(["import", "rig.csv", "--out", "rig"]) == 2
    suggested, _ = asked(capsys)
    columns = {
        "kind": '"gear_pair"',
        "import.columns.torque_Nm": '"T1 [Nm]"',
        "import.columns.speed_rpm": '"n1 [1/min]"',
        "import.columns.oil_temperature_C": '"Oil sump temp. [°C]"',
        "import.columns.power_loss_W": '"Pv total [kW]"',
    }
    assert {key: value for key, value in suggested.items() if "_surface" not in key} == columns
    words = [word for key, value in columns.items() for word in ("--set", f"{key}={value}")]
    both = [word for side in ("pinion", "gear") for word in ("--set", f"import.values.{side}_surface=ground")]
    assert main(["import", "rig.csv", "--out", "rig", *words, *both]) == 0
    last = (tmp_path / "rig/recordings.csv").read_text(encoding="utf-8").splitlines()[-1]
    assert last == "3,100.5,1000,60,50.5,ground,ground"


@pytest.mark.parametrize(
    ("reading", "headers"),
    [
        ("friction_torque_Nm", "ideal_drive_torque_Nm,torque_sensor_Nm"),
        ("friction_torque_Nm", "Input torque [Nm],Output torque [Nm]"),
        ("power_loss_W", "Input power [kW],Output power [kW]"),
    ],
)
def test_a_transmitted_torque_or_power_is_not_proposed_as_the_loss(reading, headers):
    kind = "friction_map" if reading == "friction_torque_Nm" else "gear_pair"
    text = f"speed_rpm,{headers}\n1,5,4\n2,6,5\n3,7,6\n"
    found = draft(InputFile("t.csv", text), {"kind": kind, "recording.quantity": reading})
    (question,) = [q for q in found.questions if q.key == f"import.columns.{reading}"]
    assert question.example == '"HEADER"'
    assert question.needed
    assert all(header in question.text.split(" file has ")[0] for header in headers.split(","))
