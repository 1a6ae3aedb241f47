"""Data quality checks: implausible values in a recording, reported before anything is fitted."""

from __future__ import annotations

import numpy as np

from mixedlub.base_model.limits import FAR_FROM_OIL
from mixedlub.case.folder import Case
from mixedlub.case.forward import Forward
from mixedlub.case.validity import judge_rows
from mixedlub.data_checks.faulty_stretches import faulty_stretches
from mixedlub.data_checks.included import unmodelled_losses
from mixedlub.data_checks.inertia import inertia_in_torque
from mixedlub.data_checks.misread import NEGATIVE_SIGMAS, misread, sds
from mixedlub.data_checks.mixed_units import of_odd_units
from mixedlub.data_checks.placeholders import placeholders
from mixedlub.data_checks.sign_checks import both_signs, of_other_sign
from mixedlub.kinds.kind import gears_out
from mixedlub.recording.conditions import PASSING, raw_coordinates
from mixedlub.recording.noise import (
    is_stated,
    nearly_repeated,
    noise_from_repeats,
    pooled_sd,
    setups_differ,
    transformed_noise,
)
from mixedlub.rig.plausibility import implausible
from mixedlub.schema.findings import Finding, Severity, finding, gravest_first, listed
from mixedlub.schema.ranges import ranges
from mixedlub.schema.table import Table
from mixedlub.schema.units import UNITS, unit_of
from profiles.errors import InputError

FEWEST = 5
"""Judgement. Fewest readings that can be diagnosed: fewer leave hardly a residual."""
SCARCE = 30
"""Judgement. Readings below which ties and wide intervals are to be expected: a few to each parameter."""
MOST_SLIDING = 10.0
"""Judgement. Slide-roll ratio above which percent is more likely: 2 is pure sliding, more needs surfaces moving in
opposition."""
SAME_SIZE = 0.05
"""Judgement. Half the difference of two directions over their mean, up to which they count as equal: a payload exceeds
it."""
THINNEST_OIL = 0.4
"""Judgement. Viscosity (mPa s) of the thinnest liquid for which the model holds."""
STUCK_ROWS, STUCK_SHARE = 5, 0.2
"""Judgement. Rows with exactly the same reading, and their share of all rows, from which a stuck channel is
suspected."""
STUCK_STEPS, STUCK_SPAN = 3.0, 0.05
"""Judgement. Change of the base model over these rows that shows a stuck channel: in steps of the reading, and
relative."""

ORDER = ("run", "sequence", "time_s")
"""Columns in which a row that is entered twice differs from its copy."""
TWICE_ROWS, TWICE_SHARE = 3, 0.1
"""Judgement. Number and share of repeated rows, equal to the last digit, that chance does not explain."""
CHANCE = 2.0
"""Judgement. Ratio of repeated readings to those expected from rounding, above which it is not chance."""
CONTRADICTING = 4.0
"""Judgement. Ratio of the scatter of repeats to the stated noise, above which they contradict each other."""


def audit(case: Case, rows: Table, y: np.ndarray, forward: Forward) -> list[Finding]:
    """Findings on the files and the readings; an error where the recording cannot be diagnosed."""
    found = [*implausible(case.rig), *check_readings(case, rows, y, forward), *judge_rows(forward).findings]
    return [*gravest_first(found), *_noise_source(case, y)]


def check_readings(case: Case, rows: Table, y: np.ndarray, forward: Forward) -> list[Finding]:
    """Findings on the readings and their conditions; an error if no diagnosis is possible."""
    _readable(case, y)
    if all(np.unique(values).size == 1 for values in raw_coordinates(forward).values()):
        where = str(case.folder / "recordings.csv")
        raise InputError("all readings were taken at the same conditions; vary at least one", where=where)
    base = forward.base_prediction()
    other_sign = of_other_sign(case, rows, y, NEGATIVE_SIGMAS * sds(case, rows, y))
    return [
        *_entered_twice(case, rows, y),
        *_parts(case, rows),
        *unmodelled_losses(case.system.recording.includes, forward),
        *_setups(case, rows),
        *inertia_in_torque(forward),
        *_scarce(y),
        *of_odd_units(case, rows, y, base, FEWEST, SCARCE),
        *_more_than_put_in(case, rows, y),
        *_of_one_sign(case, rows, y),
        *_sliding(rows),
        *_warm(rows),
        *_in_fahrenheit(case, rows),
        *_backwards(rows),
        *_stuck(case, rows, y, base),
        *faulty_stretches(case),
        *placeholders(case.quantity, rows, y, base),
        *misread(case, rows, y, forward, other_sign),
        *both_signs(case, rows, y, other_sign),
        *_contradicting(case, rows, y, base),
    ]


