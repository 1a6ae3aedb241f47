"""The result of a command: tables of described columns, figures, and lines for the user."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.schema.units import unit_of

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

_END = re.compile(r"_(sd|low90|high90)(_own)?$")
"""Ends of the names of columns that say how sure another column is."""
_ANY = re.compile(r"[A-Z]{4,}")
"""Part of a declared name that stands for any text."""


@dataclass(frozen=True)
class ResultColumn:
    """A column of a table: the output it is of, its name with unit, and its meaning.

    Its values are ``factor`` times the output in SI, less ``zero``, or ``value`` of what was found. Four capitals or
    more in a name stand for any text: ``ORIGIN_loss_W``.
    """

    output: str
    name: str
    meaning: str
    factor: float = 1.0
    zero: float = 0.0
    given_unit: str = ""
    value: Callable[[Any], Any] | None = None

    @property
    def unit(self) -> str:
        """Its unit, ``-`` for a number without one.

        >>> ResultColumn("", "normal_force_N_sd", "").unit, ResultColumn("", "film_parameter", "").unit
        ('N', '-')
        """
        return self.given_unit or unit_of(_END.sub("", self.name)) or "-"

    def of(self, values: np.ndarray) -> np.ndarray:
        """The values of the column from those of the output in SI.

        >>> ResultColumn("bulk", "bulk_temperature_C", "of the teeth", zero=273.15).of(np.array([373.15])).tolist()
        [100.0]
        """
        scaled = values * self.factor
        return scaled - self.zero if self.zero else scaled

    def declares(self, name: str) -> bool:
        """Whether a column of a table is this one.

        >>> ResultColumn("", "ORIGIN_loss_W", "").declares("seals_loss_W")
        True
        """
        return re.fullmatch(_ANY.sub(".+", self.name), name) is not None


def column(value: Callable[[Any], Any], name: str, meaning: str, unit: str = "") -> ResultColumn:
    """A column with the function that gives its values, None where the table has no such column."""
    return ResultColumn("", name, meaning, given_unit=unit, value=value)


def described(**meanings: str) -> tuple[ResultColumn, ...]:
    """Columns by name with their meanings; a meaning that begins with ``text:`` is of a column of words."""
    return tuple(
        ResultColumn("", name, meaning.removeprefix("text:").strip(), given_unit="text" if ":" in meaning[:5] else "")
        for name, meaning in meanings.items()
    )


def with_interval(name: str, meaning: str, *, own: bool = False) -> tuple[ResultColumn, ...]:
    """Columns of a value with its standard deviation and 90 % interval.

    >>> [one.name for one in with_interval("mean_friction", "of the mesh")]
    ['mean_friction', 'mean_friction_sd', 'mean_friction_low90', 'mean_friction_high90']
    """
    ends = {"sd": "standard deviation", "low90": "lower end of the 90 % interval", "high90": "upper end of it"}
    ends |= {"sd_own": "part of the standard deviation by errors from reading to reading"} if own else {}
    return described(**{name: meaning, **{f"{name}_{end}": f"{words}: {name}" for end, words in ends.items()}})


def frame_of(found: Any, columns: Iterable[ResultColumn], shape: tuple[int, ...] | None = None) -> pd.DataFrame:
    """The table of what was found, a column each that has values; those are spread over a ``shape`` if it is given."""
    import pandas as pd

    values = {one.name: one.value(found) for one in columns if one.value is not None}
    kept = {name: value for name, value in values.items() if value is not None}
    if shape is not None:
        kept = {name: np.broadcast_to(value, shape).ravel() for name, value in kept.items()}
    return pd.DataFrame(kept)


def declared(columns: Iterable[ResultColumn], name: str) -> ResultColumn:
    """The declaration of a column of a table; of one that has none, its name with the unit in it."""
    found = next((one for one in columns if one.declares(name)), ResultColumn("", name, ""))
    return replace(found, name=name)


@dataclass(frozen=True)
class Curve:
    """Readings (``marker``) or a line of a figure; ``low`` and ``high`` are the ends of its 90 % interval."""

    x: np.ndarray
    y: np.ndarray
    label: str = ""
    marker: bool = False
    low: np.ndarray | None = None
    high: np.ndarray | None = None
    group: int = 0
    style: str = "-"


def curve(rows: pd.DataFrame, x: str, y: str, label: str = "", **further: Any) -> Curve:
    """A curve of two columns of a table, with the 90 % interval where the table has it."""
    low, high = (rows[name].to_numpy() if (name := f"{y}_{end}90") in rows else None for end in ("low", "high"))
    return Curve(rows[x].to_numpy(), rows[y].to_numpy(), label, low=low, high=high, **further)


@dataclass(frozen=True)
class Panel:
    """One panel of a figure: the words of its axes with units, and its curves; those of one group share a colour."""

    across: str
    up: str
    curves: tuple[Curve, ...]
    from_zero: bool = False
    ceiling: float | None = None


Drawing = tuple[Panel, ...] | Callable[[], "Figure | None"]
"""A figure: its panels, or the function that draws it."""


@dataclass(frozen=True)
class CaseDraft:
    """A case folder to be written: tables of ``system.toml``, columns of ``recordings.csv``, files that it names."""

    system: Mapping[str, Any]
    columns: Mapping[str, np.ndarray]
    attachments: Mapping[str, bytes] = field(default_factory=dict)


@dataclass(frozen=True)
class Result:
    """Tables by the name of their file (frames or `LongTable`), figures by theirs, lines for the user, and a case.

    ``files`` are further files by name, as friction laws for studies; ``columns`` describes the columns by table.
    """

    title: str
    tables: Mapping[str, Any]
    figures: Mapping[str, Drawing]
    lines: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    case: CaseDraft | None = None
    files: Mapping[str, str | bytes] = field(default_factory=dict)
    columns: Mapping[str, Sequence[ResultColumn]] = field(default_factory=dict)
    captions: Mapping[str, str] = field(default_factory=dict)

    def described(self, table: str, names: Collection[str]) -> list[ResultColumn]:
        """The columns of a table with their units and meanings."""
        return [declared(self.columns.get(table, ()), name) for name in names]
