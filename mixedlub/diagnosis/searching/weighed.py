"""Every explanation weighed under the noise that the readings have."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from mixedlub.case import Case
from mixedlub.diagnosis.fitting.problem import Problem
from mixedlub.diagnosis.recording.features import coordinates
from mixedlub.diagnosis.recording.noise import estimated, is_stated, repeated
from mixedlub.diagnosis.searching.scatter import Raised, repeats_allow, shown, stated_or_more, under_its_own
from mixedlub.diagnosis.searching.search import MANY, Progress, Search, search, spread_rows
from mixedlub.diagnosis.searching.serial import lasting, lasting_alone
from mixedlub.forward import Forward
from mixedlub.table import Table


@dataclass(frozen=True, eq=False)
class Weighed:
    """The search, how much more than the stated noise it took, and what weighs everything under other noise.

    That takes the case, its readings and how many of them tell as much as one.
    """

    found: Search
    raised: Raised
    stated: bool
    again: Callable[[Case, Table, float], Search]

    def alone(self) -> Search:
        """The search under the noise that the calibrated base model would need if nothing were missing.

        Noise that is stated is as large as that, and may last longer.
        """
        kept = self.found.problem.together
        found = self.found
        if not self.stated:
            found = under_its_own(found, lambda case, rows: self.again(case, rows, kept))
        lasts = lasting_alone(found)
        return found if lasts <= kept else self.again(found.problem.case, found.problem.rows, lasts)


def weighed(
    case: Case, rows: Table, forward: Forward, y: np.ndarray, exclude: Sequence[str], progress: Progress
) -> Weighed:
    """Every explanation weighed under the stated noise or what readings ask for, else under the noise they show.

    Where noise lasts over several readings, so many count as one, and everything is weighed again.
    """
    space = coordinates(case, rows, forward)
    values = space.values(case, rows, forward)

    def trial(case: Case, rows: Table, together: float = 1.0) -> Search:
        return search(Problem.of(case, rows, forward, y, together), space, values, exclude, progress)

    def glance(case: Case, rows: Table) -> Search:
        few = spread_rows(values, y.size)
        return search(Problem.of(case, rows, forward, y).take(few), space, [v[few] for v in values], exclude, progress)

    seek = trial if y.size <= MANY else glance
    stated, raised = is_stated(case, rows), Raised()
    if stated:
        group, most = repeated(case, rows), np.inf
        if group is not None:
            whole = Problem.of(case, rows, forward, y)
            most = repeats_allow(whole.y, whole.sd, group)
        found, raised = stated_or_more(case, rows, seek, most)
        case, rows = raised.of(case, rows)
    else:
        found = shown(estimated(case, rows, y, forward.predict(), space, values), rows, seek)
        case = found.problem.case
    if seek is glance:
        found = trial(case, rows)
    together = lasting(found)
    if together > 1.0:
        found = trial(case, rows, together)
    return Weighed(found, raised, stated, trial)
