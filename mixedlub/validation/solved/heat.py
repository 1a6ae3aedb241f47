"""Temperatures of film and walls: layers across the film, and surfaces heated by a source that moves along them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mixedlub.validation.contact import Solid

LAYERS = 15
"""Layers of equal thickness across the film, an odd number: films within 0.8 % of 35 layers, friction within 0.5 %."""
HEIGHTS = (np.arange(LAYERS) + 0.5) / LAYERS - 0.5
"""Middles of the layers over the thickness, from the middle of the film."""
SQUARES = HEIGHTS**2 + 1 / (12 * LAYERS**2)
"""Means of the square of the height over each layer."""
PLACES = HEIGHTS[:, None] + np.array([-1.0, 1.0]) / (2 * np.sqrt(3) * LAYERS)
"""Two places in each layer by which means over it are exact to the third power (Gauss)."""


@dataclass(frozen=True)
class Warmth:
    """Temperatures (C) of the layers (cells by layers) and of both walls."""

    layers: np.ndarray
    first: np.ndarray
    second: np.ndarray

    def towards(self, new: Warmth, pace: float, most: float) -> Warmth:
        """A share of the way to new temperatures, each layer within a bound."""
        layers = self.layers + np.clip(pace * (new.layers - self.layers), -most, most)
        first, second = (a + pace * (b - a) for a, b in ((self.first, new.first), (self.second, new.second)))
        return Warmth(layers, first, second)

    @property
    def film(self) -> np.ndarray:
        """Mean temperature of the film."""
        return np.asarray(self.layers.mean(axis=1))

    @property
    def middle(self) -> np.ndarray:
        """Temperature in the middle of the film."""
        return self.layers[:, LAYERS // 2]


def resting(cells: int, oil: float, walls: tuple[float, float]) -> Warmth:
    """Film at the temperature of the oil between walls of their own."""
    one = np.ones(cells)
    return Warmth(np.full((cells, LAYERS), oil), one * walls[0], one * walls[1])


def flash(ends: np.ndarray, middles: np.ndarray, speed: float, solid: Solid) -> np.ndarray:
    """Rise of a surface at the middles of cells by unit heat fluxes (K m2/W), for a fast surface (Jaeger 1942).

    Heat 1/sqrt(pi rho c k u) times the integral of q/sqrt(x - x') before the place; lengths in m.
    """
    before = np.sqrt(np.maximum(middles[:, None] - ends[None, :], 0.0))
    effusivity = np.pi * solid.conductivity * solid.density * solid.specific_heat * speed
    return np.asarray(2 / np.sqrt(effusivity) * (before[:, :-1] - before[:, 1:]))


@dataclass(frozen=True)
class Sources:
    """Heat of the film by cell, in SI.

    ``heat``, ``slopes``: source of each layer per area, and its derivatives by the temperatures of the column.
    ``conductance``: k/h. ``carried``: heat flow of each layer per width and kelvin (W/(m K)). ``widths``: of the cells.
    """

    heat: np.ndarray
    slopes: np.ndarray
    conductance: np.ndarray
    carried: np.ndarray
    widths: np.ndarray


def currents(sources: Sources) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Heat flows into each layer per kelvin (W/(m2 K)): from the cells before and behind, the layers above and below.

    Oil that a layer loses along the film enters its neighbours; backward flow is fed by the cell behind.
    """
    flows, widths = sources.carried, sources.widths[:, None]
    ends = np.concatenate([flows[:1], 0.5 * (flows[1:] + flows[:-1]), flows[-1:]])
    growth = np.diff(ends, axis=0)
    growth = growth - growth.mean(axis=1, keepdims=True)
    rising = -np.cumsum(growth, axis=1)[:, :-1] / widths
    return np.maximum(flows, 0) / widths, np.maximum(-flows, 0) / widths, np.maximum(-rising, 0), np.maximum(rising, 0)


def warmed(
    now: Warmth, sources: Sources, rises: tuple[np.ndarray, np.ndarray], ends: tuple[float, float, float]
) -> tuple[Warmth, np.ndarray]:
    """Temperatures of a march along the film with sources linear in its temperatures, and heat into both walls.

    ``ends``: temperatures of the entering oil and of both bodies. Each wall is warmed by its own past and present flux.
    """
    count, place = len(now.first), np.arange(LAYERS)
    between = LAYERS * sources.conductance
    own = np.stack([np.diagonal(rise) for rise in rises])
    into = 1 / (0.5 / between + own)
    ahead, back, down, up = currents(sources)
    matrix = -sources.slopes
    matrix[:, place, place] += ahead + back
    matrix[:, place[1:], place[1:]] += up
    matrix[:, place[1:], place[:-1]] -= up
    matrix[:, place[:-1], place[:-1]] += down
    matrix[:, place[:-1], place[1:]] -= down
    matrix[:, place[:-1], place[:-1]] += between[:, None]
    matrix[:, place[1:], place[1:]] += between[:, None]
    matrix[:, place[:-1], place[1:]] -= between[:, None]
    matrix[:, place[1:], place[:-1]] -= between[:, None]
    matrix[:, 0, 0] += into[0]
    matrix[:, -1, -1] += into[1]
    known = sources.heat - np.einsum("clm,cm->cl", sources.slopes, now.layers)
    known += back * np.concatenate([now.layers[1:], now.layers[-1:]])
    inverse = np.linalg.inv(matrix)
    layers, flux, past = np.empty((count, LAYERS)), np.zeros((2, count)), np.empty((2, count))
    before = np.full(LAYERS, ends[0])
    for i in range(count):
        past[0, i] = ends[1] + rises[0][i, :i] @ flux[0, :i]
        past[1, i] = ends[2] + rises[1][i, :i] @ flux[1, :i]
        right = known[i] + ahead[i] * before
        right[0] += into[0, i] * past[0, i]
        right[-1] += into[1, i] * past[1, i]
        before = layers[i] = inverse[i] @ right
        flux[0, i] = into[0, i] * (before[0] - past[0, i])
        flux[1, i] = into[1, i] * (before[-1] - past[1, i])
    walls = past + own * flux
    return Warmth(layers, walls[0], walls[1]), flux
