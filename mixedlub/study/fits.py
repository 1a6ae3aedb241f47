"""Straight lines of the loss over roughness and over area ratio at each condition."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.schema.result import ResultColumn
from mixedlub.schema.table_files import LongTable
from mixedlub.study import checkpoint
from mixedlub.study.columns import condition_columns
from mixedlub.study.results import LEVELS, Results, about_table

if TYPE_CHECKING:
    import pyarrow as pa

FEWEST_PAIRINGS = 3
"""Smallest number of pairings for a meaningful straight line."""
_LINE = "straight line of power_loss_W over composite_roughness_um, by least squares through all pairings"
_OVER_AREA = "straight line of power_loss_W over boundary_area_ratio, in the same way"
OF_FITS = (
    ResultColumn("pairings", "pairings", "number of pairings that the lines go through, those out of range among them"),
    ResultColumn("slope", "slope_W_per_um", f"slope of the {_LINE}", 1e-6, given_unit="W/µm"),
    ResultColumn("intercept", "intercept_W", "power loss of that line at no roughness"),
    ResultColumn("square", "r_squared", "coefficient of determination R² of that line"),
    ResultColumn("residual", "residual_W", "root mean square of the differences from that line"),
    ResultColumn("area_slope", "area_ratio_slope_W", f"slope of the {_OVER_AREA}"),
    ResultColumn("area_intercept", "area_ratio_intercept_W", "power loss of that line where no asperities touch"),
    ResultColumn("area_square", "area_ratio_r_squared", "coefficient of determination R² of that line"),
)
"""Columns of the fits, after the conditions."""


@dataclass(frozen=True, eq=False)
class Line:
    """A straight line through the pairings at each condition; arrays of shape (oil temperature, torque, speed).

    >>> x = np.array([1.0, 2.0, 3.0]).reshape(3, 1, 1, 1)
    >>> line = straight_line(x, 2.0 * x + 5.0)
    >>> line.slope.item(), line.intercept.item(), line.square.item()
    (2.0, 5.0, 1.0)
    """

    slope: np.ndarray
    intercept: np.ndarray
    square: np.ndarray
    residual: np.ndarray


def straight_line(x: np.ndarray, y: np.ndarray) -> Line:
    """Least-squares line of y over x along the first axis; NaN if all x are equal."""
    dx, dy = x - x.mean(axis=0), y - y.mean(axis=0)
    across, along, both = (dx**2).sum(axis=0), (dy**2).sum(axis=0), (dx * dy).sum(axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        slope, square = both / across, both**2 / (across * along)
    intercept = y.mean(axis=0) - slope * x.mean(axis=0)
    return Line(slope, intercept, square, np.sqrt(((y - intercept - slope * x) ** 2).mean(axis=0)))


def over_roughness(results: Results) -> Line:
    """Line of loss over composite roughness at each condition."""
    return straight_line(results["composite_roughness"], results["power_loss"])


def can_be_fitted(results: Results) -> bool:
    """Whether the number and roughness range of the pairings suffice for straight lines."""
    roughness = results["composite_roughness"][:, 0, 0, 0]
    return len(np.unique(roughness)) >= FEWEST_PAIRINGS


def fit_columns() -> list[ResultColumn]:
    """All columns of the fits."""
    sides = ("pinion_surface", "gear_surface")
    return [*(c for c in condition_columns() if c.name not in sides), *OF_FITS]


def fits(results: Results) -> pa.Table:
    """Lines of a study as a table, a row per condition; without rows if there are too few pairings."""
    import pyarrow as pa

    line, area = over_roughness(results), straight_line(results["area_ratio"], results["power_loss"])
    values = {
        "pairings": np.full(line.slope.shape, float(len(results.study.pairings))),
        **{name: getattr(line, name) for name in ("slope", "intercept", "square", "residual")},
        **{f"area_{name}": getattr(area, name) for name in ("slope", "intercept", "square")},
    }
    axes = (getattr(results.study.file.conditions, name) for name in LEVELS)
    grid = dict(zip(LEVELS, np.meshgrid(*axes, indexing="ij"), strict=True))
    columns = {c.name: grid[c.name] if c.name in grid else c.of(values[c.output]) for c in fit_columns()}
    rows = None if can_be_fitted(results) else 0
    return pa.table({name: checkpoint.floats(column) for name, column in columns.items()}).slice(0, rows)


def fits_table(results: Results) -> LongTable:
    """Lines of a study for writing."""
    return LongTable(lambda: [fits(results)], tuple(c.name for c in fit_columns()), about_table(results.study))
