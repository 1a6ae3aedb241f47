"""The rooms of the diagnosis stand in one order, and each knows only those before it."""

import ast
from pathlib import Path

import pytest

import mixedlub.diagnosis

HOME = Path(mixedlub.diagnosis.__file__).parent
ORDER = ("recording", "labels", "fitting", "unnamed", "searching", "judging", "diagnose", "telling")
ORDER += ("drawing", "publishing")
FILES = sorted(path for path in HOME.rglob("*.py") if path.name != "__init__.py")


def room(path: Path) -> str:
    return path.relative_to(HOME).parts[0].removesuffix(".py")


def test_every_room_has_its_place() -> None:
    assert {room(path) for path in FILES} == set(ORDER)


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(HOME)))
def test_a_room_knows_only_those_before_it(path: Path) -> None:
    own = ORDER.index(room(path))
    known = [
        node.module.split(".")[2]
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("mixedlub.diagnosis.")
    ]
    late = [name for name in known if ORDER.index(name) > own]
    assert not late
