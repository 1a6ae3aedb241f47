"""Pages and tables that come from the source: laws, effects, keys and columns, commands, rooms, scores."""

from __future__ import annotations

import ast
import contextlib
import io
import itertools
import pkgutil
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import scores
from sphinx.application import Sphinx

ROOT = Path(__file__).parents[2]
LAW_MODULES = ("roughness.mccool", "roughness.integrals")
"""Laws of surfaces that the chain calls; those of `mixedlub.laws` come first."""
TITLES = {"mccool": "McCool's asperities", "integrals": "Integrals of Gaussian heights"}
HEADS = {5: "| name | unit | default | allowed | meaning |", 4: "| name | default | allowed | meaning |"}
"""Heads of the tables of `mixedlub kinds`, by their columns; the unit is left out where no row has one."""
BASELINES = (
    "right verdict, one effect, identifiable",
    "right or honestly tied, one effect, all",
    "both effects of a pair named",
    "none where nothing is missing",
    "unknown where so and identifiable",
    "withheld: error of predicted over calibrated",
    "90 % predictive intervals cover",
    "log score of the probabilities, a case",
)


def pages() -> dict[str, str]:
    """Markdown by path in `docs/reference`."""
    return dict([*_laws(), *_effects(), *_commands(), *_kinds()])


def pieces() -> dict[str, str]:
    """Markdown by name that pages include."""
    battery, rigs = ((scores.FOLDER / name).read_text(encoding="utf-8") for name in ("score.txt", "score_rigs.txt"))
    gears, others = scores.scores(battery), scores.scores(rigs)
    return {
        "score_gears": scores.all_rows(gears[scores.TOOL]),
        "missed_gears": scores.missed(gears[scores.TOOL]),
        "baselines": scores.compared(gears, BASELINES),
        "score_rigs": scores.all_rows(others[scores.TOOL]),
        "missed_rigs": scores.missed(others[scores.TOOL]),
        "by_kind": scores.by_kind(rigs),
        "options": _options(),
        "results": _results(),
        "rooms": _rooms(),
        "ranges": _ranges(),
    }


def _laws() -> Iterator[tuple[str, str]]:
    import mixedlub.laws

    inside = sorted(m.name for m in pkgutil.iter_modules(mixedlub.laws.__path__))
    for name in (*(f"mixedlub.laws.{m}" for m in inside), *LAW_MODULES):
        last = name.rpartition(".")[2]
        title = TITLES.get(last, last.replace("_", " ").capitalize())
        yield f"laws/{last}", f"# {title}\n\n```{{eval-rst}}\n.. automodule:: {name}\n   :members:\n```\n"


def _effects() -> Iterator[tuple[str, str]]:
    from mixedlub.chain.effect import STAGES
    from mixedlub.effects import catalogue
    from mixedlub.report.effect_pages import effects_text

    for stage in STAGES:
        parts = [f"# Stage: {stage}"]
        for e in catalogue().values():
            if e.stage == stage:
                parts += [
                    f"## {e.id}",
                    e.summary,
                    f"```{{math}}\n{e.equation}\n```",
                    f"```{{code-block}} text\n:class: wide\n{effects_text(e.id).partition(chr(10) * 2)[2]}\n```",
                ]
        if len(parts) > 1:
            yield f"effects/{stage}", "\n\n".join(parts) + "\n"


def _commands() -> Iterator[tuple[str, str]]:
    from mixedlub.cli import COMMANDS

    for command in COMMANDS:
        text = _printed(command.NAME, "--help")
        yield f"commands/{command.NAME}", f"# mixedlub {command.NAME}\n\n```text\n{text}\n```\n"


def _kinds() -> Iterator[tuple[str, str]]:
    from mixedlub.kinds import KINDS

    for kind in KINDS:
        text = _printed("kinds", kind).splitlines()
        groups = [list(lines) for _, lines in itertools.groupby(text, lambda line: len(line) - len(line.lstrip()))]
        yield f"kinds/{kind}", f"# {kind}\n\n" + "\n\n".join(map(_tabled, groups)) + "\n"