def _readable(case: Case, y: np.ndarray) -> None:
    """Raise an error where no diagnosis is possible: too few readings, or values the quantity never takes."""
    where = f"{case.folder / 'recordings.csv'}: {case.quantity}"
    if y.size < FEWEST:
        raise InputError(f"needs at least {FEWEST} readings to say anything", where=where, value=y.size)
    if case.quantity == "viscosity_mPa_s" and np.median(y) < THINNEST_OIL:
        rule = f"are below the {THINNEST_OIL} mPa s of the thinnest liquid that the model holds for; check the unit"
        raise InputError(f"readings {rule}", where=where, value=float(np.median(y)))


def _entered_twice(case: Case, rows: Table, y: np.ndarray) -> list[Finding]:
    """Rows that repeat others in reading and conditions, more often than rounding explains."""
    named = [_numbered(values) for name, values in rows.columns.items() if name not in (*ORDER, case.quantity)]
    keys = np.column_stack([np.zeros(y.size, dtype=int), *named])
    point = np.unique(keys, axis=0, return_inverse=True)[1].reshape(-1)
    both = np.column_stack([point, _numbered(y)])
    _, first, count = np.unique(both, axis=0, return_index=True, return_counts=True)
    repeated, coarse = int(np.count_nonzero(count > 1)), 2 * np.unique(y).size < count.size
    if coarse or repeated < max(TWICE_ROWS, TWICE_SHARE * count.size):
        return []
    again = y.size - count.size
    if again <= CHANCE * _expected_ties(point, y, first):
        return []
    text = f"{again} readings repeat others to the last digit, with their conditions: check that none was entered twice"
    return [finding("readings_entered_twice", text)]


def _expected_ties(point: np.ndarray, y: np.ndarray, different: np.ndarray) -> float:
    """Expected number of equal pairs of readings at one point, from the scatter of the ``different`` ones.

    Two normal numbers with one sd round to the same value with a probability of step / (2 sqrt(pi) sd).
    """
    group, values = point[different], y[different]
    size = np.bincount(group)
    mean = np.bincount(group, values) / np.maximum(size, 1)
    free = int(np.sum(np.maximum(size - 1, 0)))
    if free == 0:
        return 0.0
    sd = np.sqrt(np.sum((values - mean[group]) ** 2) / free)
    step = float(np.min(np.diff(np.unique(y))))
    n = np.bincount(point)
    return float(np.sum(n * (n - 1) / 2.0) * min(step / (2.0 * np.sqrt(np.pi) * sd), 1.0))


def _numbered(values: np.ndarray) -> np.ndarray:
    return np.unique(values, return_inverse=True)[1]


def _parts(case: Case, rows: Table) -> list[Finding]:
    """Finding on readings of part rigs that are compared with the whole model."""
    whole = np.setdiff1d(rows["rig"], case.kind.part_rigs) if "rig" in rows else np.array([])
    if whole.size < 2:
        return []
    known = f"only as {' or '.join(case.kind.part_rigs)}" if case.kind.part_rigs else "for no case of this kind"
    text = (
        f"readings of the rigs {', '.join(whole.tolist())} are all compared with the whole base model: a part rig is "
        f"modelled {known}"
    )
    return [finding("part_rigs_not_modelled", text)]


def _setups(case: Case, rows: Table) -> list[Finding]:
    """Several set-ups without a stated error between them, which is then estimated."""
    if "setup" not in rows or setups_differ(case):
        return []
    sizes = np.unique(rows["setup"], return_counts=True)[1]
    if sizes.size < 2:
        return []
    alone = int(np.count_nonzero(sizes == 1))
    text = (
        f"{sizes.size} set-ups: the error that readings of one set-up share is not stated, so it is estimated; state "
        "it as noise.setup_relative or noise.setup_absolute where it is known"
    )
    text += f"; {alone} of them have one reading, which cannot tell that error from noise" if alone else ""
    return [finding("setups_pooled", text)]


