"""Description of a kind of recording."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mixedlub.chain.model import Chain
from mixedlub.kinds.calibration import Calibration
from mixedlub.kinds.standard import StandardRig
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.rig.rig import Rig
from mixedlub.schema import system_file
from mixedlub.schema.table import BOOKKEEPING, Column, Table

Inputs = dict[str, Any]
CONSTANT_WITHIN = 0.02
"""Judgement. Largest span of a constant condition, as a share of its size in absolute units.

Controllers hold load and speed within 1 % and oil temperature within 3 K; at 2 % a temperature may span 6 K.
"""
MIXED_FRICTION = (
    "Roelands viscosity at the largest Hertz pressure, Ree-Eyring shear, Greenwood-Williamson area ratio of McCool "
    "asperities, friction of film and asperities weighted by that ratio (Tallian)"
)
"""The laws that the base models of friction share, from the film to the friction coefficient."""
SUBJECTS = ("gears", "contact", "drive", "oil", "simulation")
"""Subjects of recordings, in the order in which kinds are listed."""


@dataclass(frozen=True)
class Kind:
    """A kind of recording: its columns, the sections of the system it needs, the chain that predicts readings.

    ``subject``: test object, one of SUBJECTS. ``readings``: columns, exactly one of which is in a recording. ``scale``:
    factor from SI to their unit. ``uses``: optional sections. ``unread_of_oil``: keys of the oil without influence.
    ``standard``: rig for the comparison of effects in the catalogue. ``base_model``: laws of the chain as text.

    ``inputs(system, rig, table, recorded)``: inputs of the chain as arrays of shape (rows, points), of length one on
    axes without dependence; the chain ends in ``reading``, shape (rows, 1), in SI. ``recorded`` is the recording of the
    case, which sets typical sizes (the largest speed, the duration), also for other predictions; ``extra_calibration``
    uses it to scale the priors of unknown inputs. ``instrument_fault(recorded, row, excess, sd)``: description of the
    fault that explains a residual ``excess`` of reading ``row`` with noise ``sd`` (unit of the column). ``logarithmic``
    kinds span decades and are compared by the logarithm of the reading. ``part_rigs``: names in the column ``rig`` of
    readings that are compared with a part of the base model. ``instrument_channels``: other outputs of the instrument,
    read as columns, but not test conditions. ``fill_channels(table, recorded)`` adds them, predicted, to rows without a
    recording. ``base_inputs``: quantities of the base model before calibration, and their names in effects.
    ``column_limits(system)``: lowest and highest values of columns on this rig. ``direction(table)``: signed speed of
    each row, for kinds with readings that change sign with it. ``by_case(system, headers)``: the kind of a case, where
    the columns depend on it. ``effects_of``: name of the kind whose effects apply, if not its own.
    ``signed``: readings of either sign. ``units``: units of columns without a unit in their name.
    ``filled``: channels that follow from the conditions, which ``fill_channels`` predicts at others.
    ``shown``: columns in the reference of the format, where they depend on the case.
    ``check(system, table, recorded)``: raises an error for values that only the kind can judge.

    For imports and figures: ``either``: alternative columns. Histories (``is_history``) are plotted over time; logged
    series (``is_logged``) may be thinned. ``asks_for_oil``: the import requests the properties of the oil.
    """

    name: str
    subject: str
    readings: tuple[Column, ...]
    columns: tuple[Column, ...]
    sections: tuple[str, ...]
    base_model: str
    chain: Callable[[system_file.System, Table], Chain]
    inputs: Callable[[system_file.System, Rig, Table, Table], Inputs]
    standard: StandardRig
    extra_calibration: Callable[[system_file.System, Table], tuple[Calibration, ...]] = lambda system, recorded: ()
    instrument_fault: Callable[[Table, int, float, float], str | None] = lambda recorded, row, excess, sd: None
    logarithmic: bool = False
    part_rigs: tuple[str, ...] = ()
    instrument_channels: tuple[Column, ...] = ()
    fill_channels: Callable[[Table, Table], Table] = lambda table, recorded: table
    column_limits: Callable[[system_file.System], Mapping[str, tuple[float, float]]] = lambda system: {}
    base_inputs: Mapping[str, str] = field(default_factory=dict)
    uses: tuple[str, ...] = ()
    unread_of_oil: tuple[str, ...] = ()
    scale: float = 1.0
    direction: Callable[[Table], np.ndarray] | None = None
    either: tuple[str, ...] = ()
    is_history: bool = False
    is_logged: bool = False
    asks_for_oil: bool = False
    by_case: Callable[[system_file.System, Sequence[str]], Kind] | None = None
    effects_of: str = ""
    signed: bool = False
    units: Mapping[str, str] = field(default_factory=dict)
    shown: tuple[Column, ...] = ()
    filled: tuple[str, ...] = ()
    check: Callable[[system_file.System, Table, Table | None], None] = lambda system, table, recorded: None

    def __post_init__(self) -> None:
        if self.subject not in SUBJECTS:
            raise TypeError(f"kind {self.name}: subject {self.subject!r} is none of {SUBJECTS}")

    def of_case(self, system: system_file.System, headers: Iterable[str]) -> Kind:
        """The kind with the columns of a case, whose table has these headers."""
        return self if self.by_case is None else self.by_case(system, tuple(headers))

    def with_condition(self, table: Table, name: str, values: np.ndarray) -> Table:
        """The rows at other values of a condition, without the channels that follow from it."""
        kept = {column: cells for column, cells in table.columns.items() if column not in self.filled}
        return Table({**kept, name: values}, table.source)

    @property
    def numbers(self) -> tuple[str, ...]:
        """Columns of conditions that are numbers."""
        return tuple(c.name for c in (*BOOKKEEPING, *self.columns) if c.dtype == "number")

    @property
    def effect_kind(self) -> str:
        """Name of the kind by which effects are chosen."""
        return self.effects_of or self.name

    @property
    def rank(self) -> tuple[int, str]:
        """Position of the kind in lists."""
        return SUBJECTS.index(self.subject), self.name

    @property
    def about(self) -> str:
        """Recorded quantity: first line of the docstring of the kind's module."""
        return (inspect.getdoc(inspect.getmodule(self.inputs)) or self.name).split("\n")[0]

    @property
    def quantities(self) -> tuple[str, ...]:
        """Names of the possible reading columns."""
        return tuple(column.name for column in self.readings)

    def is_unsigned(self, quantity: str) -> bool:
        """Whether readings are positive apart from noise; readings that depend on direction are signed."""
        return quantity in self.quantities and self.direction is None and not (self.logarithmic or self.signed)


