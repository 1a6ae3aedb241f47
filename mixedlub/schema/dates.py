"""Dates with time of day in instrument formats; both readings if day and month are ambiguous."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime, timedelta, timezone

ORDERS = ("day first", "month first")
MONTHS = ("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec")
ENDS = ("uary", "ruary", "ch", "il", "", "e", "y", "ust", "t(?:ember)?", "ober", "ember", "ember")
MONTH = "|".join(rf"{month}(?:{end})?" for month, end in zip(MONTHS, ENDS, strict=True))
NAMED = rf"(?P<month>{MONTH})\.?"
DAY, YEAR = r"(?P<day>\d{1,2})", r"(?P<year>\d{4})"
CLOCK = (
    r"(?P<hour>\d{1,2}):(?P<minute>\d\d)(?P<second>:\d\d(?:\.\d+)?)?"
    r"(?:\s*(?P<half>[ap])\.?m\.?)?(?:\s*(?P<zone>z|utc|gmt|[+-]\d\d(?::?\d\d)?))?"
)
FORMS = tuple(
    re.compile(rf"{date}(?:t|,?\s+){CLOCK}", re.IGNORECASE)
    for date in (
        rf"{YEAR}(?P<mark>[-/.])(?P<month>\d{{1,2}})(?P=mark){DAY}",
        rf"(?P<first>\d{{1,2}})(?P<mark>[-/.])(?P<other>\d{{1,2}})(?P=mark){YEAR}",
        rf"{DAY}[ .-]+{NAMED}[ ,-]+{YEAR}",
        rf"{NAMED}[ -]+{DAY}(?:st|nd|rd|th)?[ ,-]+{YEAR}",
    )
)
BEGUN = re.compile(rf"\d+[-/.:]\d+|(?:\d{{1,2}}[ .-]+)?(?:{MONTH})\.?[ ,-]+\d", re.IGNORECASE)


def is_dated(cell: str) -> bool:
    """Whether a cell begins with a date or a time of day, and so cannot be a name.

    >>> [is_dated(cell) for cell in ("23/11/2026", "14:03", "23 Nov 2026", "Nov 23, 2026", "steel 52", "Marlin 3")]
    [True, True, True, True, False, False]
    """
    return BEGUN.match(cell) is not None


def moments(cells: Sequence[str]) -> Mapping[str, list[datetime]]:
    """Times in cells of dates in one format, by order of day and month.

    An unambiguous order has the name ''. Empty if a cell is not a date.

    >>> [str(m) for m in moments(["23 Nov 2026 02:03:10 PM"])[""]]
    ['2026-11-23 14:03:10']
    >>> {order: str(found[0]) for order, found in moments(["05/06/2019 22:00"]).items()}
    {'day first': '2019-06-05 22:00:00', 'month first': '2019-05-06 22:00:00'}
    >>> list(moments(["23/11/2026 14:03", "05/11/2026 14:03"])), moments(["14:03"])
    ([''], {})
    """
    for form in FORMS:
        if not cells or form.fullmatch(cells[0].strip()) is None:
            continue
        parts = [form.fullmatch(cell.strip()) for cell in cells]
        read = [part.groupdict() for part in parts if part is not None]
        if len(read) < len(parts):
            return {}
        if "first" not in read[0]:
            ways = {"": [_moment(part, part["day"], part["month"]) for part in read]}
        else:
            ways = {"day first": [_moment(part, part["first"], part["other"]) for part in read]}
            # With dots as separators the day comes first.
            if any(part["mark"] != "." for part in read):
                ways["month first"] = [_moment(part, part["other"], part["first"]) for part in read]
        whole = {order: [m for m in found if m is not None] for order, found in ways.items()}
        whole = {order: found for order, found in whole.items() if len(found) == len(cells) and _same_zone_use(found)}
        return whole if len(whole) != 1 else {"": next(iter(whole.values()))}
    return {}


def resolution(cells: Sequence[str]) -> float:
    """Resolution of a clock in seconds; a minute if seconds are missing.

    >>> resolution(["23/11/2026 14:03"]), resolution(["2026-11-23T14:03:10Z"])
    (60.0, 1.0)
    """
    return 1.0 if all(re.search(r":\d\d:\d\d", cell) for cell in cells) else 60.0


def _same_zone_use(found: Sequence[datetime]) -> bool:
    """Whether either all times or no times have a time zone."""
    return len({moment.tzinfo is None for moment in found}) == 1


def _moment(part: Mapping[str, str | None], day: str | None, month: str | None) -> datetime | None:
    """Time from the parts of a date; None for a day or hour that does not exist."""
    name, half, hour = (month or "").lower(), (part["half"] or "").lower(), int(part["hour"] or 0)
    number = int(name) if name.isdecimal() else MONTHS.index(name[:3]) + 1
    if half and not 1 <= hour <= 12:
        return None
    if half:
        hour = hour % 12 + (12 if half == "p" else 0)
    second = float((part["second"] or ":0")[1:])
    try:
        start = datetime(int(part["year"] or 0), number, int(day or 0), hour, int(part["minute"] or 0))
        zone = _zone(part["zone"]) if part["zone"] else None
    except ValueError:
        return None
    return (start + timedelta(seconds=second)).replace(tzinfo=zone) if second < 61.0 else None


def _zone(text: str | None) -> timezone:
    """Time zone from the suffix of a time of day.

    >>> _zone("Z") == timezone.utc, str(_zone("-0530"))
    (True, 'UTC-05:30')
    """
    found = re.fullmatch(r"([+-])(\d\d):?(\d\d)?", text or "")
    if found is None:
        return UTC
    ahead = timedelta(hours=int(found[2]), minutes=int(found[3] or 0))
    return timezone(ahead if found[1] == "+" else -ahead)
