"""Instrument files into case folders: constructed files, every unit read, nothing guessed."""

import numpy as np
import pytest

from mixedlub.case.folder import read_case
from mixedlub.importers import import_files
from mixedlub.importers.vocabulary import convert, target_of
from mixedlub.importers.wizard import run
from mixedlub.schema.units import split
from profiles.errors import InputError

BALL = {"radius_mm": [9.525, float("inf")], "youngs_modulus_GPa": [207.0, 75.0], "poisson_ratio": [0.3, 0.22]}

EHD_HEAD = (
    "Rolling Speed (mm/s)\tAverage Film (nm)\t\tStep Time (s)\tLube Temp (°C)\tPot Temp (°C)\tBall Load (N)"
    "\tRolling Speed (mm/s)\tSRR (%)\t\tAverage Film (nm)\tStandard Deviation (nm)\tOrder\tImage file name"
)
EHD = """EHD261 Test Data File
Profile description:\tsweep
Test started at 01/02/2017 15:47

Step 1 "spacer" started at 01/02/2017 15:48
Step type\tFILM_ZERO\tStep description\tspacer
Spacer thickness = 519.7 nm

Step 2 "film" started at 01/02/2017 16:09
Step type\tFILM\tStep description\tfilm
@HEAD
20.2\t24.4\t\t10\t40.4\t41.2\t20.025\t20.21\t0.5\t\t24.4\t0.00\t3\tone.bmp
25.3\t30.6\t\t18\t40.4\t41.3\t19.994\t25.32\t-0.5\t\t30.6\t0.00\t3\ttwo.bmp

Step 3 "zero" started at 01/02/2017 16:13
Step type\tZERO_CHECK\tStep description\tcheck
""".replace("@HEAD", EHD_HEAD)

MTM_HEAD = (
    "Step Time (s)\tTraction Coeff (-)\t\tStep Time (s)\tPot RTD Temp (degC)\tLube RTD Temp (degC)\tBall Load (N)"
    "\tPin Load (N)\tRolling Speed (mm/s)\tSliding Speed (mm/s)\tSRR (%)\tTraction Coeff (-)"
)


def mtm(lube=119.0):
    """Two timed steps a minute apart, a mapper step between."""
    rows = "\n".join(f"{s}\t0.0{s}\t\t{s}\t120.0\t{lube}\t49.9\t\t200.0\t200.0\t100.0\t0.0{s}" for s in (1, 2, 3))
    step = "Step type\tBOD_TIMED\tStep description\trub\tStep duration\t00:00:03\nZero traction force (N)\t0.5\n"
    return (
        "MTM311 Test Data File\nTest started at 23/03/2018 10:02:57\n\n"
        f"Step 1 started at 23/03/2018 10:10:00\n{step}{MTM_HEAD}\n{rows}\n\n"
        "Step 2 started at 23/03/2018 10:10:30\nStep type\tMAPPER\tStep description\tmap\n\n"
        f"Step 3 started at 23/03/2018 10:11:00\n{step}{MTM_HEAD}\n{rows}\n"
    )


TRIOS = """Filename\txxx
[step]
Peak hold - 1
Stress\tViscosity\tStep time\tTemperature
dyne/cm²\tPa.s\ts\t°C
42.6\t0.0364\t1.0\t24.996
72.8\t0.0365\t2.0\t24.995

[step]
Temperature ramp - 2
Stress\tViscosity\tStep time\tTemperature
dyne/cm²\tmPa.s\tmin\tK
42.6\t30.4\t0.5\t308.15
72.8\t24.5\t1.0\t313.15
"""


@pytest.fixture
def file(tmp_path):
    def write(text, name="data.txt", encoding="utf-8"):
        path = tmp_path / name
        path.write_text(text, encoding=encoding)
        return path

    return write


def test_film_steps_become_a_film_case_in_si_columns(file, tmp_path):
    case = read_case(import_files([file(EHD)], tmp_path / "case", contact=BALL))
    table = case.recordings
    assert case.kind.name == "film"
    assert table["film_thickness_nm"].tolist() == [24.4, 30.6]
    assert table["entrainment_speed_m_s"].tolist() == [0.02021, 0.02532]
    assert table["slide_roll_ratio"].tolist() == [0.005, -0.005]
    assert table["fringe_order"].tolist() == [3.0, 3.0]
    assert case.notes == ()


def test_film_files_of_old_windows_encoding_are_read(file, tmp_path):
    folder = import_files([file(EHD, encoding="latin-1")], tmp_path / "case", contact=BALL)
    assert read_case(folder).recordings["oil_temperature_C"].tolist() == [40.4, 40.4]


def test_what_a_film_file_does_not_say_is_listed_with_the_way_to_say_it(file, tmp_path):
    with pytest.raises(InputError) as caught:
        import_files([file(EHD)], tmp_path / "case")
    for key in ("contact.radius_mm", "contact.youngs_modulus_GPa", "contact.poisson_ratio"):
        assert f"--set '{key}=" in str(caught.value)
    assert not (tmp_path / "case").exists()


