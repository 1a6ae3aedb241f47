"""Runs of a file of factors: the study modified for each combination of levels, and the responses."""

from __future__ import annotations

import copy
import hashlib
import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.rig.rig import Rig
from mixedlub.running.origin import Origin, code_fingerprint
from mixedlub.running.parallel import shared_out
from mixedlub.schema.findings import collected
from mixedlub.schema.toml_file import parse, read_toml
from mixedlub.study.checkpoint import input_fingerprint
from mixedlub.study.factor_file import FactorFile
from mixedlub.study.factor_setters import set_level, traced
from mixedlub.study.plan import Study, read_study
from mixedlub.study.results import LEVELS, Results, run_study
from mixedlub.study.schema import StudyFile
from mixedlub.study.sensitivity import all_samples, base_samples
from profiles.errors import InputError

Run = dict[str, Any]
"""The level of every factor in one run."""
MOST_ROWS = 2_000_000
"""Largest number of rows of the table of a full factorial."""
STEEL = ("coating", "thermal_conductivity_W_mK", "density_kg_m3", "specific_heat_J_kgK")
"""Keys of a surface kept when moments replace its trace."""


@dataclass(frozen=True, eq=False)
class Experiment:
    """A file of factors and its study."""

    file: FactorFile
    path: Path
    content: Mapping[str, Any]
    fingerprint: str = ""
    """Hash of every number and line of code that affects the results."""

    @property
    def levels(self) -> dict[str, tuple[Any, ...]]:
        """Levels of every factor."""
        return self.file.factors.given

    @property
    def study_path(self) -> Path:
        """File of the study."""
        return self.path.parent / self.file.study

    @property
    def origin(self) -> Origin:
        """Content hashes of both files."""
        digest = hashlib.sha256()
        for path in (self.path, self.study_path):
            digest.update(hashlib.sha256(path.read_bytes()).digest())
        return Origin(self.path, digest.hexdigest())

    @cached_property
    def runs(self) -> list[Run]:
        """The runs in order: combinations of a full factorial, or points of a random design."""
        design = self.file.design
        if design.runs is None:
            return [dict(zip(self.levels, combination)) for combination in itertools.product(*self.levels.values())]
        points = all_samples(base_samples(design.kind, design.runs, len(self.levels), design.seed))
        return [
            {name: _at(levels, float(u)) for u, (name, levels) in zip(point, self.levels.items(), strict=True)}
            for point in points
        ]

    def study(self, run: Run) -> Study:
        """The study of a run."""
        where = f"{self.path}: {', '.join(f'{name} = {_told(level)}' for name, level in run.items())}"
        try:
            file = parse(StudyFile, self._altered(run), str(self.study_path))
            study = read_study(self.study_path, file)
        except InputError as error:
            raise InputError(str(error), where=where) from None
        if "boundary_friction" in run and any(n.code == "boundary_friction_unread" for n in study.notes):
            rule = f"the friction law {file.options.friction} does not read it; leave the factor out"
            raise InputError(rule, where=f"{self.path}: factors.boundary_friction")
        return study

    def _altered(self, run: Run) -> dict[str, Any]:
        content: dict[str, Any] = copy.deepcopy(dict(self.content))
        for name, level in run.items():
            if name != "replicate":
                set_level(content, name, level, self.study_path.parent)
        if "replicate" in run:
            self._resample(content, int(run["replicate"]))
        return content

    def _resample(self, content: dict[str, Any], seed: int) -> None:
        """Replace every trace by the moments of its sampling lengths, resampled with replacement."""
        from roughness.uncertainty import resampled_moments

        rig = Rig(parse(StudyFile, content, str(self.study_path)), self.study_path.parent.resolve())
        for place, (name, surface) in enumerate(traced(content, "replicate").items()):
            with collected():
                drawn = resampled_moments(rig.profile(name), np.random.default_rng((seed, place)))
            body = {key: surface[key] for key in STEEL if key in surface}
            moments = {"m0_um2": drawn.m0 * 1e12, "m2": drawn.m2, "m4_per_um2": drawn.m4 * 1e-12}
            content["surfaces"][name] = moments | body


def read_experiment(path: Path, file: FactorFile) -> Experiment:
    """Experiment of a file of factors; the first run is read, so that errors appear at once."""
    study = path.parent / file.study
    if not study.is_file():
        raise InputError(
            "no such file; it is relative to the file of factors", where=f"{path}: study", value=file.study
        )
    content = read_toml(study)
    parse(StudyFile, content, str(study))
    found = Experiment(file, path, content)
    digest = hashlib.sha256(f"{code_fingerprint()}{found.origin.fingerprint}".encode())
    for name, levels in found.levels.items():
        for level in levels:
            digest.update(input_fingerprint(found.study(found.runs[0] | {name: level}).plan).encode())
    return replace(found, fingerprint=digest.hexdigest())


def _at(levels: Sequence[Any], u: float) -> Any:
    """Level at a point of the unit interval: a number between the ends, or a name or seed by position.

    >>> _at((10.0, 20.0), 0.25), _at(("rigid", "ldp"), 0.75)
    (12.5, 'ldp')
    """
    if isinstance(levels[0], float):
        low, high = min(levels), max(levels)
        return low + u * (high - low)
    return levels[min(int(u * len(levels)), len(levels) - 1)]


def _told(level: Any) -> str:
    return f"{level:g}" if isinstance(level, float) else str(level)


def axes(experiment: Experiment, study: Study) -> dict[str, tuple[Any, ...]]:
    """Factors of a full factorial with at least two levels, including pairings and conditions."""
    conditions = {name: tuple(getattr(study.file.conditions, name)) for name in LEVELS}
    pairings = tuple(f"{a} / {b}" for a, b in study.pairings)
    every = {**experiment.levels, "pairing": pairings, **conditions}
    return {name: levels for name, levels in every.items() if len(levels) > 1}


def refuse_too_many(experiment: Experiment) -> None:
    """Raise an error if the table of a full factorial would exceed the memory."""
    rows = len(experiment.runs) * experiment.study(experiment.runs[0]).conditions
    if rows > MOST_ROWS:
        rule = f"{len(experiment.runs)} runs give {rows} rows, of at most {MOST_ROWS}; take fewer levels or conditions"
        raise InputError(rule, where=f"{experiment.path}: factors")


def response_of(experiment: Experiment, found: Results) -> np.ndarray:
    """Response at every pairing and condition, in the unit of its column."""
    wanted = experiment.file.design.response
    known = {c.name: c for c in found.columns}
    if wanted not in known:
        raise InputError("the study has no such column", where=f"{experiment.path}: design.response", value=wanted)
    return known[wanted].of(found[known[wanted].output])


def mean_responses(experiment: Experiment, runs: Sequence[Run]) -> np.ndarray:
    """Mean response and share of conditions out of range per run of a random design, of shape (2, runs)."""

    def of_run(run: Run) -> tuple[float, float]:
        with collected():
            found = run_study(experiment.study(run), threads=1)
        return float(response_of(experiment, found).mean()), float(found.outside.mean())

    return np.array(shared_out(of_run, runs)).T
