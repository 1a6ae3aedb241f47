"""Pages and tables that come from the source: laws, effects, keys and columns, commands, rooms, scores."""

from __future__ import annotations

import ast
import contextlib
import io
import pkgutil
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import form_tables
import markdown_tables as md
import oils_and_gears
import one_law
import real_recordings
import scores
import thresholds
from sphinx.application import Sphinx

if TYPE_CHECKING:
    from mixedlub.chain.law import Law

ROOT = Path(__file__).parents[2]
LAW_MODULES = ("roughness.mccool", "roughness.integrals", "roughness.single_asperity", "roughness.height_sums")
"""Laws of surfaces that the chain calls; those of `mixedlub.laws` come first."""
TITLES = {"mccool": "McCool's asperities", "integrals": "Integrals of Gaussian heights"}
COLUMN_HEAD = ("column", "unit", "needed", "allowed", "meaning")
ELSEWHERE = re.compile(r"^gears|^stages\.NAME\.(gears|lubricant|surfaces|options)\b")
"""Tables of a file whose keys other pages have."""
OF_CASES = re.compile(r"^(lubricant|surfaces|options)\b")
"""Tables of a file with gears of its own whose keys other pages have."""
RESULTS = {
    "gear": ("mixedlub.gear.analysis.table", "TABLES"),
    "bevel": ("mixedlub.skew_gears.table", "TABLES"),
    "worm": ("mixedlub.worm_gears.table", "TABLES"),
    "efficiency": ("mixedlub.efficiency.table", "TABLES"),
    "ehl": ("mixedlub.ehl.table", "TABLES"),
    "friction": ("mixedlub.study.friction_comparison", "TABLES"),
    "condense": ("mixedlub.solutions.result_columns", "CONDENSED"),
    "fit": ("mixedlub.fit", "TABLES"),
    "law_errors": ("mixedlub.solutions.result_columns", "LAW_ERRORS"),
    "simulate": ("mixedlub.commands.simulate", "TABLES"),
}
"""Modules that describe the columns of the tables of commands, and the names of the descriptions."""
WITH_PAGES = ("laws", "effects", "friction")
"""Rooms of public names that other pages list."""
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
    files = ("score.txt", "score_rigs.txt", "score_poor.txt")
    battery, rigs, poor = ((scores.FOLDER / name).read_text(encoding="utf-8") for name in files)
    gears, others, flawed = scores.scores(battery), scores.scores(rigs), scores.scores(poor)
    return {
        "score_gears": scores.all_rows(gears[scores.TOOL]),
        "missed_gears": scores.missed(gears[scores.TOOL]),
        "baselines": scores.compared(gears, BASELINES),
        "score_rigs": scores.all_rows(others[scores.TOOL]),
        "missed_rigs": scores.missed(others[scores.TOOL]),
        "by_kind": scores.counts(rigs),
        "score_poor": scores.all_rows(flawed[scores.TOOL]),
        "missed_poor": scores.missed(flawed[scores.TOOL]),
        "by_flaw": scores.counts(poor, "by flaw"),
        **real_recordings.pieces(),
        "study_keys": _study_keys(),
        "study_columns": _study_columns(),
        **{f"{name}_columns": _columns(module, given) for name, (module, given) in RESULTS.items()},
        "factor_keys": _file_keys("mixedlub.study.factor_file", "FactorFile"),
        "factor_columns": _factor_columns(),
        "friction_laws": _friction_laws(),
        "oils": oils_and_gears.oils(),
        "oils_known": oils_and_gears.oils_known(),
        "oil_keys": _oil_keys(),
        "gear_keys": _file_keys("mixedlub.gear.analysis.file", "GearAnalysisFile"),
        "bevel_keys": _file_keys("mixedlub.skew_gears.file", "BevelFile", OF_CASES),
        "worm_keys": _file_keys("mixedlub.worm_gears.file", "WormFile", OF_CASES),
        "efficiency_keys": _file_keys("mixedlub.efficiency.file", "EfficiencyFile"),
        "part_laws": _part_laws(),
        "presets": oils_and_gears.presets(),
        "evaluations": _evaluations(),
        "law_keys": _file_keys("mixedlub.own_laws.file", "LawFile"),
        "ehl_keys": _file_keys("mixedlub.ehl.file", "EhlFile"),
        "ehl_oil_keys": _file_keys("mixedlub.ehl.oil.file", "OilFile"),
        "api": _api(),
        "quantities": _quantities(),
        "rooms": _rooms(),
        "ranges": _ranges(),
        "thresholds": thresholds.tables(),
        "forms": form_tables.tables(),
        "one_law": one_law.pairs(),
    }


