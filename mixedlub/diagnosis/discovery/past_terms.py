"""Terms of a law over the history of a condition: last change, relaxation after it, and fading memory."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from mixedlub.diagnosis.discovery.terms import Term, Variable, bounded_terms, single_terms
from mixedlub.diagnosis.discrepancy.past import fading_times, remembered_in
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.discovery import FADING_NEAR, FADING_SPREAD
from mixedlub.kinds.history import order_of
from mixedlub.recording.conditions import is_temperature
from mixedlub.schema.past import BEFORE, DIRECTION, MEMORY, SINCE, Past

OF_MEMORY = ("power", "linear", "grown power")
"""Shapes of a term of a memory in place of the present condition."""
RELAXATION, DIRECTED = "relaxation", "directed relaxation"
SECONDS = "s"


def past_variables(search: Search) -> dict[Past, Variable]:
    """History coordinates that the recording can show; if the discrepancy is a memory, with fading times near it."""
    forward, best = search.problem.forward, search.discrepancy.best.past
    pasts = [one.past for one in remembered_in(search.space, search.values, forward)]
    if best is not None and best.past.what == MEMORY:
        pasts += [replace(best.past, fading=float(f"{best.past.fading * ratio:.2g}")) for ratio in FADING_NEAR]
    pasts = list(dict.fromkeys(pasts))
    found = forward.histories(pasts)
    return {past: Variable(past.name, found[past.name]) for past in pasts}


def past_terms(search: Search, pasts: dict[Past, Variable]) -> list[Term]:
    """Terms of the history of each condition."""
    rows = search.problem.rows
    found: list[Term] = []
    for column in dict.fromkeys(past.column for past in pasts):
        own = {past: v for past, v in pasts.items() if past.column == column}
        found += _of_condition(search, Variable(column, np.asarray(rows[column], float)), own)
    return [t for t in found if np.isfinite(t.values).all() and np.ptp(t.values) > 0.0]


def _of_condition(search: Search, present: Variable, pasts: dict[Past, Variable]) -> Iterator[Term]:
    """Terms of one condition: jumps and relaxations after a change, and memories in place of or beside the present."""
    sense = next((v for past, v in pasts.items() if past.what == DIRECTION), None)
    if sense is not None:
        yield Term(DIRECTION, (sense.text,), sense.text, {}, {}, sense.values)
    for past, v in pasts.items():
        if past.what == SINCE:
            yield from _relaxations(search, v, sense, past.clock)
        elif past.what == BEFORE:
            yield _difference(v, present)
        elif past.what == MEMORY:
            yield _difference(v, present)
            yield from (t for t in single_terms(v) if t.shape in OF_MEMORY)


def _relaxations(search: Search, since: Variable, sense: Variable | None, clock: str) -> Iterator[Term]:
    """Decays with the duration since the last change, equal after all changes or with the sign of each."""
    case = search.problem.case
    order = order_of(search.problem.rows if case.recordings is None else case.recordings, case.kind.is_history)
    assert order is not None
    times = fading_times(order)
    prior = {"t": ("lognormal", times[len(times) // 2], FADING_SPREAD)}
    units = {"t": SECONDS} if clock == SECONDS else {}
    for time in times:
        text, values = f"exp(-{since.text}/<t>)", np.exp(-since.values / time)
        yield Term(RELAXATION, (since.text,), text, {"t": time}, prior, values, units)
        if sense is not None:
            names = (since.text, sense.text)
            yield Term(DIRECTED, names, f"{sense.text}*{text}", {"t": time}, prior, sense.values * values, units)


def _difference(past: Variable, present: Variable) -> Term:
    """Past over present condition; of signed numbers and temperatures the difference over a round range."""
    names = (past.text, present.text)
    if past.positive and present.positive and not is_temperature(present.text):
        return Term("power", names, f"log({past.text}/{present.text})", {}, {}, np.log(past.values / present.values))
    wide = float(f"{np.ptp(present.values):.2g}")
    text = f"({past.text}-{present.text})/{wide:.4g}"
    return Term("linear", names, text, {}, {}, (past.values - present.values) / wide)


def is_bounded(term: Term) -> bool:
    """Whether a term of a history lies within -1 and 1, so that it may be added and multiplied."""
    return term.shape in (DIRECTION, RELAXATION, DIRECTED)


def past_products(terms: Sequence[Term], every: Sequence[Variable]) -> list[Term]:
    """Products of bounded terms of a history with powers of a present condition."""
    own = [term for term in terms if is_bounded(term)]
    return [one.times(two) for one in own for v in every for two in bounded_terms(v) if two.shape in OF_MEMORY]
