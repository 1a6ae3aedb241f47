"""The result of a study: arrays labelled by pairing, oil temperature, torque and speed."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.chain.quantities import GLOSSARY
from mixedlub.schema.findings import Finding, as_texts, listed
from mixedlub.schema.section import table as file_table
from mixedlub.schema.table import span
from mixedlub.schema.units import unit_of
from mixedlub.study import batch, checkpoint
from mixedlub.study.bands import HIGH, LOW
from mixedlub.study.bands import column as band_column
from mixedlub.study.batch import CHECKS
from mixedlub.study.plan import Study, counted, factors
from mixedlub.study.range_flags import VALID, as_words, flags
from mixedlub.study.schema import StudyFile
from mixedlub.study.validity import out_of_range
from mixedlub.version import installed_version
from profiles.errors import InputError, refuse_other

if TYPE_CHECKING:
    import pandas as pd
    import pyarrow as pa
    import xarray as xr

COLUMNS = {
    "power_loss": ("power_loss_W", 1.0),
    "mean_friction": ("mean_friction", 1.0),
    "area_ratio": ("boundary_area_ratio", 1.0),
    "film_thickness": ("film_thickness_um", 1e6),
    "film_parameter": ("film_parameter", 1.0),
    "composite_roughness": ("composite_roughness_um", 1e6),
    "mesh_loss": ("mesh_loss_W", 1.0),
    "rolling_loss": ("rolling_loss_W", 1.0),
    "other_loss": ("other_loss_W", 1.0),
    "hertz_pressure": ("hertz_pressure_MPa", 1e-6),
    "asperity_load_ratio": ("asperity_load_ratio", 1.0),
    "asperity_real_pressure": ("asperity_real_pressure_MPa", 1e-6),
    "mean_asperity_load_share": ("mean_asperity_load_share", 1.0),
    "film_over_unbalanced": ("film_over_unbalanced_film", 1.0),
}
"""Column of each output, and the factor from SI to its unit; some outputs need an option."""

DEFINITIONS = {
    "power_loss": "total power loss, mean over a mesh cycle: the mesh and every loss that is switched on as an effect",
    "mean_friction": "sliding loss of the mesh over the path integral of load times sliding speed; with "
    'averaging = "paper", the plain mean of friction over the path',
    "area_ratio": "boundary area ratio, plain mean over the path of contact as far as it carries load",
    "film_thickness": "film thickness, plain mean over the path of contact as far as it carries load",
    "film_parameter": "mean film thickness over composite roughness",
    "composite_roughness": GLOSSARY["composite_roughness"].meaning,
    "mesh_loss": GLOSSARY["mesh_loss"].meaning,
    "rolling_loss": GLOSSARY["rolling_loss"].meaning,
    "other_loss": "power lost outside the mesh by effects that are switched on: bearings, seals, churning, windage",
    "hertz_pressure": "largest Hertz pressure of the path of contact",
    "asperity_load_ratio": "pressure that asperities would carry over mean Hertz pressure, the largest of the path; "
    'above 1 the film would have to give way, which it does with balance = "johnson_greenwood_poon"',
    "asperity_real_pressure": "pressure of the asperities over their real contact area, at the place of the path where "
    "they carry most; 0 where none touch",
    "mean_asperity_load_share": "share of the load that asperities carry, plain mean over the path of contact as far "
    "as it carries load",
    "film_over_unbalanced": "film thickness over that of a film which carries the whole load, plain mean over the "
    "path of contact as far as it carries load",
    "balance_error": "part of the load by which film and asperities together miss it, the largest of the path",
    "film_below_its_share": "1 where the film carries less than its law is for, anywhere on the path",
    "largest_area_ratio": "boundary area ratio where asperities carry most",
}
"""Meaning of each output."""

_ENDS = {
    end + name: (band_column(own, word), scale)
    for name, (own, scale) in COLUMNS.items()
    for end, word in ((LOW, "low"), (HIGH, "high"))
}
DEFINITIONS |= {
    name: f"{'lower' if name.startswith(LOW) else 'upper'} end of the band of {COLUMNS[name.split('_', 1)[1]][0]}"
    for name in _ENDS
}
COLUMNS |= _ENDS
VALIDITY = "validity"
"""Column that says of a condition where it is outside the range of the model."""
VALIDITY_MEANING = f"'{VALID}', or the kinds of findings that say why the condition is outside the model's range"
LEVELS = ("oil_temperature_C", "torque_Nm", "speed_rpm")
"""Conditions of a study in the order of the axes of its arrays."""
_ROWS = 200_000
_REPEATING = ["pinion_surface", "gear_surface", "torque_Nm", "speed_rpm", "oil_temperature_C", VALIDITY]


SUMMARISED = ("power_loss", "mean_friction", "film_parameter")
"""Outputs whose ranges the summary gives."""
LONGEST_TITLE = 36
"""Characters of a title in the summary, which is to fit a line."""


@dataclass(frozen=True, eq=False)
class Results:
    """Outputs of a study in SI by name, each of shape (pairing, oil temperature, torque, speed).

    `to_xarray` and `to_pandas` have them in the units of the table. It prints as a summary:

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
    ['oil_typical']
    """

    study: Study
    values: Mapping[str, np.ndarray]

    def __repr__(self) -> str:
        title = self.study.file.title
        named = title if len(title) <= LONGEST_TITLE else f"{title[:LONGEST_TITLE]}…"
        levels = self.study.file.conditions
        conditions = (span(name, np.array(getattr(levels, name))) for name in ("torque_Nm", "speed_rpm", LEVELS[0]))
        outputs = (span(COLUMNS[name][0], self[name] * COLUMNS[name][1]) for name in SUMMARISED)
        count = int(self.outside.sum())
        outside = f"{count} rows are outside the range of the model: {listed(list(self.flags))}"
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
        """Where conditions are outside the range of the model, by the code of the finding that says why."""
        return flags(self.study.plan, self.values)

    @cached_property
    def outside(self) -> np.ndarray:
        """Whether a condition is outside the range of the model for any reason."""
        return np.logical_or.reduce([np.zeros(self.study.plan.shape, bool), *self.flags.values()])

    @property
    def columns(self) -> Mapping[str, tuple[str, float]]:
        """The columns of the table that this study has."""
        return {name: column for name, column in COLUMNS.items() if name in self.values}

    @cached_property
    def findings(self) -> tuple[Finding, ...]:
        """What a reader should know: conditions outside the range of the model, gravest first, then assumptions."""
        return (*out_of_range(self), *self.study.notes)

    def __getitem__(self, name: str) -> np.ndarray:
        """An output in SI by its name in ``values``."""
        return self.values[name]

    def to_xarray(self) -> xr.Dataset:
        """The result as labelled arrays: the columns of the table over pairing and conditions, with meanings.

        The attribute ``findings`` has the notes, cautions and doubts as texts.
        """
        import xarray as xr

        levels = self.study.file.conditions
        coordinates: dict[str, Any] = {
            "pairing": [f"{a} / {b}" for a, b in self.study.pairings],
            "pinion_surface": ("pairing", [a for a, _ in self.study.pairings]),
            "gear_surface": ("pairing", [b for _, b in self.study.pairings]),
            **{name: (name, list(getattr(levels, name)), {"units": unit_of(name)}) for name in LEVELS},
        }
        variables = {
            column: (("pairing", *LEVELS), self.values[name] * scale, _described(name, column))
            for name, (column, scale) in {**self.columns, **{name: (name, 1.0) for name in CHECKS}}.items()
        }
        index, texts = as_words(self.flags, self.study.plan.shape)
        variables[VALIDITY] = (
            ("pairing", *LEVELS),
            np.array(texts)[index],
            {"units": "", "long_name": VALIDITY_MEANING},
        )
        whole = {"title": self.study.file.title, "findings": as_texts(self.findings)}
        return xr.Dataset(variables, coordinates, whole)

    def to_pandas(self) -> pd.DataFrame:
        """The rows of the table that `write` writes."""
        import pandas as pd

        return pd.concat([table.to_pandas() for table in self.tables()], ignore_index=True)

    def tables(self) -> Iterator[pa.Table]:
        """The rows as tables of bounded size, pairing by pairing."""
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
            for name, (column, scale) in self.columns.items():
                columns[column] = checkpoint.floats(self.values[name][start : start + step] * scale)
            columns[VALIDITY] = checkpoint.words(texts, index[start : start + step].ravel())
            yield pa.table(columns)

    def _described_schema(self, schema: pa.Schema) -> pa.Schema:
        """The columns with unit and meaning, and the metadata of the table."""
        import pyarrow as pa

        meant = meanings()
        fields = [f.with_metadata({"unit": unit_of(f.name) or "-", "meaning": meant[f.name]}) for f in schema]
        whole = {"title": self.study.file.title, "fingerprint": checkpoint.fingerprint(self.study.plan), **versions()}
        return pa.schema(fields, metadata=whole)

    def write(self, csv_path: Path, parquet_path: Path) -> None:
        """The rows as CSV and Parquet."""
        import pyarrow.csv as pc
        import pyarrow.parquet as pq

        plain = not any(mark in name for both in self.study.pairings for name in both for mark in ',"\n\r')
        quoting = "none" if plain else "needed"
        options = pc.WriteOptions(quoting_style=quoting, quoting_header="none")
        csv_writer = parquet_writer = None
        try:
            for table in self.tables():
                csv_writer = csv_writer or pc.CSVWriter(csv_path, table.schema, write_options=options)
                parquet_writer = parquet_writer or pq.ParquetWriter(
                    parquet_path, self._described_schema(table.schema), use_dictionary=_REPEATING
                )
                csv_writer.write_table(table)
                parquet_writer.write_table(table)
        finally:
            for writer in (csv_writer, parquet_writer):
                if writer is not None:
                    writer.close()


def meanings() -> dict[str, str]:
    """Meaning of each column of the table."""
    levels = {key.name: key.meaning for key in file_table(StudyFile, "conditions").fields}
    sides = {f"{side}_surface": f"surface of the {side}" for side in ("pinion", "gear")}
    outputs = {column: DEFINITIONS[name] for name, (column, _) in COLUMNS.items()}
    return sides | levels | outputs | {VALIDITY: VALIDITY_MEANING}


def versions() -> dict[str, str]:
    """Versions of the packages that a result depends on."""
    return {"mixedlub": installed_version(), "NumPy": np.__version__, "Python": sys.version.split()[0]}


def _described(name: str, column: str) -> dict[str, str]:
    """Unit and meaning of a variable."""
    return {"units": unit_of(column) or "-", "long_name": DEFINITIONS[name]}


def run_study(
    study: Study,
    *,
    parts: Path | None = None,
    scheduler: str | None = None,
    threads: int | None = None,
    progress: Callable[[int, int], None] = lambda done, of: None,
) -> Results:
    """Run a study; with a folder for parts, finished blocks are saved and those of an earlier run are reused."""
    refuse_other(study, Study, "ml.study.read_study(...)", "study.run_study: study")
    values = {name: np.empty(study.plan.shape) for name in batch.names(study.plan)}
    todo = batch.blocks(study.plan)
    waiting = {checkpoint.block_name(b): b for b in todo}
    total, done = len(todo), 0
    if total == 1:
        parts = None
    if parts is not None:
        for block, found in checkpoint.kept(parts, todo):
            _fill(values, block, found)
            del waiting[checkpoint.block_name(block)]
        done = total - len(waiting)
    progress(done, total)
    for block, found in batch.run(study.plan, list(waiting.values()), scheduler=scheduler, threads=threads):
        if parts is not None:
            checkpoint.keep(parts, block, found)
        _fill(values, block, found)
        done += 1
        progress(done, total)
    results = Results(study, values)
    _check_finite(results)
    return results


def results_of(study: Study, state: Mapping[str, Any]) -> Results:
    """The results of a study all of whose contact points are computed, as `Plan.model` has them."""
    found = batch.reduced({**study.plan.inputs, **state}, study.plan)
    results = Results(study, {n: np.broadcast_to(values[..., 0], study.plan.shape) for n, values in found.items()})
    _check_finite(results)
    return results


def _check_finite(results: Results) -> None:
    """Refuse inputs at which a law leaves its domain."""
    for name in results.columns:
        wrong = ~np.isfinite(results[name])
        if wrong.any():
            p, o, t, s = np.argwhere(wrong)[0]
            levels = results.study.file.conditions
            raise InputError(
                f"no finite {name.replace('_', ' ')}; look for a number far out of range",
                where=f"{results.study.name}.toml: {' / '.join(results.study.pairings[p])} at "
                f"{levels.torque_Nm[t]:g} N m, {levels.speed_rpm[s]:g} rpm, {levels.oil_temperature_C[o]:g} C",
            )


def _fill(values: Mapping[str, np.ndarray], block: batch.Block, found: batch.Found) -> None:
    for name, part in found.items():
        values[name][block] = part
