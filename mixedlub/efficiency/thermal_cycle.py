"""Sump temperature over a duty cycle: one heat capacity, losses and heat by temperature."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from mixedlub.efficiency.thermal import BALANCED, WHERE, ThermalModel
from mixedlub.efficiency.thermal_root import lowest_root
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.schema.findings import Finding, finding

NODES = 33
"""Grid. Temperatures at which the losses of an operating point are computed; they are interpolated between."""
SAMPLES = 24
"""Grid. Times of an operating point in the table over time."""
CLOSES = 1e-7
"""Grid. Heat kept over a closed cycle, over its losses, that ends the search."""
TOLERANCE, SMALLEST = 1e-10, 1e-13
"""Grid. Tolerances of the integration over time: relative, and of the change (K) since the point began."""
HOUR = 3600.0
Losses = Callable[[np.ndarray], np.ndarray]
"""Losses (W) of an operating point over the sump temperature (K)."""


@dataclass(frozen=True, eq=False)
class Cycle:
    """Temperatures (K) and heat (J) of the operating points of a duty cycle, in their order.

    ``closed``: ends as it starts, or has a stated start; ``inside``: below the highest temperature; ``settled``:
    the teeth have a temperature at all its sump temperatures.

    ``start``, ``end``, ``highest``, ``mean``: sump temperature of each point; ``lost``, ``removed``, ``stored``: heat
    in, heat out and heat kept; ``time`` (s) and ``sump`` (K): over the whole cycle, with the number of the point.
    """

    start: np.ndarray
    end: np.ndarray
    highest: np.ndarray
    mean: np.ndarray
    lost: np.ndarray
    removed: np.ndarray
    stored: np.ndarray
    time: np.ndarray
    sump: np.ndarray
    point: np.ndarray
    closed: bool
    inside: bool
    settled: bool

    @property
    def gap(self) -> float:
        """Heat in less heat out and heat kept, over heat in."""
        given = float(self.lost.sum())
        left = given - float(self.removed.sum()) - float(self.stored.sum())
        return left / given if given > 0.0 else 0.0

    def findings(self, model: ThermalModel) -> Iterator[Finding]:
        """Findings on a cycle that does not close or leaves the temperatures of the balance."""
        if not self.closed:
            limit = f"{model.section.highest_temperature_C:g} °C"
            text = f"the cycle closes at no start temperature up to {limit}: temperatures are of a start there"
            yield finding("thermal_cycle_open", text, WHERE)
        if not self.inside:
            text = f"the sump passes {model.section.highest_temperature_C:g} °C, above which losses are those there"
            yield finding("thermal_cycle_open", text, WHERE)
        if not self.settled:
            text = "teeth do not pass on the loss of their mesh at temperatures of the sump over the cycle"
            yield finding("thermal_cycle_open", text, WHERE)


def cycle(model: ThermalModel, torque: np.ndarray, speed: np.ndarray, seconds: np.ndarray) -> Cycle:
    r"""Temperatures over operating points one after the other, from the start of the file or of a closed cycle.

    .. math:: C\,\frac{dT}{dt} = P_V(T) - \sum Q(T)

    with one heat capacity C; losses and heat of the points are integrated together with the temperature.
    """
    from scipy.interpolate import PchipInterpolator

    section = model.section
    assert section.heat_capacity_kJ_K is not None
    capacity = section.heat_capacity_kJ_K * 1e3
    low, high = model.ends
    nodes = np.linspace(low, high, NODES)
    each, at = np.repeat(np.arange(torque.size), NODES), np.tile(nodes, torque.size)
    found, rise = model.losses(torque[each], speed[each], at)
    loose = (model.teeth_gap(found, rise) > BALANCED).reshape(torque.size, NODES)
    losses = [PchipInterpolator(nodes, row) for row in found.total().reshape(torque.size, NODES)]

    def excess(_: np.ndarray, start: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        rows = _once(model, losses, seconds, float(start[0]), capacity)
        lost, removed = (np.array([sum(row[which] for row in rows)]) for which in (1, 2))
        return removed - lost, lost

    own, closed = section.start_temperature_C, True
    start = low if own is None else own + ZERO_CELSIUS
    if own is None:
        (start,), (closed,) = lowest_root(excess, np.array([low]), np.array([high]), CLOSES)
    rows = _once(model, losses, seconds, start, capacity)
    sump, lost, removed, times = (list(one) for one in zip(*rows, strict=True))
    begin = np.concatenate([[0.0], np.cumsum(seconds)[:-1]])
    return Cycle(
        start=np.array([one[0] for one in sump]),
        end=np.array([one[-1] for one in sump]),
        highest=np.array([one.max() for one in sump]),
        mean=np.array([_mean(one, t) for one, t in zip(sump, times, strict=True)]),
        lost=np.array(lost),
        removed=np.array(removed),
        stored=capacity * np.array([one[-1] - one[0] for one in sump]),
        time=np.concatenate([t + b for t, b in zip(times, begin, strict=True)]),
        sump=np.concatenate(sump),
        point=np.repeat(np.arange(1, torque.size + 1), [one.size for one in sump]),
        closed=own is not None or bool(closed and abs(sum(lost) - sum(removed)) <= BALANCED * sum(lost)),
        inside=max(one.max() for one in sump) <= high,
        settled=not any(row[_touched(nodes, one)].any() for one, row in zip(sump, loose, strict=True)),
    )


def _once(
    model: ThermalModel, losses: list[Losses], seconds: np.ndarray, start: float, capacity: float
) -> list[tuple[np.ndarray, float, float, np.ndarray]]:
    """Temperatures, heat in and heat out (J), and times (s) of every point of a cycle."""
    from scipy.integrate import solve_ivp

    low, high = model.ends
    rows, at = [], start
    for loss, duration in zip(losses, seconds, strict=True):

        def slopes(_: float, state: np.ndarray, loss: Losses = loss, at: float = at) -> list[float]:
            sump = at + state[0]
            given = float(loss(np.clip(sump, low, high)))
            taken = float(model.paths.total(np.array(sump)))
            return [(given - taken) / capacity, given / capacity, taken / capacity]

        if duration == 0.0:
            rows.append((np.array([at]), 0.0, 0.0, np.zeros(1)))
            continue
        # Dense where the temperature moves, at the start of a point.
        times = duration * np.concatenate([[0.0], np.geomspace(1e-4, 1.0, SAMPLES)])
        done = solve_ivp(slopes, (0.0, duration), [0.0, 0.0, 0.0], "LSODA", times, rtol=TOLERANCE, atol=SMALLEST)
        sump = at + done.y[0]
        at = float(sump[-1])
        rows.append((sump, capacity * float(done.y[1, -1]), capacity * float(done.y[2, -1]), times))
    return rows


def _touched(nodes: np.ndarray, sump: np.ndarray) -> np.ndarray:
    """Nodes from which losses at temperatures of the sump are interpolated."""
    first, last = np.searchsorted(nodes, sump.min(), side="right") - 1, np.searchsorted(nodes, sump.max())
    return np.unique(np.clip(np.arange(first, last + 1), 0, nodes.size - 1))


def _mean(values: np.ndarray, times: np.ndarray) -> float:
    """Mean over time."""
    return float(np.trapezoid(values, times) / times[-1]) if times[-1] > 0.0 else float(values[0])
