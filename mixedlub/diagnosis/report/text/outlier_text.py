"""Outlier readings and the unfitted check channel, in words."""

from __future__ import annotations

import numpy as np

from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.labels import conditions_text, number, words_of
from mixedlub.diagnosis.settings.inference import LIKELY
from mixedlub.diagnosis.settings.report import MOST_LISTED, NOISE_CHANGED
from mixedlub.schema.units import unit_of


def reading_conditions(d: Diagnosis, row: int) -> str:
    """The conditions of one reading in words."""
    table = d.recorded.table
    named: dict[str, float | str] = {}
    for column in d.case.kind.columns:
        if column.name in table:
            value = table[column.name][row]
            named[column.name] = str(value) if column.dtype == "name" else float(value)
    return conditions_text(named)


def checked_channel(d: Diagnosis) -> tuple[str, ...]:
    """The correlation with the check channel, in a sentence."""
    check = d.check
    if check is None:
        return ()
    name = words_of(check.column)
    if check.correlation is None:
        return (f"The channel {name} is constant or too short to compare with.",)
    return (
        f"The predicted readings correlate with {name}, which was not used in any fit: {check.correlation:+.3f} over "
        f"{check.n} readings.",
    )


def shrunk_noise(d: Diagnosis) -> tuple[str, ...]:
    """Sentence on stated standard deviations that were shrunk strongly towards similar readings."""
    stated = d.recorded.table.columns.get(f"{d.case.quantity}_sd")
    if stated is None:
        return ()
    size = np.abs(d.readings) if d.case.kind.logarithmic else 1.0
    largest = float(np.exp(np.max(np.abs(np.log(d.search.problem.single_sd * size / stated)))))
    if largest < NOISE_CHANGED:
        return ()
    return (
        "The stated standard deviations vary irregularly, as estimates from few repeats do; they were shrunk towards "
        f"those of neighbouring conditions, by up to a factor {number(largest)}.",
    )


def outliers(d: Diagnosis) -> tuple[tuple[str, ...], tuple[tuple[str, ...], ...]]:
    """The probable outliers: sentences and a table."""
    rows = np.flatnonzero(d.outlier_chance > LIKELY)
    if not rows.size:
        return (), ()
    unit = unit_of(d.case.quantity) or "-"
    table = [("run", f"recorded ({unit})", f"predicted ({unit})", "off by", "conditions")]
    y = d.readings
    for i in rows[:MOST_LISTED]:
        deviation = (y[i] - d.recorded.predicted[i]) / d.recorded.sd[i]
        table.append(
            (
                str(int(d.recorded.table["run"][i])),
                number(y[i]),
                number(d.recorded.predicted[i]),
                f"{deviation:+.1f} sigma",
                reading_conditions(d, int(i)),
            )
        )
    more = f" The first {len(table) - 1}:" if rows.size > MOST_LISTED else ""
    several = f"{rows.size} readings are probably outliers and have"
    count = "One reading is probably an outlier and has" if rows.size == 1 else several
    sentences = [f"{count} little weight.{more}"]
    for i in rows.tolist():
        excess, sd = float(y[i] - d.recorded.predicted[i]), float(d.recorded.sd[i])
        fault = d.case.kind.instrument_fault(d.recorded.table, i, excess, sd)
        if fault is not None:
            sentences.append(f"Run {int(d.recorded.table['run'][i])}: {fault}.")
    return tuple(sentences), tuple(table)
