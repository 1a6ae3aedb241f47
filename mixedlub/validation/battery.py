"""A battery of blind cases, fixed by its seed: the same seed writes the same bytes."""

from __future__ import annotations

import json
import signal
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from mixedlub.validation.answers import IDENTIFIABLE
from mixedlub.validation.case_folder import plain, rows, write
from mixedlub.validation.planted import MEASUREMENT, MIMICS
from mixedlub.validation.rig import Case, Rig
from mixedlub.validation.rigs import CLASSES, CONTACTS, FAMILIES, KINDS, Family, Partners, family_of
from mixedlub.validation.rivals import Target, best, rivals
from mixedlub.validation.sample_case import HEAVY, LASTING, SD_ESTIMATED, Order, Sample, sample_case
from mixedlub.validation.solved.world import SWITCHES
from mixedlub.validation.worlds.misfit import told
from profiles.errors import InputError

RIGS_SURVEYED = 60
"""Rigs drawn per kind to list the effects that can be planted on it."""
MARK = "battery.json"
"""File of the seed, kinds, size and planner of a battery, beside its cases."""
Card = TypeVar("Card")


def deck(rng: np.random.Generator, cards: Sequence[Card], weights: Sequence[float], count: int) -> list[Card]:
    """``count`` cards in random order, each in proportion to its weight, the remainder by chance."""
    due = count * np.array(weights) / np.sum(weights)
    times = np.floor(due).astype(int)
    order = rng.random(len(cards)) + (due - times) * 4
    for index in np.argsort(-order)[: count - times.sum()]:
        times[index] += 1
    dealt = [card for card, n in zip(cards, times) for _ in range(n)]
    return [dealt[i] for i in rng.permutation(len(dealt))]


Survey = tuple[dict[str, float], dict[str, float]]
"""Effects that can be planted on rigs of a kind, inside and outside the catalogue, with their weights."""


def drawn_rigs(kind: str, seed: int) -> list[Rig]:
    """Rigs of a kind drawn to list the effects that can be planted on them."""
    rng = np.random.default_rng([seed, 21])
    return [KINDS[kind].draw(rng) for _ in range(RIGS_SURVEYED)]


def surveyed(drawn: Sequence[Rig]) -> Survey:
    """Effects that can be planted on the drawn rigs."""
    named = {form.id: form.rarity for rig in drawn for form in rig.forms if form.rarity > 0}
    outside = {form.id: form.rarity for rig in drawn for form in rig.outside}
    return dict(sorted(named.items())), dict(sorted(outside.items()))


Content = tuple[str, str, tuple[str, ...]]
"""Class, kind and planted effects of a case."""


def contents(
    rng: np.random.Generator,
    family: Family,
    cases: int,
    surveys: Mapping[str, Survey],
    partners_of: Mapping[str, Sequence[Partners]],
) -> list[Content]:
    """Contents of the cases of a family, class by class."""
    counts = {label: max(1, int(share * cases)) for label, share in family.classes.items()}
    counts["single"] += cases - sum(counts.values())
    pools: dict[str, dict[tuple[str, str], float]] = {"single": {}, "measurement": {}, "unknown": {}}
    for kind in family.kinds:
        named, outside = surveys[kind]
        for name, weight in named.items():
            pools["measurement" if name in MEASUREMENT else "single"][kind, name] = weight
        pools["unknown"] |= {(kind, name): weight for name, weight in outside.items()}
    contents: list[Content] = [("none", family.kinds[i % len(family.kinds)], ()) for i in range(counts["none"])]
    for label, pool in pools.items():
        dealt = deck(rng, list(pool), list(pool.values()), counts[label])
        contents += [(label, kind, (name,)) for kind, name in dealt]
    pairs = [(kind, first, partners) for kind in family.kinds for first, partners, _ in partners_of[kind]]
    weights = [weight for kind in family.kinds for *_, weight in partners_of[kind]]
    for kind, first, partners in deck(rng, pairs, weights, counts["pair"]):
        contents.append(("pair", kind, (first, partners[int(rng.integers(len(partners)))])))
    return contents


