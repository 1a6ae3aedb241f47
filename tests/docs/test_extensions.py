"""The extensions of the pages: blocks run, a failing one breaks the build, generated pages are whole."""

import doctest
import importlib
import re
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

from mixedlub.cli import COMMANDS
from mixedlub.effects import catalogue
from mixedlub.kinds import KINDS

ROOT = Path(__file__).parents[2]
EXTENSIONS = ROOT / "docs/extensions"
PAGES = [path for path in (ROOT / "docs").rglob("*.md") if "made" not in path.parts]


@pytest.fixture(scope="module", autouse=True)
def _extensions():
    sys.path.insert(0, str(EXTENSIONS))
    yield
    sys.path.remove(str(EXTENSIONS))


@cache
def pieces():
    """The text of every piece that pages include."""
    import generated

    return generated.pieces()


@pytest.fixture
def built(tmp_path):
    """Build one page with the extensions; gives its HTML and what Sphinx complained of."""

    def build(text: str) -> tuple[str, str]:
        source = tmp_path / "source"
        source.mkdir()
        (source / "conf.py").write_text(
            f"import sys\nsys.path.insert(0, {str(EXTENSIONS)!r})\n"
            "extensions = ['myst_parser', 'run_blocks', 'svg_equations', 'no_network']\n"
            "html_math_renderer = 'svg'\nmyst_enable_extensions = ['dollarmath']\n"
        )
        (source / "index.md").write_text(f"# Page\n\n{text}\n")
        words = [sys.executable, "-m", "sphinx", "-q", "--no-color", str(source), str(tmp_path / "out")]
        found = subprocess.run(words, capture_output=True, text=True, check=False)
        return (tmp_path / "out/index.html").read_text(encoding="utf-8"), found.stderr

    return build


@pytest.mark.parametrize("name", [path.stem for path in sorted(EXTENSIONS.glob("*.py"))])
def test_examples_in_the_extensions_hold(name):
    assert doctest.testmod(importlib.import_module(name)).failed == 0


def test_blocks_of_a_page_share_its_folder(built):
    html, complaints = built(
        "```{file} noted.toml\nx = 41\n```\n\n"
        "```{run} python\nfrom pathlib import Path\nprint(int(Path('noted.toml').read_text()[4:]) + 1)\n```\n\n"
        "```{run}\nls examples/case\n```\n\n```{run}\n:hidden:\necho unseen\n```\n"
    )
    assert complaints == ""
    assert "</span>42\n" in html
    assert "system.toml" in html
    assert "unseen" not in html


def test_a_block_that_fails_is_an_error_of_the_build(built):
    blocks = (
        "```{run}\nfalse\n```",
        "```{run}\n:status: 2\ntrue\n```",
        "```{run}\nmixedlub no-such-command\n```",
        "```{run}\n:status: 1\nmixedlub kinds\n```",
        "```{run} python\n1 / 0\n```",
        "```{run} python\nimport warnings\nwarnings.warn('of anything')\n```",
        "```{picture} no.svg\n```",
    )
    complaints = built("\n\n".join(blocks))[1]
    assert complaints.count("index: 'false' ended with status 1, not 0") == 1
    assert complaints.count(": ERROR: ") == len(blocks)


def test_formulas_are_drawn_and_those_that_cannot_be_are_an_error(built):
    html, complaints = built(r"$\mu = \tau / p_0$ and $\nosuchcommand$")
    assert html.count('<svg class="equation"') == 1
    assert r"\nosuchcommand" in complaints


def test_a_page_that_loads_from_another_host_is_an_error(built):
    assert "another host" in built('<img src="https://elsewhere.example/x.png">')[1]


def test_generated_pages_have_every_effect_command_and_kind():
    import generated

    pages = generated.pages()
    effects = "".join(text for name, text in pages.items() if name.startswith("effects/"))
    assert [line[3:] for line in effects.splitlines() if line.startswith("## ")] == list(catalogue())
    assert {name for name in pages if name.startswith("commands/")} == {f"commands/{c.NAME}" for c in COMMANDS}
    assert {name for name in pages if name.startswith("kinds/")} == {f"kinds/{k}" for k in KINDS}


def test_public_classes_are_documented_with_their_members():
    import mixedlub as ml

    text = pieces()["api"]
    assert ".. autoclass:: mixedlub.Answer\n   :members:" in text
    assert ".. autoexception:: mixedlub.CautionWarning" in text
    assert all(re.search(rf":: mixedlub\.{name}$", text, re.MULTILINE) for name in ml.PUBLIC)
    members = [one for name, one in vars(ml.Answer).items() if not name.startswith("_") and name != "diagnosis"]
    assert all(one.__doc__ for one in members)


def test_every_setting_has_a_row_with_its_value():
    import thresholds

    text = pieces()["thresholds"]
    for module in thresholds.SETTINGS:
        source = importlib.import_module(f"mixedlub.diagnosis.settings.{module}")
        rows = {
            name: row for row in thresholds.rows(Path(source.__file__).read_text()) for name in row.name.split(", ")
        }
        assert rows.keys() == {name for name in vars(source) if name.isupper()}
        assert all(f"| `{row.name}` | `{row.value}` | {row.kind.lower()} |" in text for row in rows.values())


@pytest.mark.parametrize("file", ["score.txt", "score_rigs.txt"])
def test_every_row_of_a_score_is_read(file):
    import scores

    text = (scores.FOLDER / file).read_text(encoding="utf-8")
    for tool, rows in scores.scores(text).items():
        block = next(b for b in text.split("\n\n") if b.startswith(f"{tool}\nfigure")).splitlines()[2:]
        assert len(rows) == len(block)
        for line, row in zip(block, rows.values(), strict=True):
            assert line.startswith(row.name)
            assert line[len(row.name) :].split()[0] == row.value
            assert (row.met is False) == line.endswith("NOT met")


def test_missed_goals_are_listed():
    import scores

    table = (
        "mixedlub diagnose\n"
        "figure                      value        90 %    n  goal\n"
        "both effects of a pair      0.839  [0.7, 0.9]   31  >= 0.85      NOT met\n"
        "good readings flagged           0     [0, 1]  200  <= 0.005     met\n"
        "seconds a case, worst        53.0             240  <= 30        NOT met\n"
    )
    said = scores.missed(scores.scores(table)[scores.TOOL])
    assert (
        said == "Goals missed: 2. both effects of a pair (0.839, goal ≥ 0.85); seconds a case, worst (53.0, goal ≤ 30)."
    )


def test_a_command_may_go_over_several_lines(built):
    html, complaints = built("```{run}\necho one \\\n  two\necho three\n```")
    assert complaints == ""
    assert "one two" in html
    assert "three" in html


def test_pieces_that_pages_include_are_there():
    included = re.findall(r"\{include\} (?:\.\./)*made/(\w+)\.md", "".join(p.read_text() for p in PAGES))
    assert set(included) == set(pieces())


def test_a_script_runs_beside_a_command_once_it_is_ready(built):
    html, complaints = built(
        "```{file} slow.sh\nsleep 0.3; echo ready; touch there; sleep 60\n```\n\n"
        "```{run}\n:with: slow.sh\n:once: ready\nsleep 0.1; ls there\n```"
    )
    assert complaints == ""
    assert "</span>there\n" in html
