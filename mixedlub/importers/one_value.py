"""Columns with one value in all rows, from an answer."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mixedlub.importers.answer_keys import COLUMNS, VALUES
from mixedlub.importers.base import Answers
from mixedlub.kinds import Kind
from mixedlub.schema.table import Column
from profiles.errors import InputError


def value_keys(kind: Kind) -> tuple[str, ...]:
    """Keys of the answers that give a column of a kind one value."""
    return tuple(VALUES + column.name for column in kind.columns)


def without_value(columns: Sequence[Column], answers: Answers) -> tuple[Column, ...]:
    """Columns that need a header, since no answer gives their value."""
    return tuple(column for column in columns if VALUES + column.name not in answers)


def constants(kind: Kind, answers: Answers, rows: int) -> dict[str, np.ndarray]:
    """Columns of a kind with one value from an answer, checked by the rules of the column."""
    columns = {}
    for column in kind.columns:
        key = VALUES + column.name
        if key in answers:
            if COLUMNS + column.name in answers:
                raise InputError("has a header too; give one of the two", where=key, value=answers[key])
            columns[column.name] = np.full(rows, column.parse(str(answers[key]), key))
    return columns
