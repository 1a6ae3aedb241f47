"""Published laws on own readings, from Python."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mixedlub.fit import Ranking, checked, of_columns, ranking, read_readings, result, tables
from mixedlub.schema.findings import collected, warn_of
from mixedlub.schema.shown import table_html
from profiles.errors import as_path

if TYPE_CHECKING:
    import pandas as pd

MOST_LAWS = 8
"""Judgement: most laws in the table of a notebook."""


@dataclass(frozen=True, eq=False)
class LawFit:
    """Laws fitted to readings, best first; it prints as the report of `mixedlub fit`.

    Attributes
    ----------
    laws : pandas.DataFrame
        A row a law: ``weight``, ``tied``, ``aicc``, ``bic``, ``rms_percent``, ``left_out_percent``, ``misfit``.
    parameters : pandas.DataFrame
        Parameters of every law with 90 % intervals and units.
    readings : pandas.DataFrame
        Readings with values and residuals of the best laws.
    not_judged : pandas.DataFrame
        Laws that could not be judged, and the reason.
    """

    ranking: Ranking
    laws: pd.DataFrame
    parameters: pd.DataFrame
    readings: pd.DataFrame
    not_judged: pd.DataFrame

    @property
    def best(self) -> str:
        """Name of the most probable law."""
        return self.ranking.best.law.name

    @property
    def tied(self) -> tuple[str, ...]:
        """Names of the laws that the readings do not tell from the best, the best first."""
        return self.ranking.tied

    def files(self, law: str | None = None) -> dict[str, str | bytes]:
        """Files of a fitted law for studies, cases and the solver, by name.

        Parameters
        ----------
        law : str, optional
            Name of the law; by default the best.

        Returns
        -------
        dict of str to str
            Contents by file name, as ``law.toml``, ``options.toml`` or ``oil.toml``.
        """
        return dict(result(self.ranking, "", law).files)

    def __repr__(self) -> str:
        return "\n".join(result(self.ranking, "").lines)

    def _repr_html_(self) -> str:
        """Table of a notebook: the laws, best first."""
        columns = ["law", "weight", "rms_percent", "left_out_percent", "misfit"]
        rows = self.laws[columns].head(MOST_LAWS).itertuples(index=False)
        return table_html(f"Laws of {self.ranking.readings.column}", rows, columns)


def fit_laws(
    readings: str | PathLike[str] | Mapping[str, Sequence[Any]] | pd.DataFrame,
    quantity: str | None = None,
    *,
    constants: Mapping[str, float] | None = None,
    relative_sd: float | None = None,
    own: Sequence[str | PathLike[str]] = (),
) -> LawFit:
    """Fit the published laws of a quantity to readings and rank them by evidence.

    Parameters
    ----------
    readings : str, PathLike, DataFrame or mapping
        Table (text or .xlsx), case folder, or columns; headers have units, as ``load_N`` or ``load (N)``.
    quantity : str, optional
        ``"friction_coefficient"``, ``"friction_torque_Nm"``, ``"film_thickness_nm"`` or ``"viscosity_mPa_s"``; by
        default the first of these that the table has.
    constants : mapping of str to float, optional
        Values that all rows share, by column with unit, as ``{"radius_mm": 20.0}``.
    relative_sd : float, optional
        Standard deviation of a reading over its size; by default a column ``..._sd``, else estimated.
    own : sequence of str or PathLike, optional
        Law files of your own that compete with the published laws.

    Returns
    -------
    LawFit
        Laws with weights and criteria, parameters with intervals, residuals, and the files of the fitted law.

    Raises
    ------
    profiles.errors.InputError
        If a column is missing or without unit, or the readings tell no law.

    Examples
    --------
    >>> import mixedlub as ml
    >>> viscosity = [1.792, 1.002, 0.653, 0.466, 0.354, 0.282]
    >>> water = {"temperature_C": [0, 20, 40, 60, 80, 100], "viscosity_mPa_s": viscosity}
    >>> found = ml.fit_laws(water, relative_sd=0.005)
    >>> found.best, "andrade" in found.tied
    ('vogel', False)
    """
    with collected() as findings:
        given = dict(constants or {})
        if isinstance(readings, str | PathLike):
            read = read_readings(as_path(readings, "fit_laws: readings"), quantity, given, relative_sd)
        else:
            columns: Any = readings
            table = {str(name): list(columns[name]) for name in columns}
            read = checked(of_columns(table, quantity, given), relative_sd)
        found = ranking(read, tuple(Path(as_path(path, "fit_laws: own")) for path in own))
        made = tables(found)
    warn_of([*read.notes, *findings, *found.range_findings(found.best)])
    return LawFit(found, made["laws"], made["parameters"], made["readings"], made["not_judged"])
