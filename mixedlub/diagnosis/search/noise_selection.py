"""Every explanation weighed under the noise that the readings have."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.case.forward import Forward
from mixedlub.diagnosis.problem import Problem
from mixedlub.diagnosis.search.autocorrelation import lasting, lasting_alone
from mixedlub.diagnosis.search.drift import under_wandering
from mixedlub.diagnosis.search.noise_inflation import Raised, repeats_allow, shown, stated_or_more, under_its_own
from mixedlub.diagnosis.search.search import MANY, Progress, Search, reweighed, search, spread_rows
from mixedlub.recording.conditions import SERIES, coordinates
from mixedlub.recording.correlated_error import STILL, Wander
from mixedlub.recording.noise import estimated, is_stated, repeated
from mixedlub.recording.readings import rows_of


@dataclass(frozen=True, eq=False)
class Weighed:
    """The search, how much more than the stated noise it took, and what weighs everything under other noise.

    That takes the case, how many of its readings tell as much as one, and how their errors wander.
    """

    found: Search
    raised: Raised
    stated: bool
    again: Callable[[Case, float, Wander], Search]

    @property
    def times(self) -> float:
        """How many times the stated noise a reading has, with what wanders."""
        return self.raised.times * self.found.problem.wander.whole

    def alone(self) -> Search:
        """The search under the noise that the calibrated base model would need if nothing were missing.

        Noise that is stated is as large as that, and may last longer.
        """
        found = self.found
        kept, wander = found.problem.together, found.problem.wander
        if not self.stated:
            found = under_its_own(found, lambda case: self.again(case, kept, wander))
        lasts = lasting_alone(found)
        return found if lasts <= kept else self.again(found.problem.case, lasts, wander)


def weighed(case: Case, forward: Forward, exclude: Sequence[str], progress: Progress) -> Weighed:
    """Every explanation weighed under the stated noise or what readings ask for, else under the noise they show.

    Where noise lasts over several readings, so many count as one; where it wanders, readings share it. A logged series
    tells first how long its noise lasts, a shorter one hardly can. Everything is then weighed again.
    """
    space = coordinates(forward)
    values = space.values(forward)

    def trial(case: Case, together: float = 1.0, wander: Wander = STILL) -> Search:
        return search(Problem.of(case, forward, together, wander), space, values, exclude, progress)

    count = len(rows_of(case))
    few = spread_rows(values, count) if count > MANY else None

    def seek(case: Case, near: Search | None = None) -> Search:
        problem = Problem.of(case, forward)
        problem = problem if few is None else problem.take(few)
        if near is not None:
            return reweighed(near, problem)
        return search(problem, space, values if few is None else [v[few] for v in values], exclude, progress)

    stated, raised, most = is_stated(case), Raised(), np.inf
    if stated:
        group = repeated(case)
        if group is not None:
            whole = Problem.of(case, forward)
            most = repeats_allow(whole.y, whole.sd, group)
        found, raised = stated_or_more(case, seek, most)
        case = raised.of(case)
    else:
        found = shown(estimated(case, forward.predict(), space, values), seek)
        case = found.problem.case
    if few is not None:
        found = trial(case)
    together = lasting(found) if count >= SERIES else 1.0
    if together > 1.0:
        found = trial(case, together)
    found, raised = under_wandering(found, raised, most, partial(trial, together=together))
    case, wander = found.problem.case, found.problem.wander
    if wander.size and together > 1.0:
        found = trial(case, wander=wander)
    longer = lasting(found)
    if longer > found.problem.together:
        found = trial(case, longer, wander)
    return Weighed(found, raised, stated, trial)
