"""Roughness in the film to first order: amplitude of a surface wave in the contact."""

from __future__ import annotations

import numpy as np

from mixedlub.ehl import across
from mixedlub.ehl.film import balance, hold
from mixedlub.ehl.flow import flow
from mixedlub.ehl.heat import full_film
from mixedlub.ehl.levels import Level, solve_levels
from mixedlub.ehl.line_contacts import Contacts, numbers
from mixedlub.ehl.linear import solved, times
from mixedlub.ehl.oil.oil import Oil
from profiles.errors import refuse_other

WAVE_NODES = (61, 121, 241, 481, 961)
"""Nodes of the grids: the finest has 16 cells on a wave of an eighth of the half width."""
CELLS = 12
"""Smallest number of cells on a wave: with fewer, the amplitude is more than 5 % too small."""
INNER = 0.8
"""Half width of the central region of the contact, over the Hertz half width."""
CENTRAL = 2.0 / 3.0
"""Share of central differences for third-order upwind differences, which do not damp short waves."""


def wave_amplitudes(
    oil: Oil, contacts: Contacts, wavelengths: np.ndarray, wave_speed: np.ndarray | None = None
) -> np.ndarray:
    r"""Amplitude of a low wave in the film, relative to the surface; a row per contact.

    Wavelengths (m) run along the contact; the wave moves with its surface at ``wave_speed`` (m/s), by default the
    entrainment speed. The transient isothermal mass balance is linearised about the smooth solution,

    .. math:: h' = a\,e^{i\omega(x - vt)} + \delta'(p') + h_0',\qquad
              \partial_x q' - i\omega v\,(\rho h)' = 0,\qquad \int p'\,dx = 0

    and the amplitude is its mean over the inner four fifths of the contact. NaN without a smooth solution, and for
    waves with fewer than 12 cells of the grid, below about a tenth of the half width. Source: the equations of C. H.
    Venner, F. Couhier, A. A. Lubrecht, J. A. Greenwood, Tribology Series 32 (1997) 103, at low amplitudes.
    """
    refuse_other(oil, Oil, "ml.ehl.read_oil(...)", "ehl.wave_amplitudes: oil")
    refuse_other(contacts, Contacts, "ml.ehl.contacts(...)", "ehl.wave_amplitudes: contacts")
    lengths = np.atleast_1d(numbers("ehl.wave_amplitudes: wavelengths", wavelengths))
    speed = contacts.speed if wave_speed is None else numbers("ehl.wave_amplitudes: wave_speed", wave_speed)
    found = solve_levels(oil, contacts, thermal=False, nodes=WAVE_NODES)
    ratios = np.full((len(contacts.radius), len(lengths)), np.nan)
    kept = contacts.take(found.index)
    speeds = np.broadcast_to(speed, contacts.speed.shape)[found.index] / kept.speed
    for column, wavelength in enumerate(lengths):
        wave = 2.0 * np.pi * kept.half_width / wavelength
        ratios[found.index, column] = _amplitude(oil, kept, found.fine, wave, speeds)
    return ratios


def _amplitude(oil: Oil, contacts: Contacts, level: Level, wave: np.ndarray, speed: np.ndarray) -> np.ndarray:
    """Mean amplitude in the centre for a wave number (per half width) per contact."""
    mesh, state = level.mesh, level.state
    gap = state.gap(mesh)
    now = flow(oil, contacts, mesh, state, gap, central=CENTRAL)
    matrix, rest = balance(mesh, now)
    hertz = contacts.pressure[:, None]
    density, squeezed, _ = oil.density_ratio(state.pressure * hertz, across.mean(state.temperature))
    held = ~full_film(state.pressure)
    held[:, [0, -1]] = True
    surface = np.exp(1j * wave[:, None] * mesh.x)
    storage = -1j * (wave * speed)[:, None] * mesh.weights
    by_gap = storage * density
    system = matrix.astype(complex)
    system[:, :-1, :-1] += by_gap[..., None] * mesh.kernel
    place = np.arange(mesh.x.shape[1])
    system[:, place, place] += storage * squeezed * hertz * gap
    system[:, :-1, -1] += by_gap
    right = np.zeros(rest.shape, dtype=complex)
    right[:, :-1] = -by_gap * surface
    right[:, 1:-2] -= np.diff(_carried_wave(now.by_gap, surface), axis=1)
    hold(system, right, held, 0.0)
    system[:, -1, :-1], right[:, -1] = mesh.weights, 0.0
    change = solved(system, right)
    film = surface + times(mesh.kernel, change[:, :-1]) + change[:, -1:]
    inside = np.abs(mesh.x) < INNER
    share = mesh.weights * inside
    resolved = 2.0 * np.pi / wave > CELLS * np.max(mesh.steps * inside[:, 1:], axis=1)
    return np.where(resolved, np.sum(share * np.abs(film), axis=1) / np.sum(share, axis=1), np.nan)


def _carried_wave(slopes: tuple[np.ndarray, np.ndarray, np.ndarray], surface: np.ndarray) -> np.ndarray:
    """Change of the flow through each cell due to a wave in the gap."""
    before, start, end = slopes
    earlier = np.pad(surface[:, :-2], ((0, 0), (1, 0)))
    return before * earlier + start * surface[:, :-1] + end * surface[:, 1:]
