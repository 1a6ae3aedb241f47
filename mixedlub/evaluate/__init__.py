"""Recordings of gear and disc rigs turned into friction, with intervals: one file an evaluation."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from mixedlub.evaluate.evaluation import Evaluated, Evaluation
from mixedlub.schema.discovery import declared
from mixedlub.schema.toml_file import keys_of, parse, read_toml
from profiles.errors import InputError, nearest

__all__ = ["EVALUATIONS", "Evaluated", "Evaluation", "evaluate"]


class _ByName(Mapping[str, Evaluation]):
    """The evaluations by name, found when they are first asked for."""

    def _all(self) -> dict[str, Evaluation]:
        return {one.name: one for one in declared("mixedlub.evaluate", "mixedlub.evaluations", "EVALUATION")}

    def __getitem__(self, name: str) -> Evaluation:
        return self._all()[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._all())

    def __len__(self) -> int:
        return len(self._all())


EVALUATIONS = _ByName()
"""Every evaluation by its name, those of other packages included (entry points ``mixedlub.evaluations``)."""


def evaluation(name: str) -> Evaluation:
    """An evaluation by its name."""
    if name not in EVALUATIONS:
        raise InputError(f"no such evaluation; {nearest(name, EVALUATIONS)}", where="METHOD", value=name)
    return EVALUATIONS[name]


def evaluate(name: str, path: Path | str) -> Evaluated:
    """What an evaluation finds in the recordings that its file describes.

    >>> evaluate("calorimetry", "rig.toml")
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: METHOD: 'calorimetry': no such evaluation; nearest known: 'calorimetric'
    """
    one, path = evaluation(name), Path(path)
    with keys_of(one.file, path):
        return one.run(parse(one.file, read_toml(path), str(path)), path)
