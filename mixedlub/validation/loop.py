"""Campaigns on rigs of known truth: proposed next readings against random ones and the corners of the recording.

Small recordings are diagnosed. Where the answer is a tie, unknown or wrong, each way to choose readings is played: the
rig is read there, and the recording with these readings is diagnosed again.
"""

from __future__ import annotations

import itertools
import json
import shutil
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.validation.battery import plan, record
from mixedlub.validation.case_folder import plain, read_columns, write
from mixedlub.validation.intervals import interval
from mixedlub.validation.rig import Case, Rig
from mixedlub.validation.rigs import CONTACTS, discs, gears
from mixedlub.validation.run import Diagnose, Progress, answer, quiet, unsealed
from mixedlub.validation.sample_case import Order, Sample, sample_case
from profiles.errors import InputError

Add = Callable[[Path, Path, Path, Path], object]
"""A diagnosis with added readings: case folder, filled-in file, earlier answer, folder for the new answer."""
REBUILT: dict[str, Callable[[Case], Rig]] = {"gear_pair": gears.rig_of, "disc": discs.rig_of}
PROPOSED, RANDOM, CORNERS = "proposed", "random", "corners"
WAYS = (PROPOSED, RANDOM, CORNERS)
STEP = 1e-6
"""Distance of two added readings in the programme."""
FLOOR = 1e-6
"""Least probability in log odds."""
DEALT_FOR_ONE = 6
"""Cases dealt for every campaign: most answers are settled and right."""


@dataclass(frozen=True)
class Standing:
    """Log odds of the truth, and whether the answer is settled, right, and holds the truth among its ties."""

    log_odds: float
    settled: bool
    right: bool
    tied: bool


def standing(record: Mapping[str, Any], label: Sequence[str]) -> Standing:
    """Standing of the truth in a `diagnosis.json`; of several effects the least probable counts."""
    chance = min(float(record["probabilities"].get(name, FLOOR)) for name in label)
    chance = float(np.clip(chance, FLOOR, 1.0 - FLOOR))
    tied = [set(one) for one in record["tied"]]
    right = set(record["verdict"]) == set(label)
    return Standing(float(np.log(chance / (1.0 - chance))), len(tied) == 1, right, set(label) in tied)


def orders(seed: int, campaigns: int, kinds: Sequence[str] = CONTACTS) -> list[Order]:
    """Small recordings with something missing, without outliers."""
    dealt = plan(seed, max(DEALT_FOR_ONE * campaigns, 10), kinds)
    return [replace(one, small=True, outliers=False) for one in dealt if one.label != "none"]


def _sample(seed: int, index: int, order: Order) -> tuple[np.random.Generator, Sample]:
    rng = np.random.default_rng([seed, 5, index])
    return rng, sample_case(rng, order)


def _deal(seed: int, index: int, order: Order, folder: Path) -> tuple[Sample, tuple[str, ...]]:
    """Write a case unless it is there; returns its sample and the label of its truth."""
    rng, sample = _sample(seed, index, order)
    label = ("unknown",) if order.label == "unknown" else tuple(sorted(order.effects))
    rig = sample.rig.refined
    truth = rig.records(sample.z, sample.acts)
    recorded, _ = record(rng, truth, sample.sd(truth), np.flatnonzero(~sample.hidden), False)
    if not (folder / "truth.json").exists():
        stated = {"noise": {"relative": sample.relative, "absolute": sample.absolute}}
        settings = {**rig.settings, "recording": {**rig.settings["recording"], **stated}}
        case = Case(settings=settings, columns=rig.columns, share=rig.share)
        told = {"label": list(label), "class": order.label, "kind": order.kind}
        write(folder, case, {rig.quantity: recorded}, sample.hidden, told)
    return sample, label


def read(sample: Sample, new: Mapping[str, np.ndarray], rng: np.random.Generator) -> np.ndarray:
    """Noisy readings of a rig at new conditions, at the end of its programme."""
    rig, count = sample.rig, len(next(iter(new.values())))
    every = {**new, "run": np.arange(count), "sequence": np.ones(count)}
    columns = {name: np.concatenate([values, every[name]]) for name, values in rig.columns.items()}
    there = REBUILT[rig.kind](Case(settings=rig.settings, columns=columns, share=rig.share))
    there = replace(there, followed=rig.followed).refined
    truth = there.records(sample.z, sample.acts)[-count:]
    return np.asarray(truth + sample.sd(truth) * rng.standard_normal(count))


