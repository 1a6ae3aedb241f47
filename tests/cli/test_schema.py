"""JSON Schema of the files: what mixedlub takes is valid, what it refuses by type, range or name is not."""

import json
import tomllib
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from mixedlub.cli import main
from mixedlub.commands.new import TEMPLATES, template_files
from mixedlub.evaluate import EVALUATIONS
from mixedlub.kinds import KINDS
from mixedlub.report.file_classes import FILES
from mixedlub.report.json_schema import json_schema

EXAMPLES = Path(__file__).parents[2] / "examples"


def errors(name, text):
    return [one.message for one in Draft202012Validator(json_schema(name)).iter_errors(tomllib.loads(text))]


@pytest.mark.parametrize("name", [*KINDS, *FILES, *EVALUATIONS])
def test_a_schema_is_one(name):
    Draft202012Validator.check_schema(json_schema(name))


@pytest.mark.parametrize("name", FILES)
def test_the_template_of_a_file_is_valid(name):
    assert name in TEMPLATES
    texts = {path: text for path, text in template_files(name).items() if path.endswith(".toml")}
    own = next(text for path, text in texts.items() if name in path or len(texts) == 1 or path == "contacts.toml")
    assert errors(name, own) == []


@pytest.mark.parametrize("name", KINDS)
def test_the_template_of_a_case_is_valid(name):
    assert errors(name, template_files("case", name)["system.toml"]) == []


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("study_*.toml")), ids=lambda path: path.stem)
def test_an_example_study_is_valid(path):
    assert errors("study", path.read_text(encoding="utf-8")) == []


@pytest.mark.parametrize(
    ("change", "word"),
    [
        (("[gears]", "[gears]\nmodul_mm = 3"), "modul_mm"),
        (("[conditions]", "[conditionen]"), "conditionen"),
        (("boundary_friction = ", "boundary_friction = 1"), "maximum"),
        (("face_width_mm = ", "face_width_mm = true #"), "number"),
    ],
)
def test_a_slip_is_found(change, word):
    text = EXAMPLES.joinpath("study_21_pairings.toml").read_text(encoding="utf-8")
    assert change[0] in text
    assert any(word in one for one in errors("study", text.replace(*change, 1)))


def test_keys_have_their_unit_and_range():
    own = json_schema("disc")
    assert own["properties"]["kind"]["const"] == "disc"
    assert "gears" not in own["properties"]
    viscosity = own["$defs"]["Lubricant"]["properties"]["eyring_stress_MPa"]
    assert "(MPa)" in viscosity["description"]
    assert any(one.get("minimum") for one in viscosity["anyOf"])


def test_the_command_writes_a_file_or_prints(tmp_path, capsys):
    assert main(["schema", "gear", "--out", str(tmp_path / "gear.json")]) == 0
    assert json.loads((tmp_path / "gear.json").read_text(encoding="utf-8")) == json_schema("gear")
    assert main(["schema", "gear"]) == 0
    assert json.loads(capsys.readouterr().out) == json_schema("gear")
    assert main(["schema", "gaer"]) == 2
    assert "'gear'" in capsys.readouterr().err
