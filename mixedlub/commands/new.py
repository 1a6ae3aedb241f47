"""`mixedlub new`: templates of a study, factors, a case, contacts, gears, a gearbox, a law or an evaluation."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Collection, Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mixedlub.commands.console import echo, named_folder, output_folder
from mixedlub.running.atomic import writing
from profiles.errors import InputError, nearest

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable

    from mixedlub.schema.section import FileTable, Section

NAME = "new"
EXAMPLE = "mixedlub new study --out out/my_study"

STUDY, FACTORS, CASE, EHL, GEAR, EFFICIENCY = "study", "factors", "case", "ehl", "gear", "efficiency"
BEVEL, WORM = "bevel", "worm"
FRICTION_LAWS, TABLE, LAW = "friction-laws", "table", "law"
TEMPLATES = (STUDY, FACTORS, CASE, TABLE, EHL, GEAR, BEVEL, WORM, EFFICIENCY, FRICTION_LAWS, LAW)
KIND = "gear_pair"
"""Default kind of a case."""
ROWS = 40
"""Number of readings of a template: enough for `mixedlub diagnose`, few enough to read."""
NOISE = 0.01
"""Relative standard deviation of the synthetic readings, as on the reference rigs of the catalogue."""
SURFACES = ("ground", "superfinished")
"""Surfaces of the reference rig in a template."""

ELASTIC = {"model": "ldp", "tip_relief_um": [15, 15], "relief_length_mm": [2, 2], "lead_crown_um": 3}
"""Load sharing of the template of gears."""

Given = Mapping[str, Any]
"""Values by key; tables within tables."""


def command(
    what: Annotated[
        str,
        typer.Argument(
            metavar="WHAT",
            help="study, factors, case, table (a case with your own simulation), ehl, gear, bevel, worm, efficiency, "
            "friction-laws, law, or a method of `mixedlub evaluate`.",
        ),
    ],
    kind: Annotated[
        str | None, typer.Option(metavar="KIND", help=f"Kind of case; default {KIND}. `mixedlub kinds` lists them.")
    ] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", parser=named_folder, help="Folder to make; default out/new/WHAT.")
    ] = None,
) -> None:
    """A study, factors, a case, line contacts (ehl), gears, a gearbox (efficiency), a law, an evaluation to start from.

    A template with the values of an example rig: optional keys are comments with their meaning. It runs unchanged; the
    readings of a case are synthetic, from the base model.
    """
    if what not in TEMPLATES:
        from mixedlub.evaluate import EVALUATIONS

        if what not in EVALUATIONS:
            known = (*TEMPLATES, *EVALUATIONS)
            raise InputError(f"no such template; {nearest(what, known)}", where="what", value=what)
    if what != CASE and kind is not None:
        raise InputError("only a case has a kind", where="--kind", value=kind)
    named = what
    if what == TABLE:
        what, kind = CASE, TABLE
    files = template_files(what, kind or KIND)
    for name in files:
        if out is not None and (out / name).exists():
            raise InputError("exists, and a template would replace it; name another --out", where=str(out / name))
    folder = output_folder(out, NAME, named)
    with writing(folder) as aside:
        for name, text in files.items():
            (aside / name).write_text(text, encoding="utf-8")
    place, commands = {
        EHL: (folder / "contacts.toml", (what,)),
        FRICTION_LAWS: (
            folder / "study.toml",
            (f"friction-laws --coefficients {folder / 'coefficients.toml'} --study",),
        ),
        LAW: (folder / "law.toml", ("effects",)),
        CASE: (folder, ("check", "diagnose")),
    }.get(what, (folder / f"{what}.toml", (what if what in TEMPLATES else f"evaluate {what}",)))
    echo(f"{' and '.join(files)} in {folder}, with the numbers of an example: put your own in their place, then")
    for name in commands:
        echo(f"  mixedlub {name} {place}")


def template_files(what: str, kind: str = KIND) -> dict[str, str]:
    """Texts of a template by the names of their files."""
    makers: dict[str, Callable[[], dict[str, str]]] = {
        STUDY: study_files,
        FACTORS: factor_files,
        EHL: ehl_files,
        GEAR: gear_files,
        FRICTION_LAWS: friction_law_files,
        CASE: partial(case_files, kind),
        **{name: partial(example_files, name) for name in (LAW, BEVEL, WORM, EFFICIENCY)},
    }
    return makers.get(what, partial(evaluation_files, what))()


def study_files() -> dict[str, str]:
    """A study of two surfaces, one by its moments and one by a shipped trace."""
    from mixedlub.schema.section import examples
    from mixedlub.study.schema import Conditions, StudyFile

    rig = _reference("gear_pair")
    first, second = SURFACES
    given = {
        "schema": "mixedlub-study/1",
        "title": "Power loss of two surfaces",
        "boundary_friction": 0.1,
        **{section: rig[section] for section in ("gears", "lubricant")},
        "surfaces": {
            first: rig["surfaces"][first],
            second: {"profile": "shipped:0036", "cutoff_mm": 0.8, "short_cutoff_um": 2.5},
        },
        "pairings": {"every": list(SURFACES)},
        "conditions": examples(Conditions),
    }
    return {"study.toml": "\n".join(_lines(StudyFile, given, tuple(StudyFile.model_fields))) + "\n"}


def factor_files() -> dict[str, str]:
    """A file of factors and the study that it varies."""
    from mixedlub.schema.section import examples
    from mixedlub.study.factor_file import FactorFile, Factors

    given = {
        "schema": "mixedlub-factors/1",
        "title": "What decides the loss",
        "study": "study.toml",
        "factors": examples(Factors),
    }
    text = "\n".join(_lines(FactorFile, given, tuple(FactorFile.model_fields))) + "\n"
    return {"factors.toml": text, **study_files()}


def ehl_files() -> dict[str, str]:
    """A file of contacts and the file of their oil."""
    from mixedlub.ehl import EXAMPLE as OIL
    from mixedlub.ehl.file import EhlFile, examples_of_contacts

    given = {"schema": "mixedlub-ehl/1", "title": "Twin discs", "oil": "oil.toml", "contacts": examples_of_contacts()}
    text = "\n".join(_lines(EhlFile, given, ("", "bodies", "contacts"))) + "\n"
    return {"contacts.toml": text, "oil.toml": OIL.read_text(encoding="utf-8")}


def gear_files() -> dict[str, str]:
    """A file of gears, with a relieved pair of elastic teeth."""
    from mixedlub.gear.analysis.file import GearAnalysisFile, Load
    from mixedlub.schema.section import examples

    given = {
        "schema": "mixedlub-gear/1",
        "title": "Gears of the example",
        "gears": _reference("gear_pair")["gears"] | {"load_sharing": ELASTIC},
        "load": examples(Load),
    }
    return {"gear.toml": "\n".join(_lines(GearAnalysisFile, given, ("", "gears", "load", "mesh", "iso_6336"))) + "\n"}


def evaluation_files(name: str) -> dict[str, str]:
    """File of an evaluation and its tables."""
    from mixedlub.evaluate import EVALUATIONS
    from mixedlub.schema.section import tables

    one = EVALUATIONS[name]
    wanted = {table.name.split(".")[0] for table in tables(one.file)} - {"surfaces"} | {"", *one.example}
    text = "\n".join(_lines(one.file, one.example, wanted)) + "\n"
    recorded = {path.name: path.read_text(encoding="utf-8") for path in sorted(one.folder.glob("*.csv"))}
    return {f"{name}.toml": text, **recorded}


def example_files(what: str) -> dict[str, str]:
    """Example files of a law, a hypoid pair, a worm drive, or gearboxes of two stages and of two planetary stages."""
    from mixedlub import efficiency, own_laws, skew_gears, worm_gears

    files: dict[str, dict[str, Traversable]] = {
        LAW: {"law.toml": own_laws.EXAMPLE},
        BEVEL: {"bevel.toml": skew_gears.EXAMPLE},
        WORM: {"worm.toml": worm_gears.EXAMPLE},
        EFFICIENCY: {"efficiency.toml": efficiency.EXAMPLE, "planetary.toml": efficiency.PLANETARY_EXAMPLE},
    }
    return {name: example.read_text(encoding="utf-8") for name, example in files[what].items()}


def friction_law_files() -> dict[str, str]:
    """A study for the comparison of friction laws, with the user's coefficients as comments."""
    from mixedlub.chain.documented import described
    from mixedlub.friction import catalogue

    lines = [
        "# Coefficients of friction laws, a table a law; a law that lacks one is left out of the comparison.",
        '# condensed = "FILE.toml"  # which `mixedlub condense` or `mixedlub evaluate` wrote',
    ]
    for law in catalogue().values():
        if any(c.default is None for c in law.coefficients) and not law.of_oil:
            lines += ["", f"# [{law.name}]"]
            lines += [
                f"# {c.name} = {'NUMBER' if c.default is None else c.default}  # {described(c)}"
                for c in law.coefficients
            ]
    return {**study_files(), "coefficients.toml": "\n".join(lines) + "\n"}


