"""Files of benches as a user has them, and how well intervals of many runs hold."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.evaluate import EVALUATIONS
from mixedlub.schema.toml_file import to_toml

TO_90 = 2 * 1.645
"""Width of a 90 % interval over the standard deviation."""


def written(folder: Path, method: str, tables: Mapping[str, str], **changed: Any) -> Path:
    """The file of an evaluation with its template's sections, some of them changed, and its tables."""
    given = copy.deepcopy(dict(EVALUATIONS[method].example))
    for name, value in changed.items():
        given[name] = {**given.get(name, {}), **value} if isinstance(value, Mapping) else value
    for name, text in tables.items():
        (folder / name).write_text(text, encoding="utf-8")
    given = {n: {k: v for k, v in s.items() if v is not None} if isinstance(s, dict) else s for n, s in given.items()}
    path = folder / f"{method}.toml"
    path.write_text(to_toml(given), encoding="utf-8")
    return path


def assert_intervals_hold(truth: np.ndarray, value: np.ndarray, low: np.ndarray, high: np.ndarray) -> None:
    """Intervals hold the truth in 85 to 95 % of the runs, and are not much wider than the estimates scatter.

    Of 200 runs a true 90 % gives 85.8 to 94.2 % in two standard deviations; one column of many may lie further out.
    """
    held = ((low < truth) & (truth < high)).mean(axis=0)
    wide = (high - low).mean(axis=0) / (TO_90 * (value - truth).std(axis=0))
    assert 0.85 <= held.mean() <= 0.95, held
    assert np.all((held >= 0.82) & (held <= 0.98)), held
    assert np.all(wide <= 1.5), wide
