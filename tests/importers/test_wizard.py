"""The wizard at a terminal: choices by number where a line was left empty, the likely header proposed."""

import re

import pytest

from mixedlub.case.folder import read_case
from mixedlub.importers import input_file
from mixedlub.importers.base import Question
from mixedlub.importers.dialogue import ask_all
from mixedlub.importers.input_file import InputFile
from mixedlub.importers.plain import draft
from mixedlub.importers.text_table import read_sheet
from mixedlub.kinds import NATIVE as KINDS
from profiles.errors import InputError

TWIN = "T1 (degC);T2 (degC);eta (mPa.s)\n40;41;30\n60;61;12\n100;99;5\n"
DRIVE = {"kind": "friction_map", "recording.quantity": "friction_torque_Nm"}
ROBOT = "velocity (rad/s),torque (N m)\n1,2\n2,2.2\n3,2.3\n"


def test_headers_are_choices_by_letter(file, tmp_path, at_terminal):
    replies = {"temperature_C": ["", "@b"], "viscosity_mPa_s": ["eta (mPa.s)"]}
    said = at_terminal(file(TWIN), tmp_path / "case", ["kind=viscosity"], replies).said
    table = read_case(tmp_path / "case").recordings
    assert table["temperature_C"].tolist() == [41.0, 61.0, 99.0]
    assert table["viscosity_mPa_s"].tolist() == [30.0, 12.0, 5.0]
    assert "       1a T1 (degC), 1b T2 (degC), 1c eta (mPa.s)" in said
    assert "needed: 1" in said


def test_a_number_that_nothing_listed_is_no_choice(file, tmp_path, at_terminal):
    """The share 1 of a unit is not the first of the units."""
    path = file("speed_rpm,friction_torque_Nm,additive\n1,2,0.02\n2,3,0.02\n3,4,0.02\n")
    told = [f"{key}={value}" for key, value in DRIVE.items()]
    at_terminal(path, tmp_path / "case", told, {"Unit of the column 'additive'": ["1"]})
    assert read_case(tmp_path / "case").recordings["additive_percent"].tolist() == [2.0, 2.0, 2.0]


def test_a_kind_may_be_chosen_by_its_letter(file, tmp_path, at_terminal):
    path = file("temperature_C,viscosity_mPa_s\n40,30\n100,5\n")
    said = at_terminal(path, tmp_path / "case", [], {"Kind of recording": ["?", "@g"]}).said
    assert any(line.startswith("  viscosity: ") for line in said)
    assert read_case(tmp_path / "case").kind.name == "viscosity"


@pytest.mark.parametrize(
    ("reply", "answer", "said"),
    [
        ("b", "disc", None),
        ("1b", "disc", None),
        ('1="film"', "film", None),
        ("film", "film", None),
        ("1d", None, "1d: no such choice"),
        ("2=film", None, "'2=film': say NUMBER=ANSWER with a number from 1 to 1"),
    ],
)
def test_one_question_takes_an_answer_by_letter_or_in_words(reply, answer, said):
    question = Question("kind", "Kind", '"film"', options=("film", "disc"))
    lines = []
    replies = iter([reply, "", ""])
    found = ask_all([question], lambda prompt: next(replies), lines.append)
    assert found == ({"kind": {"kind": answer}} if answer else {})
    assert said is None or said in lines


def test_headers_that_are_numbers_are_meant_themselves(file, tmp_path, at_terminal):
    path = file("2 (degC);1;note\n40;30;x\n60;12;y\n")
    told = ["kind=viscosity", 'import.columns.temperature_C="2 (degC)"', "import.units.viscosity_mPa_s=cP"]
    said = at_terminal(path, tmp_path / "case", told, {"viscosity_mPa_s": ["", '"1"']}).said
    assert NEEDED in said
    assert read_case(tmp_path / "case").recordings["viscosity_mPa_s"].tolist() == [30.0, 12.0]


def test_a_torque_alone_is_proposed_as_the_friction_torque():
    """It is the reading that a map needs, not the load of the drive."""
    found = draft(InputFile("t.csv", ROBOT), DRIVE)
    questions = {q.key: q for q in found.questions if q.needed}
    assert questions["import.columns.friction_torque_Nm"].example == '"torque (N m)"'
    assert "torque_Nm" not in found.columns
    told = {**DRIVE, "import.columns.friction_torque_Nm": "torque (N m)"}
    told["import.columns.speed_rpm"] = "velocity (rad/s)"
    assert list(draft(InputFile("t.csv", ROBOT), told).columns) == ["speed_rpm", "friction_torque_Nm"]


