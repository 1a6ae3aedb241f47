"""A battery of blind cases, sealed by its seed: the same seed writes the same bytes."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path

import numpy as np

from mixedlub.validation.answers import IDENTIFIABLE
from mixedlub.validation.build import PRIORS, QUANTITY, chosen, rig_of
from mixedlub.validation.deal import COARSE, Hand, Order, deal, values_of
from mixedlub.validation.explain import Target, calibrated, explain
from mixedlub.validation.planted import FORMS, MIMICS, NAMED, OUTSIDE, Concealed
from mixedlub.validation.rig import readings
from mixedlub.validation.sealed import deck, record, rows, spread, write, written
from profiles.errors import InputError

SHARES = {"none": 0.16, "single": 0.44, "pair": 0.13, "measurement": 0.11, "unknown": 0.16}


def _deck(rng: np.random.Generator, pool: Iterable[Concealed], count: int) -> list[tuple[str, str]]:
    """``count`` (effect, rig) cards: every effect in turn as often as its rarity says, rigs alternating."""
    cards = [(effect.id, kind, effect.rarity) for effect in pool for kind in effect.kinds]
    return deck(rng, [card[:2] for card in cards], [card[2] for card in cards], count)


def plan(seed: int, cases: int) -> list[Order]:
    """The orders of a battery: classes in fixed shares, all in random order under neutral names."""
    if cases < 5:
        raise InputError("a battery has at least 5 cases, one of each class", where="cases", value=cases)
    rng = np.random.default_rng([seed, 1])
    counts = {label: max(1, int(share * cases)) for label, share in SHARES.items()}
    counts["single"] += cases - sum(counts.values())
    physics = [e for e in NAMED.values() if e.stage != "measurement"]
    faults = [e for e in NAMED.values() if e.stage == "measurement"]
    drawn: list[tuple[str, str, tuple[str, ...]]] = []
    kinds = list(QUANTITY)
    drawn += [("none", kinds[i % 2], ()) for i in range(counts["none"])]
    drawn += [("single", kind, (name,)) for name, kind in _deck(rng, physics, counts["single"])]
    drawn += [("measurement", kind, (name,)) for name, kind in _deck(rng, faults, counts["measurement"])]
    drawn += [("unknown", kind, (name,)) for name, kind in _deck(rng, OUTSIDE.values(), counts["unknown"])]
    for name, kind in _deck(rng, physics, counts["pair"]):
        others = [e for e in NAMED.values() if e.hook != NAMED[name].hook and kind in e.kinds]
        drawn.append(("pair", kind, (name, others[int(rng.integers(len(others)))].id)))
    orders: list[Order] = []
    for place, (label, kind, effects) in enumerate(drawn):
        small = label in ("none", "single") and rng.random() < 0.12
        clear = small or place % 2 == 0 or label == "pair"
        orders.append(Order("", label, kind, effects, "clear" if clear else "faint", small))
    spoiled = {"none": 0.5, "single": 0.2, "measurement": 0.2, "pair": 0.1, "unknown": 0.15}
    shuffled = [orders[i] for i in rng.permutation(len(orders))]
    return [
        replace(order, name=f"case_{i:03d}", outliers=bool(rng.random() < spoiled[order.label]))
        for i, order in enumerate(shuffled)
    ]


def _alternatives(hand: Hand, visible: np.ndarray) -> tuple[dict[str, float], float]:
    """Best chi-square of none and of every single effect but the truth, and of the truth itself."""
    whole = rig_of(hand.case, COARSE)
    truth = values_of(whole, hand.case, hand.z, hand.effects, hand.knobs)[visible]
    part = rig_of(chosen(hand.case, visible), COARSE)
    sd = spread(truth, hand.relative, hand.absolute)
    target = Target(part, truth, sd, hand.case.nominal, hand.case.priors)
    none = explain(target, begin=hand.z)
    names = {effect.id for effect in hand.effects}
    single = names if len(names) == 1 else set()
    rivals = {"none": round(none.chi_square, 4)} if names else {}
    for name, forms in FORMS.items():
        tried = [form for form in forms if name not in single and form.occurs_on(part)]
        found = [explain(target, (form,), begin=none.calibration).chi_square for form in tried]
        if found:
            rivals[name] = round(min(*found, none.chi_square), 4)
    if not names:
        return {"none": round(none.chi_square, 4), **rivals}, round(none.chi_square, 4)
    own = float(hand.z @ hand.z)
    if names <= set(NAMED):
        begin = np.array([v for values in hand.knobs for v in values.values()])
        own = min(own, explain(target, hand.effects, hand.z, [begin]).chi_square)
    return rivals, round(own, 4)


def make(seed: int, index: int, order: Order, folder: Path) -> str:
    """Deal one case and write its folder, the truth beside it; a finished folder is left as it is."""
    place = folder / order.name
    if (place / "truth.json").exists():
        return order.name
    rng = np.random.default_rng([seed, 2, index])
    hand = deal(rng, order)
    case, z = hand.case, hand.z
    truth = values_of(hand.fine, case, z, hand.effects, hand.knobs)
    sd = spread(truth, hand.relative, hand.absolute)
    visible = np.flatnonzero(~hand.hidden)
    recorded, spoiled = record(rng, truth, sd, visible, order.outliers)
    rivals, own = _alternatives(hand, visible)
    least = min(rivals.values(), default=np.inf)
    outside = order.label == "unknown"
    fixed = calibrated(case.nominal, case.priors, z)
    runs = case.columns["run"]
    answer = {
        "case": order.name,
        "rig": "gear" if order.kind == "gear_pair" else "disc",
        "class": order.label,
        "effects": list(order.effects),
        "label": "none" if not order.effects else ["unknown"] if outside else list(order.effects),
        "stage": [effect.stage for effect in hand.effects],
        "info": [
            {
                "id": effect.id,
                "form": effect.source,
                "law": effect.law.__name__,
                "within": effect.within,
                "strength": values["strength"],
                "snr": round(hand.seen, 4),
                "params": {k: v for k, v in values.items() if k != "strength"},
            }
            for effect, values in zip(hand.effects, hand.knobs)
        ],
        "level": order.level if order.effects else "none",
        "small": order.small,
        "mimic": bool(set(order.effects) & MIMICS),
        "theta": {
            "boundary_friction": fixed.boundary_friction,
            **{f"{name}_scale": getattr(fixed, name) for name in PRIORS[1:]},
        },
        "noise": {"relative": hand.relative, "absolute": hand.absolute},
        "outliers": sorted(int(runs[i]) for i in spoiled),
        "alternatives": rivals,
        "own": own,
        "identifiable": bool(not order.effects or least - own > IDENTIFIABLE),
        "rows": rows(
            runs,
            hand.hidden,
            truth=truth,
            base=readings(hand.fine, fixed),
            nominal=readings(hand.fine, case.nominal),
            sd=sd,
        ),
    }
    noise = {"relative": hand.relative, "absolute": hand.absolute}
    settings = {**case.settings, "recording": {**case.settings["recording"], "noise": noise}}
    write(place, settings, case.columns, {QUANTITY[case.kind]: recorded}, hand.hidden, case.share, answer)
    return order.name


def generate(
    folder: Path,
    seed: int,
    cases: int = 240,
    jobs: int = 1,
    progress: Callable[[int, int], None] | None = None,
) -> list[Path]:
    """Write a battery of cases into a folder, or what is missing of it; returns the case folders."""
    return written(folder, {"seed": seed, "cases": cases}, plan(seed, cases), make, jobs, progress)
