"""Templates of every evaluation: they run as they are, and their tables are those of the independent rigs."""

import re
from typing import Literal, get_args, get_origin

import pytest

from mixedlub.cli import main
from mixedlub.evaluate import EVALUATIONS, evaluate
from mixedlub.report.format_reference import kinds_text
from mixedlub.schema.section import examples, tables
from mixedlub.validation.benches.templates import tables as made
from profiles.errors import InputError


def test_the_tables_of_the_templates_are_those_of_the_benches():
    text = {f"{e.folder.name}/{p.name}": p.read_text("utf-8") for e in EVALUATIONS.values() for p in e.folder.glob("*")}
    assert text == made()


@pytest.mark.parametrize("name", EVALUATIONS)
def test_a_template_runs_as_it_is_and_its_case_is_understood(tmp_path, capsys, name):
    assert main(["new", name, "--out", str(tmp_path / "rig")]) == 0
    file = tmp_path / "rig" / f"{name}.toml"
    assert f"mixedlub evaluate {name} {file}" in capsys.readouterr().out
    assert main(["evaluate", name, str(file), "--out", str(tmp_path / "out")]) == 0
    said = capsys.readouterr()
    assert "typical" not in said.err
    assert any((tmp_path / "out" / "figures").glob("*.svg"))
    written = {path.name for path in (tmp_path / "out").iterdir()}
    if "case" in written:
        assert main(["check", str(tmp_path / "out" / "case")]) == 0
        assert "Cannot" not in capsys.readouterr().out
    else:
        assert any(name.endswith(".toml") for name in written)


@pytest.mark.parametrize("name", EVALUATIONS)
def test_every_key_is_described_and_shown(name):
    text, file = kinds_text(name), EVALUATIONS[name].file
    for table in tables(file):
        assert not table.title or f"\n[{table.title}]" in text
        for key in table.fields:
            assert key.meaning
            options = get_args(key.type) if get_origin(key.type) is Literal else ()
            assert set(key.values) == set(options) or (not key.values and key.required), f"{table.name}.{key.name}"
        for key in table.keys:
            assert re.search(rf"\n +{key.name} ", text), f"{table.name}.{key.name}"
        found = examples(table.model)
        if {key.name for key in table.fields if key.required} <= set(found):
            assert table.model.model_validate(found)
    assert max(map(len, text.splitlines())) <= 80


def test_an_unknown_evaluation_gets_the_nearest(capsys):
    assert main(["evaluate", "calorimetry", "x.toml"]) == 2
    assert "METHOD: 'calorimetry': no such evaluation; nearest known:" in capsys.readouterr().err


def test_a_file_of_another_evaluation_is_refused(tmp_path):
    main(["new", "calorimetric", "--out", str(tmp_path)])
    with pytest.raises(InputError, match="mixedlub-strain-gauge/1"):
        evaluate("strain-gauge", tmp_path / "calorimetric.toml")


TABLES = [
    ("calorimetric", "readings", "readings"),
    ("two-disc", "readings", "readings"),
    ("off-line", "response", "shaft.response"),
    ("strain-gauge", "calibration", "calibration"),
    ("regression", "readings", "readings"),
]


@pytest.mark.parametrize(("name", "key", "place"), TABLES)
@pytest.mark.parametrize("content", [None, b"\x89PNG\r\n\xff\xfe"], ids=["folder", "binary"])
def test_a_table_that_is_none_is_refused_with_its_file(tmp_path, capsys, name, key, place, content):
    assert main(["new", name, "--out", str(tmp_path)]) == 0
    file, table = tmp_path / f"{name}.toml", tmp_path / "sub"
    table.mkdir() if content is None else table.write_bytes(content)
    text = re.sub(rf'^{key} = ".*"', f'{key} = "sub"', file.read_text("utf-8"), flags=re.MULTILINE)
    file.write_text(text, encoding="utf-8")
    capsys.readouterr()
    assert main(["evaluate", name, str(file), "--out", str(tmp_path / "o")]) == 2
    said = capsys.readouterr().err
    if content is None:
        assert said == f"mixedlub: {file}: {place}: 'sub': is a folder; name a file in it\n"
    else:
        assert said == f"mixedlub: {table}: is not text in UTF-8; save it as comma-separated text in UTF-8\n"


def test_a_file_named_like_a_table_of_a_case_is_named_once(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "contact.toml").write_text('schema = "mixedlub-two-disc/1"\n', encoding="utf-8")
    assert main(["evaluate", "two-disc", "contact.toml"]) == 2
    assert capsys.readouterr().err.count("contact.toml") == 1