def test_a_torque_alone_without_a_unit_is_asked_about_once():
    questions = [q.key for q in draft(InputFile("t.csv", ROBOT.replace(" (N m)", "")), DRIVE).questions]
    assert "import.units.friction_torque_Nm" in questions
    assert "import.units.torque_Nm" not in questions


def test_a_torque_beside_the_friction_torque_is_the_load():
    text = "speed (rpm),torque (N m),drag (N m)\n1,20,2\n2,20,2.2\n3,20,2.3\n"
    found = draft(InputFile("t.csv", text), {**DRIVE, "import.columns.friction_torque_Nm": "drag (N m)"})
    assert found.columns["torque_Nm"].tolist() == [20.0, 20.0, 20.0]
    (question,) = (
        q for q in draft(InputFile("t.csv", text), DRIVE).questions if q.key == "import.columns.friction_torque_Nm"
    )
    assert question.example == '"drag (N m)"'


DISCS = "load (N);speed (m/s);SRR;T (degC);mu\n20;1;0.1;40;0.05\n20;2;0.1;40;0.04\n40;2;0.1;40;0.045\n"
NEEDED = "needed: 1; Enter again leaves them open, and then no case is written"
NAMED = [
    'kind="disc"',
    'import.columns.entrainment_speed_m_s="speed (m/s)"',
    'import.columns.oil_temperature_C="T (degC)"',
]
BODIES = {
    "surface_1": ["import.values.surface_1=ground"],
    "surface_2": ['import.values.surface_2="ground"'],
    "Unit": ["-", "-"],
    "Form": ["line"],
    "Width": ["6"],
    "Radii": ["20, 25.4"],
    "Young": ["206, 75"],
    "Poisson": ["0.3, 0.3"],
}


def test_lists_may_be_typed_without_brackets_and_columns_told_as_one_value(file, tmp_path, at_terminal):
    at_terminal(file(DISCS), tmp_path / "case", NAMED, BODIES)
    system = (tmp_path / "case" / "system.toml").read_text(encoding="utf-8")
    assert "youngs_modulus_GPa = [206, 75]" in system
    assert "ground,ground" in (tmp_path / "case" / "recordings.csv").read_text(encoding="utf-8")


def test_a_wrong_answer_is_asked_again_at_once(file, tmp_path, at_terminal):
    replies = {
        **BODIES,
        "Form": ["cube", "line"],
        "Radii": ["20", "20, 25.4"],
        "surface_1": ["gruond", "import.values.surface_1=ground"],
        "Standard deviation of a reading over": ["-1", "0.02"],
    }
    said = at_terminal(file(DISCS), tmp_path / "case", NAMED, replies).said
    for wrong in ("contact.geometry: 'cube': must be 'line' or 'point'", "contact.radius_mm: 20: must be a list"):
        assert any(text.startswith(wrong) for text in said)
    assert any("'gruond': no such header" in text for text in said)
    assert any(text.startswith("recording.noise.relative: -1") for text in said)
    assert "relative = 0.02" in (tmp_path / "case" / "system.toml").read_text(encoding="utf-8")


def test_a_kind_that_is_none_is_asked_again(file, tmp_path, at_terminal):
    replies = {"Kind": ["viscosit", "viscosity"]}
    said = at_terminal(file("temperature_C,viscosity_mPa_s\n40,30\n100,5\n"), tmp_path / "c", [], replies).said
    assert any("no such kind; nearest known: 'viscosity'" in text for text in said)
    assert read_case(tmp_path / "c").kind.name == "viscosity"


def test_a_value_of_all_rows_without_its_sign_is_asked_again(file, tmp_path, at_terminal):
    replies = {**BODIES, "surface_1": ["import.values.surface_1", "import.values.surface_1=ground"]}
    said = at_terminal(file(DISCS), tmp_path / "case", NAMED, replies).said
    assert "one value for all rows is written as NUMBER==VALUE" in said


def test_what_no_answer_mends_is_wrong_in_the_file(file, tmp_path, at_terminal):
    path = file("temperature;viscosity (cP)\n40;30\n60;abc\n100;5\n")
    with pytest.raises(InputError, match="number") as error:
        at_terminal(path, tmp_path / "c", ["kind=viscosity"], {"temperature": ["degC", "degF", "K"]})
    assert "line 3" in error.value.where


LOSS = "Test no.;T1 [Nm];n1 [1/min];Oil sump temp. [°C];Pv total [kW]\n1;50,0;500;40,0;0,0175\n2;100,5;1000;60;0,0505\n"


