"""The notebooks of the gallery run from top to bottom, hold no outputs, and show what their last lines return."""

import ast
import json
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "examples/notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))
FIGURES = {"1_surfaces": 1, "2_power_loss": 3, "3_pairings": 2, "4_gearbox": 2, "5_diagnosis": 1, "6_laws": 2}
"""Figures that each notebook shows."""


def cells(path: Path) -> list[str]:
    """Programs of the code cells."""
    return [
        "".join(c["source"]) for c in json.loads(path.read_text(encoding="utf-8"))["cells"] if c["cell_type"] == "code"
    ]


def run(path: Path) -> list[object]:
    """What the last lines of the cells return, as a notebook displays it."""
    names: dict[str, object] = {}
    shown = []
    for number, program in enumerate(cells(path), start=1):
        tree = ast.parse(program)
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, f"{path.name}, cell {number}", "exec"), names)
        if last is not None:
            shown.append(eval(compile(ast.Expression(last.value), f"{path.name}, cell {number}", "eval"), names))
    return [one for one in shown if one is not None]


def test_the_gallery_has_six_notebooks() -> None:
    assert [path.stem for path in NOTEBOOKS] == sorted(FIGURES)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_no_output_is_kept(path: Path) -> None:
    book = json.loads(path.read_text(encoding="utf-8"))
    assert (book["nbformat"], book["nbformat_minor"]) == (4, 5)
    assert len({cell["id"] for cell in book["cells"]}) == len(book["cells"])
    for cell in book["cells"]:
        if cell["cell_type"] == "code":
            assert (cell["outputs"], cell["execution_count"]) == ([], None)
        else:
            assert not {"outputs", "execution_count"} & set(cell)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs_and_shows(path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    shown = run(path)
    drawn = [one for one in shown if hasattr(one, "_repr_svg_")]
    assert len(drawn) == FIGURES[path.stem]
    assert all(figure._repr_svg_().startswith("<svg") for figure in drawn)
    tables = [one._repr_html_() for one in shown if hasattr(one, "_repr_html_") and not hasattr(one, "_repr_svg_")]
    assert tables
    assert all(table.strip().startswith("<") and table.strip().endswith(">") for table in tables)


def test_every_notebook_is_on_the_page() -> None:
    page = (ROOT / "docs/howto/notebook.md").read_text(encoding="utf-8")
    assert not [path.name for path in NOTEBOOKS if f"examples/notebooks/{path.name}" not in page]
