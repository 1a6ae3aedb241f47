"""What every battery shares: cards dealt by their weight, readings with noise, and the sealed case folder."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from mixedlub.validation.workers import workers
from profiles.errors import InputError

Card = TypeVar("Card")


def deck(rng: np.random.Generator, cards: Sequence[Card], weights: Sequence[float], count: int) -> list[Card]:
    """``count`` cards in random order: every one in turn as often as its weight says, the rest by chance."""
    due = count * np.array(weights) / np.sum(weights)
    times = np.floor(due).astype(int)
    rest = rng.random(len(cards)) + (due - times) * 4
    for place in np.argsort(-rest)[: count - times.sum()]:
        times[place] += 1
    dealt = [card for card, n in zip(cards, times) for _ in range(n)]
    return [dealt[i] for i in rng.permutation(len(dealt))]


def spread(truth: np.ndarray, relative: float, absolute: float) -> np.ndarray:
    """Standard deviation of readings."""
    return np.asarray(np.sqrt((relative * truth) ** 2 + absolute**2))


def record(
    rng: np.random.Generator, truth: np.ndarray, sd: np.ndarray, visible: np.ndarray, spoiled: bool
) -> tuple[np.ndarray, np.ndarray]:
    """Readings with noise, and the places of those that are wild: a fortieth of the visible ones where so."""
    recorded = truth + sd * rng.standard_normal(len(truth))
    if not spoiled:
        return recorded, np.array([], dtype=int)
    wild = rng.choice(visible, max(1, round(0.025 * len(visible))), replace=False)
    recorded[wild] += rng.uniform(8, 25, len(wild)) * rng.choice([-1.0, 1.0], len(wild)) * sd[wild]
    return recorded, wild


def plain(values: np.ndarray) -> list[float]:
    """Numbers as they are written."""
    return [float(f"{value:.9g}") for value in values]


def rows(run: np.ndarray, hidden: np.ndarray, **columns: np.ndarray) -> dict[str, list[Any]]:
    """The rows of a truth: run numbers, which readings are kept back, and columns of numbers."""
    return {
        "run": [int(number) for number in run],
        "withheld": [bool(flag) for flag in hidden],
        **{name: plain(column) for name, column in columns.items()},
    }


def write(
    place: Path,
    settings: dict[str, Any],
    columns: Mapping[str, np.ndarray],
    readings: Mapping[str, np.ndarray],
    hidden: np.ndarray,
    share: np.ndarray | None,
    answer: dict[str, Any],
) -> None:
    """The case folder as an engineer would hand it in; ``truth.json`` comes last and marks it done."""
    import pandas as pd

    place.mkdir(parents=True, exist_ok=True)
    (place / "system.toml").write_text(toml(settings), encoding="utf-8")
    frame = pd.DataFrame({**columns, **{name: plain(column) for name, column in readings.items()}})
    frame[~hidden].to_csv(place / "recordings.csv", index=False)
    frame[hidden].drop(columns=list(readings)).to_csv(place / "conditions.csv", index=False)
    if share is not None:
        names = ["torque_Nm", "roll_angle_deg", "load_share"]
        pd.DataFrame(share, columns=names).to_csv(place / "load_share.csv", index=False)
    (place / "truth.json").write_text(json.dumps(answer, indent=1), encoding="utf-8")


def toml(settings: dict[str, Any]) -> str:
    """Settings as TOML: plain values first, then tables; enough for case files."""

    def value(item: Any) -> str:
        if isinstance(item, dict):
            return "{ " + ", ".join(f"{k} = {value(v)}" for k, v in item.items()) + " }"
        if isinstance(item, list):
            return "[" + ", ".join(value(v) for v in item) + "]"
        return "inf" if item == float("inf") else json.dumps(item)

    lines = [f"{key} = {value(item)}" for key, item in settings.items() if not isinstance(item, dict)]
    for key, item in settings.items():
        if key == "surfaces":
            for name, surface in item.items():
                lines += ["", f"[surfaces.{name}]", *(f"{k} = {value(v)}" for k, v in surface.items())]
        elif isinstance(item, dict):
            lines += ["", f"[{key}]", *(f"{k} = {value(v)}" for k, v in item.items())]
    return "\n".join(lines) + "\n"


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
    if seal.exists() and json.loads(seal.read_text(encoding="utf-8")) != mark:
        raise InputError("the folder holds a battery of another seed or size", where=str(folder), value=mark)
    seal.write_text(json.dumps(mark), encoding="utf-8")
    seed, count = mark["seed"], len(orders)
    if jobs == 1:
        for done, order in enumerate(orders):
            make(seed, done, order, folder)
            if progress:
                progress(done + 1, count)
    else:
        with workers(jobs) as pool:
            work = [pool.submit(make, seed, i, order, folder) for i, order in enumerate(orders)]
            for done, future in enumerate(work):
                future.result()
                if progress:
                    progress(done + 1, count)
    return [folder / order.name for order in orders]
