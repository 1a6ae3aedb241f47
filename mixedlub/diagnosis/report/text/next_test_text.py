"""Next tests in words: conditions, joint information, and tests beyond the recording."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from mixedlub.diagnosis.assessment.experiment_design import Batch
from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.labels import amount, conditions_text, explanation_words, range_text, words_of
from mixedlub.diagnosis.settings.assessment import CHANCE_OF_SETTLED, MOST_READINGS
from mixedlub.diagnosis.settings.report import USELESS_TEST, WEAK_TEST, WIDE_RANGE
from mixedlub.recording.conditions import PASSING, noisy_set_point
from mixedlub.recording.noise import setups_differ
from mixedlub.schema.table import Table
from mixedlub.study.plan import counted

BATCH_FILE = "next_tests.csv"
"""File of the answer with the batch to fill in."""
TAKEN_IN = f"Fill in its last column and hand it back: mixedlub diagnose CASE --add {BATCH_FILE}."
WAITED_FOR = ("time_s",)
"""Conditions reached by waiting."""
SETUPS = (
    "It differs between named parts, as it does where parts were mounted anew and set-ups differ: name these in a "
    "column setup and give the error of one set-up as noise.setup_relative or noise.setup_absolute."
)


def next_test(d: Diagnosis) -> tuple[str, ...]:
    """Recommended next tests, or the statement that no test is useful."""
    advice = _of_discrepancy(d) if d.posterior.verdict.is_discrepancy else ()
    if advice and d.batch.settled:
        return advice
    return (*advice, *_of_batch(d), *_beyond(d))


def _of_discrepancy(d: Diagnosis) -> tuple[str, ...]:
    """Readings that show the form or the cause of a discrepancy."""
    period = wave_period(d)
    if period:
        return (
            f"Look for a part of the rig with a period of {period}, such as a thermostat or a rotating part. Read "
            "at other intervals as well: a swing faster than the sampling appears with a longer period (aliasing).",
        )
    if d.search.discrepancy.best.form == "step" and d.search.discrepancy.best.axes[0] in PASSING:
        moment = local_position(d)
        return (f"Look up what was done to the rig or the sample at {moment}, and repeat a reading from before.",)
    if d.search.discrepancy.best.form == "delay":
        return ("Wait longer after a change of temperature, or run the same conditions in another order.",)
    past = d.search.discrepancy.best.past
    if past is not None:
        name = words_of(past.past.column)
        return (
            f"Change {name} up and down between the same levels, and read at once and again after different waits: "
            "only a history makes readings at equal conditions differ.",
        )
    if set(d.search.discrepancy.best.axes) <= set(PASSING) and d.search.discrepancy.best.axes:
        return ("It depends on time alone: run the programme again, in another order, and see whether it returns.",)
    return _refined(d)


def _of_batch(d: Diagnosis) -> tuple[str, ...]:
    """The batch in words: its first test, its information, and the readings it takes."""
    batch = d.batch
    if len(batch.rivals) < 2 or not batch.tests:
        return ("No useful test: there is no second explanation to distinguish from the first.",)
    first, table = batch.tests[0], d.recorded.table
    names = "; ".join(explanation_words(name.split("+")) for name in first.separates)
    run = to_run(first.conditions, table)
    if batch.settled:
        rival = next(explanation_words(key.ids) for key, _ in batch.rivals if key != d.posterior.verdict)
        run = run if batch.expected_bits >= USELESS_TEST else f"The test in {BATCH_FILE}"
        return (f"{run}: it could refute the answer best, in favour of {rival}.",)
    if batch.expected_bits < USELESS_TEST:
        return ("No useful test: no readings at these conditions would decide more.",)
    weak = ("No readings at these conditions would decide much; the best ones are:",)
    together = (
        f"{counted(len(batch.tests), 'reading')}, listed in {BATCH_FILE}, to distinguish between {names}: together "
        f"{batch.expected_bits:.2f} bit (1 bit decides between two equally probable ones). The first: {run}."
    )
    return (*(weak if batch.expected_bits < WEAK_TEST else ()), together, needed_readings(batch), TAKEN_IN)


def needed_readings(batch: Batch) -> str:
    """Readings for a settled answer, as a sentence.

    >>> needed_readings(Batch(readings=14, chance=0.7))
    'About 14 such readings give a chance of 80 % that one explanation is left.'
    >>> needed_readings(Batch(chance=0.1))
    'No 60 readings at these conditions give a chance of 80 % that one explanation is left; after the batch it is 10 %.'
    >>> needed_readings(Batch(settled=True))
    'One explanation is left already.'
    """
    if batch.settled:
        return "One explanation is left already."
    share = f"{100 * CHANCE_OF_SETTLED:.0f} %"
    if batch.readings is None:
        return (
            f"No {MOST_READINGS} readings at these conditions give a chance of {share} that one explanation is left; "
            f"after the batch it is {100 * batch.chance:.0f} %."
        )
    return f"About {counted(batch.readings, 'such reading')} give a chance of {share} that one explanation is left."


def _beyond(d: Diagnosis) -> tuple[str, ...]:
    """The best test beyond the recording, if it tells more than the best single one inside."""
    own = d.batch.tests[0].expected_bits if d.batch.tests else 0.0
    if not d.batch.beyond or d.batch.beyond[0].expected_bits < max(own, WEAK_TEST) or d.batch.settled:
        return ()
    test = d.batch.beyond[0]
    return (
        f"Beyond the recording a single reading could tell {test.expected_bits:.2f} bit, if the laws hold there: "
        f"{to_run(test.conditions, d.recorded.table)}. It needs {'; '.join(test.needs)}.",
    )


def to_run(conditions: Mapping[str, float | str], recorded: Table) -> str:
    """Conditions to set, and the time of the reading.

    >>> import numpy as np
    >>> hour = Table({"time_s": np.array([0.0, 3600.0])})
    >>> to_run({"load_N": 9.0, "time_s": 600.0}, hour), to_run({"load_N": 9.0}, hour)
    ('Run load 9 N from the start, and read at time 600 s', 'Run load 9 N')
    >>> to_run({"time_s": 600.0}, hour)
    'Run the test anew from the start, and read at time 600 s'
    >>> to_run({"load_N": 9.0, "time_s": 4500.0}, hour)
    'Run load 9 N for longer than recorded, and read at time 4500 s'
    """
    time = {name: value for name, value in conditions.items() if name in WAITED_FOR}
    settings = conditions_text({name: value for name, value in conditions.items() if name not in time})
    if not time:
        return f"Run {settings}"
    later = any(name in recorded and float(value) > float(recorded[name].max()) for name, value in time.items())
    how = "for longer than recorded" if later else "from the start" if settings else "anew from the start"
    return f"Run {settings or 'the test'} {how}, and read at {conditions_text(time)}"


def _refined(d: Diagnosis) -> tuple[str, ...]:
    """Readings to repeat or refine to learn the form of the discrepancy; names have no levels in between."""
    shape, space = d.search.discrepancy.best, d.search.space
    table = d.recorded.table
    cuts = d.region.where if shape.at is None else ()
    cuts = tuple(cut for cut in cuts if noisy_set_point(cut["column"], table[cut["column"]]) is None)
    names = [range_text(cut) for cut in cuts if "values" in cut]
    ranges = [cut for cut in cuts if "values" not in cut]
    periods = [range_text(cut) for cut in ranges if cut["column"] in PASSING]
    ranges = [cut for cut in ranges if cut["column"] not in PASSING]
    wide = [range_text(cut) for cut in ranges if cut["high"] - cut["low"] > WIDE_RANGE * np.ptp(table[cut["column"]])]
    around = [text for text in map(range_text, ranges) if text not in wide] or (
        [local_position(d)] if shape.at is not None else []
    )
    parts = [f"repeat readings with {', '.join(names)} and with others in its place"] if names else []
    parts += [f"refine and repeat the levels around {', '.join(around)}"] if around else []
    parts += [f"read at more levels within {', '.join(wide)}"] if wide else []
    parts += [f"run the programme again, with more readings within {', '.join(periods)}"] if periods else []
    parts = parts or ["refine and repeat the levels of all conditions"]
    sentences = (f"To learn its form, {'; '.join(parts)}.",)
    by_name = bool(names) or any(space.axes[space.place(name)].named for name in shape.axes)
    return (*sentences, SETUPS) if by_name and not setups_differ(d.case) else sentences


def wave_period(d: Diagnosis) -> str:
    """Period of a discrepancy that is a wave in time; empty for other forms."""
    shape = d.search.discrepancy.best
    if not shape.waves:
        return ""
    low, high = d.search.space.axes[d.search.space.place(shape.axes[0])].ends
    return amount(float(f"{(high - low) / shape.waves:.3g}"), shape.axes[0])


def local_position(d: Diagnosis) -> str:
    """Position of a peak or step of the discrepancy: a condition, or a run of the programme."""
    shape, rows = d.search.discrepancy.best, d.search.problem.rows
    name, at = shape.axes[0], shape.at or 0.0
    if name == "sequence":
        after = rows[name] - at
        distance = np.where(after >= 0.0, after, np.inf) if shape.form == "step" else np.abs(after)
        return f"run {rows['run'][np.argmin(distance)]:g}"
    both = d.search.space.axes[d.search.space.place(name)].symmetric_log and at
    return f"{words_of(name)} {amount(at, name)}{' in both directions' if both else ''}"


def box_place(d: Diagnosis) -> str:
    """Ranges of conditions that confine the discrepancy."""
    rows, box = d.search.problem.rows, d.search.discrepancy.best.box
    ranges = []
    for name, low, high in box:
        values = rows[name]
        within = values[(values >= low) & (values < high)]
        if np.isinf(low) or np.isinf(high):
            side, end = ("up to", within.max()) if np.isinf(low) else ("from", within.min())
            ranges.append(f"{words_of(name)} is {side} {amount(float(end), name)}{'' if np.isinf(low) else ' on'}")
        else:
            ranges.append(range_text({"column": name, "low": float(within.min()), "high": float(within.max())}))
    return " and ".join(ranges)
