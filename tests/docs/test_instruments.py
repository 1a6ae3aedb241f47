"""What the page of rigs and instruments names in its last column exists, and acts on the kind of its section."""

import ast
import re
from pathlib import Path

import pytest

from mixedlub import data_checks, effects
from mixedlub.base_model import limits
from mixedlub.case import reference_rigs
from mixedlub.kinds import NATIVE
from mixedlub.schema.findings import registered

PAGE = Path(__file__).parents[2] / "docs" / "validation" / "instruments.md"
_, GENERAL, *SECTIONS = re.split(r"^## ", PAGE.read_text(encoding="utf-8"), flags=re.MULTILINE)
FORCE_CELL = {"force_offset", "force_drift"}
"""Effects of a drive whose friction coefficient is recorded under several loads, unlike that of the reference rig."""


def rows(text):
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line[:2] == "| "][1:]


def named(text):
    return {name for *_, last in rows(text) for name in re.findall(r"`([^`]+)`", last)}


@pytest.fixture(scope="module")
def checks():
    """Codes of findings in the source of the data checks and of the judgement of ranges."""
    paths = [*Path(data_checks.__file__).parent.glob("*.py"), Path(limits.__file__)]
    trees = [ast.parse(path.read_text("utf-8")) for path in paths]
    texts = {one.value for tree in trees for one in ast.walk(tree) if isinstance(one, ast.Constant)}
    return texts & set(registered())


def test_each_kind_of_recording_has_a_section():
    assert [text.splitlines()[0] for text in SECTIONS] == list(NATIVE)


@pytest.mark.parametrize("text", SECTIONS, ids=[text.splitlines()[0] for text in SECTIONS])
def test_effects_of_a_section_act_on_its_kind(text, checks):
    kind = text.splitlines()[0]
    acting = {effect.id for effect in reference_rigs.forward(kind).effects()}
    assert named(text) <= acting | checks | (FORCE_CELL if kind == "friction_map" else set())


def test_effects_of_any_recording_exist(checks):
    assert named(GENERAL) <= {*effects.catalogue(), *checks}


@pytest.mark.parametrize("text", [GENERAL, *SECTIONS], ids=lambda text: text.splitlines()[0])
def test_each_row_has_a_source_and_says_why_an_effect_lacks(text):
    for row in rows(text):
        what, how, source, last = row
        assert how, what
        assert source, what
        assert re.match("no:|no .*: ", last) or "`" in last or "base model" in last, what
