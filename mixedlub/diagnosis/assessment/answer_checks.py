"""What speaks against an answer as a whole, and what the readings say of their noise."""

from __future__ import annotations

from math import comb

import numpy as np

from mixedlub.case.forward import Forward
from mixedlub.data_checks.audit import Doubt
from mixedlub.diagnosis.assessment.cross_validation import HeldOut
from mixedlub.diagnosis.assessment.posterior import Key, Posterior
from mixedlub.diagnosis.labels import amount, effect_words, words_of
from mixedlub.diagnosis.search.noise_inflation import CLEAR, MOST, Raised, more, quiet
from mixedlub.diagnosis.search.search import Search
from mixedlub.recording.conditions import PASSING, clock_of
from mixedlub.recording.set_points import set_points
from mixedlub.schema.table import Table
from mixedlub.schema.units import unit_of

MANY_WRONG = 0.1
"""Share of wrong readings from which the answer is doubted: ten times what is usual."""
LEAST_STREAK, RARE = 3, 0.05
"""Wrong readings in a row that are told of, where fewer such streaks than that would be there by chance."""
MOST_OF_LEVEL = 0.75
"""Share of the readings of a level that a streak has to hold to be that level."""
WORTH_TELLING = 1.5
"""Inflation of the variance from which it is told."""
FAR_OFF = 3.0
"""Error on levels left out, in sigmas of a reading, from which an answer foretells none."""
LARGE = 0.1
"""Share of a reading from which estimated noise is doubted."""
UNFOLLOWED = (
    "readings lie farther from every explanation than from their repeats: something is missing whose form none that "
    "was tried follows"
)
NOT_NOISE = (
    "either something is missing that no form tried follows, or what is stated is not the noise of a reading; what is "
    "named below was found under noise that much larger"
)
QUIET = "readings scatter by less than half of the stated noise: with noise nearer to theirs more could be told"


def likelier_notes(forward: Forward) -> list[str]:
    """Effects that are missing more often than usual, by what is known before any reading is seen."""
    return [
        f"{words_of(e.likelier[0])} {float(forward.inputs[e.likelier[0]]):.3g}, beyond {e.likelier[1]:g}: "
        f"{effect_words(e.id)} is taken as {forward.odds(e) / e.odds:.2g} times as usual, before any reading is seen; "
        "how probable it is told to be rests on that"
        for e in forward.effects()
        if e.likelier and forward.odds(e) != e.odds
    ]


def scatter_notes(found: Search, stated: bool, raised: Raised) -> list[str]:
    """What the readings say of their noise, where that is not what the recording says."""
    lasting = found.problem.together
    series = (
        [f"what readings are off by lasts over several that follow one another: about {lasting:.2g} count as one here"]
        if lasting > 1.0
        else []
    )
    return [*series, *_wandering_notes(found), *_size_notes(found, stated, raised)]


def _wandering_notes(found: Search) -> list[str]:
    wander, rows = found.problem.wander, found.problem.rows
    if not wander.size:
        return []
    length = wander.lasts
    over = (
        f"{100.0 * length:.2g} % of the programme" if "sequence" in rows else amount(float(f"{length:.2g}"), "time_s")
    )
    return [
        Doubt(
            f"what readings are off by wanders, by {wander.size:.2g} times the noise of a single one, and is forgotten "
            f"over about {over}; that counts as noise here, and no event of that size can be told from it"
        )
    ]


def _size_notes(found: Search, stated: bool, raised: Raised) -> list[str]:
    times = raised.times
    whole = times * found.problem.wander.whole
    if raised.share:
        beside = f"readings scatter by {100.0 * raised.share:.2g} % of them beside the sds told, which may be those of"
        return [Doubt(f"{beside} one setting; the noise was taken as that much larger")]
    scatter = "readings scatter about {:.2g} times as much as stated, whatever is taken to explain them"
    if stated and whole > MOST:
        return [Doubt(f"{scatter.format(whole)}: more than a stated noise is off by, so {NOT_NOISE}")]
    if times > 1.0:
        return [Doubt(f"{scatter.format(times)}: the noise was taken as that much larger")]
    noise = found.problem.case.system.recording.noise
    if not stated and noise is not None:
        unit = unit_of(found.problem.case.quantity)
        parts = [f"{100.0 * noise.relative:.2g} % of it"] if noise.relative else []
        parts += [f"{noise.absolute:.2g} {unit}".rstrip()] if noise.absolute else []
        said = f"the noise of a reading was estimated as {' and '.join(parts)}"
        sd = found.problem.one_sd * found.problem.unit_size(found.problem.y)
        if np.median(sd) <= LARGE * np.median(np.abs(found.problem.level(found.problem.y))):
            return [said]
        return [
            Doubt(f"{said}, more than rigs scatter by: rows may be of different things, or what is missing is in it")
        ]
    if stated and more(found)[0] > CLEAR:
        return [Doubt(UNFOLLOWED)]
    return [QUIET] if quiet(found) else []


