"""Rows of different things in one table: warned of where they would be pooled, and kept apart where told."""

import pytest

from mixedlub.case.folder import read_case
from mixedlub.importers import import_files
from mixedlub.importers.input_file import InputFile
from mixedlub.importers.plain import draft
from mixedlub.schema.findings import FindingWarning, Severity
from profiles.errors import InputError

MAP = {"kind": "friction_map", "recording.quantity": "friction_torque_Nm"}


def table(header, *groups):
    rows = (f"{group},{speed},0.{speed}{i}" for i, group in enumerate(groups) for speed in (1, 2, 4))
    return "\n".join([f"{header},speed_rpm,friction_torque_Nm", *rows]) + "\n"


def warned(text, answers=MAP):
    return [note for note in draft(InputFile("t.csv", text), answers).notes if note.severity is Severity.DOUBT]


@pytest.mark.parametrize("header", ["drive", "Sample ID", "machine", "specimen no.", "rig_id", "Batch", "Probe"])
def test_a_column_that_names_things_is_warned_of_with_the_way_to_keep_one(header):
    (note,) = warned(table(header, "1", "2", "3"))
    key = f"import.only.{header}=1"
    shown = key if " " not in header else f"'{key}'"
    assert (note.code, note.place) == ("things_pooled", "t.csv")
    assert f"{header!r} is not taken" in note.text
    assert note.text.endswith(f"--set {shown}")


def test_a_nameless_column_is_warned_of_where_it_splits_equal_conditions():
    (note,) = warned(table("build", "old", "new"))
    assert "'build' is not taken" in note.text
    apart = "build,speed_rpm,friction_torque_Nm\nold,1,1\nold,2,2\nold,3,3\nnew,4,4\nnew,5,5\nnew,6,6\n"
    assert warned(apart) == []


@pytest.mark.parametrize(
    ("header", "groups"),
    [
        ("drive", ["1"]),
        ("drive", [str(i) for i in range(30)]),
        ("repeat", ["1", "2", "3"]),
        ("samples", ["500", "400"]),
        ("pump", ["", "1"]),
        ("remark", ["", "slow", "noisy"]),
        ("humidity (%)", ["45", "50"]),
        ("started", ["2020-07-08 21:10", "2020-07-09 21:10"]),
    ],
)
def test_what_names_no_things_is_no_warning(header, groups):
    assert warned(table(header, *groups)) == []


def test_of_two_columns_the_one_that_tells_more_apart_is_named():
    (note,) = warned(table("group,sample", "oils,a", "oils,b", "greases,c"))
    assert "import.only.sample=a" in note.text


def test_steps_of_a_history_are_no_different_things():
    text = "phase,time_s,load_N,mu\n" + "".join(f"{phase},{t},9,0.1{t}\n" for t, phase in enumerate("aaabbb"))
    assert warned(text, {"kind": "friction_history", "import.units.friction_coefficient": "-"}) == []


def test_a_column_that_is_taken_pools_nothing():
    assert warned(table("drive", "1", "2"), {**MAP, "import.columns.setup": "drive"}) == []


@pytest.mark.parametrize(("value", "rows"), [(2, 3), ("2", 3), (2.0, 3), ([1, 3], 6)])
def test_rows_are_kept_by_the_value_of_a_column(value, rows):
    found = draft(InputFile("t.csv", table("drive", "1", "2", "3")), {**MAP, "import.only.drive": value})
    assert len(found.columns["speed_rpm"]) == rows
    assert f"t.csv: {rows} of 9 rows kept, those with drive " in " ".join(map(str, found.notes))


def test_a_warning_leads_to_a_case_of_one_thing(file, tmp_path):
    path = file(table("oil name", "A 1", "B.2"))
    with pytest.warns(FindingWarning, match="pooled"):
        import_files([path], tmp_path / "all", **MAP)
    one = import_files([path], tmp_path / "one", **MAP, **{"import.only.oil name": "B.2"})
    assert read_case(one).recordings["friction_torque_Nm"].tolist() == [0.11, 0.21, 0.41]


@pytest.mark.parametrize(
    ("key", "value", "said"),
    [
        ("import.only.driv", 1, r"import\.only\.driv: no such header; nearest known: 'drive'"),
        ("import.only.drive", 9, r"import\.only\.drive: 9: is in no row; the column has 1, 2"),
        ("import.only", 1, r"import\.only: key is not known.*'import\.only\.COLUMN'"),
    ],
)
def test_what_is_not_there_is_refused(key, value, said):
    with pytest.raises(InputError, match=said):
        draft(InputFile("t.csv", table("drive", "1", "2")), {**MAP, key: value})
