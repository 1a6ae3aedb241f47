"""Friction coefficients of a mesh cycle from harmonics of the total friction force."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mixedlub.evaluate.frequency_response import Division, over_period
from mixedlub.evaluate.synchronous import Average
from mixedlub.gear import GearPair, Sharing, at_roll_angle
from profiles.errors import InputError

LARGEST_CONDITION = 1e4
"""Largest condition number at which harmonics determine local friction."""


@dataclass(frozen=True)
class Meters:
    """Standard deviations: response (relative; shared, and by frequency), zero (um), normal force (relative).

    ``centred``: the mean over the cycle is left out.
    """

    response: float
    response_noise: float
    zero: float
    normal_force: float
    centred: bool


@dataclass(frozen=True, eq=False)
class Pattern:
    """Friction force over a mesh cycle (P, M), in N per unit of friction at each of P points of the path.

    ``roll_angle`` (P,): roll angles of the points (deg); ``work`` (P,): weights of the mean by sliding work.
    """

    roll_angle: np.ndarray
    force: np.ndarray
    work: np.ndarray


@dataclass(frozen=True, eq=False)
class Found:
    """Friction force over the cycle (M,), and friction coefficients at points of the path and on average.

    ``sd_own``: part of ``sd`` estimated from the scatter between turns.
    """

    force: np.ndarray
    force_sd: np.ndarray
    force_sd_own: np.ndarray
    fitted: np.ndarray
    friction: np.ndarray
    friction_sd: np.ndarray
    friction_sd_own: np.ndarray
    mean: float
    mean_sd: float
    mean_sd_own: float
    misfit: float


def cycle_pattern(pair: GearPair, shared: Sharing, torque: float, first: float, points: int, count: int) -> Pattern:
    r"""Friction force over a mesh cycle per unit of friction at points of the path.

    .. math:: F = \sum_k \mu(\theta_k)\, W_k\, \mathrm{sign}(\theta_k - \theta_P)

    Friction is linear between the points; a single point means constant friction. ``first``: roll angle (deg) of a
    pinion tooth at the start of the cycle. Loads follow from the load sharing at the torque (N m).

    Source: Vaishya and Houser 1999, AGMA 99FTMS1, equation 6.4.
    """
    fine = 8 * count
    low, high = (math.degrees(end / pair.base_radius[0]) for end in (pair.path_start, pair.path_end))
    pitch, step = math.degrees(pair.pitch_point / pair.base_radius[0]), 360.0 / pair.teeth[0]
    places = np.linspace(low, high, points) if points > 1 else np.array([pitch])
    force, work = np.zeros((points, fine)), np.zeros(points)
    angle = first + (np.arange(fine) + 0.5) / fine * step
    reach = math.ceil((high - low) / step) + 1
    base = low + (angle - low) % step
    for turn in range(-1, reach):
        roll = base + turn * step
        on = (roll > low) & (roll < high)
        if not on.any():
            continue
        mesh = at_roll_angle(pair, shared, np.radians(roll[on]), slices=1)
        load = mesh.load_share(torque) * torque / pair.base_radius[0]
        shape = np.array([np.interp(roll[on], places, one) for one in np.eye(points)])
        force[:, on] += shape * load * np.sign(roll[on] - pitch)
        work += (shape * load * np.abs(roll[on] - pitch)).sum(axis=1)
    # From the middles of fine steps to the samples of the cycle, which begin at its start.
    harmonics = np.fft.rfft(force, axis=1) * np.exp(-1j * math.pi * np.arange(fine // 2 + 1) / fine)
    return Pattern(places, np.fft.irfft(harmonics, n=fine, axis=1)[:, ::8], work / work.sum())


def friction_of_cycle(
    average: Average,
    divided: Division,
    pattern: Pattern,
    turned: Pattern,
    leak: float,
    meters: Meters,
    name: str,
) -> Found:
    """Force and friction of the average mesh cycle (displacements in um), with standard deviations.

    ``leak``: displacement caused by the force along the line of action; ``turned``: pattern at a roll angle larger by
    one standard deviation. Friction is a least-squares fit to the harmonics kept, so that the filter does not reduce
    it. Its mean is over the path of contact, weighted with load and sliding.
    """
    count = average.mean.shape[0]
    keep = np.ones(divided.inverse.size)
    keep[0] = 0.0 if meters.centred else 1.0
    harmonics = divided.force(average.mean[:, 0] - leak) * keep
    own = divided.force(average.errors[:, :, 0]) * keep
    shared = [harmonics * meters.response]
    zero = np.zeros_like(harmonics)
    zero[0] = meters.zero * divided.inverse[0].real * keep[0]
    shared.append(zero)
    for order in range(harmonics.size):
        for quadrature in (1.0, 1j) if order else (1.0,):
            one = np.zeros_like(harmonics)
            one[order] = harmonics[order] * quadrature * meters.response_noise
            shared.append(one)
    errors = np.concatenate([own, np.array(shared)])
    design = _as_real(divided.harmonics(pattern.force) * divided.gain * keep).T
    size = np.linalg.norm(design, axis=0)
    if design.shape[0] < design.shape[1] or not np.linalg.cond(design / size) <= LARGEST_CONDITION:
        rule = f"{harmonics.size - 1} harmonics of the mesh do not determine friction at so many points"
        raise InputError(rule, where=f"recordings.{name}: filter.local_points", value=design.shape[1])
    inverse = np.linalg.pinv(design)
    friction, moved = inverse @ _as_real(harmonics), _as_real(errors) @ inverse.T
    of_load = friction * meters.normal_force
    elsewhere = _as_real(divided.harmonics(turned.force) * divided.gain * keep).T
    of_angle = np.linalg.pinv(elsewhere) @ _as_real(harmonics) - friction
    common = np.stack([of_load, of_angle])
    of_turns = moved[: len(own)]
    fitted = over_period(_as_complex(design @ friction), count)
    force = over_period(harmonics, count)
    return Found(
        force=force,
        force_sd=np.sqrt((over_period(errors, count) ** 2).sum(axis=0)),
        force_sd_own=np.sqrt((over_period(own, count) ** 2).sum(axis=0)),
        fitted=fitted,
        friction=friction,
        friction_sd=np.sqrt((moved**2).sum(axis=0) + (common**2).sum(axis=0)),
        friction_sd_own=np.sqrt((of_turns**2).sum(axis=0)),
        mean=float(pattern.work @ friction),
        mean_sd=float(np.linalg.norm(np.concatenate([moved, common]) @ pattern.work)),
        mean_sd_own=float(np.sqrt(((of_turns @ pattern.work) ** 2).sum())),
        misfit=float(np.sqrt(((force - fitted) ** 2).mean())),
    )


def _as_real(harmonics: np.ndarray) -> np.ndarray:
    """Real and imaginary parts side by side (..., 2 J + 1), scaled to make the sum of squares the mean square."""
    rest = harmonics[..., 1:] * math.sqrt(2.0)
    return np.concatenate([harmonics[..., :1].real, rest.real, rest.imag], axis=-1)


def _as_complex(parts: np.ndarray) -> np.ndarray:
    """Complex harmonics from the arrays of `_as_real`."""
    count = (parts.shape[-1] - 1) // 2
    rest = (parts[..., 1 : 1 + count] + 1j * parts[..., 1 + count :]) / math.sqrt(2.0)
    return np.concatenate([parts[..., :1], rest], axis=-1)
