"""Tables of an experiment: rows of a full factorial, runs of a random design, indices, interactions, main effects."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from mixedlub.schema.result import ResultColumn
from mixedlub.schema.units import unit_of
from mixedlub.study import sensitivity
from mixedlub.study.columns import VALID, VALIDITY, every_column
from mixedlub.study.factor_file import Factors
from mixedlub.study.factor_parts import in_chunks
from mixedlub.study.factor_runs import Experiment, Run, axes, mean_responses, refuse_too_many, response_of
from mixedlub.study.results import run_study
from mixedlub.study.sensitivity import Indices, MainEffect

Progress = Callable[[int, int], None]
OF_INDICES = (
    ResultColumn("factor", "factor", "what is varied", given_unit="text"),
    ResultColumn("first", "first_order", "share of the variance of the response that the factor decides alone"),
    ResultColumn("first_low", "first_order_low95", "lower end of its 95 % interval; random designs"),
    ResultColumn("first_high", "first_order_high95", "upper end of its 95 % interval; random designs"),
    ResultColumn("total", "total", "share of the variance in which the factor takes part, alone or with others"),
    ResultColumn("total_low", "total_low95", "lower end of its 95 % interval; random designs"),
    ResultColumn("total_high", "total_high95", "upper end of its 95 % interval; random designs"),
)
"""Columns of ``indices.csv``: Sobol' indices."""
OF_INTERACTIONS = (
    ResultColumn("factor_1", "factor_1", "one of two factors", given_unit="text"),
    ResultColumn("factor_2", "factor_2", "the other one", given_unit="text"),
    ResultColumn("share", "share", "share of the variance that both decide only together"),
)
"""Columns of ``interactions.csv`` of a full factorial."""
OF_MAIN_EFFECTS = (
    ResultColumn("factor", "factor", "what is varied", given_unit="text"),
    ResultColumn("level", "level", "its level, or the middle of a range of it", given_unit="that of the factor"),
    ResultColumn("mean", "mean", "mean response at that level", given_unit="that of the response"),
    ResultColumn("difference", "difference", "that less the mean of all runs", given_unit="that of the response"),
    ResultColumn("count", "count", "responses behind it"),
)
"""Columns of ``main_effects.csv``."""
OUTSIDE = "share_out_of_range"
"""Column of ``runs.csv``: share of the conditions of a run outside the model's range."""


@dataclass(frozen=True, eq=False)
class Decided:
    """Indices, interactions and main effects of the factors by name."""

    response: str
    unit: str
    names: tuple[str, ...]
    mean: float
    indices: Indices
    interactions: Mapping[tuple[int, int], float]
    main_effects: Mapping[str, MainEffect]

    def tables(self) -> dict[str, pd.DataFrame]:
        """Tables by file name."""
        none = np.full((2, len(self.names)), np.nan)
        first = none if self.indices.first_ends is None else self.indices.first_ends
        total = none if self.indices.total_ends is None else self.indices.total_ends
        values = (self.names, self.indices.first, *first, self.indices.total, *total)
        rows = [
            (name, level, mean, mean - self.mean, count)
            for name, effect in self.main_effects.items()
            for level, mean, count in zip(effect.levels, effect.mean, effect.count, strict=True)
        ]
        found = {
            "indices": pd.DataFrame(dict(zip((c.name for c in OF_INDICES), values, strict=True))),
            "main_effects": pd.DataFrame(rows, columns=[c.name for c in OF_MAIN_EFFECTS]),
        }
        if self.interactions:
            pairs = [(self.names[a], self.names[b], share) for (a, b), share in self.interactions.items()]
            found["interactions"] = pd.DataFrame(pairs, columns=[c.name for c in OF_INTERACTIONS])
        return found


def factor_columns(experiment: Experiment) -> list[ResultColumn]:
    """Columns of the levels of the factors."""
    fields = Factors.model_fields
    return [
        ResultColumn("", _column(name), fields[name].description or "", given_unit=unit_of(name) or "text")
        for name in experiment.levels
    ]


