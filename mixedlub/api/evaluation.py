"""Evaluation of rig recordings to friction, from Python."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from mixedlub.schema.findings import collected, warn_of
from profiles.errors import as_path

if TYPE_CHECKING:
    import pandas as pd


def evaluate_recording(method: str, file: Any) -> dict[str, pd.DataFrame]:
    """Evaluate a recording of a rig: the tables of `mixedlub evaluate`.

    Parameters
    ----------
    method : str
        Name of the method, e.g. ``"calorimetric"``.
    file : str or PathLike
        File (TOML) of the evaluation.

    Returns
    -------
    dict of str to pandas.DataFrame
        Tables by name; columns carry their unit.

    Raises
    ------
    profiles.errors.InputError
        If the method is unknown or the file is invalid.

    Examples
    --------
    >>> import tempfile, pathlib
    >>> from mixedlub.commands.new import evaluation_files
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     for name, text in evaluation_files("two-disc").items():
    ...         _ = pathlib.Path(folder, name).write_text(text, encoding="utf-8")
    ...     found = evaluate_recording("two-disc", pathlib.Path(folder, "two-disc.toml"))
    >>> sorted(found), len(found["traction"])
    (['sweeps', 'traction'], 24)
    """
    import pandas as pd

    from mixedlub.evaluate import evaluate

    with collected() as findings:
        found = evaluate(method, as_path(file, "evaluate_recording: file"))
    warn_of(findings)
    return {name: table for name, table in found.tables.items() if isinstance(table, pd.DataFrame)}
