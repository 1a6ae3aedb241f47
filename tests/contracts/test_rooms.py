"""The rooms of the package stand in one order: each imports only those before it, and no file imports in a circle."""

import ast
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import mixedlub

HOME = Path(mixedlub.__file__).parent
ROOMS = {
    "": (
        *(
            "running",
            "schema",
            "expressions",
            "chain",
            "laws",
            "base_model",
            "effects",
            "own_laws",
            "friction",
            "parts",
            "gear",
            "rig",
            "ehl",
            "full_base",
            "kinds",
        ),
        *(
            "solutions",
            "case",
            "recording",
            "evaluate",
            "data_checks",
            "study",
            "efficiency",
            "skew_gears",
            "worm_gears",
            "report",
            "diagnosis",
        ),
        *("importers", "fit", "api", "validation", "commands", "app", "cli", "__main__"),
    ),
    "diagnosis": (
        "settings",
        "explanation",
        "problem",
        "labels",
        "inference",
        "discrepancy",
        "search",
        "assessment",
        "discovery",
        "diagnose",
        "campaign",
        "report",
    ),
    "diagnosis/report": ("text", "figures", "html", "improved", "files"),
}
"""By folder, its rooms and loose modules, each behind those that it may import."""
ALONE = "validation"
"""The proof of the diagnosis imports nothing of the package, so that it cannot share its mistakes."""
MODULES = {
    ".".join(("mixedlub", *path.relative_to(HOME).with_suffix("").parts)).removesuffix(".__init__"): path
    for path in sorted(HOME.rglob("*.py"))
}


@cache
def imported(module: str) -> set[str]:
    """Modules of the package that a module imports anywhere, type hints among them."""
    found = set()
    for node in ast.walk(ast.parse(MODULES[module].read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            names = {f"{node.module}.{alias.name}" for alias in node.names}
            found |= {name if name in MODULES else str(node.module) for name in names}
    return found & MODULES.keys()


def rooms_of(module: str, folder: str) -> str:
    """The room of a folder in which a module stands."""
    return MODULES[module].relative_to(HOME / folder).parts[0].removesuffix(".py")


@pytest.mark.parametrize("folder", ROOMS)
def test_every_room_has_its_place(folder: str) -> None:
    there = {path.name.removesuffix(".py") for path in (HOME / folder).iterdir() if path.suffix in ("", ".py")}
    assert there - {"__init__", "__pycache__"} == set(ROOMS[folder])


@pytest.mark.parametrize("folder", ROOMS)
def test_a_room_imports_only_those_before_it(folder: str) -> None:
    inside = {
        m for m, path in MODULES.items() if path.is_relative_to(HOME / folder) and path.parent / "__init__.py" != path
    }
    inside -= {m for m, path in MODULES.items() if path == HOME / folder / "__init__.py"}
    order = ROOMS[folder]
    upward = [
        f"{module} -> {other}"
        for module in inside
        for other in imported(module) & inside
        if order.index(rooms_of(other, folder)) > order.index(rooms_of(module, folder))
    ]
    assert not upward


def test_no_module_imports_in_a_circle() -> None:
    try:
        tuple(TopologicalSorter({m: imported(m) - {m} for m in MODULES}).static_order())
    except CycleError as error:
        pytest.fail(" -> ".join(error.args[1]))


def test_the_proof_imports_nothing_of_what_it_proves() -> None:
    own = {m for m in MODULES if m.startswith(f"mixedlub.{ALONE}")}
    assert not [f"{m} -> {other}" for m in own for other in imported(m) - own - {"mixedlub"}]