def _scarce(y: np.ndarray) -> list[Finding]:
    """Readings too few to identify an effect."""
    if y.size >= SCARCE:
        return []
    return [finding("readings_few", f"only {y.size} readings: expect ties and wide intervals")]


def _more_than_put_in(case: Case, rows: Table, y: np.ndarray) -> list[Finding]:
    """Gear losses above the input power at the pinion."""
    if case.quantity != "power_loss_W" or not {"torque_Nm", "speed_rpm"} <= rows.columns.keys():
        return []
    put_in = rows["torque_Nm"] * rows["speed_rpm"] * np.pi / 30.0
    above = int(np.count_nonzero((y > put_in) & ~gears_out(rows)))
    if 2 * above <= y.size:
        return []
    excess = f"{above} of {y.size} losses are above the power put in, torque times speed"
    text = f"{excess}: check the units of torque_Nm, speed_rpm and power_loss_W"
    return [finding("loss_above_input_power", text)]


def _of_one_sign(case: Case, rows: Table, y: np.ndarray) -> list[Finding]:
    """Friction of a drive that has the same sign in both directions."""
    if case.kind.direction is None:
        return []
    speed = case.kind.direction(rows)
    forth, back = y[speed > 0.0], y[speed < 0.0]
    if min(forth.size, back.size) < FEWEST or np.any(np.sign(y) != np.sign(y[0])):
        return []
    one, other = float(np.median(forth)), float(np.median(back))
    statement = f"{case.quantity} keeps its sign when the drive turns back"
    if abs(one - other) > SAME_SIZE * abs(one + other):
        text = f"{statement}: right if a payload outweighs friction, otherwise the sign was lost"
        return [finding("sign_lost", text, severity=Severity.CAUTION)]
    text = f"{statement}, and its size: friction changes sign with the speed, so check that its sign was not lost"
    return [finding("sign_lost", text)]


def _sliding(rows: Table) -> list[Finding]:
    """Slide-roll ratios that look like percent."""
    most = np.abs(rows["slide_roll_ratio"]).max() if "slide_roll_ratio" in rows else 0.0
    if most <= MOST_SLIDING:
        return []
    text = f"reaches {most:g} where 2 is pure sliding: check that it is not in percent"
    return [finding("slide_roll_ratio_in_percent", text, "slide_roll_ratio")]


def _contradicting(case: Case, rows: Table, y: np.ndarray, base: np.ndarray) -> list[Finding]:
    """Readings at equal conditions that scatter far more than the stated noise."""
    group = nearly_repeated(case)
    if group is None or not is_stated(case):
        return []
    repeats = pooled_sd(_without_drift(case, rows, y, base, group), group)
    typical = float(np.median(transformed_noise(case, rows, y)[0]))
    if repeats <= CONTRADICTING * typical:
        return []
    unit = "" if case.kind.logarithmic else f" {unit_of(case.quantity)}".rstrip()
    ignored = [note.place for note in case.notes if note.code == "column_near_known"]
    advice = "if they belong to several assemblies or sweeps, name these in a column setup"
    advice = f"a condition may be in a column that is ignored: {'; '.join(ignored)}" if ignored else advice
    comparison = f"they scatter by {repeats:.3g}{unit} where the stated noise is {typical:.3g}{unit}; {advice}"
    return [finding("repeats_contradictory", f"readings at equal conditions contradict each other: {comparison}")]


