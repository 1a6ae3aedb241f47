"""Result of a command: tables of described columns, figures, and lines for the user."""

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
"""Suffixes of columns with the uncertainty of another column."""
_ANY = re.compile(r"[A-Z]{4,}")
"""Placeholder for any text in a declared name."""


@dataclass(frozen=True)
class ResultColumn:
    """Column of a result table: output, name with unit, and meaning.

    Values are ``factor`` times the output in SI, minus ``zero``, or ``value`` of the result. Four or more capitals in a
    name stand for any text: ``ORIGIN_loss_W``.
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
        """Unit of the column, ``-`` for a dimensionless number.

        >>> ResultColumn("", "normal_force_N_sd", "").unit, ResultColumn("", "film_parameter", "").unit
        ('N', '-')
        """
        return self.given_unit or unit_of(_END.sub("", self.name)) or "-"

    def of(self, values: np.ndarray) -> np.ndarray:
        """Values of the column from the output in SI.

        >>> ResultColumn("bulk", "bulk_temperature_C", "of the teeth", zero=273.15).of(np.array([373.15])).tolist()
        [100.0]
        """
        scaled = values * self.factor
        return scaled - self.zero if self.zero else scaled

    def declares(self, name: str) -> bool:
        """Whether this declaration covers a column name.

        >>> ResultColumn("", "ORIGIN_loss_W", "").declares("seals_loss_W")
        True
        """
        return re.fullmatch(_ANY.sub(".+", self.name), name) is not None


def column(value: Callable[[Any], Any], name: str, meaning: str, unit: str = "") -> ResultColumn:
    """Column with the function for its values; None leaves the column out."""
    return ResultColumn("", name, meaning, given_unit=unit, value=value)


def described(**meanings: str) -> tuple[ResultColumn, ...]:
    """Columns with meanings by name; the prefix ``text:`` marks a column of words."""
    return tuple(
        ResultColumn("", name, meaning.removeprefix("text:").strip(), given_unit="text" if ":" in meaning[:5] else "")
        for name, meaning in meanings.items()
    )


def with_interval(name: str, meaning: str, *, own: bool = False) -> tuple[ResultColumn, ...]:
    """Columns of a value with standard deviation and 90 % interval.

    >>> [one.name for one in with_interval("mean_friction", "of the mesh")]
    ['mean_friction', 'mean_friction_sd', 'mean_friction_low90', 'mean_friction_high90']
    """
    ends = {"sd": "standard deviation", "low90": "lower end of the 90 % interval", "high90": "upper end of it"}
    ends |= {"sd_own": "part of the standard deviation by errors from reading to reading"} if own else {}
    return described(**{name: meaning, **{f"{name}_{end}": f"{words}: {name}" for end, words in ends.items()}})


def frame_of(found: Any, columns: Iterable[ResultColumn], shape: tuple[int, ...] | None = None) -> pd.DataFrame:
    """Table of a result, one column per function with values; these are broadcast to ``shape`` if given."""
    import pandas as pd

    values = {one.name: one.value(found) for one in columns if one.value is not None}
    kept = {name: value for name, value in values.items() if value is not None}
    if shape is not None:
        kept = {name: np.broadcast_to(value, shape).ravel() for name, value in kept.items()}
    return pd.DataFrame(kept)


def declared(columns: Iterable[ResultColumn], name: str) -> ResultColumn:
    """Declaration of a column; without declaration, a column with the unit in its name."""
    found = next((one for one in columns if one.declares(name)), ResultColumn("", name, ""))
    return replace(found, name=name)


@dataclass(frozen=True)
class Curve:
    """Points (``marker``) or line of a figure; ``low`` and ``high``: ends of the 90 % interval."""

    x: np.ndarray
    y: np.ndarray
    label: str = ""
    marker: bool = False
    low: np.ndarray | None = None
    high: np.ndarray | None = None
    group: int = 0
    style: str = "-"


def curve(rows: pd.DataFrame, x: str, y: str, label: str = "", **further: Any) -> Curve:
    """Curve of two columns of a table, with the 90 % interval if the table has it."""
    low, high = (rows[name].to_numpy() if (name := f"{y}_{end}90") in rows else None for end in ("low", "high"))
    return Curve(rows[x].to_numpy(), rows[y].to_numpy(), label, low=low, high=high, **further)


@dataclass(frozen=True)
class Panel:
    """Panel of a figure: axis labels with units, and curves; curves of a group share a colour."""

    across: str
    up: str
    curves: tuple[Curve, ...]
    from_zero: bool = False
    ceiling: float | None = None


Drawing = tuple[Panel, ...] | Callable[[], "Figure | None"]
"""Figure: panels, or the function that draws it."""


@dataclass(frozen=True)
class CaseDraft:
    """Contents of a case folder: tables of ``system.toml``, columns of ``recordings.csv`` and attached files."""

    system: Mapping[str, Any]
    columns: Mapping[str, np.ndarray]
    attachments: Mapping[str, bytes] = field(default_factory=dict)


@dataclass(frozen=True)
class Result:
    """Tables by file name (frames or `LongTable`), figures by name, lines for the user, and a case.

    ``files``: further files by name, such as friction laws for studies; ``columns``: descriptions of the columns by
    table.
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
        """Declared columns of a table, with units and meanings."""
        return [declared(self.columns.get(table, ()), name) for name in names]
