"""Friction coefficients with intervals from recordings of gear and disc rigs; each evaluation is a file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from mixedlub.evaluate.evaluation import Evaluated, Evaluation
from mixedlub.schema.discovery import declared
from mixedlub.schema.toml_file import keys_of, parse, read_toml
from profiles.errors import InputError, nearest

__all__ = ["EVALUATIONS", "Evaluated", "Evaluation", "evaluate"]


class _ByName(Mapping[str, Evaluation]):
    """Mapping of the evaluations by name, loaded at the first access."""

    def _all(self) -> dict[str, Evaluation]:
        return {one.name: one for one in declared("mixedlub.evaluate", "mixedlub.evaluations", "EVALUATION")}

    def __getitem__(self, name: str) -> Evaluation:
        return self._all()[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._all())

    def __len__(self) -> int:
        return len(self._all())


EVALUATIONS = _ByName()
"""Evaluations by name, including evaluations of other packages (entry points ``mixedlub.evaluations``)."""


def evaluation(name: str) -> Evaluation:
    """Return the evaluation of a name; raise an error with the nearest known name otherwise."""
    if name not in EVALUATIONS:
        raise InputError(f"no such evaluation; {nearest(name, EVALUATIONS)}", where="METHOD", value=name)
    return EVALUATIONS[name]


def evaluate(name: str, path: Path | str) -> Evaluated:
    """Result of an evaluation of the recordings in its file.

    >>> evaluate("calorimetry", "rig.toml")
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: METHOD: 'calorimetry': no such evaluation; nearest known: 'calorimetric'
    """
    one, path = evaluation(name), Path(path)
    with keys_of(one.file, path):
        return one.run(parse(one.file, read_toml(path), str(path)), path)