def test_an_empty_line_takes_what_is_proposed(file, tmp_path, at_terminal):
    replies = {f"holds {side}_surface": [f"import.values.{side}_surface=ground"] for side in ("pinion", "gear")}
    at_terminal(file(LOSS), tmp_path / "case", [], replies)
    text = (tmp_path / "case/recordings.csv").read_text(encoding="utf-8")
    assert "kind = " + '"gear_pair"' in (tmp_path / "case/system.toml").read_text(encoding="utf-8")
    assert text.splitlines()[-1] == "2,100.5,1000,60,50.5,ground,ground"


def test_help_explains_each_kind_in_a_line_and_names_the_setting(file, tmp_path, at_terminal):
    said = at_terminal(
        file(TWIN), tmp_path / "case", [], {"Kind of": ["?", "viscosity"], "temperature_C": ["T1 (degC)"]}
    ).said
    kinds = [line for line in said if re.match(r"  \w+: ", line)]
    assert [line.split()[0] for line in kinds] == [f"{name}:" for name in KINDS]
    assert all(len(line.split(": ")[1]) > 20 for line in kinds)
    assert any(line.startswith("  --set 'kind=\"viscosity\"'") for line in said)


def test_units_and_ambiguous_headers_are_never_taken_by_an_empty_line(file, tmp_path, at_terminal):
    path = file("temperature;T2 (degC);viscosity (cP)\n40;41;30\n60;62;12\n100;99;5\n")
    replies = {"Unit of the column 'temperature'": ["", "degC"]}
    said = at_terminal(path, tmp_path / "case", ["kind=viscosity"], replies).said
    assert NEEDED in said


def test_one_value_for_all_rows_is_a_reply_to_any_question_for_a_column(file, tmp_path, at_terminal):
    replies = {
        **BODIES,
        "surface_1": ["?", "ground", "=ground"],
        "surface_2": ["= Ra 0.4"],
        "oil_temperature_C": ["", "=900", "=40"],
    }
    said = at_terminal(file(DISCS.replace("T (degC)", "T")), tmp_path / "case", NAMED[:2], replies).said
    assert "surface_1: a surface of system.toml" in said
    assert any("--set import.values.surface_1=ground" in text for text in said)
    assert "if all rows have the same value, reply N==ground" in said
    assert any("900.0: oil_temperature_C must lie between" in text for text in said)
    rows = (tmp_path / "case" / "recordings.csv").read_text(encoding="utf-8").splitlines()
    assert rows[0].endswith(",oil_temperature_C,surface_1,surface_2")
    assert all(row.endswith(",40,ground,Ra 0.4") for row in rows[1:])


def test_headers_of_numbers_are_not_listed_for_the_name_of_a_surface(file, tmp_path):
    asked = [q for q in draft(InputFile("t.csv", LOSS), {"kind": "gear_pair"}).questions if "_surface" in q.key]
    assert [q.options for q in asked] == [("Test no.",)] * 2


def test_a_needed_question_is_left_open_by_a_second_empty_line(file, tmp_path, at_terminal):
    with pytest.raises(InputError, match=r"(?s)1 answer is missing.*import\.columns\.temperature_C"):
        at_terminal(file(TWIN), tmp_path / "case", ["kind=viscosity"], {"temperature_C": ["", ""]})
    assert not (tmp_path / "case").exists()


def test_what_will_be_written_is_shown_first_with_what_was_left_open(file, tmp_path, at_terminal):
    path = file("temperature_C,viscosity_mPa_s\n40,30\n100,5\n")
    said = at_terminal(path, tmp_path / "case", ["kind=viscosity"], {}).said
    shown = said[: next(i for i, line in enumerate(said) if "columns taken" in line)]
    assert any(line.split() == ["temperature_C", "40", "to", "100"] for line in shown)
    assert any(line.startswith("  --set recording.noise.relative=") for line in shown)


def test_nothing_is_written_where_the_summary_is_declined(file, tmp_path, at_terminal):
    path = file("temperature_C,viscosity_mPa_s\n40,30\n100,5\n")
    with pytest.raises(InputError, match="nothing was changed"):
        at_terminal(path, tmp_path / "case", ["kind=viscosity"], {"Write this case": ["n"]})
    assert not (tmp_path / "case").exists()


def test_a_table_is_separated_into_cells_once_whatever_is_asked(file, tmp_path, monkeypatch, at_terminal):
    """A question costs no pass over the file."""
    passes = []
    monkeypatch.setattr(input_file, "read_sheet", lambda *given: passes.append(given) or read_sheet(*given))
    at_terminal(file(DISCS), tmp_path / "case", NAMED, BODIES)
    assert len(passes) == 1