def _tabled(lines: list[str]) -> str:
    """Aligned rows as a table in Markdown; other lines as they are, those without indent as headings.

    >>> print(_tabled(["  torque_Nm  N m  required  above 0  torque", "  run        -    required  number   a run"]))
    | name | unit | default | allowed | meaning |
    |---|---|---|---|---|
    | `torque_Nm` | N m | required | above 0 | torque |
    | `run` | - | required | number | a run |
    """
    length = max(map(len, lines))
    blank = "".join(" " if all(line[i : i + 1] in ("", " ") for line in lines) else "x" for i in range(length))
    spans = [match.span() for match in re.finditer(r"x+(?: x+)*", blank)]
    if len(spans) in HEADS:
        rows = [" | ".join(line[start:end].strip().replace("|", "\\|") for start, end in spans) for line in lines]
        marked = (f"| `{name}` |{rest} |" for name, _, rest in (row.partition(" |") for row in rows))
        return "\n".join([HEADS[len(spans)], "|---" * len(spans) + "|", *marked])
    return "\n\n".join(line.strip() if line[:1] in ("", " ") else f"## {line}" for line in lines)


def _printed(*words: str) -> str:
    from mixedlub.cli import main

    with contextlib.redirect_stdout(io.StringIO()) as out:
        if main(words) != 0:
            raise RuntimeError(f"mixedlub {' '.join(words)} failed")
    return out.getvalue().rstrip()


def _rooms() -> str:
    """The rooms of the package with the first line of each one's docstring, in the order that a test holds."""
    source = ast.parse((ROOT / "tests/contracts/test_rooms.py").read_text(encoding="utf-8"))
    (given,) = (
        node.value
        for node in source.body
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name) and node.targets[0].id == "ROOMS"
    )
    rooms = eval(compile(ast.Expression(given), "test_rooms", "eval"))[""]
    lines = ["| room | holds |", "|---|---|"]
    for room in rooms:
        folder = ROOT / "mixedlub" / room
        path = folder / "__init__.py" if folder.is_dir() else folder.with_suffix(".py")
        about = (ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or "").partition("\n")[0]
        if not room.startswith("__"):
            lines.append(f"| `mixedlub/{room}` | {about} |")
    return "\n".join(lines)


def _options() -> str:
    """The options of a study with their choices, the default first."""
    from mixedlub.study.options import MEANINGS
    from mixedlub.study.schema import Options

    lines = ["| option | value | meaning |", "|---|---|---|"]
    for name, schema in Options.model_json_schema()["properties"].items():
        default = schema.get("default")
        for choice in sorted(schema.get("enum", ["number"]), key=lambda c: c != default):
            value = f'`"{choice}"`' if "enum" in schema else f"number, default {'-' if default is None else default}"
            mark = " (default)" if choice == default else ""
            meaning = MEANINGS.get(name, {}).get(choice, schema.get("description", name.replace("_", " ")))
            lines.append(f"| `{name}` | {value}{mark} | {meaning} |")
    return "\n".join(lines)


def _results() -> str:
    """The columns of the table of a study."""
    from mixedlub.study.results import COLUMNS, DEFINITIONS

    lines = ["| column | holds |", "|---|---|"]
    lines += [f"| `{column}` | {DEFINITIONS[name][1]} |" for name, (column, _) in COLUMNS.items()]
    return "\n".join(lines)


def _ranges() -> str:
    """Allowed and typical ranges of every number, from the table that holds them."""
    source = (ROOT / "mixedlub/schema/ranges.toml").read_text(encoding="utf-8")
    lines = ["| key | allowed | typical |", "|---|---|---|"]

    def walk(place: str, table: dict[str, Any]) -> None:
        for key, value in table.items():
            name = f"{place}.{key}".lstrip(".")
            if not isinstance(value, dict):
                continue
            limits = [v for v in value.values() if isinstance(v, list) and len(v) == 2]
            if limits:
                cells = (f"{low:g} to {high:g}" for low, high in limits)
                lines.append(f"| `{name}` | {' | '.join(cells)} |")
            else:
                walk(name, value)

    walk("", tomllib.loads(source))
    notes = [line.lstrip("# ") for line in source.partition("\n\n")[0].splitlines() if line.startswith("#")]
    return "\n".join(lines) + "\n\n" + "\n".join(notes)


def _write(app: Sphinx) -> None:
    for folder, found in (("reference/made", pages()), ("made", pieces())):
        for name, text in found.items():
            path = Path(app.srcdir) / folder / f"{name}.md"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text + ("" if text.endswith("\n") else "\n"), encoding="utf-8")


def setup(app: Sphinx) -> dict[str, Any]:
    app.connect("builder-inited", _write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
