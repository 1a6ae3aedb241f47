"""Diagnosis with added readings, going on from an earlier answer."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.case.added import with_added
from mixedlub.case.folder import Case, read_case, read_conditions
from mixedlub.diagnosis.assessment.campaign import Campaign, Standing, realised_bits
from mixedlub.diagnosis.assessment.experiment_design import expected_information
from mixedlub.diagnosis.diagnose import Diagnosis, diagnosis_of
from mixedlub.diagnosis.search.search import Progress
from mixedlub.diagnosis.settings.assessment import FALSE_ALARM_RATE
from mixedlub.schema.table import Table

if TYPE_CHECKING:
    from mixedlub.case.folder import Frame


def diagnosis_with(
    case: Case,
    added: Path | Frame,
    requested: Table | None = None,
    exclude: Sequence[str] = (),
    level: float = FALSE_ALARM_RATE,
    progress: Progress = lambda text: None,
    earlier: Mapping[str, Any] | None = None,
) -> Diagnosis:
    """Diagnose a case with added readings, and compare with the answer without them.

    ``earlier``: this answer, as in `diagnosis.json`; without one, or if other tests were run than it proposed, the case
    is diagnosed without the readings first.
    """
    joined, rows = with_added(case, added)
    if earlier is not None and _are_proposed(rows, earlier):
        before, expected = Standing.read(earlier), float(earlier["next_batch"]["expected_bits"])
    else:
        progress("diagnosing without the added readings")
        first = diagnosis_of(case, None, exclude, level, progress)
        before = Standing.of(first.search, first.posterior, first.batch)
        expected = expected_information(first.search, first.posterior, first.refined, rows)
    found = diagnosis_of(joined, requested, exclude, level, progress)
    after = Standing.of(found.search, found.posterior, found.batch, list(before.explanations))
    realised = realised_bits(before.explanations, after.explanations)
    runs = tuple(int(run) for run in rows["run"])
    return replace(found, campaign=Campaign(runs, before, after, expected, realised))


def diagnose_added(
    folder: Path,
    added: Path,
    answered: Path,
    predict: Path | None = None,
    exclude: Sequence[str] = (),
    level: float = FALSE_ALARM_RATE,
    progress: Progress = lambda text: None,
    campaign: Path | None = None,
) -> Diagnosis:
    """Diagnose the case in a folder with the readings of a file, from the answer in another folder.

    ``campaign``: folder of the case with readings that were added before.
    """
    case = replace(read_case(folder if campaign is None else campaign), name=folder.resolve().name)
    requested = case.conditions if predict is None else read_conditions(case, predict)
    return diagnosis_with(case, added, requested, exclude, level, progress, earlier_answer(answered, exclude, level))


def earlier_answer(folder: Path, exclude: Sequence[str], level: float) -> dict[str, Any] | None:
    """Answer in a folder to the same question; None if there is none."""
    try:
        record = json.loads((folder / "diagnosis.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    left_out = any(one["code"] == "effects_left_out" for one in record.get("findings", ()))
    same = "next_batch" in record and record["mismatch"]["level"] == level and not exclude and not left_out
    return record if same else None


def _are_proposed(rows: Table, earlier: Mapping[str, Any]) -> bool:
    """Whether rows are the whole proposed batch."""
    tests = [one["conditions"] for one in earlier["next_tests"]]
    if len(tests) != len(rows):
        return False
    return all(
        str(rows[name][i]) == value if isinstance(value, str) else bool(np.isclose(float(rows[name][i]), value))
        for i, test in enumerate(tests)
        for name, value in test.items()
    )
