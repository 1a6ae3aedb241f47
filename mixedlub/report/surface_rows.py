"""Evaluated surfaces of `mixedlub profile`: lines for the terminal, and one table with a row a surface."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from mixedlub.chain.effect import entry
from mixedlub.schema.result import described

if TYPE_CHECKING:
    import pandas as pd

Record = Mapping[str, Any]

_LINES = "core of the material ratio curve, ISO 13565-2"
TRACE_COLUMNS = {
    "Ra_um": "mean height of the trace (across the lay of a map)",
    "Rq_um": "rms height of the trace",
    "Rz_um": "mean of highest peak plus deepest valley over the sampling lengths",
    "Rt_um": "highest peak plus deepest valley of the whole trace",
    "Rp_um": "mean of the highest peaks",
    "Rv_um": "mean of the deepest valleys",
    "Rsk": "skewness of the heights of the trace",
    "Rku": "kurtosis of the heights of the trace",
    "Rdq": "rms slope of the trace",
    "RSm_um": "mean width of the profile elements",
    "Rk_um": f"height of the {_LINES}",
    "Rpk_um": f"height of the peaks above the {_LINES}",
    "Rvk_um": f"depth of the valleys below the {_LINES}",
    "Mr1_percent": f"material ratio at the upper end of the {_LINES}",
    "Mr2_percent": f"material ratio at the lower end of the {_LINES}",
}
MOMENT_COLUMNS = {
    "m0_um2": "variance of the heights of the trace",
    "m2": "variance of its slopes",
    "m4_per_um2": "variance of its curvatures",
    "spacing_um": "step of the trace",
    "short_cutoff_um": "short cut-off; empty for none",
    "cutoff_mm": "long cut-off; empty for none",
}
ASPERITY_COLUMNS = {
    "density_per_mm2": "asperities per area, by the moments of the trace",
    "radius_um": "radius of the asperities",
    "sigma_um": "standard deviation of the heights of the asperities",
    "nayak": "bandwidth m0 m4 / m2^2",
}
MAP_COLUMNS = {
    "Sa_um": "mean height of the map",
    "Sq_um": "rms height of the map",
    "Sz_um": "highest peak plus deepest pit of the map",
    "Sp_um": "highest peak of the map",
    "Sv_um": "deepest pit of the map",
    "Ssk": "skewness of the heights of the map",
    "Sku": "kurtosis of the heights of the map",
    "Sal_um": "shortest distance at which the autocorrelation falls to 0.2",
    "Str": "shortest over longest such distance: near 0 with a lay, near 1 without",
    "Std_deg": "direction of the lay to the rows of the map",
    "Sdq": "rms gradient of the map",
    "Sdr_percent": "developed area beyond the projected area",
    "Sk_um": "height of the core of the areal material ratio curve",
    "Spk_um": "height of the peaks above the areal core",
    "Svk_um": "depth of the valleys below the areal core",
    "Smr1_percent": "areal material ratio at the upper end of the core",
    "Smr2_percent": "areal material ratio at the lower end of the core",
    "Sxp_um": "height from 50 to 2.5 % areal material ratio",
    "Vmp_um": "volume of the peaks over the area (1 um = 1 um3/um2 = 1 ml/m2)",
    "Vmc_um": "material volume of the core over the area",
    "Vvc_um": "void volume of the core over the area",
    "Vvv_um": "void volume of the valleys over the area",
}
SURFACE_COLUMNS = described(
    file="text:file of the surface",
    kind="text:trace, map, or assumed from one number",
    **TRACE_COLUMNS,
    **MOMENT_COLUMNS,
    **ASPERITY_COLUMNS,
    gaussian="text:verdict on the heights of the trace",
    holes_percent="points of the map without a height",
    **MAP_COLUMNS,
    warnings="number of warnings",
)


def surface_table(records: Iterable[Record]) -> pd.DataFrame:
    """Table with a row a surface; parameters that a kind of surface lacks are empty, columns without any left out."""
    import pandas as pd

    rows = []
    for record in records:
        areal = record.get("areal") or {}
        row = {"file": record["file"], "kind": record["kind"]}
        for part, columns in (
            ("parameters", TRACE_COLUMNS),
            ("moments", MOMENT_COLUMNS),
            ("asperities", ASPERITY_COLUMNS),
        ):
            row |= {name: (record.get(part) or {}).get(name) for name in columns}
        row["gaussian"] = (record.get("gaussian") or {}).get("verdict")
        row["holes_percent"] = areal.get("holes_percent")
        row |= {name: areal.get("parameters", {}).get(name) for name in MAP_COLUMNS}
        rows.append({**row, "warnings": len(record["warnings"])})
    table = pd.DataFrame(rows, columns=[one.name for one in SURFACE_COLUMNS])
    numbers = [name for name in table.columns if name not in ("file", "kind", "gaussian")]
    table[numbers] = table[numbers].astype(float)
    return table.dropna(axis="columns", how="all")


def summary(record: Record) -> Iterator[str]:
    """Summary of a surface in lines that fit a terminal."""
    yield str(record["file"])
    if record.get("areal"):
        yield from _of_map(record["areal"])
    if record.get("assumption"):
        yield from _of_number(record)
    if record.get("parameters"):
        yield from _of_trace(record, "across" if record.get("areal") else "steps")
    if record.get("along"):
        p, m = record["along"]["parameters"], record["along"]["moments"]
        heights = ", ".join(f"{name} {number(p[key], 5)}{unit}" for name, key, unit in _HEIGHTS)
        yield _entry("along", f"{heights}; m2 {number(m['m2'])}, m4 {number(m['m4_per_um2'])} 1/um2")


def _of_map(areal: Record) -> Iterator[str]:
    p, m = areal["parameters"], areal["moments"]
    points, size = (" x ".join(f"{value:.4g}" for value in areal[key]) for key in ("points", "size_mm"))
    yield _entry("map", f"{points} points, {size} mm; {'; '.join(areal['steps'])}")
    yield _entry("heights", _listed(p, ("Sa_um", "Sq_um", "Sz_um", "Sp_um", "Sv_um", "Ssk", "Sku")))
    yield _entry("texture", _listed(p, ("Sal_um", "Str", "Std_deg", "Sdq", "Sdr_percent")))
    yield _entry("functional", _listed(p, ("Sk_um", "Spk_um", "Svk_um", "Smr1_percent", "Smr2_percent", "Sxp_um")))
    yield _entry("volumes", _listed(p, ("Vmp_um", "Vmc_um", "Vvc_um", "Vvv_um")))
    yield _entry(
        "moments",
        f"m0 {number(m['m0_um2'])} um2, across the lay m2 {number(m['m2'])}, m4 {number(m['m4_per_um2'])} 1/um2, "
        f"along it m2 {number(m['m2_along'])}, m4 {number(m['m4_along_per_um2'])} 1/um2",
    )


def _of_number(record: Record) -> Iterator[str]:
    m, a = record["moments"], record["asperities"]
    values = (
        (key, unit, m[key], m["band"][key]) for key, unit in (("m0_um2", " um2"), ("m2", ""), ("m4_per_um2", " 1/um2"))
    )
    yield _entry(
        "moments",
        ", ".join(
            f"{key.partition('_')[0]} {number(value)} ({number(low)} to {number(high)}){unit}"
            for key, unit, value, (low, high) in values
        ),
    )
    yield _asperities(a)


def _of_trace(record: Record, what: str) -> Iterator[str]:
    p, m, a, g = (record[key] for key in ("parameters", "moments", "asperities", "gaussian"))
    yield _entry(what, "; ".join(record["steps"]) or "none: evaluated as read")
    yield _entry("by", f"{p['convention']}, sampling lengths: {p['sections']}")
    yield _entry("heights", ", ".join(f"{name} {number(p[key], 5)}{unit}" for name, key, unit in _HEIGHTS))
    yield _entry("moments", f"m0 {number(m['m0_um2'])} um2, m2 {number(m['m2'])}, m4 {number(m['m4_per_um2'])} 1/um2")
    yield _asperities(a)
    for row in a["short_cutoff_band"]:
        if row["short_cutoff_um"] != m["short_cutoff_um"]:
            yield _entry(
                "",
                f"at short cut-off {number(row['short_cutoff_um'])} um: m2 {number(row['m2'])}, "
                f"m4 {number(row['m4_per_um2'])} 1/um2, {number(row['density_per_mm2'])} per mm2, "
                f"radius {number(row['radius_um'])} um",
            )
    yield _entry("Gaussian?", g.get("words", "cannot be judged, so not taken as Gaussian"))


def _asperities(a: Record) -> str:
    return _entry(
        "asperities",
        f"{number(a['density_per_mm2'])} per mm2, radius {number(a['radius_um'])} um, "
        f"sigma {number(a['sigma_um'])} um, Nayak alpha {number(a['nayak'])}",
    )


def _listed(values: Record, names: Iterable[str]) -> str:
    """Parameters with their units: names end in them."""
    shown = ((*name.partition("_")[::2], values[name]) for name in names)
    return ", ".join(
        f"{symbol} {number(value, 4)}{'' if value is None else _UNITS.get(unit, '')}" for symbol, unit, value in shown
    )


def _entry(name: str, text: str) -> str:
    """A name and its text, wrapped."""
    return entry(f"  {name}", text, _INDENT)


_INDENT = 13
_UNITS = {"um": " um", "deg": " degrees", "percent": " %"}
_HEIGHTS = (
    *((name, f"{name}_um", " um") for name in ("Ra", "Rq", "Rz")),
    *((name, name, "") for name in ("Rsk", "Rku", "Rdq")),
)


def number(value: float | None, digits: int = 4) -> str:
    """A number with so many digits; a dash for none.

    >>> number(0.123456), number(None)
    ('0.1235', '-')
    """
    return "-" if value is None else f"{value:.{digits}g}"
