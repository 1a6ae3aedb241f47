"""Rows of an experiment in chunks of runs, saved as Parquet, so that an interrupted experiment resumes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from mixedlub.running.atomic import PARTS, whole
from mixedlub.study.factor_runs import Experiment, Run

if TYPE_CHECKING:
    import pandas as pd

MOST_RUNS, MOST_ROWS = 64, 200_000
"""Largest number of runs of a chunk, and of rows of their studies unless a single study has more."""


def parts_folder(out: Path, experiment: Experiment) -> Path:
    """Folder of the chunks of an experiment with these inputs, until it is complete."""
    return out / f"{PARTS}{experiment.fingerprint[:16]}"


def in_chunks(
    experiment: Experiment,
    rows_of: Callable[[Sequence[Run]], pd.DataFrame],
    parts: Path | None,
    progress: Callable[[int, int], None],
) -> pd.DataFrame:
    """Rows of all runs in order; finished chunks in a folder for parts are reused."""
    import pandas as pd

    size = max(1, min(MOST_RUNS, MOST_ROWS // experiment.study(experiment.runs[0]).conditions))
    chunks = [experiment.runs[i : i + size] for i in range(0, len(experiment.runs), size)]
    parts = None if len(chunks) == 1 else parts
    kept = {} if parts is None else {k: found for k in range(len(chunks)) if (found := _kept(parts, k)) is not None}
    done = sum(len(chunks[k]) for k in kept)
    progress(done, len(experiment.runs))
    for k, chunk in enumerate(chunks):
        if k not in kept:
            kept[k] = rows_of(chunk)
            if parts is not None:
                _keep(parts, k, kept[k])
            done += len(chunk)
            progress(done, len(experiment.runs))
    return pd.concat([kept[k] for k in range(len(chunks))], ignore_index=True)


def _kept(folder: Path, place: int) -> pd.DataFrame | None:
    import pandas as pd
    from pyarrow import ArrowInvalid

    path = _path(folder, place)
    try:
        return pd.read_parquet(path) if path.is_file() else None
    except (OSError, ArrowInvalid):
        return None


def _keep(folder: Path, place: int, rows: pd.DataFrame) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    with whole(_path(folder, place)) as aside:
        rows.to_parquet(aside, index=False)


def _path(folder: Path, place: int) -> Path:
    return folder / f"runs_{place}.parquet"
