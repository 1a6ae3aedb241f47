"""The full factorial: every pairing of surfaces at every torque, speed and oil temperature."""

from __future__ import annotations

from os import PathLike
from typing import Any

from mixedlub.schema.findings import warn_of
from mixedlub.study.plan import Study, counted, factors, read_study
from mixedlub.study.rank import ranking
from mixedlub.study.results import Results, run_study
from profiles.errors import as_path


def run(study: Study | str | PathLike[str], **how: Any) -> Results:
    """Run a study, given as a file or as a `Study`; ``how``: keywords of `run_study`.

    Cautions and doubts are issued as ``mixedlub.CautionWarning``; the result has all findings.

    >>> import mixedlub as ml
    >>> ml.study.run("nowhere.toml")
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: nowhere.toml: no such file
    """
    results = run_study(study if isinstance(study, Study) else read_study(as_path(study, "study.run")), **how)
    warn_of(results.findings)
    return results


__all__ = ["Results", "Study", "counted", "factors", "ranking", "read_study", "run", "run_study"]
