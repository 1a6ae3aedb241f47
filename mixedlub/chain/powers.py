"""Powers of quantities in laws: NaN for a negative base, for numbers as for arrays."""

from __future__ import annotations

from typing import Any

import numpy as np


def power(base: Any, exponent: Any) -> Any:
    """The base to an exponent; Python numbers would give complex results or fail at zero.

    >>> with np.errstate(invalid="ignore", divide="ignore"):
    ...     [float(power(base, exponent)) for base, exponent in ((-0.5, 0.69), (0.0, -0.1), (4.0, 0.5))]
    [nan, inf, 2.0]
    """
    return (np.float64(base) if isinstance(base, float | int) else base) ** exponent
