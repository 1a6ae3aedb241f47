"""The count of items of papers at the top of its page is that of the rows, and what the rows name exists."""

import ast
import re
from collections import Counter
from pathlib import Path

import pytest

import mixedlub
from mixedlub import effects, friction
from mixedlub.chain.slots import SLOTS
from mixedlub.cli import COMMANDS
from mixedlub.evaluate import EVALUATIONS
from mixedlub.schema.gear_file import gear_names
from mixedlub.schema.oil_file import oil_names

PAGES = Path(__file__).parents[2] / "docs"
PAGE = (PAGES / "validation" / "papers.md").read_text(encoding="utf-8")
COMMAND_NAMES = {module.NAME for module in COMMANDS}
UNIT = re.compile(r"(_(W|N|K|m|s|mm|MPa|GPa))+$")
"""Units that tables append to a name."""
STATUS = ("yes", "partly", "no", "not reproducible")
TOP, *PAPERS = re.split(r"^## ", PAGE, flags=re.MULTILINE)


def rows(text):
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line[:2] == "| "][1:]


def counted(items):
    found = Counter(status.split(":")[0] for *_, status in items)
    assert set(found) <= set(STATUS)
    return [str(len(items)), *(str(found[one]) for one in STATUS)]


def parted(text):
    """Items of the audit, and claims counted beside them."""
    further = [row[0].startswith("further") for row in rows(text)]
    return [[row for row, apart in zip(rows(text), further) if apart == kept] for kept in (False, True)]


def test_the_numbers_at_the_top_are_those_of_the_rows():
    made = [[text.splitlines()[0], *counted(parted(text)[0])] for text in PAPERS]
    items, further = ([row for text in PAPERS for row in parted(text)[kept]] for kept in (0, 1))
    assert rows(TOP) == [*made, ["all", *counted(items)], ["further claims", *counted(further)]]
    assert len(items) == 153


@pytest.mark.parametrize("text", PAPERS, ids=[text.splitlines()[0] for text in PAPERS])
def test_each_item_is_there_once_and_says_what_lacks(text):
    items = rows(text)
    assert len({name for name, *_ in items}) == len(items)
    for name, _, how, status in items:
        assert (status == "yes") == (":" not in status), name
        assert how != "none" or status.split(":")[0] in ("no", "not reproducible"), name


COMPARED = {
    (1, "claim 1"): (
        "A: mean friction, 20 to 95 m/s, geometry B, ground",
        "A: mean friction, 20 to 95 m/s, geometry B, super",
    ),
    (1, "claim 2"): ("A: mean friction, ground to superfinished",),
    (1, "claim 3"): ("A: mean friction, geometry A to B",),
    (1, "claim 4"): ("A: mean friction, 1900 to 4000 N m",),
    (1, "claim 5"): ("A: mean friction, oil 80 to 120 °C",),
    (3, "claim 1"): ("C: friction of fluid A over",),
    (3, "claim 2"): ("C: friction of fluid A, inlet",),
    (3, "claim 3"): ("C: friction of fluid A, slide-to-roll",),
    (3, "claim 4"): ("C: friction of fluid A, rolling speed",),
    (3, "further claim 1"): ("C: friction of fluid A, load",),
    (3, "further claim 2"): ("C: Hertz pressure of the baseline",),
    (4, "claim 1"): ("B: largest friction, 800 rpm",),
    (4, "claim 2"): ("B: largest friction, 6000 rpm",),
    (4, "claim 3"): ("B: 78 to 141 %",),
    (4, "claim 5"): ("B: pitch point over",),
    (4, "claim 7"): ("B: Hertz pressure", "B: half width"),
    (4, "claim 8"): ("B: film (",),
    (4, "claim 9"): ("B: rise of the film",),
    (4, "figure 12"): ("B: rise of the film",),
}
"""Items with a number of the page of published numbers, by paper, and the beginnings of its rows."""


@pytest.mark.parametrize(("item", "beginnings"), COMPARED.items())
def test_an_item_has_the_number_of_the_page_that_is_computed(item, beginnings):
    """The first table of that page has the base model in its third column."""
    computed = (PAGES.parent / "examples" / "published" / "points.md").read_text(encoding="utf-8")
    (how,) = (" ".join(row[2:]) for row in rows(PAPERS[item[0] - 1]) if row[0] == item[1])
    for beginning in beginnings:
        base = next(row[2] for row in rows(computed) if row[0].startswith(beginning))
        assert base in how, beginning


@pytest.fixture(scope="module")
def declared():
    """Keys of sections and effects; and texts of the source that are one name: of columns, tables, figures, kinds."""
    trees = [ast.parse(path.read_text("utf-8")) for path in Path(mixedlub.__file__).parent.rglob("*.py")]
    nodes = [node for tree in trees for node in ast.walk(tree)]
    fields = [one for one in nodes if isinstance(one, ast.AnnAssign) and isinstance(one.value, ast.Call)]
    keys = {one.target.id for one in fields if getattr(one.value.func, "id", "") == "key"}
    keys |= {"NAME", *effects.catalogue(), *(slot.option for slot in SLOTS)}
    return keys, {one.value for one in nodes if isinstance(one, ast.Constant) and isinstance(one.value, str)}


def test_what_the_rows_name_exists(declared):
    """Commands, methods and values of keys by their lists, keys by the sections, other names as whole ones."""
    keys, names = declared
    known = {"friction": friction.catalogue(), "oil": oil_names(), "preset": gear_names()}
    known |= {slot.option: slot.choices for slot in SLOTS}
    for text in re.findall(r"`([^`]+)`", "\n".join(PAPERS)):
        command, *rest = text.removeprefix("mixedlub ").split() if text.startswith("mixedlub ") else [""]
        assert not command or command in COMMAND_NAMES, text
        assert command != "evaluate" or rest[0] in EVALUATIONS, text
        key, _, value = text.partition(" = ")
        if value.strip('"') != value and key in known:
            assert value.strip('"') in known[key], text
        said = [] if command else re.findall(r"\w+", key.removesuffix(".csv"))
        places = keys if value or "." in key.removesuffix(".csv") or key.startswith("[") else keys | names
        for name in said:
            assert name in places or UNIT.sub("", name) in places, text
