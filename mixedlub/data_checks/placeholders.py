"""Readings that are exactly zero where nearly all others are far from it: a channel not on, or a cell filled in."""

from __future__ import annotations

import numpy as np

from mixedlub.schema.findings import Finding, finding, listed
from mixedlub.schema.table import Table

FEWEST = 5
"""Judgement. Fewest other readings that show how near zero readings come."""
MOST = 0.2
"""Judgement. Largest share of zeros that are single placeholders; more are a channel that was stuck."""
LOWEST = 0.05
"""Judgement. Share of the other readings that may be near zero, as at a start."""
FAR = 0.2
"""Judgement. Size from which the other readings are far from zero, over their median."""
STEPS = 3.0
"""Judgement. The same in steps of the reading: less may be rounded to zero."""


def placeholders(quantity: str, rows: Table, y: np.ndarray, base: np.ndarray) -> list[Finding]:
    """Readings that are exactly zero among others that are not near it; where the base model is zero they are right.

    >>> rows = Table({"run": np.arange(1, 8)})
    >>> y = np.array([0.0, 0.11, 0.12, 0.11, 0.10, 0.12, 0.11])
    >>> [str(one) for one in placeholders("friction_coefficient", rows, y, np.ones(7))]
    ['friction_coefficient: 1 of 7 readings is exactly zero where nearly all others are 0.1 or more in size: likely a \
placeholder, of a channel that was not on or a cell filled in; delete its row (run 1) if so']
    """
    zero = (y == 0.0) & (base != 0.0)
    others = np.abs(y[y != 0.0])
    count = int(np.count_nonzero(zero))
    if not count or count > MOST * y.size or others.size < FEWEST:
        return []
    near = float(np.quantile(others, LOWEST, method="lower"))
    step = float(np.min(np.diff(np.unique(np.abs(y)))))
    if near < max(FAR * float(np.median(others)), STEPS * step):
        return []
    one, several = ("is", "a placeholder", "its row (run"), ("are", "placeholders", "their rows (runs")
    are, likely, its = one if count == 1 else several
    runs = listed(rows["run"][zero].tolist())
    text = (
        f"{count} of {y.size} readings {are} exactly zero where nearly all others are {near:.3g} or more in size: "
        f"likely {likely}, of a channel that was not on or a cell filled in; delete {its} {runs}) if so"
    )
    return [finding("readings_zero", text, quantity)]
