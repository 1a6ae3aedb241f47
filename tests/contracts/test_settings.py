"""Numbers that decide an outcome: those of the diagnosis are in its settings, each with the kind of its reason."""

import ast
import re
from collections import Counter
from pathlib import Path

import pytest

import mixedlub

HOME = Path(mixedlub.__file__).parent
DIAGNOSIS = HOME / "diagnosis"
SETTINGS = DIAGNOSIS / "settings"
KINDS = r"(Definition|Grid|Cost limit|Judgement)\. \S|Source: \S.*\. \S|Measured \((\S+\.py)\): \S"
"""How the docstring of a constant begins; a measured one names the test or script."""
BELOW = tuple(HOME / room for room in ("recording", "data_checks", "kinds"))
"""Rooms that the diagnosis uses, and that keep their own constants."""
LAYOUT = (DIAGNOSIS / "report/figures", DIAGNOSIS / "report/text/words.py")
"""Sizes of figures, and the width of the text."""
CALLS = ("array", "arange", "geomspace", "linspace", "Fraction")


def is_number(node: ast.expr) -> bool:
    """Whether an expression is a number, or a collection whose values are numbers."""
    match node:
        case ast.Constant(value=value):
            return type(value) in (int, float)
        case ast.Tuple(elts=parts) | ast.List(elts=parts) | ast.Set(elts=parts) | ast.Dict(values=parts):
            return bool(parts) and all(map(is_number, parts))
        case ast.UnaryOp(operand=part):
            return is_number(part)
        case ast.BinOp(left=left, right=right):
            return is_number(left) or is_number(right)
        case ast.GeneratorExp(elt=part) | ast.Call(func=ast.Name(id="tuple"), args=[part]):
            return is_number(part)
        case ast.Call(func=ast.Attribute(attr=name) | ast.Name(id=name)):
            return name in CALLS
    return False


def constants(path: Path) -> list[tuple[tuple[str, ...], str]]:
    """Names of each assignment of numbers at the level of a module, in capitals, and the docstring below it."""
    found = []
    body = ast.parse(path.read_text(encoding="utf-8")).body
    for node, below in zip(body, [*body[1:], None], strict=True):
        if not isinstance(node, ast.Assign | ast.AnnAssign) or node.value is None or not is_number(node.value):
            continue
        targets = node.targets if isinstance(node, ast.Assign) else [node.target]
        names = tuple(x.id for target in targets for x in ast.walk(target) if isinstance(x, ast.Name))
        if all(name.lstrip("_").isupper() for name in names):
            text = below.value if isinstance(below, ast.Expr) else None
            found.append((names, str(text.value) if isinstance(text, ast.Constant) else ""))
    return found


def modules(*folders: Path) -> list[Path]:
    return [path for folder in folders for path in sorted(folder.rglob("*.py"))]


def used_names() -> set[str]:
    """Names that a module of the diagnosis reads."""
    # Settings are read too: one of them may be made of another.
    trees = [ast.parse(path.read_text(encoding="utf-8")) for path in modules(DIAGNOSIS)]
    reads = (node for tree in trees for node in ast.walk(tree) if isinstance(node, ast.Name))
    return {node.id for node in reads if isinstance(node.ctx, ast.Load)}


@pytest.mark.parametrize(
    ("text", "seen"),
    [
        ("LEAST = 3", ["LEAST"]),
        ("LOW, HIGH = -0.5, 2e3", ["LOW", "HIGH"]),
        ("GRID = tuple(np.geomspace(1.0, 2.0, 3))", ["GRID"]),
        ("PRIOR = {'none': 0.4}", ["PRIOR"]),
        ("_LOG = 2.0 * np.pi", ["_LOG"]),
        ("POWERS = tuple(Fraction(n, 2) for n in (1, 3))", ["POWERS"]),
        ("NAMES = tuple(names)", []),
        ("NAME = 'word'", []),
        ("least = 3", []),
    ],
)
def test_a_constant_is_recognised(tmp_path: Path, text: str, seen: list[str]) -> None:
    path = tmp_path / "one.py"
    path.write_text(f'{text}\n"""Grid. Some."""\n')
    assert [name for names, _ in constants(path) for name in names] == seen


@pytest.mark.parametrize("text", ["", "Some.", "Judgement", "Measured: often.", "Source: somebody", "Guess. Some."])
def test_a_docstring_without_a_kind_is_recognised(text: str) -> None:
    assert not re.match(KINDS, text)


def test_no_module_of_the_diagnosis_has_a_number_of_its_own() -> None:
    own = [
        f"{path.relative_to(HOME)}: {', '.join(names)}"
        for path in modules(DIAGNOSIS)
        if not {SETTINGS, *LAYOUT} & {path, *path.parents}
        for names, _ in constants(path)
    ]
    assert own == []


@pytest.mark.parametrize("path", modules(SETTINGS, *BELOW), ids=lambda path: str(path.relative_to(HOME)))
def test_every_constant_says_what_kind_of_reason_it_has(path: Path) -> None:
    assert [names for names, text in constants(path) if not re.match(KINDS, text)] == []


def test_whatever_measured_a_number_exists() -> None:
    found = [re.match(KINDS, text) for path in modules(SETTINGS, *BELOW) for _, text in constants(path)]
    measured = {match[2] for match in found if match and match[2]}
    assert [name for name in measured if not (HOME.parent / name).exists()] == []


def test_names_of_settings_are_unique() -> None:
    count = Counter(name for path in modules(SETTINGS) for names, _ in constants(path) for name in names)
    assert [name for name, times in count.items() if times > 1] == []


def test_every_setting_is_used() -> None:
    every = {name for path in modules(SETTINGS) for names, _ in constants(path) for name in names}
    assert every - used_names() == set()