def ordered(rng: np.random.Generator, family: Family, dealt: Sequence[Content]) -> list[Order]:
    """Orders of cases with the dealt contents: some small, some with outliers, some without a data sheet."""
    orders = []
    for index, (label, kind, effects) in enumerate(dealt):
        small = label in ("none", "single") and rng.random() < family.small
        clear = small or index % 2 == 0 or label == "pair"
        # Every third case of a kind whose oil may have no data sheet, unless its effects could then not be seen.
        third = KINDS[kind].draw_without_data_sheet is not None and index % 3 == 1
        orders.append(
            Order(
                name="",
                kind=kind,
                label=label,
                effects=effects,
                level="clear" if clear else "faint",
                outliers=bool(rng.random() < family.outliers[label]),
                no_data_sheet=third and not KINDS[kind].needs_data_sheet & set(effects),
                small=small,
            )
        )
    return orders


def _orders(rng: np.random.Generator, family: Family, seed: int, cases: int) -> list[Order]:
    surveys = {kind: surveyed(drawn_rigs(kind, seed)) for kind in family.kinds}
    partners = {kind: KINDS[kind].pairs for kind in family.kinds}
    return ordered(rng, family, contents(rng, family, cases, surveys, partners))


def families(kinds: Sequence[str]) -> list[Family]:
    """Families restricted to the chosen kinds."""
    chosen = [replace(family, kinds=tuple(k for k in family.kinds if k in kinds)) for family in FAMILIES]
    return [family for family in chosen if family.kinds]


def fewest(kinds: Sequence[str]) -> int:
    """Smallest number of cases in a battery of the kinds: each class once per family."""
    return len(CLASSES) * len(families(kinds))


def sizes(rng: np.random.Generator, chosen: Sequence[Family], cases: int, least: int) -> list[int]:
    """Cases per family, at least ``least``; half of the rest go to gears and discs if other families are chosen too."""
    weights = [max(len(chosen) - 1.0, 1.0) if set(family.kinds) & set(CONTACTS) else 1.0 for family in chosen]
    each = [least] * len(chosen)
    for index in deck(rng, range(len(chosen)), weights, cases - least * len(chosen)):
        each[index] += 1
    return each


