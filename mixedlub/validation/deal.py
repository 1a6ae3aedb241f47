"""Dealing one case: rig, calibration, hidden effects, and the noise that makes them as visible as ordered."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from mixedlub.validation.build import PRIORS, Case, rig_of
from mixedlub.validation.design import draw_disc, draw_gear, withhold
from mixedlub.validation.explain import calibrated, sensitivity, visibility
from mixedlub.validation.planted import FORMS, OUTSIDE, Concealed
from mixedlub.validation.rig import Rig, readings

CLEAR, FAINT, PAIR = (16.0, 30.0), (7.0, 11.0), (10.0, 24.0)
COARSE, FINE = 48, 240
NOISE = (0.35, 5.0)
TRIES = 12


@dataclass(frozen=True)
class Order:
    """What one case is to be: its class, rig, hidden effects, and how visible they should be."""

    name: str
    label: str
    kind: str
    effects: tuple[str, ...]
    level: str
    small: bool
    outliers: bool = False


def form_of(rng: np.random.Generator, effect: str) -> Concealed:
    """One of the forms of an effect."""
    forms = FORMS.get(effect) or (OUTSIDE[effect],)
    return forms[int(rng.integers(len(forms)))]


@dataclass(frozen=True)
class Hand:
    """One case as dealt: rigs fine and coarse, the true calibration, effects with their knobs, sds."""

    case: Case
    hidden: np.ndarray
    fine: Rig
    z: np.ndarray
    effects: tuple[Concealed, ...]
    knobs: tuple[dict[str, float], ...]
    relative: float
    absolute: float
    seen: float


def values_of(rig: Rig, case: Case, z: np.ndarray, effects: Sequence[Concealed], knobs: Sequence[dict]) -> np.ndarray:
    hidden = [effect.hide(values) for effect, values in zip(effects, knobs)]
    return readings(rig, calibrated(case.nominal, case.priors, z), hidden)


def _draw_knobs(rng: np.random.Generator, effect: Concealed) -> dict[str, float]:
    values = {knob.name: float(rng.uniform(*knob.typical)) for knob in effect.knobs}
    if effect.knobs[0].low < 0 and rng.random() < 0.4:
        values["strength"] = -values["strength"]
    return values


def _scaled(effect: Concealed, values: dict[str, float], factor: float) -> dict[str, float]:
    knob = effect.knobs[0]
    strength = float(np.clip(values["strength"] * factor, 0.98 * knob.low, 0.98 * knob.high))
    return {**values, "strength": strength}


def deal(rng: np.random.Generator, order: Order) -> Hand:
    """The hand nearest to what was ordered; rigs on which an effect cannot be seen are redrawn."""
    best: Hand | None = None
    band = PAIR if order.label == "pair" else CLEAR if order.level == "clear" else FAINT
    goal = rng.uniform(*band)
    for _ in range(TRIES if order.effects else 1):
        coated = "coating_insulation" in order.effects or rng.random() < 0.12
        case = (draw_gear if order.kind == "gear_pair" else draw_disc)(rng, coated)
        hand = _noised(rng, order, case, goal)
        if best is None or abs(np.log(hand.seen / goal)) < abs(np.log(best.seen / goal)):
            best = hand
        if not order.effects or abs(np.log(best.seen / goal)) < 0.25:
            break
    assert best is not None
    return best


def _noised(rng: np.random.Generator, order: Order, case: Case, goal: float) -> Hand:
    hidden = withhold(rng, case, order.small)
    coarse, fine = rig_of(case, COARSE), rig_of(case, FINE)
    z = rng.standard_normal(len(PRIORS))
    effects = tuple(form_of(rng, name) for name in order.effects)
    knobs = tuple(_draw_knobs(rng, effect) for effect in effects)
    base = values_of(coarse, case, z, (), ())
    slopes = sensitivity(coarse, case.nominal, case.priors, z)[~hidden]
    typical = float(np.median(np.abs(base)))
    share = float(np.exp(rng.uniform(np.log(0.15), np.log(1.2))))

    def spread(level: float, values: np.ndarray) -> np.ndarray:
        return np.sqrt((0.01 * level * values) ** 2 + (0.01 * level * share * typical) ** 2)

    def each(level: float, factors: Sequence[float]) -> list[float]:
        """The visibility of every effect, with the others there."""
        now = [_scaled(e, k, f) for e, k, f in zip(effects, knobs, factors)]
        truth = values_of(coarse, case, z, effects, now)
        found = []
        for i in range(len(effects)):
            rest = [j for j in range(len(effects)) if j != i]
            without = values_of(coarse, case, z, [effects[j] for j in rest], [now[j] for j in rest])
            found.append(visibility((truth - without)[~hidden], spread(level, truth)[~hidden], slopes))
        return found

    level, factors, reached = float(np.exp(rng.uniform(np.log(0.4), np.log(4.0)))), [1.0] * len(effects), goal
    if effects:
        level = solve(lambda x: min(each(x, factors)), goal, *NOISE, falling=True)
        for i, effect in enumerate(effects):
            widest = max(1.0, min(4.0, effect.knobs[0].high / abs(knobs[i]["strength"])))
            wanted = goal if len(effects) == 1 else np.clip(each(level, factors)[i], goal, 1.6 * goal)
            factors = refactored(each, level, factors, i, float(wanted), widest)
        reached = max(min(each(level, factors)), 1e-3)
    return Hand(
        case=case,
        hidden=hidden,
        fine=fine,
        z=z,
        effects=effects,
        knobs=tuple(_scaled(e, k, f) for e, k, f in zip(effects, knobs, factors)),
        relative=round(0.01 * level, 6),
        absolute=float(f"{0.01 * level * share * typical:.4g}"),
        seen=reached,
    )


def refactored(
    each: Callable[[float, Sequence[float]], list[float]],
    level: float,
    factors: list[float],
    place: int,
    goal: float,
    widest: float,
) -> list[float]:
    """The factors with one of them changed so that its effect is as visible as wanted."""

    def at(factor: float) -> list[float]:
        return [factor if i == place else f for i, f in enumerate(factors)]

    return at(solve(lambda x: each(level, at(x))[place], goal, 0.05, widest, falling=False))


def solve(measure: Callable[[float], float], goal: float, low: float, high: float, falling: bool) -> float:
    """Log bisection of a monotone measure to the goal; the nearer end where it is out of reach."""
    if not falling and abs(np.log(max(measure(1.0), 1e-9) / goal)) < 0.03:
        return 1.0
    for _ in range(12):
        middle = float(np.sqrt(low * high))
        above = measure(middle) > goal
        low, high = (middle, high) if above == falling else (low, middle)
    return float(f"{np.sqrt(low * high):.5g}")
