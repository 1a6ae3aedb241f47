"""The recorded rows of a case and the readings in them."""

from __future__ import annotations

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.schema.table import Table


def rows_of(case: Case) -> Table:
    """The recorded rows; only for a case that has them."""
    assert case.recordings is not None
    return case.recordings


def readings_of(case: Case) -> np.ndarray:
    """The recorded quantity, one number a row, in the unit of its column."""
    return np.asarray(rows_of(case)[case.quantity], dtype=float)
