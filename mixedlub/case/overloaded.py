"""Whether asperities of a gear case would carry more than the load at the gap that the film formula sets."""

from __future__ import annotations

import numpy as np

from mixedlub.base_model.balanced import overloaded
from mixedlub.case.forward import Forward
from mixedlub.laws.contact import asperity_load_ratio, mean_hertz_pressure
from mixedlub.laws.load import carries_load
from mixedlub.schema.findings import Finding, Severity, finding


def overloaded_asperities(forward: Forward) -> list[Finding]:
    """A note on the rows in which they would anywhere on the path, by the rule of a study."""
    if forward.case.system.gears is None or "load_share" not in forward.inputs:
        return []
    with np.errstate(all="ignore"):
        wanted = ("asperity_pressure", "hertz_pressure", "line_load")
        state = forward.model(wanted)(forward.inputs, forward.known_values({}))
        ratio = asperity_load_ratio(state["asperity_pressure"], mean_hertz_pressure(state["hertz_pressure"]))
    largest = np.max(ratio, axis=-1, where=carries_load(state["line_load"]), initial=0.0)
    count = int(overloaded(largest).sum())
    if not count:
        return []
    text = (
        f"in {count} of {largest.size} rows asperities would carry up to {largest.max():.3g} times the mean Hertz "
        "pressure at the gap of the film formula: boundary friction is not quantitative there"
    )
    return [finding("asperities_overloaded", text, forward.table.source, Severity.NOTE)]
