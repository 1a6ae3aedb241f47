"""Recipes of finishing processes, and of changes in service and handling: run-in, scratches, pits. Each returns the
trace with moments measured from it, for none of these surfaces is Gaussian as a whole."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

import numpy as np

from profiles.errors import InputError
from profiles.profile import Profile
from profiles.synthesise import Synthetic, measured, self_affine, uniform


def ground(
    rms: float, *, points: int, spacing: float, seed: int, rolloff: float = 100e-6, hurst: float = 0.7
) -> Synthetic:
    """Across the lay of grinding: a Gaussian self-affine trace, rolled off above the width of the grit tracks.

    Power-law spectra of ground and lapped steel with a corner: Majumdar and Tien, Wear 136 (1990) 313.

    >>> ground(3e-7, points=19200, spacing=2.5e-7, seed=1).m0
    9e-14
    """
    shortest = max(4 * spacing, 1e-6)
    return self_affine(
        rms, hurst=hurst, rolloff=rolloff, shortest=shortest, points=points, spacing=spacing, seed=seed, name="ground"
    )


def hobbed(*, feed: float, radius: float, rms: float, points: int, spacing: float, seed: int) -> Synthetic:
    """Along the feed of hobbing or turning: cusps of tool radius R at a distance of the feed f, with a ground texture.

    .. math:: z = x^2/2R \\;\\text{for}\\; |x| \\le f/2, \\quad \\text{cusp height} = f^2/8R

    >>> t = hobbed(feed=0.4e-3, radius=10e-3, rms=1e-9, points=8001, spacing=5e-7, seed=1)
    >>> round(float(np.ptp(t.profile.heights)) * 1e6, 1)         # f^2/8R = 2 um
    2.0
    """
    if not (feed > 2 * spacing and radius > feed):
        raise InputError("the feed must span steps and be below the tool radius", where="hobbed", value=(feed, radius))
    x = np.arange(points) * spacing
    distance = (x + feed / 2) % feed - feed / 2
    texture = ground(rms, points=points, spacing=spacing, seed=seed).profile
    cusps = distance**2 / (2 * radius)
    return measured(_with(texture, "hobbed", cusps - cusps.mean() + texture.heights))


def honed(
    plateau_rms: float,
    valley_rms: float,
    *,
    plateau_share: float,
    points: int,
    spacing: float,
    seed: int,
    rolloff: float = 60e-6,
) -> Synthetic:
    """Plateau honing: the lower of a fine and a coarse Gaussian surface, as left by two cuts in turn.

    ``plateau_share``: share of the profile covered by the fine cut, the knee Rmq of the probability plot; the two
    slopes of the plot are the two rms heights (m). Whitehouse, Proc. IMechE 199 (1985); ISO 13565-3.

    >>> t = honed(5e-8, 8e-7, plateau_share=0.8, points=20000, spacing=5e-7, seed=2)
    >>> w = t.profile.heights; bool(np.mean(w**3) / np.mean(w**2)**1.5 < -1.5)
    True
    """
    if not (0 < plateau_share < 1 and 0 < plateau_rms < valley_rms):
        raise InputError(
            "needs a share between 0 and 1 and a plateau finer than the valleys",
            where="honed",
            value=(plateau_rms, valley_rms, plateau_share),
        )
    cut = partial(ground, points=points, spacing=spacing)
    fine = cut(plateau_rms, rolloff=rolloff, seed=seed).profile
    coarse = cut(valley_rms, rolloff=2 * rolloff, seed=seed + 1).profile.heights
    gap = np.quantile(fine.heights - coarse, plateau_share)
    return measured(_with(fine, "honed", np.minimum(fine.heights, coarse + gap)))


def superfinished(
    rms: float, *, base_rms: float, removed_share: float, points: int, spacing: float, seed: int
) -> Synthetic:
    """Superfinishing: a ground surface with peaks cut to a plateau and a fine texture of ``rms`` on it.
    ``removed_share``: share of the length touched by the stone."""
    worn = run_in(ground(base_rms, points=points, spacing=spacing, seed=seed).profile, removed_share).profile
    fine = ground(rms, rolloff=15e-6, points=points, spacing=spacing, seed=seed + 1).profile.heights
    return measured(_with(worn, "superfinished", worn.heights + fine))


def run_in(profile: Profile, share: float, *, left: float = 0.05) -> Synthetic:
    """Run-in truncation: peaks above the height that ``share`` of the surface exceeds are worn down.

    Peaks keep the fraction ``left`` of their excess over that height, for worn plateaus are smooth, not flat.

    >>> t = run_in(Profile(np.array([0.0, 4.0, 0.0, 1.0, 0.0, 1.0]) * 1e-6, 1e-6), 1 / 6, left=0.0)
    >>> t.profile.steps
    ('run in: the highest 16.7 % worn to 0 of their height',)
    """
    if not (0 < share < 1 and 0 <= left < 1):
        raise InputError("shares must lie between 0 and 1", where="run_in", value=(share, left))
    height = np.quantile(profile.heights, 1 - share)
    worn = np.where(profile.heights > height, height + left * (profile.heights - height), profile.heights)
    said = f"run in: the highest {share * 100:.3g} % worn to {left:g} of their height"
    return measured(profile.after(said, worn))


def scratched(profile: Profile, *, count: int, depth: float, width: float, seed: int, ridge: float = 0.2) -> Synthetic:
    """Scratches across the trace: V grooves of a depth and full width (m), with ridges pushed up beside them.

    Depths are spread evenly from half to the whole of ``depth``; ``ridge`` is their height over the depth.

    >>> flat = Profile(np.zeros(2000), 5e-7)
    >>> round(float(scratched(flat, count=5, depth=2e-6, width=1e-5, seed=1).profile.heights.min()) * 1e6, 1)
    -2.0
    """
    places, depths = _scattered(profile, count, depth, width, seed, "scratched")
    heights = profile.heights.copy()
    for place, deep in zip(places, depths):
        distance = np.abs(profile.positions - place) / (width / 2)
        groove = -deep * np.maximum(1 - distance, 0.0)
        ridges = ridge * deep * np.maximum(1 - np.abs(distance - 1.5) / 0.5, 0.0)
        heights += groove + ridges
    said = f"{count} scratches to {depth * 1e6:g} um deep, {width * 1e6:g} um wide"
    return measured(profile.after(said, heights))


def pitted(profile: Profile, *, count: int, depth: float, width: float, seed: int) -> Synthetic:
    """Pits: round-bottomed hollows of a depth and full width (m), depths spread from half to the whole.

    >>> flat = Profile(np.zeros(2000), 5e-7)
    >>> bool(pitted(flat, count=3, depth=5e-6, width=4e-5, seed=1).profile.heights.max() == 0)
    True
    """
    places, depths = _scattered(profile, count, depth, width, seed, "pitted")
    heights = profile.heights.copy()
    for place, deep in zip(places, depths):
        distance = (profile.positions - place) / (width / 2)
        heights -= deep * np.sqrt(np.maximum(1 - distance**2, 0.0))
    said = f"{count} pits to {depth * 1e6:g} um deep, {width * 1e6:g} um wide"
    return measured(profile.after(said, heights))


def _scattered(
    profile: Profile, count: int, depth: float, width: float, seed: int, where: str
) -> tuple[np.ndarray, np.ndarray]:
    """Places, one in each equal part of the trace, and depths, the largest equal to ``depth``."""
    room = profile.length / max(count, 1)
    if not (count >= 1 and depth > 0 and math.isfinite(depth) and 2 * profile.spacing < width < room / 2):
        raise InputError(
            "needs a count, a depth above zero and a width of two steps to half the room of each",
            where=where,
            value=(count, depth, width),
        )
    places = (np.arange(count) + 0.25 + 0.5 * uniform(seed, count)) * room
    # On whole points, so that the deepest point is sampled.
    places = np.round(places / profile.spacing) * profile.spacing
    depths = depth * np.linspace(0.5 if count > 1 else 1.0, 1.0, count)
    return places, depths[np.argsort(uniform(seed + 1, count), kind="stable")]


def _with(profile: Profile, name: str, heights: np.ndarray) -> Profile:
    return replace(profile, name=name, heights=heights)