def _laws() -> Iterator[tuple[str, str]]:
    import mixedlub.laws

    inside = sorted(m.name for m in pkgutil.iter_modules(mixedlub.laws.__path__))
    for name in (*(f"mixedlub.laws.{m}" for m in inside), *LAW_MODULES):
        last = name.rpartition(".")[2]
        title = TITLES.get(last, last.replace("_", " ").capitalize())
        yield f"laws/{last}", f"# {title}\n\n```{{eval-rst}}\n.. automodule:: {name}\n   :members:\n```\n"


def _page_of(law: Law, heading: str, page: str) -> list[str]:
    """Heading, summary and drawn equation of a law, and the rest of its printed page."""
    rest = page.partition("\n\n")[2]
    equation = f"```{{math}}\n{law.equation}\n```"
    return [heading, law.summary, equation, f"```{{code-block}} text\n:class: wide\n{rest}\n```"]


def _effects() -> Iterator[tuple[str, str]]:
    from mixedlub.chain.effect import STAGES
    from mixedlub.effects import catalogue
    from mixedlub.report.effect_pages import effects_text

    for stage in STAGES:
        parts = [f"# Stage: {stage}"]
        for e in catalogue().values():
            if e.stage == stage:
                parts += _page_of(e, f"## {e.id}", effects_text(e.id))
        if len(parts) > 1:
            yield f"effects/{stage}", "\n\n".join(parts) + "\n"


def _commands() -> Iterator[tuple[str, str]]:
    from mixedlub.cli import COMMANDS

    for command in COMMANDS:
        text = _printed(command.NAME, "--help")
        yield f"commands/{command.NAME}", f"# mixedlub {command.NAME}\n\n```text\n{text}\n```\n"


def _kinds() -> Iterator[tuple[str, str]]:
    """A page for each kind of case: its columns, and the keys that it takes."""
    from mixedlub.kinds import KINDS, kind
    from mixedlub.report.file_classes import EVERY_CASE
    from mixedlub.report.format_reference import common_rows, kind_rows
    from mixedlub.schema.section import tables
    from mixedlub.schema.system_file import System

    for name in KINDS:
        k = kind(name)
        taken = {*EVERY_CASE, *k.sections, *k.uses}
        parts = [
            f"# {name}",
            f"{k.about.rstrip('.')}. Base model: {k.base_model}",
            "## Columns",
            md.named_table(COLUMN_HEAD, kind_rows(k)),
        ]
        parts += ["Columns of every kind:", md.named_table(COLUMN_HEAD, common_rows()), "## Keys of system.toml"]
        for table in tables(System):
            if table.name.split(".")[0] in taken:
                use = " Optional for this kind." if table.name.split(".")[0] in k.uses else ""
                parts += md.keys(table, use)
        yield f"kinds/{name}", "\n\n".join(parts) + "\n"


def _friction_laws() -> str:
    """Every friction law: its equation drawn, and its page."""
    from mixedlub.chain.friction_law import PLACES
    from mixedlub.friction import catalogue

    parts = []
    for place, words in PLACES.items():
        parts.append(f"## {words[:1].upper()}{words[1:]}")
        for law in (one for one in catalogue().values() if one.place == place):
            parts += _page_of(law, f"### {law.name}", law.page())
    return "\n\n".join(parts)


def _part_laws() -> str:
    """Every law of a machine part: its equation drawn, and its page."""
    from mixedlub.chain.part_law import GIVES
    from mixedlub.parts import of_kind
    from mixedlub.report.part_pages import page

    parts = []
    for kind, gives in GIVES.items():
        parts.append(f"## {kind[:1].upper()}{kind[1:]}: {gives}")
        for law in of_kind(kind).values():
            parts += _page_of(law, f"### {law.name}", page(law))
    return "\n\n".join(parts)


def _oil_keys() -> str:
    """The keys of the file of an oil."""
    from mixedlub.schema.oil_file import OilFile

    return md.key_tables(OilFile)


def _study_keys() -> str:
    from mixedlub.study.schema import StudyFile

    return md.key_tables(StudyFile)


def _columns(module: str, given: str) -> str:
    """The columns of the tables of a command."""
    from importlib import import_module

    return md.columns({f"{name}.csv": columns for name, columns in getattr(import_module(module), given).items()})


def _study_columns() -> str:
    """The columns of every table of a study."""
    from mixedlub.study.columns import every_column
    from mixedlub.study.curves import curve_columns
    from mixedlub.study.fits import fit_columns
    from mixedlub.study.rank import COMPARISONS, RANKING

    return md.columns(
        {
            "results.csv, results.parquet": every_column(["EFFECT"], bands=False),
            "fits.csv": fit_columns(),
            "ranking.csv": RANKING,
            "comparisons.csv": COMPARISONS,
            "curves.parquet, curves.csv": curve_columns(),
        }
    )


