"""Traces of files and maps, and their roughness over a series of cut-offs."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from profiles import SHIPPED_MARK, InputError, Profile, shipped
from profiles.maps import read_any
from profiles.profile import of_profile
from roughness.maps.lay import trace_across_lay
from roughness.record import trace_record

LONG = (0.08e-3, 0.25e-3, 0.8e-3, 2.5e-3, 8e-3)
"""Source: ISO 3274:1996. Long cut-offs of stylus instruments (m)."""
FEWEST = 1.0
"""Judgement. Cut-offs that a trace must hold at least."""
HEIGHTS, MOMENTS, ASPERITIES = ("Ra_um", "Rq_um", "Rz_um"), ("m2", "m4_per_um2"), ("density_per_mm2", "radius_um")


def trace_of(file: str | Path, unit: str | None = None, spacing: str | None = None) -> Profile:
    """Trace of a file or of the package; of a map, the trace across its lay."""
    if str(file).startswith(SHIPPED_MARK):
        return shipped(str(file), "FILE")
    found = read_any(file, unit=unit, spacing=spacing)
    return found if isinstance(found, Profile) else trace_across_lay(found)


@of_profile
def over_cutoffs(trace: Profile, chosen: float | None = None, **how: Any) -> Iterator[dict[str, Any]]:
    """Roughness of a trace at each standard long cut-off that it holds, and at the chosen one (m).

    ``how``: keywords of `trace_record`.

    >>> from profiles import shipped
    >>> [round(row["cutoff_mm"], 2) for row in over_cutoffs(shipped("shipped:0258"))]
    [0.08, 0.25, 0.8, 2.5]
    """
    for cutoff in sorted({*LONG, *(() if chosen is None else (chosen,))}):
        if cutoff * FEWEST > trace.length:
            continue
        try:
            _, record = trace_record(trace, cutoff=cutoff, **how)
        except InputError:
            continue
        row: dict[str, Any] = {"cutoff_mm": round(cutoff * 1e3, 6)}
        for part, names in (("parameters", HEIGHTS), ("moments", MOMENTS), ("asperities", ASPERITIES)):
            found = record[part]
            row |= {name: found.get(name) if isinstance(found, dict) else None for name in names}
        yield row
