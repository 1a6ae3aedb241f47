"""Columns that a file leaves out because all its rows have the same: told as an answer, in the unit of the column."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mixedlub.importers.draft import Answers
from mixedlub.kinds import Kind
from mixedlub.schema.table import Column
from profiles.errors import InputError

VALUES = "import.values."
"""Before the name of a column, the value that all its rows have."""


def value_keys(kind: Kind) -> tuple[str, ...]:
    """The answers that give a column of a kind one value."""
    return tuple(VALUES + column.name for column in kind.columns)


def not_told(columns: Sequence[Column], answers: Answers) -> tuple[Column, ...]:
    """The columns that a header has to be found for."""
    return tuple(column for column in columns if VALUES + column.name not in answers)


def constants(kind: Kind, answers: Answers, rows: int) -> dict[str, np.ndarray]:
    """The columns of a kind that are told as one value, each checked by the rules of its column."""
    found = {}
    for column in kind.columns:
        key = VALUES + column.name
        if key in answers:
            if f"import.columns.{column.name}" in answers:
                raise InputError("has a header too; say one of the two", where=key, value=answers[key])
            found[column.name] = np.full(rows, column.parse(str(answers[key]), key))
    return found


def in_words(column: str) -> str:
    """How to tell a column that is the same in all rows."""
    return f"; or {VALUES}{column}=... if all rows have the same"


def has_header(header: str, column: str) -> bool:
    """Whether a header is the name of a column, with blanks or hyphens for its underscores.

    >>> has_header("Pinion surface", "pinion_surface"), has_header("pinion", "pinion_surface")
    (True, False)
    """
    return header.strip().lower().replace(" ", "_").replace("-", "_") == column.lower()
