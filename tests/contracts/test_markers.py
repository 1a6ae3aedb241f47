"""Numbers of the literature name their source, and none of them is held beside numbers of our own code.

A source in a journal has its DOI, with which a reader finds it.
"""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[1]
ARTICLE = re.compile(r"\(\d{4}\), [^,;\d]+ \d+, \w*\d")
"""Year, journal, volume and page."""
DOI = re.compile(r"\bdoi:10\.\d{4,9}/\w")
WITHOUT_DOI = {
    "Archard (1959), Wear 2, 438",
    "Changenet and Velex (2007), J. Mech. Des. 129, 128",
    "Diab, Ville, Velex and Changenet (2004), J. Mech. Des. 126, 903",
    "Hamrock and Dowson (1977), J. Lubr. Technol. 99, 264",
    "Hsu and Lee (1994), J. Tribol. 116, 762",
}
"""Articles whose DOI is not confirmed."""


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


def without_doi(source: str) -> list[str]:
    """Articles of a marker, which semicolons part, that have no DOI."""
    return [part for part in source.split("; ") if ARTICLE.search(part) and not DOI.search(part)]


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


@pytest.mark.parametrize(
    ("source", "without"),
    [
        ("Blok (1937), Wear 2, 438", ["Blok (1937), Wear 2, 438"]),
        ("Blok (1937), J. Mech. Des. 126, 903, table 2", ["Blok (1937), J. Mech. Des. 126, 903, table 2"]),
        ("Blok (1937), Proc. IMechE J 233, 303, doi:", ["Blok (1937), Proc. IMechE J 233, 303, doi:"]),
        ("Blok (1937), Wear 2, 438, doi:10.1016/0043-1648(86)90045-1, table 2", []),
        ("Blok (1937), Wear 2, 438, doi:10.1115/1.1; Hertz (1881), Wear 1, 2", ["Hertz (1881), Wear 1, 2"]),
        ("Blok (1937)", []),
        ("Blok (1996), NASA TM-107279", []),
        ("Blok (1999), AGMA 99FTMS1, table 2", []),
        ("ISO 4288:1996", []),
    ],
)
def test_an_article_without_a_doi_is_recognised(source: str, without: list[str]) -> None:
    assert without_doi(source) == without


def test_every_article_has_a_doi_or_is_listed() -> None:
    every = [own for path in TESTS.rglob("test_*.py") for own in marked(path.read_text("utf-8")).values()]
    assert {part for own in every for part in without_doi(own.get("literature", ""))} == WITHOUT_DOI