def _stuck(case: Case, rows: Table, y: np.ndarray, base: np.ndarray) -> list[Finding]:
    """A reading that is exactly the same in many rows although their conditions differ."""
    values, counts = np.unique(y, return_counts=True)
    most = int(np.argmax(counts))
    if values.size < 2 or counts[most] < max(STUCK_ROWS, STUCK_SHARE * y.size):
        return []
    same = y == values[most]
    span = float(np.ptp(base[same]))
    if span <= max(STUCK_STEPS * float(np.min(np.diff(values))), STUCK_SPAN * float(np.median(np.abs(base)))):
        return []
    names = [c.name for c in case.kind.columns if c.name in rows and c.name not in PASSING]
    varied = [name for name in names if np.unique(rows[name][same]).size > 1]
    if not varied:
        return []
    runs = listed(rows["run"][same].tolist(), STUCK_ROWS)
    statement = f"{counts[most]} of {y.size} readings are exactly {values[most]:g} though {', '.join(varied)} vary"
    ended = ", at the end of its range" if most in (0, values.size - 1) else ""
    text = f"{statement}: check for a channel that was stuck{ended}, or filled in (runs {runs})"
    return [finding("channel_stuck", text)]


def _warm(rows: Table) -> list[Finding]:
    """Temperatures all above the range of oils: often a column in kelvin."""
    name = next((n for n in ("oil_temperature_C", "temperature_C") if n in rows), None)
    if name is None or not np.all(rows[name] > ranges()["conditions.oil_temperature_C"].typical[1]):
        return []
    lowest = float(rows[name].min())
    return [finding("temperature_in_kelvin", f"{lowest:g} or more in all rows: check that it is not in kelvin", name)]


def _in_fahrenheit(case: Case, rows: Table) -> list[Finding]:
    """Temperatures far outside the two points of viscosity that are within them as degrees Fahrenheit."""
    oil = case.system.lubricant
    if oil is None or oil.temperature_C is None or "oil_temperature_C" not in rows:
        return []
    low, high = min(oil.temperature_C) - FAR_FROM_OIL, max(oil.temperature_C) + FAR_FROM_OIL
    coldest, hottest = float(rows["oil_temperature_C"].min()), float(rows["oil_temperature_C"].max())
    factor, added = UNITS["C"]["degF"]
    least, most = (factor * value + added for value in (coldest, hottest))
    if (low <= coldest and hottest <= high) or not (low <= least and most <= high):
        return []
    text = f"{coldest:g} to {hottest:g} °F would be {least:.3g} to {most:.3g} °C: is it in that unit?"
    return [finding("temperature_in_fahrenheit", text, "oil_temperature_C")]


def _backwards(rows: Table) -> list[Finding]:
    """A time that decreases within a set-up: often a clock that restarts at every step."""
    falls = np.flatnonzero(np.diff(rows["time_s"]) < 0.0) + 1 if "time_s" in rows else np.array([], dtype=int)
    if falls.size and "setup" in rows:
        falls = falls[rows["setup"][falls] == rows["setup"][falls - 1]]
    if not falls.size:
        return []
    times = "1 place" if falls.size == 1 else f"{falls.size} places"
    first = f"runs backwards in {times}, first at run {rows['run'][falls[0]]}"
    text = f"{first}: check that it is no clock that restarts at every step, and that rows are in order"
    return [finding("time_backwards", text, "time_s")]


def _without_drift(case: Case, rows: Table, y: np.ndarray, base: np.ndarray, group: np.ndarray) -> np.ndarray:
    """Readings less the base model, with the linear drift of repeats over the programme removed."""
    residual = np.log(y / base) if case.kind.logarithmic else y - base
    position = next((rows[name] for name in ("sequence", "time_s") if name in rows), None)
    if position is None or np.ptp(position) == 0.0:
        return residual
    drift = (position - position.min()) / np.ptp(position) * (1.0 if case.kind.logarithmic else base)
    count = np.bincount(group)
    within, apart = (x - (np.bincount(group, weights=x) / count)[group] for x in (residual, drift))
    spread = float(apart @ apart)
    return residual - drift * (float(apart @ within) / spread) if spread > 0.0 else residual


def _repeats(case: Case, y: np.ndarray) -> float:
    return noise_from_repeats(case, np.log(y) if case.kind.logarithmic else y)


def _noise_source(case: Case, y: np.ndarray) -> list[Finding]:
    """Method of the noise estimate, if the recording does not state the noise."""
    if is_stated(case):
        return []
    source = "repeats" if _repeats(case, y) > 0 else "the fit"
    text = f"no noise given: the standard deviation of a reading is estimated from {source}"
    return [finding("noise_estimated", text)]
