"""Laws of the user, each a file: read as effects, taken by path, and checked against the model that they act in."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from pathlib import Path
from typing import Any, TypeVar

from mixedlub.chain.effect import Effect
from mixedlub.chain.quantities import GLOSSARY
from mixedlub.own_laws.law import FileLaw, as_hypothesis, law_of_text, read_law
from mixedlub.own_laws.usable import ABSENT, check_usable
from mixedlub.schema.past import Past
from mixedlub.schema.toml_file import named_file
from profiles.errors import InputError

Values = TypeVar("Values")
EXAMPLE = Path(__file__).with_name("example.toml")
"""A law file that runs."""
ENDING = ".toml"
"""End of a path, which tells it from the id of an effect."""


def by_id(
    section: Mapping[str, Values], folder: Path, columns: Collection[str] = (), where: str = "effects"
) -> tuple[dict[str, Values], dict[str, Effect]]:
    """A section ``[effects]`` with ids in place of the paths of law files, and these laws by id."""
    named, laws = dict(section), []
    for key in section:
        if key.endswith(ENDING):
            laws.append(read_law(named_file(folder, key, where), columns))
            named[laws[-1].id] = named.pop(key)
    return named, distinct(laws)


def distinct(laws: Iterable[Effect]) -> dict[str, Effect]:
    """Laws by id; two of one id are an error."""
    found: dict[str, Effect] = {}
    for law in laws:
        first = found.setdefault(law.id, law)
        if first is not law:
            rule = f"is the id of {path_of(first)} too; take another"
            raise InputError(rule, where=f"{path_of(law)}: id", value=law.id)
    return found


def read_laws(paths: Iterable[Path], columns: Collection[str] = ()) -> dict[str, Effect]:
    """Laws of files by id."""
    return distinct([read_law(path, columns) for path in paths])


def path_of(law: Effect) -> Path:
    """File of a law of the user."""
    assert isinstance(law.law, FileLaw)
    return law.law.path


def text_of(law: Effect) -> str:
    """Content of the file of a law of the user."""
    assert isinstance(law.law, FileLaw)
    return law.law.text


def pasts_read(laws: Iterable[Effect], columns: Collection[str]) -> list[Past]:
    """History coordinates of the columns that laws read."""
    found = [law.law.pasts(columns) for law in laws if isinstance(law.law, FileLaw)]
    return list(dict.fromkeys(past for own in found for past in own))


def columns_read(laws: Iterable[Effect], rows: Mapping[str, Any]) -> dict[str, Any]:
    """Columns of a recording that laws read as recorded, or that bound them, as inputs of the shape (rows, 1)."""
    return {
        name: rows[name][:, None]
        for law in laws
        if isinstance(law.law, FileLaw)
        for name in (*(read.argument for read in law.law.reads.values()), *law.valid.keys() - GLOSSARY.keys())
        if name in rows
    }


__all__ = [
    "ABSENT",
    "ENDING",
    "EXAMPLE",
    "FileLaw",
    "as_hypothesis",
    "by_id",
    "check_usable",
    "columns_read",
    "distinct",
    "law_of_text",
    "pasts_read",
    "path_of",
    "read_law",
    "read_laws",
    "text_of",
]