def table_columns(experiment: Experiment) -> dict[str, list[ResultColumn]]:
    """Columns of every table of an experiment."""
    levels, design = factor_columns(experiment), experiment.file.design
    response = ResultColumn("", design.response, "mean response of the run")
    runs = [
        ResultColumn("", "run", "number of the run"),
        *levels,
        response,
        ResultColumn("", OUTSIDE, "share of its conditions that are outside the model's range"),
    ]
    rows = {"runs": runs} if design.random else {"results": [*levels, *every_column(["EFFECT"])]}
    others = {"indices": OF_INDICES, "interactions": OF_INTERACTIONS, "main_effects": OF_MAIN_EFFECTS}
    return {**rows, **{name: list(columns) for name, columns in others.items()}}


def _column(name: str) -> str:
    """Column of a factor; the prefix distinguishes it from a condition of the same name.

    >>> _column("oil")
    'factor_oil'
    """
    return f"factor_{name}"


def full_factorial(
    experiment: Experiment, progress: Progress = lambda done, of: None, parts: Path | None = None
) -> tuple[pd.DataFrame, Decided]:
    """Rows of all runs and the influence of the factors, including pairings and conditions.

    With a folder for parts, finished chunks are saved, and chunks of an earlier run are reused.
    """

    def rows_of(runs: Sequence[Run]) -> pd.DataFrame:
        tables = []
        for run in runs:
            found = run_study(experiment.study(run))
            response_of(experiment, found)
            rows = found.to_pandas()
            for place, (name, level) in enumerate(run.items()):
                rows.insert(place, _column(name), level)
            tables.append(rows)
        return pd.concat(tables, ignore_index=True)

    refuse_too_many(experiment)
    table = in_chunks(experiment, rows_of, parts, progress)
    named = axes(experiment, experiment.study(experiment.runs[0]))
    response = table[experiment.file.design.response].to_numpy()
    grid = response.reshape([len(levels) for levels in named.values()])
    effects = {name: sensitivity.main_effect_of_grid(grid, i, levels) for i, (name, levels) in enumerate(named.items())}
    decided = _decided(experiment, grid, sensitivity.of_grid(grid), sensitivity.interactions(grid), effects)
    return table, decided


def random_design(
    experiment: Experiment, progress: Progress = lambda done, of: None, parts: Path | None = None
) -> tuple[pd.DataFrame, Decided]:
    """The runs with their mean responses and the influence of the factors; ``parts`` as in `full_factorial`."""
    design = experiment.file.design
    assert design.runs is not None

    def rows_of(runs: Sequence[Run]) -> pd.DataFrame:
        return pd.DataFrame(dict(zip(("response", OUTSIDE), mean_responses(experiment, runs), strict=True)))

    found_rows = in_chunks(experiment, rows_of, parts, progress)
    response, outside = (found_rows[name].to_numpy() for name in ("response", OUTSIDE))
    runs = pd.DataFrame(experiment.runs)
    base = 2 * design.runs
    effects = {
        name: sensitivity.main_effect_of_samples(response[:base], runs[name][:base].tolist()) for name in runs.columns
    }
    found = sensitivity.of_samples(response, design.runs, design.seed)
    runs = runs.rename(columns=_column)
    runs.insert(0, "run", np.arange(1, len(runs) + 1))
    runs[design.response] = response
    runs[OUTSIDE] = outside
    return runs, _decided(experiment, response[:base], found, {}, effects)


def _decided(
    experiment: Experiment,
    response: np.ndarray,
    indices: Indices,
    together: Mapping[tuple[int, int], float],
    effects: Mapping[str, MainEffect],
) -> Decided:
    name = experiment.file.design.response
    return Decided(name, unit_of(name) or "-", tuple(effects), float(response.mean()), indices, together, effects)


def share_out_of_range(table: pd.DataFrame) -> float:
    """Share of the conditions of all runs outside the model's range."""
    return float(table[OUTSIDE].mean() if OUTSIDE in table else (table[VALIDITY] != VALID).mean())
