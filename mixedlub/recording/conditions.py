"""Test conditions: varied conditions, and smooth functions of them as columns."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.case.forward import Forward
from mixedlub.kinds.acceleration import stretches
from mixedlub.kinds.kind import CONSTANT_WITHIN, varies
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.recording.set_points import roundest
from mixedlub.schema.table import Table

NODES = 12
"""Judgement. Most nodes of the functions along a condition: finer structure is a wave, a peak or a step."""
PASSING = ("sequence", "time_s", "position_deg")
"""Conditions that pass by themselves, with an arbitrary origin."""
FUNCTIONS_IN_PRODUCTS = 4
"""Cost limit. Functions of a numeric condition in products with functions of another condition."""
JITTER = 1e-6
"""Judgement. Diagonal added to the kernel of close nodes, so that it can be inverted: rounding."""
SMALLEST = 1e-300
"""Judgement. Smallest argument of a logarithm: near the smallest double."""
PURE_ROLLING = 0.02
"""Judgement. Slide-roll ratio up to which a film measurement is pure rolling: under 5 % of the heat of full sliding."""
NOISY_WITHIN = 0.1
"""Judgement. Largest span of a noisy constant, as a share of its size.

`CONSTANT_WITHIN` answers another question: below it, differences between values are never used. Here values differ by
more, and count as measurements of one set point only because hardly any value is repeated.
"""
NEGLIGIBLE_CHANGE = 0.005
"""Judgement. Largest change of the base model, as a share of its median, by which a noisy constant may be left out."""
MOST_READINGS = 0.9
"""Judgement. Share of the readings near a set point if the others are a start-up."""
SERIES = 400
"""Judgement. Readings from which a table is a logged series: nobody sets so many conditions by hand."""
START_UP_SHARE = 0.005
"""Judgement. Share of a series below which times count as one on a logarithmic axis, because a start-up is shorter."""
LOST_AFTER = 2.0
"""Judgement. Periods beyond a record after which the phase of a wave is unknown."""


@dataclass(frozen=True, eq=False)
class Coordinate:
    """A condition scaled to 0..1, or a name; ``nodes`` are the places of its functions.

    A condition with both signs has a ``symmetric_log`` scale, linear below that size. Values below the ``floor`` of a
    logarithmic scale count as one.
    """

    name: str
    nodes: np.ndarray
    low: float = 0.0
    span: float = 1.0
    logarithmic: bool = False
    symmetric_log: float = 0.0
    floor: float = SMALLEST

    @property
    def named(self) -> bool:
        """Whether the condition is a name, not a number."""
        return self.nodes.dtype.kind in "US"

    @property
    def ends(self) -> tuple[float, float]:
        """The lowest and the highest value."""
        low, high = self.low, self.low + self.span
        return (float(np.exp(low)), float(np.exp(high))) if self.logarithmic else (low, high)

    def scale(self, values: np.ndarray) -> np.ndarray:
        """Values on the 0..1 axis."""
        seen = np.maximum(values, self.floor) if self.logarithmic else values
        return (unrolled(seen, self.logarithmic, self.symmetric_log) - self.low) / self.span

    def wave(self, values: np.ndarray, waves: float) -> np.ndarray:
        """A cosine and a sine with ``waves`` periods from the lowest to the highest value."""
        low, high = self.ends
        turn = 2.0 * np.pi * waves * (values - low) / (high - low)
        return np.column_stack([np.cos(turn), np.sin(turn)]) * self.phase_known(values, waves)[:, None]

    def phase_known(self, values: np.ndarray, waves: float) -> np.ndarray:
        """Share of a wave with a known phase: 1 within the record, falling to 0 a few periods beyond it."""
        low, high = self.ends
        beyond = np.maximum(np.maximum(low - values, values - high), 0.0) * waves / (high - low)
        return np.exp(-((beyond / LOST_AFTER) ** 2))

    def about(self, values: np.ndarray, at: float, width: float) -> np.ndarray:
        """Bell of ``width`` (share of the range) about a value, or a step there for zero width. A condition with both
        signs has one on either side."""
        x = self.scale(values)
        sides = (1.0, -1.0) if self.symmetric_log and at else (1.0,)
        off = [side * (x - self.scale(np.array(side * at))) for side in sides]
        return np.column_stack([np.exp(-0.5 * (d / width) ** 2) if width else (d >= 0.0).astype(float) for d in off])

    def functions(self, values: np.ndarray, length: float) -> np.ndarray:
        """Columns; a random combination of them is a smooth function of the condition with variance one."""
        if self.named:
            return (values[:, None] == self.nodes[None, :]).astype(float)
        nodes = self.nodes
        kernel = _kernel(nodes, nodes, length)
        size, vectors = np.linalg.eigh(kernel + JITTER * np.eye(nodes.size))
        keep = size > 1e-3 * size.max()
        return _kernel(self.scale(values), nodes, length) @ (vectors[:, keep] / np.sqrt(size[keep]))[:, ::-1]


def unrolled(values: np.ndarray, logarithmic: bool, symmetric_log: float) -> np.ndarray:
    """Values on a linear, logarithmic or symmetric logarithmic scale.

    >>> unrolled(np.array([-99.0, 0.0, 1.0]), False, 1.0).round(3).tolist()
    [-4.605, 0.0, 0.693]
    """
    if symmetric_log:
        return np.asarray(np.sign(values) * np.log1p(np.abs(values) / symmetric_log))
    return np.log(values) if logarithmic else values


def clock_of(rows: Table, ties: bool = False) -> np.ndarray | None:
    """Column with the order of the readings; None if missing or with ties.

    With ``ties`` half of the readings may share a time, as where a logger writes whole seconds. Set-ups whose clock
    starts again follow each other.

    >>> log = Table({"time_s": np.array([0.0, 1.0, 1.0, 2.0])}, "log")
    >>> clock_of(log), clock_of(log, ties=True).tolist()
    (None, [0.0, 1.0, 1.0, 2.0])
    """
    clock = next((rows[name] for name in ("sequence", "time_s") if name in rows), None)
    if clock is None:
        return None
    clock = in_a_row(rows, clock)
    times = np.unique(clock).size
    return clock if times == clock.size or (ties and 2 * times > clock.size) else None


def in_a_row(rows: Table, clock: np.ndarray) -> np.ndarray:
    """The clock, or that of set-ups one after the other where each has its own.

    >>> rows = {"time_s": np.array([0.0, 2.0, 0.0, 2.0]), "setup": np.array(["a", "a", "b", "b"])}
    >>> in_a_row(Table(rows), rows["time_s"]).tolist()
    [0.0, 2.0, 4.0, 6.0]
    """
    if "setup" not in rows or np.all(np.diff(clock) >= 0.0):
        return clock
    part = stretches(Table({"time_s": clock, "setup": rows["setup"]}))
    if part[-1] + 1 > np.unique(rows["setup"]).size:
        return clock
    begins = np.flatnonzero(np.diff(part, prepend=-1))
    steps = np.diff(clock, prepend=clock[0])
    steps[begins[1:]] = np.median(np.abs(steps[steps != 0.0]))
    return clock[0] + np.cumsum(steps)


def is_constant(name: str, values: np.ndarray) -> bool:
    """Whether a condition was held constant, so that readings cannot show how they depend on it.

    >>> is_constant("oil_temperature_C", np.array([31.0, 36.0])), is_constant("speed_rpm", np.array([500.0, 520.0]))
    (True, False)
    """
    if values.dtype.kind in "US" or name in PASSING:
        return False
    return not varies(_absolute(name, values))


def _absolute(name: str, values: np.ndarray) -> np.ndarray:
    """Values from an absolute zero: temperatures in kelvin."""
    return values + ZERO_CELSIUS if is_temperature(name) else values


def is_temperature(name: str) -> bool:
    """Whether a column is a temperature."""
    return name.endswith("temperature_C")


def _is_pure_rolling(name: str, levels: np.ndarray, case: Case) -> bool:
    """Whether a film measurement was in pure rolling, with a residual slide-roll ratio."""
    return (
        case.quantity == "film_thickness_nm"
        and name == "slide_roll_ratio"
        and bool(np.abs(levels).max() <= PURE_ROLLING)
    )


def is_noisy_constant(name: str, values: np.ndarray) -> bool:
    """Whether values are noisy measurements of one set point: within NOISY_WITHIN, and hardly one repeated.

    Temperatures lie within the span of a constant one.

    >>> load = np.array([19.9, 20.1, 20.3, 19.7])
    >>> is_noisy_constant("load_N", load), is_noisy_constant("load_N", np.array([20.0, 21.0, 20.0, 21.0]))
    (True, False)
    """
    if values.dtype.kind in "US" or name in PASSING or 2 * np.unique(values).size <= values.size:
        return False
    return bool(np.ptp(values) <= _noisy_span(name, float(np.max(np.abs(_absolute(name, values))))))


def _noisy_span(name: str, size: float) -> float:
    """Largest span of a noisy constant of this size in absolute units."""
    return (CONSTANT_WITHIN if is_temperature(name) else NOISY_WITHIN) * size


def noisy_set_point(name: str, values: np.ndarray) -> float | None:
    """Set point about which nearly all values of a condition scatter; None for a varied or an exact condition.

    A few values far from it, as of a start-up, do not count.

    >>> load = np.concatenate([[4.9, 12.0], 50.0 + 0.01 * np.arange(-20, 20)])
    >>> [noisy_set_point("load_N", values) for values in (load, np.arange(42.0), np.full(42, 50.0))]
    [50.0, None, None]
    """
    if values.dtype.kind in "US" or name in PASSING:
        return None
    middle = np.median(values)
    span = _noisy_span(name, abs(float(np.median(_absolute(name, values)))))
    near = values[np.abs(values - middle) <= 0.5 * span]
    many = is_noisy_constant(name, near) or np.unique(near).size > NODES
    if near.size < MOST_READINGS * values.size or not many:
        return None
    return roundest(*(float(np.quantile(near, share)) for share in (0.25, 0.75)))


def _is_negligible(name: str, forward: Forward) -> bool:
    """Whether a noisy constant changes a base model that reads it, and by next to nothing."""
    table = forward.table
    if name not in table or not is_noisy_constant(name, table[name]):
        return False
    steady = forward.case.kind.with_condition(table, name, np.full(len(table), np.median(table[name])))
    here, there = forward.predict(), Forward(forward.case, steady).predict()
    return 0.0 < float(np.max(np.abs(there - here))) <= NEGLIGIBLE_CHANGE * float(np.median(np.abs(here)))


def _kernel(a: np.ndarray, b: np.ndarray, length: float) -> np.ndarray:
    return np.exp(-0.5 * ((a[:, None] - b[None, :]) / length) ** 2)


@dataclass(frozen=True, eq=False)
class Coordinates:
    """The axes along which the conditions of a case varied."""

    axes: tuple[Coordinate, ...]

    def place(self, name: str) -> int:
        """Index of the axis of a condition."""
        return [axis.name for axis in self.axes].index(name)

    def values(self, forward: Forward) -> list[np.ndarray]:
        """The conditions of the rows that a model predicts, one array an axis."""
        every = raw_coordinates(forward)
        return [every[axis.name] for axis in self.axes]

    def columns(
        self, values: list[np.ndarray], length: float, only: tuple[str, ...] = (), interactions: bool = False
    ) -> np.ndarray:
        """Function columns over some axes or all, with products of pairs on request; total variance about one."""
        blocks = [
            (axis.functions(v, length), None if axis.named else FUNCTIONS_IN_PRODUCTS)
            for axis, v in zip(self.axes, values, strict=True)
            if not only or axis.name in only
        ]
        found = [block for block, _ in blocks]
        if interactions:
            for (first, few), (second, some) in combinations(blocks, 2):
                a, b = first[:, :few], second[:, :some]
                found.append((a[:, :, None] * b[:, None, :]).reshape(a.shape[0], -1))
        return np.hstack(found) / np.sqrt(len(found))


def raw_coordinates(forward: Forward) -> dict[str, np.ndarray]:
    """Condition columns of a model's rows, the surfaces as a pair and as a composite roughness."""
    case, table = forward.case, forward.table
    found: dict[str, np.ndarray] = {}
    names = [c for c in case.kind.columns if c.dtype == "name" and c.name in table]
    for column in case.kind.columns:
        if column.dtype != "name" and column.name in table:
            found[column.name] = np.asarray(table[column.name], dtype=float)
    if names:
        label = table[names[0].name].astype(str)
        for column in names[1:]:
            label = np.char.add(np.char.add(label, " / "), table[column.name].astype(str))
        are_surfaces = any("surface" in column.name for column in names)
        found["surfaces" if are_surfaces else "_and_".join(column.name for column in names)] = label
    if "m0" in forward.inputs:
        found["composite_roughness_um"] = np.broadcast_to(np.sqrt(forward.inputs["m0"])[:, 0] * 1e6, len(table))
    if "sequence" in table:
        found["sequence"] = np.asarray(table["sequence"], dtype=float)
    return found


