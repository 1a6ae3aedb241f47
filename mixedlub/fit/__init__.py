"""Fit of published laws to own readings, ranked by evidence."""

from mixedlub.fit.ranking import Ranking, ranking
from mixedlub.fit.readings import FITTED, Readings, checked, of_columns, read_readings
from mixedlub.fit.result import TABLES, result, tables

__all__ = [
    "FITTED",
    "TABLES",
    "Ranking",
    "Readings",
    "checked",
    "of_columns",
    "ranking",
    "read_readings",
    "result",
    "tables",
]
