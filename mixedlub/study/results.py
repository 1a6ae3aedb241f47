"""The result of a study: arrays labelled by pairing, oil temperature, torque and speed."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.chain.ranges import as_words
from mixedlub.running.version import installed_version
from mixedlub.schema.findings import Finding, as_texts, gravest_first, listed
from mixedlub.schema.result import ResultColumn
from mixedlub.schema.shown import Summarised, span
from mixedlub.schema.table_files import LongTable, write_long
from mixedlub.schema.units import unit_of
from mixedlub.study import batch, checkpoint
from mixedlub.study.columns import (
    CHECKS,
    COLUMNS,
    FIRST,
    FURTHER,
    OF_VALIDITY,
    VALIDITY,
    condition_columns,
    every_column,
    loss_columns,
)
from mixedlub.study.derived import derived
from mixedlub.study.pieces import Block
from mixedlub.study.plan import Study, counted, factors
from mixedlub.study.validity import flags_of, out_of_range
from profiles.errors import InputError, refuse_other

if TYPE_CHECKING:
    import pandas as pd
    import pyarrow as pa
    import xarray as xr

LEVELS = ("oil_temperature_C", "torque_Nm", "speed_rpm")
"""Conditions of a study in the order of the array axes."""
_ROWS = 100_000


SUMMARISED = ("power_loss", "mean_friction", "film_parameter")
"""Outputs with a range in the summary."""
LONGEST_TITLE = 36
"""Largest number of characters of a title in the summary, which must fit a line."""


@dataclass(frozen=True, eq=False)
class Results(Summarised):
    """Outputs of a study in SI by name, each of shape (pairing, oil temperature, torque, speed).

    `to_xarray` and `to_pandas` return them in the units of the table. Printed as a summary:

    >>> import mixedlub as ml
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder) / "polished.toml"
    ...     size = file.write_text('''schema = "mixedlub-study/1"
    ... title = "Polished flanks"
    ... gears = { teeth = [17, 26], normal_module_mm = 4.0, face_width_mm = 14.0 }
    ... surfaces = { polished = { m0_um2 = 4e-4, m2 = 2e-4, m4_per_um2 = 4e-4 } }
    ... conditions = { torque_Nm = [50, 150], speed_rpm = [3000], oil_temperature_C = [80] }
    ... ''')
    ...     results = ml.study.run(file)
    >>> print(repr(results).partition("\\n")[0])
    Results of 'Polished flanks': 1 pairing x 2 torques x 1 speed x 1 oil temperature = 2 rows
    >>> results.to_pandas()["torque_Nm"].tolist(), results["power_loss"].shape
    ([50.0, 150.0], (1, 1, 2, 1))
    >>> [one.code for one in results.findings]
    ['oil_typical', 'boundary_friction_assumed']
    """

    study: Study
    values: Mapping[str, np.ndarray]

    def __repr__(self) -> str:
        title = self.study.file.title
        named = title if len(title) <= LONGEST_TITLE else f"{title[:LONGEST_TITLE]}…"
        levels = self.study.file.conditions
        conditions = (span(name, np.array(getattr(levels, name))) for name in ("torque_Nm", "speed_rpm", LEVELS[0]))
        outputs = (span(c.name, c.of(self[c.output])) for c in FIRST if c.output in SUMMARISED)
        count = int(self.outside.sum())
        outside = f"{count} rows are outside the range of the model: {listed(list(self.flags), 2)}"
        return "\n  ".join(
            (
                f"Results of {named!r}: {' x '.join(factors(self.study))} = {counted(self.study.conditions, 'row')}",
                "; ".join(conditions),
                "; ".join(outputs),
                outside if count else "all rows are within the range of the model",
                f"{counted(len(self.findings), 'finding')}; to_xarray(), to_pandas() and write() give the table",
            )
        )

    @cached_property
    def flags(self) -> Mapping[str, np.ndarray]:
        """Grades of the conditions by code of the finding; 0: within the range of the model."""
        return flags_of(self.study.plan, self.values, self.study.mesh.notes)

    @cached_property
    def outside(self) -> np.ndarray:
        """Whether a condition is outside the range of the model for any reason."""
        return np.logical_or.reduce([np.zeros(self.study.plan.shape, bool), *(g > 0 for g in self.flags.values())])

    @property
    def columns(self) -> tuple[ResultColumn, ...]:
        """Columns of the outputs of this study; the validity follows ``FIRST``."""
        known = (*COLUMNS.values(), *loss_columns(self.study.plan.losing))
        return tuple(column for column in known if column.output in self.values)

    @cached_property
    def findings(self) -> tuple[Finding, ...]:
        """Findings: doubts, conditions outside the range of the model, then assumptions."""
        return tuple(gravest_first((*out_of_range(self), *self.study.notes)))

    def __getitem__(self, name: str) -> np.ndarray:
        """An output in SI by its name in ``values``."""
        return self.values[name]

    def to_xarray(self) -> xr.Dataset:
        """The result as labelled arrays: columns of the table over pairing and conditions, with meanings.

        The attribute ``findings`` lists notes, cautions and doubts as text.
        """
        import xarray as xr

        levels = self.study.file.conditions
        coordinates: dict[str, Any] = {
            "pairing": [f"{a} / {b}" for a, b in self.study.pairings],
            "pinion_surface": ("pairing", [a for a, _ in self.study.pairings]),
            "gear_surface": ("pairing", [b for _, b in self.study.pairings]),
            **{name: (name, list(getattr(levels, name)), {"units": unit_of(name)}) for name in LEVELS},
        }
        checks = [ResultColumn(name, name, CHECKS[name]) for name in batch.CHECKS]
        variables = {
            c.name: (("pairing", *LEVELS), c.of(self.values[c.output]), {"units": c.unit, "long_name": c.meaning})
            for c in (*self.columns, *checks)
        }
        index, texts = as_words(self.flags, self.study.plan.shape)
        variables[VALIDITY] = (
            ("pairing", *LEVELS),
            np.array(texts)[index],
            {"units": "", "long_name": OF_VALIDITY.meaning},
        )
        whole = {"title": self.study.file.title, "findings": as_texts(self.findings)}
        return xr.Dataset(variables, coordinates, whole)

    def to_pandas(self) -> pd.DataFrame:
        """Rows of the table as written by `write`."""
        import pandas as pd

        return pd.concat([table.to_pandas() for table in self.tables()], ignore_index=True)

    def tables(self) -> Iterator[pa.Table]:
        """Rows as tables of bounded size, by pairing."""
        import pyarrow as pa

        levels = self.study.file.conditions
        axes = (levels.oil_temperature_C, levels.torque_Nm, levels.speed_rpm)
        theta, torque, speed = (grid.ravel() for grid in np.meshgrid(*axes, indexing="ij"))
        step = max(1, _ROWS // theta.size)
        index, texts = as_words(self.flags, self.study.plan.shape)
        for start in range(0, len(self.study.pairings), step):
            pairings = self.study.pairings[start : start + step]
            columns = {
                name: checkpoint.words([both[side] for both in pairings], np.arange(len(pairings)).repeat(theta.size))
                for side, name in enumerate(("pinion_surface", "gear_surface"))
            }
            for name, level in (("torque_Nm", torque), ("speed_rpm", speed), ("oil_temperature_C", theta)):
                columns[name] = checkpoint.floats(np.tile(level, len(pairings)))
            for c in self.columns:
                if c.output == FURTHER[0].output:
                    columns[VALIDITY] = checkpoint.words(texts, index[start : start + step].ravel())
                columns[c.name] = checkpoint.floats(c.of(self.values[c.output][start : start + step]))
            yield pa.table(columns)

    def long_table(self) -> LongTable:
        """Rows with metadata for writing."""
        return LongTable(
            self.tables,
            tuple(next(self.tables()).column_names),
            about_table(self.study),
            self.study.needs_quotes,
            (*(c.name for c in condition_columns()), VALIDITY),
        )

    def write(self, csv_path: Path, parquet_path: Path) -> None:
        """Write the rows as CSV and Parquet."""
        write_long(self.long_table(), every_column(self.study.plan.losing), csv_path, parquet_path)


def about_table(study: Study) -> dict[str, str]:
    """Metadata of a table of a study."""
    return {"title": study.file.title, "fingerprint": checkpoint.fingerprint(study.plan), **versions()}


def versions() -> dict[str, str]:
    """Versions of the packages that affect a result."""
    return {"mixedlub": installed_version(), "NumPy": np.__version__, "Python": sys.version.split()[0]}


def run_study(
    study: Study,
    *,
    parts: Path | None = None,
    scheduler: str | None = None,
    threads: int | None = None,
    progress: Callable[[int, int], None] = lambda done, of: None,
) -> Results:
    """Run a study; with a folder for parts, finished blocks are saved, and blocks of an earlier run are reused."""
    refuse_other(study, Study, "ml.study.read_study(...)", "study.run_study: study")
    values: dict[str, np.ndarray] = {}
    todo = batch.blocks(study.plan)
    waiting = {checkpoint.block_name(b): b for b in todo}
    total, done = len(todo), 0
    if total == 1:
        parts = None
    if parts is not None:
        for block, found in checkpoint.kept(parts, todo):
            _fill(values, study.plan.shape, block, found)
            del waiting[checkpoint.block_name(block)]
        done = total - len(waiting)
    progress(done, total)
    for block, found in batch.run(study.plan, list(waiting.values()), scheduler=scheduler, threads=threads):
        if parts is not None:
            checkpoint.keep(parts, block, found)
        _fill(values, study.plan.shape, block, found)
        done += 1
        progress(done, total)
    return _whole(study, values)


def results_of(study: Study, state: Mapping[str, Any]) -> Results:
    """Results of a study from the state of `Plan.model` at all contact points."""
    found = batch.reduced({**study.plan.inputs, **state}, study.plan)
    return _whole(study, {n: np.broadcast_to(values[..., 0], study.plan.shape) for n, values in found.items()})


def _whole(study: Study, values: Mapping[str, np.ndarray]) -> Results:
    """Results including derived outputs; raises an error if an output is not finite."""
    results = Results(study, {**values, **derived(study.plan, study.pair, values)})
    _check_finite(results)
    return results


def _check_finite(results: Results) -> None:
    """Raise an error for inputs at which a law leaves its domain."""
    for column in results.columns:
        wrong = ~np.isfinite(results[column.output])
        if wrong.any():
            p, o, t, s = np.argwhere(wrong)[0]
            levels = results.study.file.conditions
            where = (
                f"{results.study.name}: oil_temperature_C = {levels.oil_temperature_C[o]:g}, "
                f"torque_Nm = {levels.torque_Nm[t]:g}, speed_rpm = {levels.speed_rpm[s]:g}, "
                f"{' / '.join(results.study.pairings[p])}"
            )
            rule = f"no finite {column.output.replace('_', ' ')}; look for a number far out of range"
            raise InputError(rule, where=where)


def _fill(values: dict[str, np.ndarray], shape: tuple[int, ...], block: Block, found: batch.Found) -> None:
    for name, part in found.items():
        values.setdefault(name, np.empty(shape))[block] = part
