"""Alternating steps of film and temperatures until each contact has converged."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mixedlub.ehl.batch import Batch
from mixedlub.ehl.film import film_step
from mixedlub.ehl.grid import Grid
from mixedlub.ehl.heat import full_film, heat_step
from mixedlub.ehl.line_contacts import Contacts
from mixedlub.ehl.oil.oil import Oil
from mixedlub.ehl.state import State

PRESSURE_TOLERANCE, HOT_PRESSURE_TOLERANCE = 1e-8, 1e-6
"""Converged change of pressure (Hertz pressures): isothermal, thermal."""
TEMPERATURE_TOLERANCE = 0.01
"""Converged change of temperature (K)."""
WARM_START = 0.3
"""Change of pressure below which temperatures are updated (Hertz pressures)."""
LARGEST_HEATING = 30.0
"""Largest change of a temperature in a step (K)."""
DAMPED_ABOVE = 12.0
"""Change of temperature above which a step is damped (K)."""
STALLED = 10
"""Cost limit. Steps of the film in a row cut short at their limits, after which a contact with a near start is given
up: of 303 runs that converged, one had more than 7, and of 39 that did not, none had fewer than 10."""
GROWN, LESS = 0.9, 0.5
"""If a change exceeds this share of the previous change, the step is reduced by the second factor."""


@dataclass(frozen=True)
class Pace:
    """Largest number of steps, smallest relaxation of the temperature step, and its growth per step."""

    steps: int
    least: float
    more: float


QUICK, PATIENT, SHORT = Pace(80, 0.25, 1.4), Pace(300, 0.1, 1.1), Pace(30, 0.25, 1.4)
"""Pace for most contacts (5 to 10 steps), for contacts that fail with it, and for a stage of a continuation."""


@dataclass(frozen=True)
class _Run(Batch):
    """Unconverged contacts with their history: last changes, relaxation of the temperature step, and steps of the
    film in a row cut short."""

    contacts: Contacts
    mesh: Grid
    state: State
    pressure_change: np.ndarray
    temperature_change: np.ndarray
    share: np.ndarray
    far: np.ndarray
    limited: np.ndarray


def converge(
    oil: Oil, contacts: Contacts, mesh: Grid, start: State, *, thermal: bool, far: np.ndarray, pace: Pace = QUICK
) -> tuple[State, np.ndarray]:
    """State of each contact after its last step, and convergence, from a start that is ``far`` or near."""
    cases = len(contacts.radius)
    state, converged = start.mapped(np.copy), np.zeros(cases, dtype=bool)
    unknown = np.full(cases, np.inf)
    run = _Run(contacts, mesh, start, unknown, unknown, np.ones(cases), far, np.zeros(cases))
    active = np.arange(cases)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        for _ in range(pace.steps):
            if not len(active):
                break
            new, change = film_step(oil, run.contacts, run.mesh, run.state)
            limited = np.where(np.isinf(change) & ~run.far, run.limited + 1.0, 0.0)
            run = replace(run, state=new, pressure_change=change, limited=limited)
            run = _warmed(oil, run, pace) if thermal else run
            failed = ~np.isfinite(run.state.approach + np.sum(run.state.temperature, axis=(1, 2)))
            tolerance = HOT_PRESSURE_TOLERANCE if thermal else PRESSURE_TOLERANCE
            warm = (run.temperature_change < TEMPERATURE_TOLERANCE) | (not thermal)
            done = (run.pressure_change < tolerance) & warm & ~failed
            stop = done | failed | (limited >= STALLED)
            state.put(active, run.state)
            state.approach[active[failed]] = np.nan
            converged[active[done]] = True
            if np.any(stop):
                run, active = run.take(~stop), active[~stop]
    return state, converged


def _warmed(oil: Oil, run: _Run, pace: Pace) -> _Run:
    """State after a temperature step, taken if the film is nearly converged.

    A large step is damped: at once if the previous step was large and the start is far, otherwise after a trial.
    """
    gap = run.state.gap(run.mesh)
    damped = (run.temperature_change > DAMPED_ABOVE) & run.far
    wanted = _wanted(oil, run, gap, damped)
    again = ~damped & ~(np.max(np.abs(wanted), axis=(1, 2)) < DAMPED_ABOVE)
    if np.any(again):
        wanted[again] = _wanted(oil, run.take(again), gap[again], again[again])
    counts = full_film(run.state.pressure)[..., None]
    change = np.max(np.abs(wanted) * counts, axis=(1, 2))
    ready = run.pressure_change < WARM_START
    change = np.where(ready, change, np.inf)
    grown = ~damped & ~again & (change > GROWN * run.temperature_change)
    share = np.where(grown, np.maximum(LESS * run.share, pace.least), np.minimum(pace.more * run.share, 1.0))
    step = np.clip(share[:, None, None] * wanted, -LARGEST_HEATING, LARGEST_HEATING) * ready[:, None, None]
    state = replace(run.state, temperature=run.state.temperature + step)
    return replace(run, state=state, temperature_change=change, share=share)


def _wanted(oil: Oil, run: _Run, gap: np.ndarray, damped: np.ndarray) -> np.ndarray:
    """Change of temperature requested by a step (K)."""
    found = heat_step(oil, run.contacts, run.mesh, run.state, gap, damped.astype(float))
    return found.temperature - run.state.temperature