def test_timed_steps_become_a_history_with_pauses_kept(file, tmp_path):
    table = read_case(import_files([file(mtm())], tmp_path / "case")).recordings
    assert table["time_s"].tolist() == [1.0, 2.0, 3.0, 61.0, 62.0, 63.0]
    assert table["friction_coefficient"].tolist() == [0.01, 0.02, 0.03] * 2
    assert table["slide_roll_ratio"].tolist() == [1.0] * 6
    assert table["oil_temperature_C"].tolist() == [119.0] * 6


def test_two_probes_that_disagree_are_asked_about(file, tmp_path):
    with pytest.raises(InputError, match="12 degC, the pot 120 degC"):
        import_files([file(mtm(lube=12.0))], tmp_path / "case")
    folder = import_files([file(mtm(lube=12.0))], tmp_path / "case", **{"import.temperature": "pot"})
    assert read_case(folder).recordings["oil_temperature_C"].tolist() == [120.0] * 6


def test_rheometer_steps_follow_each_other_in_their_own_units(file, tmp_path):
    table = read_case(import_files([file(TRIOS)], tmp_path / "case")).recordings
    assert table["viscosity_mPa_s"].tolist() == pytest.approx([36.4, 36.5, 30.4, 24.5])
    assert table["temperature_C"].tolist() == pytest.approx([24.996, 24.995, 35.0, 40.0])
    assert table["time_s"].tolist() == pytest.approx([1.0, 2.0, 32.0, 62.0])


def test_a_rheometer_makes_no_other_kind_of_case(file, tmp_path):
    with pytest.raises(InputError, match="kind: 'film': is no kind that files of this rig make; they make viscosity"):
        import_files([file(TRIOS)], tmp_path / "case", kind="film")


def test_a_rheometer_column_without_a_unit_is_refused(file, tmp_path):
    with pytest.raises(InputError, match="no unit is given"):
        import_files([file(TRIOS.replace("dyne/cm²\tPa.s", "dyne/cm²\t"))], tmp_path / "case")


def test_a_bad_cell_of_a_rheometer_is_named_with_its_line(file, tmp_path):
    with pytest.raises(InputError, match=r"data\.txt: line 7, Viscosity: 'high': Viscosity must be a number"):
        import_files([file(TRIOS.replace("0.0365", "high"))], tmp_path / "case")


def test_every_nth_reading_can_be_kept(file, tmp_path):
    folder = import_files([file(TRIOS)], tmp_path / "case", **{"import.every": 3})
    assert read_case(folder).recordings["viscosity_mPa_s"].tolist() == pytest.approx([36.4, 24.5])


def test_two_files_of_one_kind_are_one_case(file, tmp_path):
    files = [file(EHD, "a.txt"), file(EHD.replace("24.4", "26.5"), "b.txt")]
    table = read_case(import_files(files, tmp_path / "case", contact=BALL)).recordings
    assert table["film_thickness_nm"].tolist() == [24.4, 30.6, 26.5, 30.6]
    assert table["run"].tolist() == [1, 2, 3, 4]


def test_files_of_two_kinds_are_refused(file, tmp_path):
    with pytest.raises(InputError, match=r"b\.txt"):
        import_files([file(EHD, "a.txt"), file(mtm(), "b.txt")], tmp_path / "case", contact=BALL)


def test_a_plain_table_with_units_in_its_headers_needs_only_its_kind(file, tmp_path):
    text = "Speed (rad/s);Friction torque (mNm)\n10,5;2,5\n-10,5;-2,25\n"
    with pytest.raises(InputError, match="--set 'kind="):
        import_files([file(text)], tmp_path / "case")
    answers = {"kind": "friction_map", "recording.quantity": "friction_torque_Nm"}
    table = read_case(import_files([file(text)], tmp_path / "case", **answers)).recordings
    assert table["speed_rpm"].tolist() == pytest.approx([100.2676, -100.2676], rel=1e-6)
    assert table["friction_torque_Nm"].tolist() == pytest.approx([0.0025, -0.00225])


def test_a_plain_column_without_a_unit_is_asked_about(file, tmp_path):
    text = "temperature,viscosity\n40,30\n100,5\n"
    with pytest.raises(InputError, match=r"import\.units\.viscosity_mPa_s"):
        import_files([file(text)], tmp_path / "case", kind="viscosity")
    units = {"import.units.temperature_C": "degC", "import.units.viscosity_mPa_s": "cP"}
    table = read_case(import_files([file(text)], tmp_path / "case", kind="viscosity", **units)).recordings
    assert table["viscosity_mPa_s"].tolist() == [30.0, 5.0]


def test_a_column_of_another_name_is_told(file, tmp_path):
    text = "T (degC),eta (cP)\n40,30\n100,5\n"
    with pytest.raises(InputError, match=r"the file has T \(degC\), eta \(cP\)"):
        import_files([file(text)], tmp_path / "case", kind="viscosity")
    told = {"import.columns.temperature_C": "T (degC)", "import.columns.viscosity_mPa_s": "eta (cP)"}
    table = read_case(import_files([file(text)], tmp_path / "case", kind="viscosity", **told)).recordings
    assert table["temperature_C"].tolist() == [40.0, 100.0]


