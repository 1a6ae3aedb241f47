"""A sealed battery of benches: the same seed writes the same bytes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.validation.answers import IDENTIFIABLE
from mixedlub.validation.deal import CLEAR, FAINT, PAIR, refactored, solve
from mixedlub.validation.explain import visibility
from mixedlub.validation.planted import MEASUREMENT
from mixedlub.validation.rigs import drive, film, history, mesh, viscosity
from mixedlub.validation.rigs.fit import Aim, best, nearest, rivals, slopes
from mixedlub.validation.rigs.stage import Act, Bench, Form
from mixedlub.validation.sealed import deck, plain, record, rows, spread, write, written
from profiles.errors import InputError

ROOMS = {
    "film": film,
    "friction_history": history,
    "friction_map": drive,
    "viscosity": viscosity,
    "mesh_friction": mesh,
}
SHARES = {"none": 0.175, "single": 0.40, "pair": 0.10, "measurement": 0.15, "unknown": 0.175}
SPOILED = {"none": 0.5, "single": 0.15, "measurement": 0.15, "pair": 0.0, "unknown": 0.1}
UNNAMED = {"film": film.draw_unnamed}
"""Kinds of which every third case has an oil that nobody names, unless no reading could then show its effects."""
NOISE = (0.3, 5.0)
SURVEY, TRIES, DRAWS = 60, 8, 400


@dataclass(frozen=True)
class Order:
    """What one case is to be: kind, class, hidden effects, and how visible they should be."""

    name: str
    kind: str
    label: str
    effects: tuple[str, ...]
    level: str
    outliers: bool = False
    unnamed: bool = False


@dataclass(frozen=True)
class Hand:
    """One case as dealt: bench, readings kept back, calibration, forms with their knobs, noise."""

    bench: Bench
    hidden: np.ndarray
    z: np.ndarray
    forms: tuple[Form, ...]
    knobs: tuple[dict[str, float], ...]
    relative: float
    absolute: float
    seen: float

    @property
    def acts(self) -> list[Act]:
        return [form.hide(values) for form, values in zip(self.forms, self.knobs)]

    def sd(self, values: np.ndarray) -> np.ndarray:
        return spread(values, self.relative, self.absolute)


def _surveyed(kind: str, seed: int) -> tuple[dict[str, float], dict[str, float]]:
    """Effects that benches of a kind are open to, named and outside, with the weights of their forms."""
    rng = np.random.default_rng([seed, 21])
    named: dict[str, float] = {}
    strange: dict[str, float] = {}
    for _ in range(SURVEY):
        bench = ROOMS[kind].draw(rng)
        named |= {form.id: form.rarity for form in bench.forms if form.rarity > 0}
        strange |= {form.id: form.rarity for form in bench.outside}
    return dict(sorted(named.items())), dict(sorted(strange.items()))


def _of_kind(rng: np.random.Generator, kind: str, seed: int, cases: int) -> list[Order]:
    counts = {label: max(1, int(share * cases)) for label, share in SHARES.items()}
    counts["single"] += cases - sum(counts.values())
    named, strange = _surveyed(kind, seed)
    faults = {name: weight for name, weight in named.items() if name in MEASUREMENT}
    physics = {name: weight for name, weight in named.items() if name not in MEASUREMENT}
    pairs = ROOMS[kind].PAIRS
    drawn: list[tuple[str, tuple[str, ...]]] = [("none", ())] * counts["none"]
    for label, pool in (("single", physics), ("measurement", faults), ("unknown", strange)):
        drawn += [(label, (name,)) for name in deck(rng, list(pool), list(pool.values()), counts[label])]
    drawn += [("pair", pair) for pair in deck(rng, pairs, [1.0] * len(pairs), counts["pair"])]
    levels = ["clear" if place % 2 == 0 or label == "pair" else "faint" for place, (label, _) in enumerate(drawn)]
    return [
        Order("", kind, label, effects, level, bool(rng.random() < SPOILED[label]), _unnamed(kind, place, effects))
        for place, ((label, effects), level) in enumerate(zip(drawn, levels))
    ]


def _unnamed(kind: str, place: int, effects: tuple[str, ...]) -> bool:
    """Every third of the cases as they are drawn, class by class."""
    return kind in UNNAMED and place % 3 == 1 and not film.NAMED_ONLY & set(effects)


def plan(seed: int, cases: int) -> list[Order]:
    """The orders of a battery: every kind as often, classes in fixed shares, all in random order."""
    if cases < 25:
        raise InputError("a battery of five kinds has at least 25 cases", where="cases", value=cases)
    rng = np.random.default_rng([seed, 11])
    kinds = list(ROOMS)
    each = [cases // len(kinds) + (place < cases % len(kinds)) for place in range(len(kinds))]
    orders = [order for kind, count in zip(kinds, each) for order in _of_kind(rng, kind, seed, count)]
    return [replace(orders[i], name=f"case_{n:03d}") for n, i in enumerate(rng.permutation(len(orders)))]


def _bench_for(rng: np.random.Generator, order: Order) -> tuple[Bench, tuple[Form, ...]]:
    """A bench on which the ordered effects can be at work, and one form of each."""
    draw = UNNAMED[order.kind] if order.unnamed else ROOMS[order.kind].draw
    for _ in range(DRAWS):
        bench = draw(rng)
        pool = bench.outside if order.label == "unknown" else bench.forms
        chosen = []
        for name in order.effects:
            options = [form for form in pool if form.id == name and form.rarity > 0]
            if options:
                chosen.append(options[int(rng.integers(len(options)))])
        if len(chosen) == len(order.effects):
            return bench, tuple(chosen)
    raise InputError("no bench is open to these effects", where=order.kind, value=order.effects)


def _knobs(rng: np.random.Generator, form: Form) -> dict[str, float]:
    values = {knob.name: float(rng.uniform(*knob.typical)) for knob in form.knobs}
    if form.knobs[0].low < 0 and rng.random() < 0.4:
        values["strength"] = -values["strength"]
    return values


def _scaled(form: Form, values: dict[str, float], factor: float) -> dict[str, float]:
    if form.rigid:
        return values
    knob = form.knobs[0]
    return {**values, "strength": float(np.clip(values["strength"] * factor, 0.98 * knob.low, 0.98 * knob.high))}


def withhold(rng: np.random.Generator, bench: Bench) -> np.ndarray:
    """Readings to keep back: a tenth at random and, of most, a whole level of a condition or a stretch of time."""
    count = len(bench.columns["run"])
    hidden = rng.random(count) < rng.uniform(0.05, 0.12)
    plain = ("run", "sequence", "time_s", "position_deg")
    names = [n for n, c in bench.columns.items() if n not in plain and c.dtype != object and len(np.unique(c)) >= 4]
    if count >= 30 and names and rng.random() < 0.6:
        name = names[int(rng.integers(len(names)))]
        inner = np.unique(bench.columns[name])[1:-1]
        hidden |= bench.columns[name] == inner[int(rng.integers(len(inner)))]
    elif count >= 30 and "time_s" in bench.columns and rng.random() < 0.6:
        first = int(rng.uniform(0.1, 0.8) * count)
        hidden[first : first + count // 12] = True
    if not hidden.any():
        hidden[count // 2] = True
    return hidden


def deal(rng: np.random.Generator, order: Order) -> Hand:
    """The hand nearest to what was ordered; benches that show no effect, or what nothing reads, are drawn again."""
    band = PAIR if order.label == "pair" else CLEAR if order.level == "clear" else FAINT
    goal = float(rng.uniform(*band))
    found: Hand | None = None
    for place in range(DRAWS):
        bench, forms = _bench_for(rng, order)
        hand = _noised(rng, order, bench, forms, goal)
        if not _readable(hand):
            continue
        if found is None or abs(np.log(hand.seen / goal)) < abs(np.log(found.seen / goal)):
            found = hand
        if not order.effects or abs(np.log(found.seen / goal)) < 0.25 or place + 1 >= TRIES:
            return found
    raise InputError("no bench with these effects can be read", where=order.kind, value=order.effects)


def _readable(hand: Hand) -> bool:
    """Only maps of friction have a sign: a film, a viscosity or a coefficient is above zero but for its noise."""
    return hand.bench.kind == "friction_map" or bool(np.all(hand.bench.records(hand.z, hand.acts) > 0))


def _noised(rng: np.random.Generator, order: Order, bench: Bench, forms: tuple[Form, ...], goal: float) -> Hand:
    hidden = withhold(rng, bench)
    z = rng.standard_normal(len(bench.names))
    if not order.effects and rng.random() < 0.5:
        z = np.sign(z) * rng.uniform(1.0, 2.0, len(z))
    z = z if bench.planted is None else nearest(bench)
    knobs = tuple(_knobs(rng, form) for form in forms)
    base = bench.records(z, ())
    moves = slopes(bench, z)[~hidden]
    typical = float(np.quantile(np.abs(base), bench.quantile))
    share = float(np.exp(rng.uniform(*np.log(bench.floor))))

    def hand(level: float, factors: Sequence[float]) -> Hand:
        now = tuple(_scaled(f, k, factor) for f, k, factor in zip(forms, knobs, factors))
        absolute = float(f"{0.01 * level * share * typical:.4g}")
        return Hand(bench, hidden, z, forms, now, round(0.01 * level, 6), absolute, 0.0)

    def each(level: float, factors: Sequence[float]) -> list[float]:
        """How visible every effect is with the others there."""
        one = hand(level, factors)
        truth = bench.records(z, one.acts)
        sd = one.sd(truth)[~hidden]
        rests = [bench.records(z, [act for j, act in enumerate(one.acts) if j != i]) for i in range(len(forms))]
        return [visibility((truth - rest)[~hidden], sd, moves) for rest in rests]

    level, factors = float(np.exp(rng.uniform(*np.log(NOISE)))), [1.0] * len(forms)
    if not forms:
        return hand(level, factors)
    level = solve(lambda x: min(each(x, factors)), goal, *NOISE, falling=True)
    for i, form in enumerate(forms):
        widest = max(1.0, min(4.0, form.knobs[0].high / abs(knobs[i]["strength"])))
        wanted = goal if len(forms) == 1 else float(np.clip(each(level, factors)[i], goal, 1.6 * goal))
        factors = refactored(each, level, factors, i, wanted, widest)
    return replace(hand(level, factors), seen=max(min(each(level, factors)), 1e-3))


def _told(rng: np.random.Generator, hand: Hand, truth: np.ndarray) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """How the noise is told: in the settings, in a column of its own, or by repeats alone."""
    quantity = hand.bench.settings["recording"]["quantity"]
    if hand.bench.repeats and rng.random() < 0.7:
        return {}, {}
    if rng.random() < 0.15:
        return {}, {f"{quantity}_sd": hand.sd(truth)}
    return {"noise": {"relative": hand.relative, "absolute": hand.absolute}}, {}


def _matched(hand: Hand, order: Order, aim: Aim) -> tuple[dict[str, float], float]:
    """Least chi-square of every other explanation, and of the truth itself."""
    rank = 2 if order.label == "unknown" else max((form.rank for form in hand.forms), default=0)
    other = rivals(aim, hand.forms, hand.knobs, hand.z, rank)
    if order.label == "none":
        return other, other["none"]
    if hand.bench.planted is not None:
        return other, min(best(aim, hand.forms, hand.z, known)[0] for known in (hand.knobs, ()))
    own = float(hand.z @ hand.z)
    return other, own if order.label == "unknown" else min(own, best(aim, hand.forms, hand.z, hand.knobs)[0])


def _identifiable(hand: Hand, other: dict[str, float], own: float) -> bool:
    """No other explanation comes near; nothing missing needs only that none be better, where it is not exact."""
    least = min(other.values()) - own
    if hand.forms:
        return least > IDENTIFIABLE
    return hand.bench.planted is None or least > -IDENTIFIABLE


def make(seed: int, index: int, order: Order, folder: Path) -> str:
    """Deal one case and write its folder, the truth beside it; a finished folder is left as it is."""
    place = folder / order.name
    if (place / "truth.json").exists():
        return order.name
    rng = np.random.default_rng([seed, 12, index])
    hand = deal(rng, order)
    bench, z = hand.bench, hand.z
    truth = bench.records(z, hand.acts)
    sd = hand.sd(truth)
    visible = np.flatnonzero(~hand.hidden)
    recorded, spoiled = record(rng, truth, sd, visible, order.outliers)
    if order.kind == "viscosity":
        recorded = np.maximum(recorded, 0.02 * truth)
    other, own = _matched(hand, order, Aim(bench, visible, truth[visible], sd[visible]))
    outside = order.label == "unknown"
    runs = bench.columns["run"]
    answer = {
        "case": order.name,
        "rig": order.kind,
        "class": order.label,
        "effects": list(order.effects),
        "label": "none" if not order.effects else ["unknown"] if outside else list(order.effects),
        "info": [
            {
                "id": form.id,
                "form": form.source,
                "law": form.law.__name__,
                "within": form.within,
                "snr": round(hand.seen, 4),
                **values,
            }
            for form, values in zip(hand.forms, hand.knobs)
        ],
        "level": order.level if order.effects else "none",
        "unnamed_oil": order.unnamed,
        "theta": bench.theta(z),
        "z": dict(zip(bench.names, plain(z))),
        "noise": {"relative": hand.relative, "absolute": hand.absolute},
        "outliers": sorted(int(runs[i]) for i in spoiled),
        "alternatives": other,
        "own": round(own, 4),
        "identifiable": _identifiable(hand, other, own),
        "rows": rows(
            runs,
            hand.hidden,
            truth=truth,
            base=bench.records(z, ()),
            nominal=bench.model(np.zeros(len(z)), ()),
            sd=sd,
        ),
    }
    noise, more = _told(rng, hand, truth)
    counted = bench.settle(bench.records(z, [act for act in hand.acts if act.stage != "sensor"]))
    settings = {**bench.settings, "recording": {**bench.settings["recording"], **noise}}
    readings = {settings["recording"]["quantity"]: recorded, **more}
    write(place, settings, {**bench.columns, **counted}, readings, hand.hidden, bench.share, answer)
    return order.name


def generate(
    folder: Path, seed: int, cases: int = 200, jobs: int = 1, progress: Callable[[int, int], None] | None = None
) -> list[Path]:
    """Write a battery of cases into a folder, or what is missing of it; returns the case folders."""
    mark = {"rigs": list(ROOMS), "seed": seed, "cases": cases}
    return written(folder, mark, plan(seed, cases), make, jobs, progress)
