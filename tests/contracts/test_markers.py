"""Numbers of the literature name their source, and none of them is held beside numbers of our own code."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[1]


def marks(node: ast.expr) -> Iterator[tuple[str, str]]:
    """Name of a marker and its source; those of a list one after the other."""
    match node:
        case ast.List(elts=parts) | ast.Tuple(elts=parts):
            for part in parts:
                yield from marks(part)
        case ast.Call(func=ast.Attribute(attr=name), args=[ast.Constant(value=str(source)), *_]):
            yield name, source.strip()
        case ast.Attribute(attr=name) | ast.Call(func=ast.Attribute(attr=name)):
            yield name, ""


def marked(text: str) -> dict[str, dict[str, str]]:
    """Markers of each test of a file with their sources, those of its class and of the module included."""
    found: dict[str, dict[str, str]] = {}

    def visit(body: list[ast.stmt], above: dict[str, str]) -> None:
        for node in body:
            match node:
                case ast.Assign(targets=[ast.Name(id="pytestmark")], value=value):
                    above = above | dict(marks(value))
        for node in body:
            if not isinstance(node, ast.FunctionDef | ast.ClassDef):
                continue
            own = above | {name: source for each in node.decorator_list for name, source in marks(each)}
            if isinstance(node, ast.ClassDef):
                visit(node.body, own)
            elif node.name.startswith("test_"):
                found[node.name] = own

    visit(ast.parse(text).body, {})
    return found


def unsourced(found: dict[str, dict[str, str]]) -> list[str]:
    return [name for name, own in found.items() if not own.get("literature")]


@pytest.mark.parametrize(
    ("text", "without"),
    [
        ("def test_a(): ...", ["test_a"]),
        ("@pytest.mark.literature\ndef test_a(): ...", ["test_a"]),
        ("@pytest.mark.literature('Blok (1937)')\ndef test_a(): ...", []),
        ("pytestmark = pytest.mark.literature('Blok (1937)')\ndef test_a(): ...", []),
        ("@pytest.mark.literature('Blok (1937)')\nclass TestA:\n    def test_a(self): ...", []),
    ],
)
def test_a_marker_without_a_source_is_recognised(text: str, without: list[str]) -> None:
    assert unsourced(marked(text)) == without


@pytest.mark.parametrize("path", sorted((TESTS / "literature").glob("test_*.py")), ids=lambda path: path.name)
def test_every_number_of_the_literature_names_its_source(path: Path) -> None:
    assert unsourced(marked(path.read_text(encoding="utf-8"))) == []


@pytest.mark.parametrize("path", sorted((TESTS / "golden").glob("test_*.py")), ids=lambda path: path.name)
def test_every_test_of_the_golden_folder_is_golden(path: Path) -> None:
    assert [name for name, own in marked(path.read_text(encoding="utf-8")).items() if "golden" not in own] == []


def test_no_test_holds_numbers_of_the_literature_beside_our_own() -> None:
    paths = TESTS.rglob("test_*.py")
    every = {f"{path.name}::{name}": own for path in paths for name, own in marked(path.read_text("utf-8")).items()}
    assert [name for name, own in every.items() if {"golden", "literature"} <= set(own)] == []


def test_a_marker_has_a_source_wherever_it_stands() -> None:
    every = [own for path in TESTS.rglob("test_*.py") for own in marked(path.read_text("utf-8")).values()]
    assert [own for own in every if own.get("literature") == ""] == []