def conditions(columns: Mapping[str, np.ndarray]) -> list[str]:
    """Columns of the conditions that are set."""
    return [name for name in columns if name not in ("run", "sequence")]


def chosen(way: str, recorded: Mapping[str, np.ndarray], count: int, rng: np.random.Generator) -> dict[str, np.ndarray]:
    """Conditions at random recorded levels or at the ends of the recorded ranges, on recorded pairs of surfaces."""
    names = conditions(recorded)
    surfaces = [name for name in names if "surface" in name]
    pairs = sorted({*zip(*(recorded[name] for name in surfaces))})
    rest = [name for name in names if name not in surfaces]
    levels = [np.unique(recorded[name].astype(float)) for name in rest]
    levels = [each[[0, -1]] if way == CORNERS else each for each in levels]
    grid = [(*pair, *row) for pair in pairs for row in itertools.product(*levels)]
    picked = [grid[i] for i in rng.choice(len(grid), count, replace=len(grid) < count)]
    columns = dict(zip((*surfaces, *rest), zip(*picked)))
    return {name: np.array(columns[name], dtype=object if name in surfaces else float) for name in names}


def _appended(case: Path, target: Path, new: Mapping[str, np.ndarray], quantity: str, values: np.ndarray) -> None:
    """Copy of a case with more readings at the end of its programme."""
    import pandas as pd

    shutil.rmtree(target, ignore_errors=True)
    shutil.copytree(case, target)
    frame = pd.read_csv(case / "recordings.csv")
    frame["sequence"] *= 1.0 - STEP * len(values)
    rows = pd.DataFrame({**new, quantity: plain(values)})
    rows["sequence"] = 1.0 - STEP * np.arange(len(rows))[::-1]
    rows["run"] = _free_run(case) + np.arange(len(rows))
    pd.concat([frame, rows[frame.columns]], ignore_index=True).to_csv(target / "recordings.csv", index=False)


def _free_run(case: Path) -> int:
    return 1 + max(int(read_columns(case / f"{name}.csv")["run"].max()) for name in ("recordings", "conditions"))


def _record(folder: Path, name: str = "diagnosis.json") -> dict[str, Any]:
    return dict(json.loads((folder / name).read_text(encoding="utf-8")))


@dataclass(frozen=True)
class Loop:
    """Folder, seed and tool of the campaigns."""

    out: Path
    seed: int
    diagnose: Diagnose
    add: Add

    def campaign(self, index: int, order: Order) -> dict[str, Any] | None:
        """Play every way on one rig; None for a settled and right answer. A finished campaign is read."""
        result = self.out / "campaigns" / f"{order.name}.json"
        if result.exists():
            return json.loads(result.read_text(encoding="utf-8")) or None
        sample, label = _deal(self.seed, index, order, self.out / "sealed" / order.name)
        (self.out / "cases").mkdir(parents=True, exist_ok=True)
        case = unsealed(self.out / "sealed" / order.name, self.out / "cases")
        first = self.out / "answers" / order.name
        answer(self.diagnose, case, first)
        begun = _record(first)
        before = standing(begun, label)
        told: dict[str, Any] = {}
        if not (before.settled and before.right):
            told = {"case": order.name, "kind": order.kind, "label": list(label), "before": vars(before)}
            told |= {way: self._played(way, index, sample, label, case, first) for way in WAYS}
            told["expected_bits"] = begun["next_batch"]["expected_bits"]
            told["readings"] = begun["next_batch"]["readings"]
        result.parent.mkdir(parents=True, exist_ok=True)
        result.write_text(json.dumps(told, indent=1), encoding="utf-8")
        return told or None

    def _played(
        self, way: str, index: int, sample: Sample, label: Sequence[str], case: Path, first: Path
    ) -> dict[str, Any]:
        """Standing after the readings of one way."""
        import pandas as pd

        rng = np.random.default_rng([self.seed, 6, index, WAYS.index(way)])
        batch = pd.read_csv(first / "next_tests.csv")
        recorded, quantity = read_columns(case / "recordings.csv"), sample.rig.quantity
        into = self.out / way / case.name
        if way == PROPOSED:
            names = conditions(sample.rig.columns)
            new = {name: batch[name].to_numpy(dtype=object if "surface" in name else float) for name in names}
            batch[quantity] = plain(read(sample, new, rng))
            into.parent.mkdir(parents=True, exist_ok=True)
            file = into.with_name(f"{case.name}.csv")
            batch.to_csv(file, index=False)
            answer(lambda folder, out: self.add(folder, file, first, out), case, into)
            bits = {key: _record(into, "campaign.json")[key] for key in ("expected_bits", "realised_bits")}
        else:
            new = chosen(way, {k: v for k, v in recorded.items() if k != quantity}, len(batch), rng)
            target = self.out / f"{way}_cases" / case.name
            _appended(case, target, new, quantity, read(sample, new, rng))
            answer(self.diagnose, target, into)
            bits = {}
        return {**vars(standing(_record(into), label)), **bits}