def case_files(kind: str) -> dict[str, str]:
    """System and recordings of a case: the reference rig of a kind, with readings of the base model."""
    from mixedlub.kinds import kind as kind_of
    from mixedlub.schema.system_file import System

    found = kind_of(kind, "--kind")
    tables = ("uncertainty", "recording", *found.sections, *found.uses)
    return {
        "system.toml": "\n".join(_lines(System, _reference(kind), tables)) + "\n",
        "recordings.csv": _recordings(kind),
    }


def _reference(kind: str) -> dict[str, Any]:
    """Tables of `system.toml` for the reference rig of a kind, with up to two of its surfaces."""
    from mixedlub.case import reference_rigs

    given = reference_rigs.case(kind).system.model_dump(by_alias=True, exclude_unset=True)
    return given | {"surfaces": {name: given["surfaces"][name] for name in SURFACES if name in given["surfaces"]}}


def _recordings(kind: str) -> str:
    """Readings of the base model with noise at some conditions of the reference rig; a history at a single one."""
    import numpy as np

    from mixedlub.case import reference_rigs
    from mixedlub.case.forward import Forward

    case, random = reference_rigs.case(kind), np.random.default_rng(0)
    levels = {name: values for name, (_, values) in reference_rigs.conditions(kind).items()}
    levels |= {"surfaces": SURFACES} if "surfaces" in levels else {}
    if "sequence" in levels:
        levels = {name: values if name == "sequence" else values[:1] for name, values in levels.items()}
    table = reference_rigs.table(kind, **levels)
    table = table.take(np.sort(random.permutation(len(table))[:ROWS]))
    reading = Forward(case, table).predict() * (1.0 + NOISE * random.standard_normal(len(table)))
    names = [c.name for c in (*case.kind.columns, *case.kind.instrument_channels) if c.name in table]
    columns = {"run": np.arange(1, len(table) + 1), **{name: table[name] for name in names}, case.quantity: reading}
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    rows = zip(*columns.values(), strict=True)
    writer.writerows([f"{v:.6g}" if isinstance(v, float) else v for v in row] for row in rows)
    return text.getvalue()