def test_a_misspelt_answer_names_the_nearest_key(file, tmp_path):
    with pytest.raises(InputError, match="radius_mm"):
        import_files([file(EHD)], tmp_path / "case", contact={**BALL, "radii_mm": [1.0, 2.0]})


def test_all_questions_are_asked_together_and_needed_ones_again(file, tmp_path, at_terminal):
    replies = {
        "Radii": ["", "[9.525, inf]"],
        "Young": ["[207, 75]"],
        "Poisson": ["[0.3, 0.22]"],
        "Name of the oil": ["oil A"],
        "over": ["0.02"],
    }
    user = at_terminal(file(EHD), tmp_path / "case", [], replies)
    case = read_case(tmp_path / "case")
    assert case.system.contact.radius_mm == (9.525, float("inf"))
    assert case.system.recording.noise.relative == 0.02
    assert len(user.forms) == 1
    assert "needed: 1" in user.said
    assert any("lubricant.temperature_C" in line for line in user.said)


def test_settings_and_an_answers_file_serve_where_nobody_can_answer(file, tmp_path):
    answers = file("[contact]\nyoungs_modulus_GPa = [207.0, 75.0]\npoisson_ratio = [0.3, 0.22]\n", "answers.toml")
    settings = ["contact.radius_mm=[9.525, inf]"]
    folder = run([file(EHD)], tmp_path / "case", settings, answers, say=lambda text: None)
    assert read_case(folder).system.contact.youngs_modulus_GPa == (207.0, 75.0)


def test_a_folder_that_is_no_case_is_not_overwritten(file, tmp_path):
    (tmp_path / "home").mkdir()
    (tmp_path / "home" / "letter.txt").write_text("mine", encoding="utf-8")
    with pytest.raises(InputError, match="no case folder"):
        import_files([file(EHD)], tmp_path / "home", contact=BALL)
    assert (tmp_path / "home" / "letter.txt").read_text(encoding="utf-8") == "mine"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("Step 1 started at 01/02/2017 15:48\nStep type\tFILM\n", "no step with films"),
        ("one line only\n", "at least one row"),
        ("a,b\n1\n", "not as many cells"),
    ],
)
def test_files_that_hold_nothing_are_refused_with_their_name(file, tmp_path, text, message):
    told = {} if text.startswith("Step") else {"kind": "viscosity"}
    with pytest.raises(InputError, match=message) as caught:
        import_files([file(text)], tmp_path / "case", **told)
    assert "data.txt" in str(caught.value)


def test_a_binary_file_is_refused(tmp_path):
    path = tmp_path / "data.bin"
    path.write_bytes(b"PK\x03\x04\0\0\0")
    with pytest.raises(InputError, match="damaged or unsupported zip archive"):
        import_files([path], tmp_path / "case")
    path.write_bytes(b"\x7fELF\0\0\0")
    with pytest.raises(InputError, match="not a text file"):
        import_files([path], tmp_path / "case")


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(InputError, match=r"nowhere\.txt"):
        import_files([tmp_path / "nowhere.txt"], tmp_path / "case")


def test_an_unknown_unit_names_the_nearest():
    with pytest.raises(InputError, match="mm/s"):
        convert(np.ones(1), "mm/sec", target_of("Rolling Speed (mm/s)"), "file")


def test_suffixes_are_units():
    assert split("ball_load_N") == ("ball load", "N")
    assert split("slide_roll_ratio_percent") == ("slide roll ratio", "%")
    assert target_of("rolling_speed_mm_s").name == "entrainment_speed_m_s"


def test_kinematic_viscosity_is_told_from_dynamic():
    with pytest.raises(InputError, match="kinematic viscosity: in mm²/s, times the density"):
        convert(np.array([46.0]), "mm²/s", target_of("Viscosity (mm²/s)"), "oil.csv: Viscosity (mm²/s)")


def test_the_speed_of_one_surface_is_no_entrainment(file, tmp_path):
    head = "Disc Speed (m/s),Ball Speed (m/s),Slide/Roll (%),Load (N),Lube Temp (degC),Film (nm)\n"
    path = file(head + "0.1,0,200,20,40,44\n0.2,0,200,20,40,71\n")
    told = {"import.columns.entrainment_speed_m_s": "Disc Speed (m/s)"}
    with pytest.raises(InputError, match="is the speed of one surface; entrainment is the mean"):
        import_files([path], tmp_path / "case", kind="film", **told)


def test_a_line_of_units_may_hold_new_ones_and_gaps(file, tmp_path):
    head = "Tick,Time,Load,Frequency,COF\n,[s],[uN],[Hz],\n"
    path = file(head + "".join(f"{i},{10 * i},5e7,50,0.1{i}\n" for i in range(6)))
    told = {"import.units.friction_coefficient": "-"}
    table = read_case(import_files([path], tmp_path / "case", kind="friction_history", **told)).recordings
    assert table["load_N"].tolist() == pytest.approx([50.0] * 6)
    assert table["time_s"].tolist() == [0.0, 10.0, 20.0, 30.0, 40.0, 50.0]