def play(
    out: Path,
    diagnose: Diagnose,
    add: Add,
    campaigns: int,
    seed: int,
    kinds: Sequence[str] = CONTACTS,
    progress: Progress = quiet,
) -> str:
    """Play campaigns into ``out`` and return the score as text; a stopped run is resumed."""
    if not set(kinds) <= set(REBUILT):
        raise InputError(f"campaigns are played on {' and '.join(REBUILT)}", where="kinds", value=list(kinds))
    loop, found = Loop(out, seed, diagnose, add), list[dict[str, Any]]()
    for index, order in enumerate(orders(seed, campaigns, kinds)):
        if len(found) == campaigns:
            break
        told = loop.campaign(index, order)
        found += [] if told is None else [told]
        progress("campaigns", len(found), campaigns)
    text = "\n".join(table(found)) + "\n"
    (out / "score.txt").write_text(text, encoding="utf-8")
    (out / "score.json").write_text(json.dumps(found, indent=1), encoding="utf-8")
    return text


def _figure(values: Sequence[float], reduction: str) -> str:
    """A mean or share with its 90 % interval."""
    each = np.array(values, dtype=float)
    if not each.size:
        return "-"
    low, high = interval(each, np.ones(each.size), reduction)
    return f"{each.mean():.2f} [{low:.2f}, {high:.2f}]"


def table(found: Sequence[Mapping[str, Any]]) -> Iterator[str]:
    """Score of the campaigns, one column a way."""
    yield f"{len(found)} campaigns from ties, unknowns and misses; 90 % intervals"
    yield f"{'':34s}" + "".join(f"{way:>22s}" for way in WAYS)
    rows: dict[str, Callable[[Mapping[str, Any], Mapping[str, Any]], float | None]] = {
        "change of log odds of the truth": lambda before, after: after["log_odds"] - before["log_odds"],
        "settled": lambda before, after: float(after["settled"]),
        "settled and right": lambda before, after: float(after["settled"] and after["right"]),
        "truth lost from the tie": lambda before, after: float(before["tied"] and not after["tied"]),
        "truth gained": lambda before, after: float(after["tied"] and not before["tied"]),
    }
    for text, measure in rows.items():
        cells = []
        for way in WAYS:
            values = [measure(one["before"], one[way]) for one in found]
            cells.append(_figure([v for v in values if v is not None], "mean" if "change" in text else "share"))
        yield f"{text:34s}" + "".join(f"{cell:>22s}" for cell in cells)
    for key in ("expected_bits", "realised_bits"):
        yield f"{key.replace('_', ' '):34s}{_figure([one[PROPOSED][key] for one in found], 'mean'):>22s}"
    told = [(one[PROPOSED]["log_odds"] - one["before"]["log_odds"]) / np.log(2.0) for one in found]
    yield f"{'change of log odds, in bits':34s}{_figure(told, 'mean'):>22s}"
