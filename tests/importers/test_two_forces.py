"""A friction force beside the load: their ratio is the friction coefficient, and that is said."""

import pytest

from mixedlub.importers.input_file import InputFile
from mixedlub.importers.plain import draft
from profiles.errors import InputError

HISTORY = {"kind": "friction_history"}
ROWS = "0,1.0,10\n1,1.2,10\n2,-1.1,11\n"


def read(header, answers=HISTORY, rows=ROWS):
    return draft(InputFile("t.csv", f"{header}\n{rows}"), answers)


def said(found):
    return " ".join(map(str, found.notes))


@pytest.mark.parametrize(
    ("header", "factor"),
    [
        ("Time [s],Friction force [N],Normal load [N]", 1.0),
        ("Time [s],Friction [mN],Normal [mN]", 1.0),
        ("Time [s],Reibkraft [N],Normal force [kN]", 1e-3),
        ("Time [s],Tangential force [N],load_N", 1.0),
    ],
)
def test_force_over_load_is_taken_and_said(header, factor):
    found = read(header)
    assert [q.key for q in found.questions if q.needed] == []
    assert found.columns["friction_coefficient"].tolist() == pytest.approx([0.1 * factor, 0.12 * factor, -0.1 * factor])
    _, friction, load = header.split(",")
    assert f"friction_coefficient is {friction!r} divided by {load!r}" in said(found)
    assert "3 of 3 columns taken: time_s, load_N, friction_coefficient" in said(found)
    assert "not taken" not in said(found)


def test_the_kind_of_forces_in_time_is_offered():
    asked = {q.key: q.example for q in read("Time [s],Friction [N],Normal [N]", {}).questions if q.needed}
    assert asked == {"kind": '"friction_history"'}


def test_a_recorded_coefficient_is_taken_before_two_forces():
    found = read("Time [s],Friction force [N],Load [N],COF [-]", rows="0,1.0,10,0.2\n1,1.2,10,0.3\n")
    assert found.columns["friction_coefficient"].tolist() == [0.2, 0.3]
    assert "not taken: Friction force [N]" in said(found)


def test_the_load_may_be_one_value_for_all_rows():
    found = read("Time [s],Friction force [mN]", {**HISTORY, "import.values.load_N": 2.0}, "0,100\n1,200\n")
    assert found.columns["friction_coefficient"].tolist() == pytest.approx([0.05, 0.1])
    assert "friction_coefficient is 'Friction force [mN]' divided by the load of 2 N" in said(found)


@pytest.mark.parametrize("load", ["0", "-0.2", "0.001"])
def test_rows_without_load_have_no_coefficient_and_are_left_out(load):
    found = read("Time [s],Friction force [N],Load [N]", rows=f"0,1,10\n1,1,{load}\n2,3,10\n")
    assert found.columns["friction_coefficient"].tolist() == pytest.approx([0.1, 0.3])
    assert "1 row left out, as 'friction_coefficient' is missing: line 3" in said(found)


def test_loads_that_are_all_negative_are_refused():
    with pytest.raises(InputError, match=r"line 2, Load \[N\]: '-10'.*load_N must be above 0"):
        read("Time [s],Friction force [N],Load [N]", rows="0,1,-10\n1,1,-10\n")


def test_of_several_friction_forces_one_is_asked_for():
    header = "Time [s],Friction force left [N],Friction force right [N],Load [N]"
    rows = "0,1,2,10\n1,1.2,2.2,10\n"
    assert "import.columns.friction_coefficient" in {q.key for q in read(header, rows=rows).questions if q.needed}
    told = {**HISTORY, "import.columns.friction_coefficient": "Friction force right [N]"}
    assert read(header, told, rows).columns["friction_coefficient"].tolist() == pytest.approx([0.2, 0.22])


def test_forces_without_units_are_asked_for_them():
    header = "Time [s],Friction force,Load"
    questions = {q.key: q for q in read(header).questions if q.needed}
    asked = questions["import.units.friction_coefficient"]
    assert "of a force, with the unit of the load, force divided by load is taken" in asked.text
    assert "N" in asked.options
    told = {**HISTORY, "import.units.friction_coefficient": "N", "import.units.load_N": "N"}
    assert read(header, told).columns["friction_coefficient"].tolist() == pytest.approx([0.1, 0.12, -0.1])


@pytest.mark.parametrize("load", ["Preload [N]", "Load cell [N]"])
def test_a_load_by_another_name_divides_only_by_answer(load):
    header = f"Time [s],Friction force [N],{load}"
    found = read(header)
    assert "friction_coefficient" not in found.columns
    assert "import.columns.friction_coefficient" in {q.key for q in found.questions if q.needed}
    assert f"{load!r} is not taken; if it is load_N: --set" in said(found)
    assert "divided" not in said(found)
    told = read(header, {**HISTORY, "import.columns.load_N": load})
    assert told.columns["friction_coefficient"].tolist() == pytest.approx([0.1, 0.12, -0.1])


def test_loads_in_steps_are_all_loads():
    found = read("Time [s],Friction force [N],Load [N]", rows="0,1,10\n1,10,100\n2,90,1000\n")
    assert found.columns["friction_coefficient"].tolist() == pytest.approx([0.1, 0.1, 0.09])


def test_the_spread_of_the_force_is_told_and_divided_by_answer():
    header, rows = "Time [s],Friction force [N],Load [N],Friction force sd [mN]", "0,1,10,100\n1,2,20,100\n"
    found = read(header, rows=rows)
    assert "friction_coefficient_sd" not in found.columns
    (note,) = (n for n in found.notes if n.code == "column_not_taken")
    assert "'Friction force sd [mN]' is not taken; if it is friction_coefficient_sd: --set" in note.text
    told = {**HISTORY, "import.columns.friction_coefficient_sd": "Friction force sd [mN]"}
    found = read(header, told, rows)
    assert found.columns["friction_coefficient_sd"].tolist() == pytest.approx([0.01, 0.005])
    assert "friction_coefficient_sd is 'Friction force sd [mN]' divided by 'Load [N]'" in said(found)
    assert "column_not_taken" not in {n.code for n in found.notes}


def test_the_spread_of_the_load_is_none_of_the_force():
    found = read("Time [s],Friction force [N],Load [N],Load sd [N]", rows="0,1,10,1\n1,2,20,1\n")
    assert "column_not_taken" not in {n.code for n in found.notes}


@pytest.mark.parametrize(
    ("friction", "load"),
    [
        ("Friction force [N]", "Normal force [N]"),
        ("Friction force FR [N]", "Normal force FN [N]"),
        ("Reibkraft [N]", "Normalkraft [N]"),
        ("Reibungskraft [N]", "Normalkraft F_N [N]"),
    ],
)
def test_forces_of_two_discs_are_divided_too(friction, load):
    found = read(
        f"{friction},{load},Öltemperatur [°C]", {"kind": "disc", "import.columns.load_N": load}, "50,1000,60\n" * 3
    )
    assert found.columns["friction_coefficient"].tolist() == pytest.approx([0.05] * 3)
    assert found.columns["oil_temperature_C"].tolist() == [60.0] * 3
    asked = {q.key: q.example for q in read(f"{friction},{load}", {"kind": "disc"}, "50,1000\n51,1000\n").questions}
    assert "import.columns.friction_coefficient" not in asked
    assert asked.get("import.columns.load_N", f'"{load}"') == f'"{load}"'
