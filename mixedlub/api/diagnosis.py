"""Diagnosis and simulation of a case from Python."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub.api.own_simulation import Simulation, case_with_simulation
from mixedlub.case.folder import Case, conditions_for, read_case, with_hypotheses
from mixedlub.case.simulation import simulate as simulated
from mixedlub.diagnosis.campaign import diagnosis_with
from mixedlub.diagnosis.diagnose import Diagnosis, diagnosis_of
from mixedlub.diagnosis.report.files import case_origin, files, write
from mixedlub.diagnosis.report.improved import improved_case
from mixedlub.diagnosis.report.text.answer import as_json, campaign_record, next_tests_table, predictions
from mixedlub.diagnosis.report.text.headline import chance
from mixedlub.schema.findings import as_texts, collected, gravest_first, listed, warn_of
from mixedlub.schema.shown import lines_html, table_html
from mixedlub.schema.units import stated_units
from mixedlub.study.plan import counted
from profiles.errors import InputError, as_path, nearest

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike

    from mixedlub.case.folder import Frame

MOST_EFFECTS = 6
"""Judgement: most effects in the table of a notebook; the others are rarely above 0.01."""


@dataclass(frozen=True, eq=False, repr=False)
class Answer:
    """Diagnosis of a case: the physics missing in its simulation, with summary, tables, figures and files.

    Returned by `ml.diagnose`; displayed as a short summary, printed as the report of `mixedlub diagnose`. ``diagnosis``
    is the source of all results; only the other members are public.

    Examples
    --------
    >>> import mixedlub as ml, numpy as np
    >>> speed = np.array([10.0, 20, 50, 100, 200, 300, 400, 500] * 4)
    >>> torque = (0.5 + 2e-3 * speed + 0.6 * np.exp(-speed / 40)) * (1 + 0.01 * np.cos(7.0 * np.arange(32)))
    >>> drive = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm", "noise": {"relative": 0.01}}}
    >>> answer = ml.diagnose(ml.case.case_of(drive, {"speed_rpm": speed, "friction_torque_Nm": torque}, name="joint"))
    >>> print(repr(answer).partition("\\n")[0])
    Answer for 'joint': 32 readings of friction_torque_Nm
    >>> answer.verdict, answer.probabilities.index[0]
    (['stribeck'], 'stribeck')
    >>> answer.parameters["of"].unique().tolist()
    ['stribeck', 'calibration']
    """

    diagnosis: Diagnosis

    @cached_property
    def record(self) -> dict[str, Any]:
        """The content of `diagnosis.json`."""
        return as_json(self.diagnosis)

    @property
    def verdict(self) -> list[str]:
        """Effect ids of the most probable explanation, or ``["none"]``, or ``["unknown"]``."""
        return list(self.record["verdict"])

    @property
    def probabilities(self) -> pd.Series:
        """Posterior probability of each effect in the explanation, of none and of unknown; largest first."""
        import pandas as pd

        found = pd.Series(self.record["probabilities"], name="probability").rename_axis("effect")
        return found.sort_values(ascending=False, kind="stable")

    @property
    def parameters(self) -> pd.DataFrame:
        """Parameters of the verdict's effects and of the calibration, with 90 % intervals."""
        import pandas as pd

        rows = [{"of": e["id"], **parameter} for e in self.record["effects"] for parameter in e["parameters"]]
        rows += [{"of": "calibration", "name": name, **value} for name, value in self.record["calibration"].items()]
        return pd.DataFrame(rows, columns=["of", "name", "unit", "value", "low90", "high90"])

    @property
    def predictions(self) -> pd.DataFrame:
        """The table of `predictions.csv`: base, calibrated and predicted readings with 90 % intervals, conditions."""
        return predictions(self.diagnosis)

    @property
    def next_tests(self) -> pd.DataFrame:
        """The table of `next_tests.csv`: a batch of tests with an empty reading, to fill in and hand to ``add``."""
        return next_tests_table(self.diagnosis)

    @property
    def campaign(self) -> dict[str, Any] | None:
        """The content of `campaign.json`: answers before and after added readings; None without any."""
        return campaign_record(self.diagnosis)

    @property
    def findings(self) -> list[str]:
        """Notes, cautions and doubts about the input and the answer."""
        return as_texts(self.diagnosis.warnings)

    @property
    def improved(self) -> Case:
        """The case with the answer in its model, for `ml.simulate`: effects and calibration at their most probable
        values, a table of a missing part without law, or calibration alone where it predicts left-out levels better.
        """
        return improved_case(self.diagnosis)

    def summary(self) -> str:
        """The report in plain words."""
        from mixedlub.diagnosis.report.files import report_text

        return report_text(self.diagnosis)

    __str__ = summary

    def __repr__(self) -> str:
        d, (verdict, *tied) = self.diagnosis, (" + ".join(names) for names in self.record["tied"])
        before, after = map(_rms, d.residuals)
        lines = [f"Answer for {d.case.name!r}: {len(d.recorded.table)} readings of {d.case.quantity}"]
        lines += [f"verdict: {verdict} (probability {chance(d.posterior.weights[d.posterior.verdict])})"]
        lines += [f"tied with {listed(tied, 2)}"] if tied else []
        lines += [f"residuals in standard deviations: rms {before:.2f} before, {after:.2f} with the verdict"]
        lines += [f"{counted(len(self.findings), 'finding')}; summary() is the report"]
        return "\n  ".join(lines)

    def _repr_html_(self) -> str:
        """Summary and probabilities of a notebook."""
        rows = [(name, chance(p)) for name, p in self.probabilities.head(MOST_EFFECTS).items()]
        return lines_html(repr(self)) + table_html("Probabilities", rows, ("effect", "probability"))

    def figures(self) -> dict[str, Figure]:
        """Every figure of the report, by name."""
        from mixedlub.diagnosis.report.figures.figures import all_figures

        return all_figures(self.diagnosis)

    def plot(self, over: str | None = None, later: ArrayLike | None = None) -> Figure:
        """Plot the answer in one picture: residuals over a condition, probabilities, and the fit.

        Parameters
        ----------
        over : str, optional
            Numeric column of the recording; default: the condition of the mismatch.
        later : array_like, optional
            Readings measured afterwards at the conditions of ``predict``, in their order.

        Returns
        -------
        matplotlib.figure.Figure
            Three panels; the predictions of later readings have their 90 % intervals.

        Raises
        ------
        profiles.errors.InputError
            If the column is unknown or holds names, or later readings do not match the predictions.
        """
        from mixedlub.diagnosis.report.figures.in_one import in_one, main_condition

        d, table = self.diagnosis, self.diagnosis.recorded.table
        numeric = {n: v for n, v in table.columns.items() if v.dtype.kind in "fiu"}
        if over is not None and over not in numeric:
            raise InputError(f"no such column of numbers; {nearest(over, numeric)}", where="plot: over", value=over)
        asked = 0 if d.wanted is None else len(d.wanted.table)
        measured = None if later is None else np.atleast_1d(np.asarray(later, dtype=float))
        if measured is not None and measured.shape != (asked,):
            rule = f"must hold a reading for each of the {counted(asked, 'condition')} of predict"
            raise InputError(f"{rule}, not {measured.size}", where="plot: later")
        return in_one(d, main_condition(d) if over is None else over, measured)

    def plot_residuals(self, over: str = "run", axes: Axes | None = None) -> Axes:
        """Plot residuals (standard deviations) over a column of the recording, before and after the answer."""
        import matplotlib.pyplot as plt

        from mixedlub.diagnosis.labels import axis_label

        columns = self.diagnosis.recorded.table.columns
        if over not in columns:
            raise InputError(f"no such column; {nearest(over, columns)}", where="plot_residuals: over", value=over)
        axes = plt.gca() if axes is None else axes
        before, after = self.diagnosis.residuals
        at = columns[over]
        axes.axhspan(-2.0, 2.0, color="0.93", lw=0)
        axes.plot(at, before, "o", ms=3, color="0.6", label=f"calibrated base model, rms {_rms(before):.2f}")
        axes.plot(at, after, "o", ms=3, color="C0", label=f"with the answer, rms {_rms(after):.2f}")
        with stated_units(self.diagnosis.case.kind.units):
            axes.set_xlabel(axis_label(over) if over != "run" else "run")
        axes.set_ylabel("residual (standard deviations of the noise)")
        axes.legend()
        return axes

    def write(self, out: str | PathLike[str]) -> Path:
        """Write the files of `mixedlub diagnose` to a folder and return its path."""
        folder, case = as_path(out, "write"), self.diagnosis.given
        write(files(self.diagnosis), folder, case_origin(case.folder) if case.is_filed else None)
        return folder


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def diagnose(
    case: Case | str | PathLike[str] | Frame,
    predict: Frame | None = None,
    *,
    exclude: str | Sequence[str] = (),
    level: float = 0.01,
    hypotheses: Sequence[str | PathLike[str]] = (),
    simulate: Simulation | None = None,
    reading: str | None = None,
    units: Mapping[str, str] | None = None,
    noise: Mapping[str, float] | None = None,
    inputs: Mapping[str, tuple[float, float]] | None = None,
    system: Mapping[str, Any] | None = None,
    folder: str | PathLike[str] | None = None,
    name: str | None = None,
    add: Frame | str | PathLike[str] | None = None,
) -> Answer:
    """Diagnose which physics is missing in the base model of a recorded case, or in the user's own simulation.

    Parameters
    ----------
    case : Case, str, PathLike, DataFrame or mapping of str to array_like
        A case of ``ml.case``, or its folder; with ``simulate`` a table of conditions and readings.
    predict : DataFrame or mapping of str to array_like, optional
        Conditions of the predictions, by column; default: the conditions of the case.
    exclude : str or sequence of str, optional
        Ids of effects left out of the catalogue.
    level : float, optional
        Significance level of the mismatch test.
    hypotheses : sequence of str or PathLike, optional
        Law files that compete with the catalogue, beside those in the folder ``hypotheses`` of the case.
    simulate : callable, optional
        ``simulate(conditions, **inputs)``: simulated readings for a DataFrame of conditions, or for a dict of one row.
    reading : str, optional
        Column of the reading; default: the only column with the name of a known reading, else the last column.
    units : mapping of str to str, optional
        Units of columns without a unit in their name; ``"-"`` for pure numbers.
    noise : mapping, optional
        ``relative`` and ``absolute`` standard deviation of a reading; default: estimated.
    inputs : mapping of str to (float, float), optional
        Value and standard deviation of uncertain inputs, passed to ``simulate`` by their names.
    system : mapping, optional
        Further sections of `system.toml`, such as ``gears`` and ``lubricant``.
    folder : str or PathLike, optional
        Folder in which the case is written; default: it stays in memory.
    name : str, optional
        Name of the case.
    add : DataFrame, mapping of str to array_like, str or PathLike, optional
        Further readings, or the file of a batch filled in: they join the recording, which is not changed, and the
        answer is compared with the one without them (``Answer.campaign``).

    Returns
    -------
    Answer
        Verdict, probabilities, parameters with intervals, and predictions.

    Raises
    ------
    profiles.errors.InputError
        If the case, the conditions or the effect ids are invalid.

    Examples
    --------
    >>> import mixedlub as ml, numpy as np, pandas as pd
    >>> speed = np.array([10.0, 20, 50, 100, 200, 300, 400, 500] * 4)
    >>> torque = (0.5 + 2e-3 * speed + 0.6 * np.exp(-speed / 40)) * (1 + 0.01 * np.cos(7.0 * np.arange(32)))
    >>> rows = pd.DataFrame({"speed_rpm": speed, "friction_torque_Nm": torque})
    >>> drive = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm", "noise": {"relative": 0.01}}}
    >>> ml.diagnose(ml.case.case_of(drive, rows)).verdict
    ['stribeck']
    >>> own = lambda at, dry: dry + 2e-3 * at["speed_rpm"]
    >>> ml.diagnose(rows, simulate=own, inputs={"dry": (0.5, 0.1)}, noise={"relative": 0.01}).verdict
    ['stribeck']
    """
    rivals = [as_path(one, "hypotheses") for one in hypotheses]
    of_table: dict[str, Any] = {"reading": reading, "units": units, "noise": noise, "inputs": inputs}
    of_table |= {"system": system, "folder": folder, "name": name}
    given = {option: value for option, value in of_table.items() if value is not None}
    if simulate is not None:
        own = with_hypotheses(case_with_simulation(case, simulate, predict, **given), rivals)
        return Answer(diagnosis_of(own, own.conditions, _ids(exclude), level))
    if given:
        raise InputError("acts only with simulate; leave it out", where=f"diagnose: {next(iter(given))}")
    found = with_hypotheses(_case(case, "diagnose"), rivals)
    asked = found.conditions if predict is None else conditions_for(found, predict)
    if add is None:
        return Answer(diagnosis_of(found, asked, _ids(exclude), level))
    added = as_path(add, "add") if isinstance(add, str | PathLike) else add
    return Answer(diagnosis_with(found, added, asked, _ids(exclude), level))


