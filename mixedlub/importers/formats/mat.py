"""MATLAB files (.mat): vectors, matrices, structs and signals with time, read by SciPy."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from mixedlub.importers.measured import MeasuredTable, named, tables_of
from profiles.errors import InputError
from profiles.readers.base import foreign_parser

UNITS, NAMES = (
    ("units", "unit", "einheiten", "einheit"),
    ("names", "headers", "header", "labels", "columns", "channels"),
)
"""Names of variables that hold the units and the names of the columns."""
VALUES, TIMES = ("values", "data", "value"), ("time", "t", "zeit")
"""Fields of a signal with its readings and its times."""
LABELS = ("label", "name", "signalname")
VARIABLES = "variables"
"""Name of the table of variables that are vectors or matrices."""


def matches(data: bytes) -> bool:
    """Whether the bytes are a MATLAB file."""
    return data[:6] == b"MATLAB"


def tables(data: bytes, where: str) -> list[MeasuredTable]:
    """Tables of the variables, and of each struct."""
    from scipy.io import loadmat
    from scipy.io.matlab import MatReadError

    if data[124:128] in (b"\x00\x02IM", b"\x02\x00MI"):
        rule = "is a MATLAB file of version 7.3 (HDF5); save it by save(FILE, '-v7')"
        raise InputError(rule, where=where)
    with foreign_parser("MATLAB", where):
        try:
            found = loadmat(io.BytesIO(data), simplify_cells=True)
        except (MatReadError, NotImplementedError) as error:
            raise InputError(f"cannot be read ({error}); save it by save(FILE, '-v7')", where=where) from None
    variables = {name: value for name, value in found.items() if not name.startswith("__")}
    read = tables_of([*_channels(variables, VARIABLES)])
    objects = [n for n, value in variables.items() if not isinstance(value, Mapping | np.ndarray | str | float | int)]
    if not read and (objects or "None" in found):
        rule = "holds objects (a table, a timetable), which only MATLAB reads; save table2struct(T, 'ToScalar', true)"
        raise InputError(rule, where=where)
    return read


def _channels(fields: Mapping[str, Any], table: str) -> Iterator[tuple[str, str, np.ndarray]]:
    """Channels of the vectors and matrices of a struct, and of the structs and signals in it."""
    units, names = _first(fields, UNITS), _first(fields, NAMES)
    times = _first(fields, TIMES)
    for name, value in fields.items():
        if name.lower() in (*UNITS, *NAMES):
            continue
        if isinstance(value, Mapping):
            yield from _of_struct(name, value, table)
        elif _is_list_of_structs(value):
            for number, one in enumerate(value):
                yield from _of_struct(_label(one, f"{name}{number + 1}"), one, table, times)
        elif isinstance(value, np.ndarray) and value.ndim == 1:
            yield table, named(name, _of(units, name, 0)), value
        elif isinstance(value, np.ndarray) and value.ndim == 2:
            for column, numbers in enumerate(value.T):
                header = _of(names, name, column) or f"{name}_{column + 1}"
                yield table, named(header, _of(units, name, column)), numbers


def _is_list_of_structs(value: Any) -> bool:
    is_list = isinstance(value, list) or (isinstance(value, np.ndarray) and value.dtype == object and value.ndim == 1)
    return is_list and len(value) > 0 and all(isinstance(one, Mapping) for one in value)


def _of_struct(
    name: str, fields: Mapping[str, Any], table: str, times: Any = None
) -> Iterator[tuple[str, str, np.ndarray]]:
    """Channels of a signal with its values, or of a struct of channels as a separate table."""
    values = _first(fields, VALUES)
    if values is None or not isinstance(values, np.ndarray) or values.ndim != 1:
        yield from _channels(fields, name if table == VARIABLES else f"{table}.{name}")
        return
    own = _first(fields, TIMES)
    clock = own if isinstance(own, np.ndarray) else times
    place = table if clock is None or clock is times else name
    if isinstance(own, np.ndarray):
        yield place, "Time (s)", own
    yield place, named(_label(fields, name), _of(_first(fields, UNITS), name, 0)), values


def _label(fields: Mapping[str, Any], name: str) -> str:
    label = _first(fields, LABELS)
    return label if isinstance(label, str) and label else name


def _first(fields: Mapping[str, Any], words: tuple[str, ...]) -> Any:
    lowered = {name.lower(): value for name, value in fields.items()}
    return next((lowered[word] for word in words if word in lowered), None)


def _of(given: Any, name: str, column: int) -> str:
    """Unit or name of a column: by the name of its variable, by its place, or one for all."""
    if isinstance(given, Mapping):
        return str(given.get(name, ""))
    if isinstance(given, str):
        return given
    return str(given.flat[column]) if isinstance(given, np.ndarray) and column < given.size else ""
