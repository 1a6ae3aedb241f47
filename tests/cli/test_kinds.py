"""`mixedlub kinds` tells the format of a case as the code has it, and the page beside the example quotes it."""

import re
import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mixedlub.case import folder
from mixedlub.case.format_reference import MEANINGS, USED, kinds_text, sections
from mixedlub.cli import main
from mixedlub.kinds import kind
from mixedlub.schema import system_file
from mixedlub.schema.system_file import KINDS
from mixedlub.schema.table import BOOKKEEPING, RUN, Column, Table

EXAMPLE = Path(__file__).parents[2] / "examples" / "case"
PAGE = (EXAMPLE / "README.md").read_text(encoding="utf-8")


def block(language: str) -> str:
    (found,) = re.findall(rf"```{language}\n(.*?)```", PAGE, re.DOTALL)
    return found


def test_the_page_quotes_what_the_command_prints(capsys):
    assert main(["kinds"]) == 0
    assert block("text") == capsys.readouterr().out


def test_the_case_of_the_page_is_understood_without_a_doubt(tmp_path, capsys):
    folder = shutil.copytree(EXAMPLE, tmp_path / "case")
    (folder / "system.toml").write_text(block("toml"), encoding="utf-8")
    assert main(["check", str(folder)]) == 0
    said = capsys.readouterr().out
    assert "coated with DLC" in said
    assert "Doubtful" not in said


@pytest.mark.parametrize("name", KINDS)
def test_every_column_of_a_kind_is_told(name):
    lines = kinds_text(name).splitlines()
    for quantity in kind(name).quantities:
        recording = system_file.Recording(quantity=quantity, check="CHECK")
        system = system_file.System.model_construct(recording=recording, surfaces={})
        for column in folder._columns(kind(name), system, measured=True):
            shown = column.name.replace(f"{quantity}_sd", "READING_sd")
            (line,) = [text for text in lines if text.split()[:1] == [shown] and text.startswith("  ")][:1]
            assert ("optional" in line) == (not column.required), line


def keys(model: type[system_file.Section], place: str = "") -> set[str]:
    """Keys of a model and of the models in it, walked by trying what pydantic knows of each field."""
    found = set()
    for name, field in model.model_fields.items():
        inner = [a for a in system_file._flatten((field.annotation,)) if system_file._is_model(a)]
        own = f"{place}{field.alias or name}"
        for table in inner:
            found |= keys(table, f"{own}{'.NAME' if own == 'surfaces' else ''}.")
        if not inner:
            found.add(own)
    return found


def test_every_key_of_a_case_is_told_with_its_meaning():
    told = {f"{table}.{key}".lstrip(".") for table, rows in sections().items() for key, _, _ in rows}
    assert told == keys(system_file.System)
    assert told <= set(MEANINGS)


def test_no_meaning_is_told_of_what_is_not_there():
    columns = {c.name for name in KINDS for c in (*kind(name).columns, *kind(name).channels)}
    columns |= {f"{name}.{c.name}" for name in KINDS for c in kind(name).columns}
    readings = {q for name in KINDS for q in kind(name).quantities}
    readings |= {f"{name}.{q}" for name in KINDS for q in kind(name).quantities}
    known = {RUN.name, *(c.name for c in BOOKKEEPING), "READING_sd", "CHECK"} | columns | readings
    assert set(MEANINGS) <= known | keys(system_file.System) | set(sections())


@pytest.mark.parametrize(
    ("place", "shown"),
    [
        ("disc", r"load_N +N +required +above 0 "),
        ("disc", r"slide_roll_ratio +- +required +-200 to 200 "),
        ("film", r"film_thickness_nm +nm +reading "),
        ("gear_pair", r"pressure_angle_deg +° +20 +6 to 44 "),
        ("gear_pair", r"thermal_conductivity_W_mK +W/\(m K\) +required +0.01 to 10000 +of the coating"),
        ("gear_pair", r'model +- +"ldp", "rigid" '),
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


def test_no_line_is_wider_than_a_page():
    assert max(map(len, kinds_text().splitlines())) <= 120


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
    if column.form == "name":
        return np.array(["ground"] * 3)
    return np.array([20.0, 21.0, 22.0]) if column.name == "roll_angle_deg" else np.array([0.5, 0.6, 0.7])


@pytest.mark.parametrize("name", KINDS)
def test_the_sections_told_are_those_that_are_computed_with(name):
    found = kind(name)
    columns = {c.name: typical(c) for c in found.columns if c.name != "sliding_speed_m_s"}
    columns["run"] = np.arange(3)
    columns[found.quantities[0]] = np.array([0.1, 0.11, 0.12])
    table = Table(columns)
    data = system_file.read_toml(EXAMPLE / "system.toml")
    data["contact"] = {"geometry": "point", "radius_mm": [10.0, 20.0]}
    watched = Watched(system_file.parse(system_file.System, data, "system.toml"))
    found.inputs(watched, EXAMPLE, table, table)
    found.chain(watched, table)
    found.extra_calibration(watched, table)
    assert watched.asked & {"gears", "contact", "lubricant", "surfaces"} == {*found.sections, *USED.get(name, ())}


def test_a_column_that_changes_changes_the_page(monkeypatch):
    changed = replace(kind("film"), columns=(Column("load_N", at_least=2.0, at_most=3.0, required=False),))
    monkeypatch.setattr("mixedlub.case.format_reference.kind", lambda name: changed if name == "film" else kind(name))
    assert re.search(r"load_N +N +optional +2 to 3 ", kinds_text("film"))
    assert kinds_text() != block("text").rstrip("\n")
