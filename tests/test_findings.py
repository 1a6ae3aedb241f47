"""Findings: one kind of them, known by code, collected by one mechanism and grouped for the reader."""

from __future__ import annotations

import ast
import re
import warnings
from pathlib import Path

import pytest

import mixedlub
from mixedlub.case.folder import read_case
from mixedlub.case.import_file import NAME, read_import_file
from mixedlub.cli import main
from mixedlub.importers import import_files
from mixedlub.schema.findings import (
    PLACES_LISTED,
    FindingWarning,
    Severity,
    codes,
    collected,
    finding,
    grouped,
    of_severity,
    registered,
    report,
)
from profiles.errors import InputError

HISTORY = "time_s,load (N),drive,cof\n" + "".join(f"{t},9,{'AB'[t % 2]},0.1{t % 7}\n" for t in range(30))
ANSWERS = ('kind="friction_history"', 'import.units.friction_coefficient="-"')


@pytest.fixture(scope="module")
def nodes() -> list[ast.AST]:
    """The source of the package."""
    paths = Path(mixedlub.__file__).parent.rglob("*.py")
    return [node for path in paths for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))]


def test_every_finding_of_the_package_is_of_a_registered_kind(nodes: list[ast.AST]) -> None:
    made = {
        node.args[0].value
        for node in nodes
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "finding"
        if node.args and isinstance(node.args[0], ast.Constant)
    }
    assert len(made) > 50
    assert set(registered()) >= made


def test_every_registered_kind_is_used_and_explained_in_one_line(nodes: list[ast.AST]) -> None:
    assert set(registered()) <= {node.value for node in nodes if isinstance(node, ast.Constant)}
    for code, kind in registered().items():
        assert re.fullmatch(r"[a-z][a-z0-9_]*", code)
        assert kind.meaning.endswith(".")
        assert "\n" not in kind.meaning


def test_an_unregistered_kind_is_an_error_that_names_the_nearest() -> None:
    with pytest.raises(ValueError, match="nearest known: 'channel_stuck'"):
        finding("chanel_stuck", "")


def test_findings_are_collected_once_and_other_warnings_pass() -> None:
    one, other = (finding("surfaces_unused", text, "surfaces") for text in ("a", "b"))
    with warnings.catch_warnings(record=True) as passed:
        warnings.simplefilter("always")
        with collected() as found:
            for each in (one, other, one):
                report(each)
            warnings.warn("old", DeprecationWarning, stacklevel=1)
    assert found == [one, other]
    assert [str(w.message) for w in passed] == ["old"]


def test_a_finding_that_nobody_collects_is_a_warning() -> None:
    with pytest.warns(FindingWarning, match="surfaces: a"):
        report(finding("surfaces_unused", "a", "surfaces"))


def test_twelve_findings_about_single_levels_are_one() -> None:
    levels = [
        finding("outliers_at_level", "all 6 readings are outliers", f"speed {v} rpm") for v in range(100, 1300, 100)
    ]
    (one,) = grouped(levels)
    assert one.code == "outliers_at_level"
    assert one.place.startswith("speed 100 rpm, speed 200 rpm, ")
    assert one.place.endswith(f" and {12 - PLACES_LISTED} more")


def test_findings_that_differ_in_number_name_the_first_and_list_the_others() -> None:
    (one,) = grouped(finding("reading_too_large", f"reads {7.5 * run:g}", f"run {run}") for run in range(1, 4))
    assert str(one) == "run 1: reads 7.5; likewise run 2, run 3"


def test_a_sentence_that_ends_is_joined_without_its_full_stop():
    traces = [finding("file_read", f"real contact is {y} times the Gaussian one.", f"trace {y}") for y in (1.5, 2.5)]
    (one,) = grouped(traces)
    assert str(one) == "trace 1.5: real contact is 1.5 times the Gaussian one; likewise trace 2.5"


def test_findings_that_differ_in_words_or_severity_stay_apart() -> None:
    near = [finding("column_near_known", f"nearest known: {name!r}", "t.csv") for name in ("load_N", "time_s")]
    lost = [finding("sign_lost", "no sign", "y", severity) for severity in (Severity.CAUTION, Severity.DOUBT)]
    assert grouped([*near, *lost]) == (*near, *lost)


def imported(folder: Path, *more: str) -> Path:
    """A case that pools the readings of two drives."""
    table = folder / "rig.csv"
    table.write_text(HISTORY, encoding="utf-8")
    settings = [word for answer in (*ANSWERS, *more) for word in ("--set", answer)]
    assert main(["import", str(table), "--out", str(folder / "case"), "--overwrite", *settings]) == 0
    return folder / "case"


def test_what_an_import_warned_of_is_repeated_by_later_commands(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    case = imported(tmp_path)
    (warned,) = of_severity(read_case(case).notes, Severity.DOUBT)
    assert (warned.code, warned.place) == ("things_pooled", "rig.csv")
    assert str(warned) in capsys.readouterr().out
    assert main(["check", str(case)]) == 0
    assert f"  {warned}." in capsys.readouterr().out.partition("Doubtful:")[2]
    assert main(["simulate", str(case), "--out", str(tmp_path / "o")]) == 0
    assert f"doubt: {warned}" in capsys.readouterr().err


def test_an_import_that_warns_of_nothing_takes_back_what_one_before_warned_of(tmp_path: Path) -> None:
    assert read_import_file(imported(tmp_path)) != ()
    assert read_import_file(imported(tmp_path, "import.only.drive=A")) == ()
    assert "things_pooled" not in codes(read_case(tmp_path / "case").notes)


def test_a_case_that_nothing_was_warned_of_has_no_such_file(tmp_path: Path) -> None:
    table = tmp_path / "rig.csv"
    table.write_text(
        "time_s,friction_coefficient\n" + "".join(f"{t},0.1{t % 7}\n" for t in range(30)), encoding="utf-8"
    )
    case = import_files([table], tmp_path / "case", kind="friction_history")
    assert not (case / NAME).exists()


@pytest.mark.parametrize(
    ("text", "rule"),
    [
        (
            '[[finding]]\ncode = "thing_pooled"\nseverity = "caution"\nplace = ""\ntext = ""',
            "nearest known: 'things_poo",
        ),
        (
            '[[finding]]\ncode = "things_pooled"\nseverity = "grave"\nplace = ""\ntext = ""',
            "'note', 'caution' or 'doubt'",
        ),
        ("[[findings]]", "nearest known: 'finding'"),
    ],
)
def test_a_wrong_import_file_is_refused_with_its_place(text: str, rule: str, tmp_path: Path) -> None:
    (tmp_path / NAME).write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=re.escape(rule)) as error:
        read_import_file(tmp_path)
    assert error.value.where.startswith(str(tmp_path / NAME))