def _lines(file: type[Section], given: Given, wanted: Collection[str]) -> Iterator[str]:
    """Tables of a file: given keys with values, others as comments with an example."""
    from mixedlub.schema.section import tables
    from mixedlub.schema.toml_file import toml_key

    for table in tables(file):
        if not table.title:
            yield from _keys(table, given)
        elif table.name in wanted:
            here = given.get(table.name)
            yield ""
            if table.title != table.name:
                for number, (name, values) in enumerate((here or {}).items()):
                    yield from ([""] if number else [])
                    yield from _table(f"{table.name}.{toml_key(name)}", table, values, optional=number == 0)
            else:
                yield from _table(table.name, table, here)


def _table(title: str, table: FileTable, given: Given | None, *, optional: bool = True) -> Iterator[str]:
    yield f"{'# ' if given is None else ''}[{title}]" + (f"  # {table.meaning}" if optional else "")
    yield from _keys(table, given or {}, optional=optional)


def _keys(table: FileTable, given: Given, *, optional: bool = True) -> Iterator[str]:
    """The keys of a table, given ones first; nested tables as inline tables."""
    from mixedlub.schema.section import section_in
    from mixedlub.schema.toml_file import default_of, toml_value

    keys = [key for key in table.fields if section_in(key.type) is None or isinstance(key.example, Mapping)]
    own = {key.name for key in keys}
    if table.name == "uncertainty":
        yield from (f"{name} = {toml_value(value)}" for name, value in given.items() if name not in own)
    for key in sorted(keys, key=lambda key: key.name not in given):
        left_out = f"; {default_of(key)} where left out" if default_of(key) else ""
        if key.name in given:
            yield f"{key.name} = {toml_value(given[key.name])}  # {key.words}"
        elif optional:
            yield f"# {key.name} = {toml_value(key.example)}  # {key.words}{left_out}"
        if optional:
            yield from (f"#   {toml_value(value)}: {meaning}" for value, meaning in key.values.items())