def against(
    verdict: Key,
    kept: HeldOut,
    rows: Table,
    y: np.ndarray,
    predicted: np.ndarray,
    wrong: np.ndarray,
    at_one_place: bool = False,
) -> list[str]:
    """What speaks against the answer as a whole: readings written off, a form that holds nowhere else.

    What stands ``at_one_place`` is not for other levels to foretell.
    """
    found = []
    if wrong.mean() > MANY_WRONG:
        found.append(
            f"{wrong.sum()} of {wrong.size} readings count as wrong: the noise may be taken too small, or the answer "
            "covers only a part of the recording"
        )
        turned = np.abs(y[wrong] + predicted[wrong]) < 0.3 * np.abs(y[wrong])
        if turned.mean() > 0.5:
            found.append(f"{turned.sum()} of them have the size that is expected with the opposite sign")
    streak = in_a_row(rows, wrong, y - predicted)
    if streak:
        found.append(
            f"the {len(streak)} readings from run {streak[0]} to run {streak[-1]} count as wrong, follow one another "
            "and lie on the same side: that is no chance, and the answer leaves it out"
        )
    found += [
        f"{level} count as wrong on one side: that is no chance, and the answer leaves it out"
        for level in levels_off(rows, wrong, y - predicted)
    ]
    if verdict != () and not at_one_place and kept.score < kept.score_before:
        answer = "the unnamed mismatch" if verdict == "unknown" else "the answer"
        found.append(
            f"{answer} predicts levels left out no better than calibration alone: outside the recorded conditions "
            "rely on neither"
        )
    elif verdict != () and not at_one_place and kept.after > FAR_OFF:
        found.append(
            f"the answer does not foretell levels that it has not seen: there it is off by {kept.after:.3g} sigma, "
            "where 1 is noise; do not extrapolate it"
        )
    return [Doubt(text) for text in found]


def unsure_odds(judged: Posterior) -> list[str]:
    """That the odds were taken as less sure, where levels left out asked for it clearly."""
    if judged.inflation < WORTH_TELLING:
        return []
    times = np.sqrt(judged.inflation)
    return [
        Doubt(
            f"levels left out lie {times:.2g} times as far off as noise and the other levels leave open: even the best "
            "explanation is not the whole of it, so the odds between effects were taken as less sure"
        )
    ]


def in_a_row(rows: Table, wrong: np.ndarray, left: np.ndarray) -> list[int]:
    """Runs of the longest streak in time of wrong readings on one side, if chance would hardly make one.

    >>> table = Table({"run": np.arange(1, 41), "time_s": np.arange(40.0)})
    >>> wrong = np.isin(np.arange(40), [0, 1, 2, 17])
    >>> in_a_row(table, wrong, np.ones(40)), in_a_row(table, wrong, (-1.0) ** np.arange(40))
    ([1, 2, 3], [])
    """
    clock = clock_of(rows)
    if clock is None or not wrong.any():
        return []
    order = np.argsort(clock, kind="stable")
    side = (np.sign(left) * wrong)[order]
    starts = np.flatnonzero(np.diff(side, prepend=np.nan) != 0.0)
    lengths = np.diff(np.append(starts, side.size)) * (side[starts] != 0.0)
    longest = int(np.argmax(lengths))
    count = int(lengths[longest])
    by_chance = 2.0 * wrong.size * (0.5 * wrong.mean()) ** count
    if count < LEAST_STREAK or by_chance > RARE:
        return []
    streak = order[starts[longest] : starts[longest] + count]
    return [] if _one_level(rows, streak) else [int(run) for run in rows["run"][streak]]


def levels_off(rows: Table, wrong: np.ndarray, left: np.ndarray) -> list[str]:
    """Levels of conditions nearly all of whose readings are wrong on one side, if chance would hardly make one.

    None where all levels are like that.
    """
    if wrong.mean() >= MOST_OF_LEVEL:
        return []
    found = []
    for name, values in _conditions(rows):
        points, label = np.unique(set_points(values), return_inverse=True)
        size = np.bincount(label)
        for side in (left > 0.0, left < 0.0):
            off = np.bincount(label, weights=wrong & side).astype(int)
            for i in np.flatnonzero((size >= LEAST_STREAK) & (off >= MOST_OF_LEVEL * size) & (size < label.size)):
                by_chance = 2.0 * points.size * comb(int(size[i]), int(off[i])) * (0.5 * wrong.mean()) ** off[i]
                if by_chance <= RARE:
                    many = f"all {size[i]}" if off[i] == size[i] else f"{off[i]} of the {size[i]}"
                    at = points[i] if points.dtype.kind in "US" else amount(float(points[i]), name)
                    found.append(f"{many} readings at {words_of(name)} {at}")
    return found


def _conditions(rows: Table) -> list[tuple[str, np.ndarray]]:
    """What was set, not what passes by."""
    return [(name, values) for name, values in rows.columns.items() if name not in (*PASSING, "run")]


def _one_level(rows: Table, streak: np.ndarray) -> bool:
    """Whether a streak is a level of a condition that was run in one go: no matter of time."""
    for _, values in _conditions(rows):
        there = values == values[streak[0]]
        if there[streak].all() and not there.all() and streak.size >= MOST_OF_LEVEL * there.sum():
            return True
    return False