def plan(seed: int, cases: int, kinds: Sequence[str] = CONTACTS) -> list[Order]:
    """Orders of a battery: families equally often, classes in fixed shares, in random order under neutral names."""
    if cases < fewest(kinds):
        raise InputError(f"a battery of these kinds has at least {fewest(kinds)} cases", where="cases", value=cases)
    chosen = families(kinds)
    rng = np.random.default_rng([seed, 1])
    each = [cases // len(chosen) + (index < cases % len(chosen)) for index in range(len(chosen))]
    orders = [order for family, count in zip(chosen, each) for order in _orders(rng, family, seed, count)]
    return shuffled(rng, orders)


def shuffled(rng: np.random.Generator, orders: Sequence[Order]) -> list[Order]:
    """Orders in random order under neutral names."""
    return [replace(orders[i], name=f"case_{n:03d}") for n, i in enumerate(rng.permutation(len(orders)))]


def errors(rng: np.random.Generator, count: int, flaws: Sequence[str]) -> np.ndarray:
    """Errors of readings in recording order, over their standard deviation."""
    white = rng.standard_normal(count)
    if HEAVY in flaws:
        white = rng.standard_t(3, count) / np.sqrt(3.0)
    if LASTING not in flaws:
        return white
    from scipy.signal import lfilter

    share, memory = rng.uniform(0.3, 0.8), np.exp(-1.0 / np.exp(rng.uniform(np.log(3.0), np.log(20.0))))
    kicks = np.sqrt(1.0 - memory**2) * rng.standard_normal(count)
    kicks[0] /= np.sqrt(1.0 - memory**2)
    return np.asarray(np.sqrt(1.0 - share) * white + np.sqrt(share) * lfilter([1.0], [1.0, -memory], kicks))


def record(
    rng: np.random.Generator,
    truth: np.ndarray,
    sd: np.ndarray,
    visible: np.ndarray,
    spoiled: bool,
    flaws: Sequence[str] = (),
) -> tuple[np.ndarray, np.ndarray]:
    """Readings with noise, and the rows of outliers: 2.5 % of the visible readings if ``spoiled``."""
    recorded = truth + sd * errors(rng, len(truth), flaws)
    if not spoiled:
        return recorded, np.array([], dtype=int)
    wild = rng.choice(visible, max(1, round(0.025 * len(visible))), replace=False)
    recorded[wild] += rng.uniform(8, 25, len(wild)) * rng.choice([-1.0, 1.0], len(wild)) * sd[wild]
    return recorded, wild


def noise_stated(
    rng: np.random.Generator, sample: Sample, sd: np.ndarray, sd_column: float, flaws: Sequence[str] = ()
) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Statement of the noise in the case: settings, an sd column, or repeats alone."""
    if SD_ESTIMATED in flaws:
        return _noise_estimated(rng, sample, sd)
    if sample.rig.repeats and rng.random() < 0.7:
        return {}, {}
    if rng.random() < sd_column:
        return {}, {f"{sample.rig.quantity}_sd": sd}
    return {"noise": {"relative": sample.relative, "absolute": sample.absolute}}, {}


def _noise_estimated(
    rng: np.random.Generator, sample: Sample, sd: np.ndarray
) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Noise stated as estimated from a few repeats, per reading or for all readings together."""
    free = int(rng.integers(2, 6))
    if rng.random() < 0.5:
        return {}, {f"{sample.rig.quantity}_sd": sd * np.sqrt(rng.chisquare(free, len(sd)) / free)}
    factor = float(np.sqrt(rng.chisquare(free) / free))
    stated = {"relative": sample.relative, "absolute": sample.absolute}
    return {"noise": {name: float(f"{factor * value:.4g}") for name, value in stated.items()}}, {}


def weighed(sample: Sample, label: str) -> tuple[dict[str, float], float]:
    """Least chi-square of every rival explanation and of the truth."""
    rig, forms, knobs, z = sample.rig.nature, sample.forms, sample.knobs, sample.z
    visible = np.flatnonzero(~sample.hidden)
    truth = rig.records(z, sample.acts)
    target = Target(rig, visible, truth[visible], sample.sd(truth)[visible])
    rank = 2 if label == "unknown" else max((form.rank for form in forms), default=0)
    # Balances of load are slow, and no figure of their batteries asks whether a pair can be told from another.
    others = rivals(target, forms, knobs, z, rank, exchanged=not sample.world)
    if label == "none":
        return others, others["none"]
    if rig.planted is not None:
        return others, min(best(target, forms, z, known).chi_square for known in (knobs, ()))
    planted = float(z @ z)
    return others, planted if label == "unknown" else min(planted, best(target, forms, z, knobs).chi_square)


def identifiable(sample: Sample, others: dict[str, float], planted: float) -> bool:
    """Whether no rival comes near the truth; without effects, whether none is better if the model is inexact."""
    least = min(others.values()) - planted
    if sample.forms:
        return least > IDENTIFIABLE
    return sample.rig.planted is None or least > -IDENTIFIABLE


def truth_of(order: Order, sample: Sample, outliers: Sequence[int]) -> dict[str, Any]:
    """Content of ``truth.json``: planted effects, calibration, noise, and fits of the rivals."""
    rig, z = sample.rig.refined, sample.z
    truth = rig.records(z, sample.acts)
    others, planted = weighed(sample, order.label)
    info = [
        {
            "id": form.id,
            "form": form.source,
            "law": form.law.__name__,
            "within": form.within,
            "snr": round(sample.visibility, 4),
            **values,
        }
        for form, values in zip(sample.forms, sample.knobs)
    ]
    return {
        "case": order.name,
        "rig": order.kind,
        "class": order.label,
        "effects": list(order.effects),
        "label": "none" if not order.effects else ["unknown"] if order.label == "unknown" else list(order.effects),
        "info": info,
        "level": order.level if order.effects else "none",
        "small": order.small,
        **({"flaws": list(order.flaws)} if order.flaws else {}),
        **(_of_full_physics(order) if order.solved else {}),
        "mimic": bool(set(order.effects) & MIMICS),
        "unnamed_oil": order.no_data_sheet,
        "theta": rig.theta(z),
        "z": dict(zip(rig.names, plain(z))),
        "noise": {"relative": sample.relative, "absolute": sample.absolute},
        "outliers": sorted(int(rig.columns["run"][row]) for row in outliers),
        "alternatives": others,
        "own": round(planted, 4),
        "identifiable": identifiable(sample, others, planted),
        **(told(sample.seen, sample.world) if sample.world else {}),
        "rows": rows(
            rig.columns["run"],
            sample.hidden,
            truth=truth,
            base=rig.records(z, ()),
            nominal=rig.model(np.zeros(len(z)), ()),
            sd=sample.sd(truth),
            **({"beyond": beyond(rig.columns, sample.hidden)} if order.beyond else {}),
        ),
    }


def beyond(columns: Mapping[str, np.ndarray], hidden: np.ndarray) -> np.ndarray:
    """Readings with a numeric condition beyond the visible ones.

    >>> load = {"load_N": np.array([10.0, 20.0, 30.0])}
    >>> beyond(load, np.array([False, False, True])).tolist()
    [0.0, 0.0, 1.0]
    """
    found = np.zeros(hidden.size)
    for name, values in columns.items():
        if name not in ("run", "sequence", "time_s") and values.dtype != object:
            seen = values[~hidden]
            found[(values < seen.min()) | (values > seen.max())] = 1.0
    return found


def _of_full_physics(order: Order) -> dict[str, Any]:
    """Entries of the truth about a rig of full physics."""
    beside = list(SWITCHES[order.solved].beside)
    return {"solved": order.solved, "full_base": order.full_base, "beside": beside}


def make(seed: int, index: int, order: Order, folder: Path) -> str:
    """Draw one case and write its folder with the truth; a complete folder is left unchanged."""
    case_folder = folder / order.name
    if (case_folder / "truth.json").exists():
        return order.name
    rng = np.random.default_rng([seed, 2, index])
    sample = sample_case(rng, order)
    rig = sample.rig.refined
    truth = rig.records(sample.z, sample.acts)
    sd = sample.sd(truth)
    recorded, outliers = record(rng, truth, sd, np.flatnonzero(~sample.hidden), order.outliers, order.flaws)
    recorded = recorded if rig.least is None else np.maximum(recorded, rig.least * truth)
    stated, more = noise_stated(rng, sample, sd, family_of(order.kind).sd_column, order.flaws)
    counted = rig.settle(rig.records(sample.z, [act for act in sample.acts if act.stage != "sensor"]))
    settings = {**rig.settings, "recording": {**rig.settings["recording"], **stated}}
    case = Case(settings=settings, columns={**rig.columns, **counted}, share=rig.share)
    readings = {rig.quantity: recorded, **more}
    write(case_folder, case, readings, sample.hidden, truth_of(order, sample, list(outliers)))
    return order.name


@contextmanager
def workers(jobs: int) -> Iterator[ProcessPoolExecutor]:
    """A pool of processes; an error here cancels all work that has not begun."""
    with ProcessPoolExecutor(jobs, initializer=_stop_at_once) as pool:
        try:
            yield pool
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


def _stop_at_once() -> None:
    """End a worker silently on Ctrl-C, even within a case, which is made again when the run is resumed."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def read_mark(folder: Path) -> dict[str, Any]:
    """Kinds, seed, size and planner of the battery in a folder; a file without planner is of ``plan``."""
    file = folder / MARK
    if not file.exists():
        raise InputError(f"{MARK}, which names the battery, is missing", where=str(folder))
    try:
        mark = json.loads(file.read_text(encoding="utf-8"))
    except ValueError:
        mark = None
    if not isinstance(mark, dict) or not isinstance(mark.get("dealt_by", ""), str):
        raise InputError("damaged: a JSON object is needed, with a name as dealt_by", where=str(file))
    return {"dealt_by": plan.__name__, **mark}


def generate(
    folder: Path,
    seed: int,
    cases: int = 240,
    kinds: Sequence[str] = CONTACTS,
    jobs: int = 1,
    progress: Callable[[int, int], None] | None = None,
    dealt: Callable[[int, int, Sequence[str]], list[Order]] = plan,
) -> list[Path]:
    """Write the missing cases of a battery into a folder; returns the case folders."""
    orders = dealt(seed, cases, kinds)
    folder.mkdir(parents=True, exist_ok=True)
    mark, file = {"kinds": list(kinds), "seed": seed, "cases": cases, "dealt_by": dealt.__name__}, folder / MARK
    if file.exists() and read_mark(folder) != mark:
        rule = "the folder holds a battery of other kinds, seed, size or planner"
        raise InputError(rule, where=str(folder), value=mark)
    file.write_text(json.dumps(mark), encoding="utf-8")
    report = progress or (lambda done, total: None)
    if jobs == 1:
        for index, order in enumerate(orders):
            make(seed, index, order, folder)
            report(index + 1, len(orders))
    else:
        with workers(jobs) as pool:
            for done, future in enumerate(
                [pool.submit(make, seed, i, order, folder) for i, order in enumerate(orders)]
            ):
                future.result()
                report(done + 1, len(orders))
    return [folder / order.name for order in orders]
