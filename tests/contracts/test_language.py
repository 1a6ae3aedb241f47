"""Docstrings and pages name things by their nouns: pronouns and relatives in place of a noun are counted."""

import ast
import re
from pathlib import Path

import pytest

import mixedlub
import profiles
import roughness

HOME = Path(mixedlub.__file__).parent
BESIDE = [Path(package.__path__[0]) for package in (profiles, roughness)]
CHAINS = re.compile(
    r"\b(that of|those of|those that|what|whose|of which|its own|where there|where it|none where|as it|is no"
    r"|the one)\b",
    re.IGNORECASE,
)
"""Words that stand for a noun which the reader must find."""
NOT_PROSE = re.compile(r"(?m)^\s*>>>.*(?:\n[ \t]*\S.*)*|^\s*\.\. math::.*$|``[^`]*``|:math:`[^`]*`")
"""Examples, formulas and names of a docstring."""
PACKAGE = 1.0
"""Most such words per 1,000 words of docstring over all packages; well-kept scientific packages have 0.3."""
ROOM = 4.0
"""The same for each room."""
PAGE = 0.1
"""The same for the prose of the written pages together."""
CHECKOUT = Path(__file__).parents[2]
PAGES = [
    *(CHECKOUT / name for name in ("README.md", "CHANGELOG.md")),
    *sorted(p for p in (CHECKOUT / "docs").rglob("*.md") if "made" not in p.parts),
]
"""Pages that are written, not generated."""
NOT_PAGE_PROSE = re.compile(
    r"^[ \t]*(`{3,}|:{3,})[^\n]*\n.*?^[ \t]*\1[ \t]*$|^[ \t]*\|[^\n]*$|\[[^]]*\]\([^)]*\)|`[^`]*`|\$\$?[^$]*\$",
    re.MULTILINE | re.DOTALL,
)
"""Blocks, tables, links, names and formulas of a page."""


def docstrings(path: Path) -> list[str]:
    """All docstrings of a file, those below constants among them, without their formulas and examples."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    texts = [
        node.value.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)
    ]
    return [NOT_PROSE.sub(" ", text) for text in texts]


PATHS = sorted(path for home in (HOME, *BESIDE) for path in home.rglob("*.py"))


def room_of(path: Path) -> str:
    """The room of a file; the diagnosis is counted by its rooms."""
    home = next(home for home in (HOME, *BESIDE) if path.is_relative_to(home))
    if home in BESIDE:
        return home.name
    parts = path.relative_to(home).parts
    folders = parts[:2] if parts[0] == "diagnosis" and len(parts) > 2 else parts[:1]
    return "/".join(folders) if len(parts) > 1 else "."


def rate(paths: list[Path]) -> float:
    """Pronouns and relatives in place of a noun per 1,000 words of docstring."""
    texts = [text for path in paths for text in docstrings(path)]
    words = sum(len(text.split()) for text in texts)
    return 1000.0 * sum(len(CHAINS.findall(text)) for text in texts) / max(words, 1)


def of_room(room: str) -> float:
    return rate([path for path in PATHS if room_of(path) == room])


ROOMS = sorted({room_of(path) for path in PATHS})


def test_a_pronoun_in_place_of_a_noun_is_counted(tmp_path: Path) -> None:
    path = tmp_path / "one.py"
    path.write_text(
        'LIMIT = 3\n"""That of a film."""\n\n\ndef f():\n    """What it is.\n\n    >>> "what"\n    1\n    """\n'
    )
    assert rate([path]) == pytest.approx(1000.0 * 2 / 7)


def test_docstrings_of_all_packages_name_things_by_their_nouns() -> None:
    assert rate(PATHS) <= PACKAGE


@pytest.mark.parametrize("room", ROOMS)
def test_docstrings_name_things_by_their_nouns(room: str) -> None:
    assert of_room(room) <= ROOM


def test_pages_name_things_by_their_nouns() -> None:
    prose = " ".join(NOT_PAGE_PROSE.sub(" ", path.read_text(encoding="utf-8")) for path in PAGES)
    assert 1000.0 * len(CHAINS.findall(prose)) / len(prose.split()) <= PAGE
