"""`mixedlub kinds` tells the format of a case as the code has it, and the page beside the example quotes it."""

import re
import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal, get_args, get_origin

import numpy as np
import pytest

from mixedlub.case.columns import case_columns
from mixedlub.cli import main
from mixedlub.kinds import KINDS, NATIVE, kind
from mixedlub.report.format_reference import kinds_text
from mixedlub.rig.rig import Rig
from mixedlub.schema import system_file, toml_file
from mixedlub.schema.section import examples, tables
from mixedlub.schema.table import BOOKKEEPING, RUN, Column, Table
from mixedlub.study.schema import StudyFile

EXAMPLE = Path(__file__).parents[2] / "examples" / "case"
PAGE = (EXAMPLE / "README.md").read_text(encoding="utf-8")


def block(language: str) -> str:
    (found,) = re.findall(rf"```{language}\n(.*?)```", PAGE, re.DOTALL)
    return found


def test_the_page_quotes_what_the_command_prints(capsys):
    assert main(["kinds"]) == 0
    assert block("text") == capsys.readouterr().out


def test_the_case_of_the_page_is_understood_and_only_its_range_is_doubted(tmp_path, capsys):
    folder = shutil.copytree(EXAMPLE, tmp_path / "case")
    (folder / "system.toml").write_text(block("toml"), encoding="utf-8")
    assert main(["check", str(folder)]) == 0
    said = capsys.readouterr().out
    assert "coated with DLC" in said
    (doubts,) = re.findall(r"Doubtful:\n(.*?)\nAssumed:", said, re.DOTALL)
    assert [line.partition("recordings.csv: of 72 rows ")[0].strip() for line in doubts.splitlines()] == [""]


@pytest.mark.parametrize("name", NATIVE)
def test_every_column_of_a_kind_is_told(name):
    lines = kinds_text(name).splitlines()
    for quantity in kind(name).quantities:
        recording = system_file.Recording(quantity=quantity, check="CHECK")
        system = system_file.System.model_construct(recording=recording, surfaces={})
        for column in case_columns(kind(name), system, measured=True):
            shown = column.name.replace(f"{quantity}_sd", "READING_sd")
            (line,) = [text for text in lines if re.match(rf" {{2,4}}{shown} ", text)][:1]
            assert ("optional" in line) == (not column.required), line


@pytest.mark.parametrize("file", [system_file.System, StudyFile])
def test_every_key_of_a_file_is_described(file):
    for table in tables(file):
        assert table.meaning or not table.title
        for key in table.fields:
            assert key.meaning
            options = get_args(key.type) if get_origin(key.type) is Literal else ()
            assert set(key.values) == set(options) or (not key.values and key.required), f"{table.name}.{key.name}"


@pytest.mark.parametrize("file", [system_file.System, StudyFile])
def test_examples_go_together(file):
    for table in tables(file):
        found = examples(table.model)
        if {key.name for key in table.fields if key.required} <= set(found):
            assert table.model.model_validate(found)


def test_every_column_is_described():
    for name in KINDS:
        found = kind(name)
        for column in (RUN, *BOOKKEEPING, *found.columns, *found.instrument_channels, *found.readings):
            assert column.meaning, f"{name}: {column.name}"


def test_a_column_has_the_same_words_in_every_kind():
    words = {}
    for column in (c for name in KINDS for c in (*kind(name).columns, *kind(name).readings)):
        assert words.setdefault(column.name, column.words) == column.words


def test_every_key_of_a_study_is_told(capsys):
    assert main(["kinds", "study"]) == 0
    said = capsys.readouterr().out
    for table in tables(StudyFile):
        assert not table.title or f"\n[{table.title}]" in said
        for key in table.keys:
            assert re.search(rf"\n  {key.name} ", said), f"{table.name}.{key.name}"
            assert all(re.search(rf'\n      "{value}" +\w', said) for value in key.values)
    assert re.search(r"bulk_temperature_rise_K +K +0 +0 to 200\n", said)
    assert re.search(r"torque_Nm +N m +required +list of 1e-09 to 1e\+09\n", said)


@pytest.mark.parametrize(
    ("place", "shown"),
    [
        ("disc", r"load_N +N +required +above 0 "),
        ("disc", r"slide_roll_ratio +- +required +-200 to 200 "),
        ("film", r"film_thickness_nm +nm +reading "),
        ("gear_pair", r"pressure_angle_deg +° +20 +6 to 44\n"),
        (
            "gear_pair",
            r"conductivity_W_mK +W/\(m K\) +required +0.01 to 10000\s+thermal conductivity of the c",
        ),
        ("gear_pair", r'model +- +one of these\s[^"]*"ldp" +elastic teeth\s+"rigid" '),
        ("viscosity", r"pressure_MPa +MPa +optional +0 to 5000 "),
    ],
)
def test_unit_default_and_rule_are_told(place, shown):
    assert re.search(shown, kinds_text(place))


def test_only_the_sections_of_the_kind_are_told():
    said = kinds_text("film")
    assert "[contact]" in said
    assert "[lubricant]" in said
    assert "[gears]" not in said
    assert "[surfaces.NAME]" not in said


@pytest.mark.parametrize("name", [None, *KINDS, "study"])
def test_no_line_is_wider_than_a_terminal(name):
    assert max(map(len, kinds_text(name).splitlines())) <= 80


def test_an_unknown_kind_gets_the_nearest(capsys):
    assert main(["kinds", "disk"]) == 2
    assert "KIND: 'disk': no such kind; nearest known: 'disc'" in capsys.readouterr().err


class Watched:
    """A system that remembers which of its sections were asked for."""

    def __init__(self, system: system_file.System) -> None:
        self.system, self.asked = system, set()

    def __getattr__(self, name: str) -> Any:
        self.asked.add(name)
        return getattr(self.system, name)


def typical(column: Column) -> np.ndarray:
    if column.dtype == "name":
        return np.array(["ground"] * 3)
    return np.array([20.0, 21.0, 22.0]) if column.name == "roll_angle_deg" else np.array([0.5, 0.6, 0.7])


@pytest.mark.parametrize("name", NATIVE)
def test_the_sections_told_are_those_that_are_computed_with(name):
    found = kind(name)
    columns = {c.name: typical(c) for c in found.columns if c.name != "sliding_speed_m_s"}
    columns["run"] = np.arange(3)
    columns[found.quantities[0]] = np.array([0.1, 0.11, 0.12])
    table = Table(columns)
    data = toml_file.read_toml(EXAMPLE / "system.toml")
    data["contact"] = {"geometry": "point", "radius_mm": [10.0, 20.0]}
    watched = Watched(toml_file.parse(system_file.System, data, "system.toml"))
    found.inputs(watched, Rig(watched, EXAMPLE), table, table)
    found.chain(watched, table)
    found.extra_calibration(watched, table)
    assert watched.asked & {"gears", "contact", "lubricant", "surfaces"} == {*found.sections, *found.uses}


def test_a_column_that_changes_changes_the_page(monkeypatch):
    changed = replace(
        kind("film"), columns=(Column("load_N", at_least=2.0, at_most=3.0, required=False, meaning="load"),)
    )
    monkeypatch.setattr("mixedlub.report.format_reference.kind", lambda name: changed if name == "film" else kind(name))
    assert re.search(r"load_N +N +optional +2 to 3 ", kinds_text("film"))
    assert kinds_text() != block("text").rstrip("\n")