def coordinates(forward: Forward) -> Coordinates:
    """Axes of the varied conditions of a recording; constant conditions count only if nothing else varies."""
    every = {name: np.unique(values) for name, values in raw_coordinates(forward).items()}
    varied = {name: levels for name, levels in every.items() if levels.size > 1}
    held = [
        k
        for k, v in varied.items()
        if is_constant(k, v) or _is_pure_rolling(k, v, forward.case) or _is_negligible(k, forward)
    ]
    swept = {k: v for k, v in varied.items() if k not in held}
    axes = []
    for name, levels in (swept or varied).items():
        if levels.dtype.kind in "US":
            axes.append(Coordinate(name, levels))
            continue
        logarithmic = bool(levels[0] > 0 and levels[-1] / levels[0] > 3.0 and name != "sequence")
        both = levels[0] < 0.0 < levels[-1] and name not in PASSING
        symmetric_log = float(np.abs(levels[levels != 0.0]).min()) if both else 0.0
        # The first decades of a logarithmic time axis hold only the start-up.
        series = name in PASSING and logarithmic and levels.size >= SERIES
        floor = float(levels[int(START_UP_SHARE * levels.size)]) if series else SMALLEST
        x = unrolled(np.maximum(levels, floor) if logarithmic else levels, logarithmic, symmetric_log)
        low, span = float(x[0]), float(x[-1] - x[0])
        nodes = (x - low) / span
        if nodes.size > NODES:
            nodes = np.linspace(0.0, 1.0, NODES)
        axes.append(Coordinate(name, nodes, low, span, logarithmic, symmetric_log, floor))
    return Coordinates(tuple(axes))