TEN_KELVIN = 10.0
"""Judgement. Warming (K) that doubles the rate of a reaction: the usual rule of thumb."""

NO_GEARS = "no_gears"
"""Name in the column ``rig`` of readings taken without gears."""


LOADS_DIFFER = 1.2
"""Judgement. Load ratio above which a force offset is distinguishable from a friction offset."""
ZERO_LOAD = 1e-3
"""Judgement. Share of the smallest recorded load below which a load is treated as zero."""


def inverse_load(system: system_file.System, table: Table, recorded: Table) -> Inputs:
    """Smallest recorded load over the load of each row, for friction coefficients recorded at different loads."""
    if system.recording.quantity != "friction_coefficient" or "load_N" not in table or "load_N" not in recorded:
        return {}
    return inverse_of(np.abs(table["load_N"]), np.abs(recorded["load_N"]))


def inverse_of(load: np.ndarray, recorded: np.ndarray) -> Inputs:
    """Smallest recorded load over the load of each row, if loads differ enough to separate a force from a share.

    >>> inverse_of(np.array([10.0, 20.0]), np.array([10.0, 40.0]))["inverse_load"][:, 0].tolist()
    [1.0, 0.5]
    >>> inverse_of(np.array([10.0]), np.array([10.0, 11.0]))
    {}
    """
    least, largest = float(np.min(recorded)), float(np.max(recorded))
    if least == 0.0 or largest < LOADS_DIFFER * least:
        return {}
    return {"inverse_load": column(least / np.maximum(load, ZERO_LOAD * least))}


def gears_out(table: Table) -> np.ndarray:
    """Mask of rows recorded without gears."""
    return table["rig"] == NO_GEARS if "rig" in table else np.zeros(len(table), dtype=bool)


def varies(values: np.ndarray) -> bool:
    """Whether a condition, in absolute units, was varied; the only definition of this.

    >>> varies(np.array([20.0, 20.3])), varies(np.array([20.0, 21.0]))
    (False, True)
    """
    return bool(np.ptp(values) > CONSTANT_WITHIN * np.max(np.abs(values)))


def column(values: np.ndarray | float) -> np.ndarray:
    """Values shaped (rows, 1)."""
    return np.asarray(values, dtype=float)[:, None]


def bookkeeping_inputs(system: system_file.System, table: Table) -> Inputs:
    """Inputs of measurement effects: position in the programme, ambient temperature."""
    inputs: Inputs = {"ambient_temperature": system.recording.ambient_temperature_C + ZERO_CELSIUS}
    if "sequence" in table:
        inputs["sequence"] = column(table["sequence"])
    return inputs


def ageing(recorded: Table, sequence: np.ndarray) -> np.ndarray:
    """Share of the programme's ageing completed at each row, at a rate that doubles every 10 K.

    This is van 't Hoff's rule of thumb for reactions such as oxidation. Without recorded temperatures, ageing follows
    the programme. ``sequence`` is shaped (rows, 1).

    >>> place = np.linspace(0.0, 1.0, 5)
    >>> run = Table({"sequence": place, "temperature_C": np.array([20.0, 20.0, 20.0, 80.0, 80.0])}, "run")
    >>> ageing(run, column(place))[:, 0].round(3).tolist()   # an hour at 20 degC is a minute at 80
    [0.0, 0.01, 0.02, 0.35, 1.0]
    """
    name = next((n for n in ("oil_temperature_C", "temperature_C") if n in recorded), None)
    places = recorded["sequence"] if "sequence" in recorded else programme(recorded, recorded).get("sequence")
    if name is None or places is None:
        return sequence
    order = np.argsort(np.ravel(places), kind="stable")
    place, celsius = np.ravel(places)[order], recorded[name][order]
    inside = (place > 0.0) & (place < 1.0)
    ends = np.concatenate([[0.0], place[inside], [1.0]])
    rate = np.exp2((np.interp(ends, place, celsius) - celsius.max()) / TEN_KELVIN)
    done = np.concatenate([[0.0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(ends))])
    return np.interp(sequence, ends, done / done[-1])


def programme(table: Table, recorded: Table) -> Inputs:
    """For rows with a time: time, and share of the recording's duration as position in the programme."""
    if "time_s" not in table:
        return {}
    inputs: Inputs = {"time": column(table["time_s"])}
    if "sequence" not in table and "time_s" in recorded:
        first, last = float(recorded["time_s"].min()), float(recorded["time_s"].max())
        start = 0.0 if 0.0 <= first <= 0.5 * last else first
        inputs["sequence"] = column((table["time_s"] - start) / ((last - start) or 1.0))
    return inputs
