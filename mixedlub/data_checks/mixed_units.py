"""Columns in the wrong unit, or in two units: all values, or some of them, are wrong by a power of ten."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from scipy.spatial import cKDTree

from mixedlub.case.folder import Case
from mixedlub.case.forward import Forward
from mixedlub.schema.findings import Finding, collected, finding
from mixedlub.schema.ranges import atypical
from mixedlub.schema.table import Table
from mixedlub.schema.units import UNITS, read_as
from profiles.errors import InputError

SLIPS: Mapping[float, str] = {
    1e2: "a hundred times",
    1e-2: "a hundredth of",
    1e3: "a thousand times",
    1e-3: "a thousandth of",
    1e6: "a million times",
    1e-6: "a millionth of",
}
UNIT_TOLERANCE = 2.0
"""Judgement. Factor by which a wrong unit may differ from its power of ten: the accuracy of the base model."""
COMMON_FACTOR, AGREED = 3.0, 1.25
"""Judgement. Factor off the base model from which a condition is tried in other units, and largest factor left by the
right unit: missing physics seldom multiplies all readings by one factor of that size."""
LEAST_PART = 0.1
"""Judgement. Least share of the readings that counts as a second unit rather than as outliers."""
TEN = 10.0
"""Judgement. A power of ten that physics may also cause: readings of both parts must then be mixed among the
conditions."""
MIXED_SHARE = 0.5
"""Judgement. Share of the smaller part with a nearest neighbour in the other, from which the parts count as mixed."""
CLEAR_GAP = 0.5
"""Judgement. Least gap between two parts, over the distance of their medians."""
CLEAR_GAP_MIXED = 0.25
"""Judgement. The same where conditions do not separate the parts."""
POWERS = (1e1, 1e2, 1e3, 1e6)
"""Grid. Powers of ten by which a wrong unit may be off."""
REPEATED_LEVELS = 3
"""Judgement. Levels of a condition that must repeat a power of ten higher."""
SAME_CONDITION = 0.02
"""Judgement. Relative tolerance of conditions that count as equal."""
SAME_READING = 0.15
"""Judgement. Tolerance of the logarithm of readings that count as equal."""
WARM = 20.0
"""Judgement. Temperature (degC) from which oils have their working viscosity."""
LOW_PRESSURE = 100.0
"""Judgement. Pressure (MPa) up to which oils have their working viscosity."""
PARTS_DIFFER = 1.5
"""Judgement. Factor by which the base model differs between two parts at least, and their gap exceeds gaps within
them."""


def of_another_unit(case: Case, y: np.ndarray, base: np.ndarray, fewest: int) -> list[Finding]:
    """Readings that differ from the base model by a power of ten, or in sign."""
    both = (np.abs(base) > 0) & (np.abs(y) > 0)
    if both.sum() < fewest:
        return []
    ratio = float(np.median(np.abs(y[both] / base[both])))
    findings = [
        finding(
            "readings_in_other_unit",
            f"readings are about {words} what the base model gives: check the unit of {case.quantity}",
        )
        for slip, words in SLIPS.items()
        if slip / UNIT_TOLERANCE < ratio < slip * UNIT_TOLERANCE
    ]
    if np.mean(base[both] * y[both] < 0) > 0.5:
        text = "most readings have the opposite sign to the base model: check the sign"
        findings.append(finding("sign_opposite_to_model", text))
    return findings


def conditions_of_another_unit(case: Case, rows: Table, y: np.ndarray, base: np.ndarray, fewest: int) -> list[Finding]:
    """A condition that brings readings a common factor off the base model to it, read in another unit."""
    before = _log_ratio(y, base)
    if before.size < fewest or abs(np.median(before)) < np.log(COMMON_FACTOR):
        return []
    found = []
    for name in _sizes(case, rows):
        for unit, (factor, added) in UNITS.get(read_as(name), {}).items():
            table = Table({**rows.columns, name: rows[name] * factor}, rows.source)
            if added or factor == 1.0 or (after := _in_unit(replace(case, recordings=table), table, y)) is None:
                continue
            off, spread = abs(float(np.median(after))), float(np.median(np.abs(after - np.median(after))))
            if max(off, spread) < np.log(AGREED):
                found.append((off + spread, name, unit, np.exp(off + spread) - 1.0))
    if not found:
        return []
    _, name, unit, left = min(found, key=lambda one: one[0])
    text = (
        f"readings are about {np.exp(np.median(before)):.2g} times what the base model gives; most would agree with it "
        f"within {100.0 * left:.0f} % if {name} were in {unit}: is it in that unit?"
    )
    return [finding("condition_in_other_unit", text, name)]


def _in_unit(case: Case, table: Table, y: np.ndarray) -> np.ndarray | None:
    """Logarithms of the readings over the base model of a changed table; None if the model has no result."""
    try:
        with collected(), np.errstate(all="ignore"):
            found = _log_ratio(y, Forward(case, table).base_prediction())
    except InputError:
        return None
    return found if found.size else None


def _log_ratio(y: np.ndarray, base: np.ndarray) -> np.ndarray:
    """Logarithm of readings over the base model where both are of one sign."""
    used = y * base > 0.0
    return np.asarray(np.log(y[used] / base[used]))


def of_two_units(case: Case, rows: Table, y: np.ndarray, base: np.ndarray, fewest: int) -> list[Finding]:
    """Readings with a part that differs from the rest by a power of ten, relative to the base model."""
    used = (np.abs(base) > 0) & (np.abs(y) > 0)
    if used.sum() < fewest:
        return []
    ratio = np.log10(np.abs(y[used] / base[used]))
    upper, gap = _upper_part(ratio)
    if min(upper.sum(), (~upper).sum()) < LEAST_PART * used.sum():
        return []
    apart = float(np.median(ratio[upper]) - np.median(ratio[~upper]))
    slips = [np.log10(slip) for slip in (TEN, *SLIPS) if slip > 1.0]
    slip = min(slips, key=lambda slip: abs(apart - slip))
    if abs(apart - slip) >= np.log10(UNIT_TOLERANCE):
        return []
    kept = rows.take(used)
    mixed = _are_mixed(_places(case, kept), upper)
    if gap < (CLEAR_GAP_MIXED if mixed else CLEAR_GAP) * apart or (slip == 1.0 and not mixed):
        return []
    lower = f"{int((~upper).sum())} readings are about {10**apart:.2g} times smaller"
    names = [case.quantity, *(name for name in _sizes(case, kept) if _same_split(np.abs(kept[name]), upper))]
    one = f"{names[0]} is" if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]} are each"
    text = f"{lower}, relative to the base model, than the others: check that {one} in one unit"
    return [finding("readings_in_two_units", text)]


def conditions_of_two_units(case: Case, rows: Table, y: np.ndarray, base: np.ndarray) -> list[Finding]:
    """Columns that mix two units: levels repeat a power of ten higher while the readings agree."""
    findings = []
    for name in _sizes(case, rows):
        size = np.abs(rows[name])
        power = _power_between(case, rows, name, y, base) if np.all(size > 0.0) else None
        if power is not None:
            count = int(_upper_part(np.log10(size))[0].sum())
            text = (
                f"{count} of {size.size} values are {power:g} times the others where readings and other conditions "
                "agree: check that the column is in one unit"
            )
            findings.append(finding("condition_in_two_units", text, name))
    return findings


def of_odd_units(case: Case, rows: Table, y: np.ndarray, base: np.ndarray, fewest: int, scarce: int) -> list[Finding]:
    """All findings on units; ``fewest`` and ``scarce`` are the fewest readings to compare and to split."""
    return [
        *atypical_sizes(rows, y, case.quantity),
        *too_thick(rows, y, case.quantity),
        *of_another_unit(case, y, base, fewest),
        *conditions_of_another_unit(case, rows, y, base, fewest),
        *(conditions_of_two_units(case, rows, y, base) or of_two_units(case, rows, y, base, scarce)),
    ]


def atypical_sizes(rows: Table, y: np.ndarray, quantity: str) -> list[Finding]:
    """Columns with a largest value above the range of all rigs, with the unit in which it would be typical."""
    columns = {**rows.columns, quantity: y}
    return [
        one
        for name in SIZED
        if name in columns
        for one in atypical(f"recordings.{name}", float(np.max(np.abs(columns[name]))), f"the largest {name}")
    ]


def too_thick(rows: Table, y: np.ndarray, quantity: str) -> list[Finding]:
    """Viscosities all above the range of oils, although some are at room temperature and low pressure."""
    if quantity != "viscosity_mPa_s" or rows["temperature_C"].max() < WARM:
        return []
    if "pressure_MPa" in rows and rows["pressure_MPa"].min() > LOW_PRESSURE:
        return []
    return atypical(f"recordings.{quantity}", float(np.min(y)), f"the smallest {quantity}")


SIZED = ("entrainment_speed_m_s", "sliding_speed_m_s", "film_thickness_nm")
"""Columns with a typical size on all rigs; loads, torques and shaft speeds depend on the machine."""


def _power_between(case: Case, rows: Table, name: str, y: np.ndarray, base: np.ndarray) -> float | None:
    """Power of ten between two parts of a condition with equal readings at equal other conditions, or None."""
    log = np.log10(np.abs(rows[name]))
    upper, gap = _upper_part(log)
    inner = max((_largest_gap(log[part]) for part in (upper, ~upper) if part.any()), default=0.0)
    if min(upper.sum(), (~upper).sum()) < REPEATED_LEVELS or gap < np.log10(PARTS_DIFFER) + inner:
        return None
    for power in POWERS:
        values = np.where(upper, rows[name] / power, rows[name])
        places = _places(case, Table({**rows.columns, name: values}))
        one, other = np.flatnonzero(upper), np.flatnonzero(~upper)
        few, many = (one, other) if one.size <= other.size else (other, one)
        many = many[np.sort(np.unique(places[many], axis=0, return_index=True)[1])]  # a tree cannot part equal points
        off, nearest = cKDTree(places[many]).query(places[few])
        near = off <= SAME_CONDITION
        if near.mean() < MIXED_SHARE or np.unique(values[few[near]]).size < REPEATED_LEVELS:
            continue
        pairs = few[near], many[nearest[near]]
        if _apart(y, *pairs) < SAME_READING and _apart(base, *pairs) > np.log(PARTS_DIFFER):
            return power
    return None


def _apart(values: np.ndarray, one: np.ndarray, other: np.ndarray) -> float:
    """Median difference in size between the rows of each pair, as a logarithm."""
    sizes = np.maximum(np.abs(values), 1e-300)
    return float(np.median(np.abs(np.log(sizes[one] / sizes[other]))))


def _upper_part(values: np.ndarray) -> tuple[np.ndarray, float]:
    """Which values lie above the widest gap between neighbours, and how wide it is.

    >>> upper, gap = _upper_part(np.array([3.0, 1.0, 1.5, 3.2]))
    >>> upper.tolist(), gap
    ([True, False, False, True], 1.5)
    """
    ranked = np.sort(values)
    cut = int(np.argmax(np.diff(ranked))) + 1 if values.size > 1 else 0
    return values >= ranked[cut], _largest_gap(values)


def _largest_gap(values: np.ndarray) -> float:
    return float(np.max(np.diff(np.sort(values)), initial=0.0))


def _same_split(sizes: np.ndarray, upper: np.ndarray) -> bool:
    """Whether a gap of half a decade or more splits a condition in the same way as the readings."""
    if np.any(sizes <= 0.0):
        return False
    high, gap = _upper_part(np.log10(sizes))
    return gap >= 0.5 and (np.array_equal(high, upper) or np.array_equal(high, ~upper))


def _sizes(case: Case, rows: Table) -> list[str]:
    """Conditions on a ratio scale: no names, times, angles or temperatures."""
    names = [column.name for column in case.kind.columns if column.dtype != "name" and column.name in rows]
    return [name for name in names if not name.endswith(("_s", "_deg", "_C")) or name.endswith("_m_s")]


def _places(case: Case, rows: Table) -> np.ndarray:
    """Conditions of each row scaled to 0 to 1, logarithmic over decades; time only where the kind requires it."""
    axes = [np.zeros(len(rows))]
    for column in case.kind.columns:
        if column.name not in rows or (column.name == "time_s" and not column.required):
            continue
        values = rows[column.name]
        if values.dtype.kind in "US":
            axes.extend((values == name).astype(float) for name in np.unique(values))
            continue
        size = np.abs(values)
        if size.min() > 0.0 and size.max() > 3.0 * size.min():
            axes.append((values > 0.0).astype(float))
            values = np.log(size)
        axes.append((values - values.min()) / (np.ptp(values) or 1.0))
    return np.column_stack(axes)


def _are_mixed(places: np.ndarray, upper: np.ndarray) -> bool:
    """Whether points of the smaller part are as near to the other part as to their own.

    >>> x = np.linspace(0.0, 1.0, 20)[:, None]
    >>> _are_mixed(x, np.arange(20) % 2 == 0), _are_mixed(x, x[:, 0] > 0.6)
    (True, False)
    """
    small = upper if 2 * upper.sum() <= upper.size else ~upper
    points = np.unique(places[small].round(9), axis=0)
    if len(points) < REPEATED_LEVELS:
        return False
    within = cKDTree(points).query(points, k=[2])[0][:, 0]
    across = cKDTree(places[~small].round(9)).query(points)[0]
    return bool(np.mean(across <= within) >= MIXED_SHARE)