def _factor_columns() -> str:
    """The columns of the tables of an experiment but those of a study."""
    from mixedlub.study.factor_tables import OF_INDICES, OF_INTERACTIONS, OF_MAIN_EFFECTS

    return md.columns(
        {"indices.csv": OF_INDICES, "interactions.csv": OF_INTERACTIONS, "main_effects.csv": OF_MAIN_EFFECTS}
    )


def _file_keys(module: str, name: str, elsewhere: re.Pattern[str] = ELSEWHERE) -> str:
    """The tables of a file but those of gears, oil, surfaces and options, which are with the cases and studies."""
    from importlib import import_module

    from mixedlub.schema.section import tables

    file = getattr(import_module(module), name)
    return "\n\n".join(part for table in tables(file) if not elsewhere.search(table.title) for part in md.keys(table))


def _evaluations() -> str:
    """Every method of `mixedlub evaluate`: its source, the columns of its tables and the keys of its file."""
    from mixedlub.evaluate import EVALUATIONS
    from mixedlub.report.format_reference import column_rows
    from mixedlub.schema.section import tables

    parts = []
    for one in EVALUATIONS.values():
        parts += [f"## {one.name}", f"{one.about[:1].upper()}{one.about[1:]}. Source: {one.source}."]
        for title, columns in one.columns.items():
            parts += [f"Columns of {title}:", md.named_table(COLUMN_HEAD, column_rows(columns))]
        elsewhere = ("gears", "lubricant", "surfaces", "contact")
        parts += [
            part for table in tables(one.file) if table.name.split(".")[0] not in elsewhere for part in md.keys(table)
        ]
        parts.append(md.columns({f"{name}.csv": columns for name, columns in one.results.items()}))
    return "\n\n".join(parts)


def _api() -> str:
    """Every public name of the package, and the public names of its rooms that have no page of their own."""
    import mixedlub

    parts = [_documented(f"mixedlub.{name}", getattr(mixedlub, name)) for name in mixedlub.PUBLIC]
    found = [f"```{{eval-rst}}\n{chr(10).join(parts)}\n```"]
    for name in (*(f"mixedlub.{room}" for room in mixedlub.ROOMS if room not in WITH_PAGES), *mixedlub.BESIDE):
        found.append(f"## {name}\n\n```{{eval-rst}}\n.. automodule:: {name}\n   :members:\n```")
    return "\n\n".join(found)


def _documented(name: str, what: object) -> str:
    """The directive that documents a function, or a class with its public members.

    >>> _documented("builtins.len", len), _documented("builtins.UserWarning", UserWarning)
    ('.. autofunction:: builtins.len', '.. autoexception:: builtins.UserWarning')
    >>> _documented("pathlib.Path", Path)
    '.. autoclass:: pathlib.Path\\n   :members:'
    """
    if not isinstance(what, type):
        return f".. autofunction:: {name}"
    if issubclass(what, Exception):
        return f".. autoexception:: {name}"
    return f".. autoclass:: {name}\n   :members:"


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
    rows = []
    for room in rooms:
        folder = ROOT / "mixedlub" / room
        path = folder / "__init__.py" if folder.is_dir() else folder.with_suffix(".py")
        about = (ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or "").partition("\n")[0]
        if not room.startswith("__"):
            rows.append((f"mixedlub/{room}", about))
    return md.named_table(("room", "holds"), rows)


def _quantities() -> str:
    """Symbols and quantities of the laws, by name."""
    from mixedlub.chain.plain_text import plain_symbol
    from mixedlub.chain.quantities import GLOSSARY

    rows = [(name, plain_symbol(one.symbol), one.unit, one.meaning) for name, one in sorted(GLOSSARY.items())]
    return md.named_table(("quantity", "symbol", "unit", "meaning"), rows)


def _ranges() -> str:
    """Allowed and typical ranges of every number, from the table that holds them."""
    source = (ROOT / "mixedlub/schema/ranges.toml").read_text(encoding="utf-8")
    rows = []

    def walk(place: str, table: dict[str, Any]) -> None:
        for key, value in ((k, v) for k, v in table.items() if isinstance(v, dict)):
            name = f"{place}.{key}".lstrip(".")
            limits = [v for v in value.values() if isinstance(v, list) and len(v) == 2]
            if limits:
                rows.append((name, *(f"{low:g} to {high:g}" for low, high in limits)))
            else:
                walk(name, value)

    walk("", tomllib.loads(source))
    notes = [line.lstrip("# ") for line in source.partition("\n\n")[0].splitlines() if line.startswith("#")]
    return md.named_table(("key", "allowed", "typical"), rows) + "\n\n" + "\n".join(notes)


def _write(app: Sphinx) -> None:
    for folder, found in (("reference/made", pages()), ("made", pieces())):
        for name, text in found.items():
            path = Path(app.srcdir) / folder / f"{name}.md"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text + ("" if text.endswith("\n") else "\n"), encoding="utf-8")


def setup(app: Sphinx) -> dict[str, Any]:
    app.connect("builder-inited", _write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
