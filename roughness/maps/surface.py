"""A map, evaluated as a surface: its areal parameters, and the traces across and along its lay."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from profiles import InputError, Profile
from profiles.maps import HeightMap
from roughness.maps.holes import filled
from roughness.maps.lay import trace_at
from roughness.maps.prepare import prepared_map
from roughness.maps.record import map_record
from roughness.record import trace_record

_OF_TRACE = ("steps", "parameters", "moments", "asperities", "gaussian")
"""Parts of the row of a trace."""


@dataclass(frozen=True, eq=False)
class EvaluatedMap:
    """A map without form and filtered, its row of ``profile.json``, and its trace across the lay, if there is one.

    ``angles``: directions (rad) of the traces across and along the lay; ``traces``: both as read, by ``across`` and
    ``along``.
    """

    area: HeightMap
    record: dict[str, Any]
    angles: tuple[float, float]
    trace: Profile | None = None
    profile: Profile | None = None
    traces: Mapping[str, Profile] = field(default_factory=dict)


def evaluated_map(
    area: HeightMap,
    *,
    form: str = "line",
    cutoff: float | str | None = "auto",
    short_cutoff: float | str | None = "auto",
    method: str = "gaussian",
    outliers: float | None = None,
    holes: str = "mask",
    **trace_keys: Any,
) -> EvaluatedMap:
    """A map evaluated: areal parameters under ``areal``, the trace across the lay in the row of a trace, and the trace
    along the lay under ``along``.

    The traces come from the map as read, with its holes as asked, and pass the filters of a trace. A trace that cannot
    be evaluated leaves the areal parameters, with a warning.
    """
    if method != "gaussian":
        raise InputError("of a height map is gaussian", where="method", value=method)
    long, short = (None if length == "auto" else length for length in (cutoff, short_cutoff))
    assert not isinstance(long, str)
    assert not isinstance(short, str)
    rough = prepared_map(area, form=form, cutoff=long, short_cutoff=short, holes=holes, outliers=outliers)
    areal = map_record(rough, area)
    across = math.radians(areal["moments"]["across_lay_deg"])  # type: ignore[index]
    warnings = list(areal.pop("warnings"))  # type: ignore[call-overload]
    bare = (
        replace(area, heights=filled(area.heights)) if holes == "fill" and not np.isfinite(area.heights).all() else area
    )
    keys = {"form": form, "cutoff": cutoff, "short_cutoff": short_cutoff, "outliers": outliers, **trace_keys}
    rows: dict[str, dict[str, Any] | None] = {}
    traces: dict[str, tuple[Profile, Profile]] = {}
    for which, angle in (("across", across), ("along", across + 0.5 * math.pi)):
        try:
            trace = trace_at(bare, angle, which)
            profile, row = trace_record(trace, **keys)
        except InputError as error:
            warnings.append(f"the trace {which} the lay is not evaluated: {error.rule}")
            rows[which] = None
            continue
        traces[which] = trace, profile
        rows[which] = row
    own = {name: (rows["across"] or {}).get(name) for name in _OF_TRACE}
    warnings += [f"trace across the lay: {text}" for text in (rows["across"] or {}).get("warnings", ())]
    record = {**own, "areal": areal, "along": rows["along"], "warnings": warnings}
    angles = across, across + 0.5 * math.pi
    raw = {which: pair[0] for which, pair in traces.items()}
    cut, evaluated = traces.get("across", (None, None))
    return EvaluatedMap(rough, record, angles, cut, evaluated, raw)
