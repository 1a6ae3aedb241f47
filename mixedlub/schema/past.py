"""Names of the history of a condition, by which laws read it as a column."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from mixedlub.schema.units import ending_of, without_unit

DIRECTION, BEFORE, SINCE, MEMORY = "direction", "before", "since", "memory"
CLOCKS = {"time_s": "s", "sequence": "share", "run": "readings"}
"""Columns that give an order, and the unit of a duration in each: seconds, share of the programme, readings."""
_TAIL = re.compile(
    rf"_({DIRECTION}|{BEFORE}|{SINCE}|{MEMORY})(?:_(\d+(?:p\d+)?)?({'|'.join(CLOCKS.values())}))?(?:_\w+)?"
)


@dataclass(frozen=True)
class Past:
    """A history coordinate of a condition.

    ``what``: direction of the last change (1 up, -1 down, 0 none yet), level before it, duration since it, or
    exponential memory of the condition with the ``fading`` time; durations have the unit ``clock``.
    """

    column: str
    what: str
    clock: str = ""
    fading: float = 0.0

    @property
    def name(self) -> str:
        """The name by which a law reads it.

        >>> Past("load_N", BEFORE).name, Past("oil_temperature_C", MEMORY, "s", 2.5).name
        ('load_before_N', 'oil_temperature_memory_2p5s_C')
        """
        ending = f"_{ending_of(self.column)}" if ending_of(self.column) else ""
        found = f"{without_unit(self.column)}_{self.what}"
        if self.what == SINCE:
            return f"{found}_{self.clock}"
        if self.what == MEMORY:
            return f"{found}_{f'{self.fading:.12f}'.rstrip('0').rstrip('.').replace('.', 'p')}{self.clock}{ending}"
        return found if self.what == DIRECTION else f"{found}{ending}"


def past_of(name: str, columns: Iterable[str]) -> Past | None:
    """The history coordinate with a name, of one of the columns; None if it is none.

    >>> past_of("load_direction", ["load_N"]).what, past_of("load_since_s", ["load_N"]).clock
    ('direction', 's')
    >>> past_of("load_memory_2p5s_N", ["load_N"]).fading, past_of("load_N", ["load_N"])
    (2.5, None)
    """
    for column in columns:
        stem = without_unit(column)
        found = _TAIL.fullmatch(name[len(stem) :]) if name.startswith(stem) else None
        if found is not None:
            what, fading, clock = found.groups()
            past = Past(column, what, clock or "", float((fading or "0").replace("p", ".")))
            if past.name == name:
                return past
    return None