def simulate(case: Case | str | PathLike[str], at: Frame | None = None) -> pd.DataFrame:
    """Simulate the model of a case, with the effects and the calibration named in it.

    Parameters
    ----------
    case : Case, str or PathLike
        A case of ``ml.case``, or its folder.
    at : DataFrame or mapping of str to array_like, optional
        Conditions by column; default: the conditions of the case.

    Returns
    -------
    pandas.DataFrame
        Readings by condition, with their validity. ``attrs["findings"]`` lists all notes, cautions and doubts; cautions
        and doubts are also issued as ``ml.CautionWarning``.

    Raises
    ------
    profiles.errors.InputError
        If the case or the conditions are invalid.

    Examples
    --------
    >>> import mixedlub as ml
    >>> drive = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm"}}
    >>> rows = {"speed_rpm": [100.0, 200.0, 300.0], "friction_torque_Nm": [0.51, 0.62, 0.69]}
    >>> ml.simulate(ml.case.case_of(drive, rows), at={"speed_rpm": [150.0, 250.0]}).columns.tolist()
    ['run', 'friction_torque_Nm', 'speed_rpm', 'validity']
    """
    found = _case(case, "simulate")
    asked = None if at is None else conditions_for(found, at)
    with collected() as notes:
        readings = simulated(found, asked)
    notes = gravest_first(notes)
    warn_of(notes)
    readings.attrs["findings"] = as_texts(notes)
    return readings


def _case(case: Any, where: str) -> Case:
    """Return the case, read from a folder if necessary."""
    return case if isinstance(case, Case) else read_case(as_path(case, where))


def _ids(exclude: str | Sequence[str]) -> tuple[str, ...]:
    """Tuple of effect ids."""
    ids = (exclude,) if isinstance(exclude, str) else tuple(exclude) if isinstance(exclude, Iterable) else (exclude,)
    if not all(isinstance(one, str) for one in ids):
        raise InputError("must be the id of an effect, or a list of effect ids", where="exclude", value=exclude)
    return ids
