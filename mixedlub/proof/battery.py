"""A battery of blind cases, sealed by its seed: the same seed writes the same bytes."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.proof.answers import IDENTIFIABLE
from mixedlub.proof.build import PRIORS, QUANTITY, chosen, rig_of
from mixedlub.proof.concealed import FORMS, MIMICS, NAMED, OUTSIDE, Concealed
from mixedlub.proof.deal import COARSE, Hand, Order, deal, values_of
from mixedlub.proof.explain import Target, calibrated, explain
from mixedlub.proof.rig import readings
from profiles.errors import InputError

SHARES = {"none": 0.16, "single": 0.44, "pair": 0.13, "measurement": 0.11, "unknown": 0.16}


def _deck(rng: np.random.Generator, pool: Iterable[Concealed], count: int) -> list[tuple[str, str]]:
    """``count`` (effect, rig) cards: every effect in turn as often as its rarity says, rigs alternating."""
    cards = [(effect.id, kind, effect.rarity) for effect in pool for kind in effect.kinds]
    weight = np.array([card[2] for card in cards])
    due = count * weight / weight.sum()
    times = np.floor(due).astype(int)
    rest = rng.random(len(cards)) + (due - times) * 4
    for place in np.argsort(-rest)[: count - times.sum()]:
        times[place] += 1
    deck = [(card[0], card[1]) for card, n in zip(cards, times) for _ in range(n)]
    return [deck[i] for i in rng.permutation(len(deck))]


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
    sd = np.sqrt((hand.relative * truth) ** 2 + hand.absolute**2)
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
    sd = np.sqrt((hand.relative * truth) ** 2 + hand.absolute**2)
    recorded = truth + sd * rng.standard_normal(len(truth))
    visible = np.flatnonzero(~hand.hidden)
    spoiled = np.array([], dtype=int)
    if order.outliers:
        spoiled = rng.choice(visible, max(1, round(rng.uniform(0.02, 0.03) * len(visible))), replace=False)
        sizes = rng.uniform(8, 25, len(spoiled)) * rng.choice([-1.0, 1.0], len(spoiled))
        recorded[spoiled] += sizes * sd[spoiled]
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
        "rows": {
            "run": [int(run) for run in runs],
            "withheld": [bool(flag) for flag in hand.hidden],
            "truth": _plain(truth),
            "base": _plain(readings(hand.fine, fixed)),
            "nominal": _plain(readings(hand.fine, case.nominal)),
            "sd": _plain(sd),
        },
    }
    write(place, hand, recorded, answer)
    return order.name


def _plain(values: np.ndarray) -> list[float]:
    return [float(f"{value:.9g}") for value in values]


def write(place: Path, hand: Hand, recorded: np.ndarray, answer: dict[str, Any]) -> None:
    """The case folder as an engineer would hand it in; ``truth.json`` comes last and marks it done."""
    import pandas as pd

    place.mkdir(parents=True, exist_ok=True)
    case = hand.case
    noise = {"relative": hand.relative, "absolute": hand.absolute}
    settings = {**case.settings, "recording": {**case.settings["recording"], "noise": noise}}
    (place / "system.toml").write_text(toml(settings))
    quantity = QUANTITY[case.kind]
    frame = pd.DataFrame({**case.columns, quantity: _plain(recorded)})
    frame[~hand.hidden].to_csv(place / "recordings.csv", index=False)
    frame[hand.hidden].drop(columns=quantity).to_csv(place / "conditions.csv", index=False)
    if case.share is not None:
        names = ["torque_Nm", "roll_angle_deg", "load_share"]
        pd.DataFrame(case.share, columns=names).to_csv(place / "load_share.csv", index=False)
    (place / "truth.json").write_text(json.dumps(answer, indent=1))


def toml(settings: dict[str, Any]) -> str:
    """Settings as TOML: plain values first, then tables; enough for case files."""

    def value(item: Any) -> str:
        if isinstance(item, dict):
            return "{ " + ", ".join(f"{k} = {value(v)}" for k, v in item.items()) + " }"
        return json.dumps(item)

    lines = [f"{key} = {value(item)}" for key, item in settings.items() if not isinstance(item, dict)]
    for key, item in settings.items():
        if key == "surfaces":
            for name, surface in item.items():
                lines += ["", f"[surfaces.{name}]", *(f"{k} = {value(v)}" for k, v in surface.items())]
        elif isinstance(item, dict):
            lines += ["", f"[{key}]", *(f"{k} = {value(v)}" for k, v in item.items())]
    return "\n".join(lines) + "\n"


def generate(
    folder: Path,
    seed: int,
    cases: int = 240,
    jobs: int = 1,
    progress: Callable[[int, int], None] | None = None,
) -> list[Path]:
    """Write a battery of cases into a folder, or what is missing of it; returns the case folders."""
    return written(folder, {"seed": seed, "cases": cases}, plan(seed, cases), make, jobs, progress)


def written(
    folder: Path,
    mark: Mapping[str, Any],
    orders: Sequence[Any],
    make: Callable[[int, int, Any, Path], object],
    jobs: int,
    progress: Callable[[int, int], None] | None,
) -> list[Path]:
    """The cases of some orders, made in ``jobs`` processes unless they are there, under the mark of their battery."""
    folder.mkdir(parents=True, exist_ok=True)
    seal = folder / "battery.json"
    if seal.exists() and json.loads(seal.read_text()) != mark:
        raise InputError("the folder holds a battery of another seed or size", where=str(folder), value=mark)
    seal.write_text(json.dumps(mark))
    seed, count = mark["seed"], len(orders)
    if jobs == 1:
        for done, order in enumerate(orders):
            make(seed, done, order, folder)
            if progress:
                progress(done + 1, count)
    else:
        with ProcessPoolExecutor(jobs) as pool:
            work = [pool.submit(make, seed, i, order, folder) for i, order in enumerate(orders)]
            for done, future in enumerate(work):
                future.result()
                if progress:
                    progress(done + 1, count)
    return [folder / order.name for order in orders]
