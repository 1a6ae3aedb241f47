"""Second attempt at contacts without convergence from the coarser grid: from larger sliding, in small steps."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.ehl.grid import Grid
from mixedlub.ehl.line_contacts import Contacts
from mixedlub.ehl.newton import PATIENT, SHORT, converge
from mixedlub.ehl.oil.oil import Oil
from mixedlub.ehl.state import State

LARGEST, LEAST = 5.0, 0.01
"""Slide-to-roll ratio at which the continuation starts, and the ratio below which it jumps to the contact's."""
FIRST, FASTEST, SLOWEST = 0.5, 0.4, 0.97
"""Factor on the sliding in the first stage, its minimum, and the value near 1 at which the continuation fails."""
STAGES = 40
"""Cost limit. Stages of a contact; most take six to ten."""


def again(
    oil: Oil, contacts: Contacts, mesh: Grid, start: State, *, thermal: bool, far: np.ndarray
) -> tuple[State, np.ndarray]:
    """State and convergence of each contact: film at the temperatures of the start, then temperatures."""
    state, found = from_larger_sliding(oil, contacts, mesh, start)
    if not thermal or not np.any(found):
        return state, found
    here = np.flatnonzero(found)
    warm, done = converge(
        oil, contacts.take(here), mesh.take(here), state.take(here), thermal=True, far=far[here], pace=PATIENT
    )
    state.put(here, warm)
    found[here] = done
    return state, found


def from_larger_sliding(oil: Oil, contacts: Contacts, mesh: Grid, start: State) -> tuple[State, np.ndarray]:
    """Film at the temperatures of the start, by continuation from larger sliding.

    With sliding, the flow driven by pressure is nearly linear in the pressure gradient. Without sliding it grows
    exponentially with the gradient at the pressure spike.
    """
    own = contacts.sliding / contacts.speed
    ratio = np.maximum(np.abs(own), LARGEST)
    state, found = _film(oil, contacts, mesh, start, ratio)
    factor, active = np.full(len(own), FIRST), np.flatnonzero(found)
    for _ in range(STAGES):
        active = active[(ratio[active] > np.abs(own[active])) & (factor[active] < SLOWEST)]
        if not len(active):
            break
        lower = ratio[active] * factor[active]
        lower = np.where(lower < LEAST, 0.0, lower)
        tried = np.maximum(lower, np.abs(own[active]))
        new, done = _film(oil, contacts.take(active), mesh.take(active), state.take(active), tried)
        state.put(active[done], new.take(done))
        ratio[active[done]] = tried[done]
        factor[active] = np.where(done, np.maximum(factor[active] ** 1.5, FASTEST), np.sqrt(factor[active]))
    return state, found & (ratio <= np.abs(own))


def _film(oil: Oil, contacts: Contacts, mesh: Grid, start: State, ratio: np.ndarray) -> tuple[State, np.ndarray]:
    """Film at a slide-to-roll ratio, with the sign of the contact's ratio."""
    half = 0.5 * np.copysign(ratio, contacts.sliding) * contacts.speed
    slid = replace(
        contacts,
        first=replace(contacts.first, speed=contacts.speed - half),
        second=replace(contacts.second, speed=contacts.speed + half),
    )
    return converge(oil, slid, mesh, start, thermal=False, far=np.zeros(len(ratio), dtype=bool), pace=SHORT)
