"""Preparation of a map: levelled, holes masked or filled, filtered by the Gaussian filters of ISO 16610-61."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from profiles import InputError
from profiles.errors import nearest
from profiles.maps import HeightMap
from roughness.filters import gaussian_kernel
from roughness.maps.heights import refuse_flat
from roughness.maps.holes import filled

LONG_CUTOFF, SHORT_CUTOFF = 0.8e-3, 2.5e-6
"""Source. Default cut-offs (m) of a map; the middle row of ISO 3274."""
FEWEST = 16
"""Grid. Fewest rows and columns of a map for its moments to be meaningful."""
MOST_HOLES = 0.2
"""Judgement. Share of points without a height up to which a map is evaluated with its holes left out."""
HOLES = ("mask", "fill")
"""Treatments of points without a height."""
DIRECT = 65
"""Cost limit. Longest kernel that is summed point by point; longer ones go through transforms."""


def prepared_map(
    area: HeightMap,
    *,
    form: str = "line",
    cutoff: float | None = None,
    short_cutoff: float | None = None,
    holes: str = "mask",
    outliers: float | None = None,
) -> HeightMap:
    """Roughness of a map by the usual steps: outliers, holes, form, short and long waves; ``steps`` names them.

    Cut-offs in m; left out they are 0.8 mm and 2.5 um as far as the map holds and resolves them. ``holes``: mask leaves
    points without a height out, fill closes them. ``outliers`` masks heights beyond so many robust sigmas.

    >>> y, x = np.mgrid[0:64, 0:64]
    >>> tilted = HeightMap(1e-7 * x + 1e-7 * ((x // 8 + y // 8) % 2), 1e-6, 1e-6)
    >>> prepared_map(tilted).steps[-1]
    'no cut-off: the map of 0.063 mm is shorter than 0.8 mm'
    """
    if holes not in HOLES:
        raise InputError(f"must be mask or fill; {nearest(holes, HOLES)}", where="holes", value=holes)
    steps = list(area.steps)
    if outliers is not None:
        area, count = _without_outliers(area, form, outliers)
        steps.append(f"{count} outliers beyond {outliers:g} sigma masked")
    if missing := area.heights.size - int(np.count_nonzero(np.isfinite(area.heights))):
        share = f"{missing} of {area.heights.size} points ({100 * area.holes:.2g} %) without a height"
        steps.append(f"{share} {'filled' if holes == 'fill' else 'left out'}")
        if holes == "fill":
            area = replace(area, heights=filled(area.heights, f"map {area.name!r}"))
    long = LONG_CUTOFF if cutoff is None else cutoff
    short = SHORT_CUTOFF if short_cutoff is None else short_cutoff
    fits = cutoff is not None or long <= min(area.size)
    resolved = short >= 2.0 * max(area.spacing_x, area.spacing_y)
    found = areal_roughness(area, form=form, cutoff=long if fits else None, short_cutoff=short if resolved else None)
    steps.append(
        {"none": "no form removed", "mean": "mean removed", "line": "plane removed"}.get(form, f"{form} removed")
    )
    if resolved:
        steps.append(f"areal Gaussian short cut-off {short * 1e6:g} um")
    else:
        coarse = max(area.spacing_x, area.spacing_y) * 1e6
        steps.append(f"short cut-off not applied: step {coarse:.3g} um is too coarse for {short * 1e6:g} um")
    if fits:
        steps.append(f"areal Gaussian cut-off {long * 1e3:g} mm")
    else:
        steps.append(f"no cut-off: the map of {min(area.size) * 1e3:.3g} mm is shorter than {long * 1e3:g} mm")
    return replace(found, steps=tuple(steps))


def areal_roughness(
    area: HeightMap, *, form: str = "line", cutoff: float | None = None, short_cutoff: float | None = None
) -> HeightMap:
    """Roughness of a map: without the form, then without waves below ``short_cutoff`` and above ``cutoff`` (m).

    ``form``: none, mean, line (a plane) or polynomial-N of total degree N. Gaussian filters of ISO 16610-61; near the
    edges the weights are normalised over the points of the map.

    >>> y, x = np.mgrid[0:64, 0:64]
    >>> tilted = HeightMap(1e-7 * x + 2e-7 * y + 1e-7 * ((x + y) % 2), 1e-6, 1e-6)
    >>> round(float(areal_roughness(tilted).heights.std() * 1e9), 1)
    50.0
    """
    heights = _levelled(checked(area), form)
    refuse_flat(heights, area)
    if short_cutoff is not None:
        heights = _smoothed(heights, area, short_cutoff)
    if cutoff is not None:
        if short_cutoff is not None and not short_cutoff < cutoff:
            rule = f"short cut-off must be below the cut-off of {cutoff * 1e6:g} um"
            raise InputError(rule, where=f"map {area.name!r}: short cut-off (um)", value=short_cutoff * 1e6)
        if cutoff > min(area.size):
            rule = f"the map of {min(area.size) * 1e3:.3g} mm is shorter than the cut-off"
            raise InputError(rule, where=f"map {area.name!r}: cut-off (mm)", value=cutoff * 1e3)
        heights = heights - _smoothed(heights, area, cutoff)
    applied = {"cutoff": cutoff, "short_cutoff": short_cutoff}
    cutoffs = {**area.cutoffs, **{name: length for name, length in applied.items() if length is not None}}
    if heights is not area.heights:
        heights.flags.writeable = False  # spares a copy
    return replace(area, heights=heights, cutoffs=cutoffs)


def checked(area: HeightMap) -> np.ndarray:
    """Heights of a map; an error for too many holes, or too few rows or columns."""
    missing = int(np.count_nonzero(~np.isfinite(area.heights)))
    if missing > MOST_HOLES * area.heights.size:
        rule = (
            f"has holes: {missing} of {area.heights.size} points have no height, more than {100 * MOST_HOLES:g} %. "
            'Fill them (holes = "fill", --holes fill), cut the map to a part without, or give traces'
        )
        raise InputError(rule, where=f"map {area.name!r}")
    if min(area.heights.shape) < FEWEST:
        rule = f"a map needs at least {FEWEST} rows and columns"
        raise InputError(rule, where=f"map {area.name!r}", value=area.heights.shape)
    return area.heights


def _levelled(heights: np.ndarray, form: str) -> np.ndarray:
    degree = _degree(form)
    if degree is None:
        return heights
    y, x = (np.linspace(-1.0, 1.0, n) for n in heights.shape)
    across = np.polynomial.legendre.legvander(x, degree)
    down = np.polynomial.legendre.legvander(y, degree)
    there = np.isfinite(heights)
    known = heights if there.all() else np.where(there, heights, 0.0)
    places = [(i, j) for i in range(degree + 1) for j in range(degree + 1 - i)]
    loads = (down.T @ known @ across)[tuple(zip(*places))]
    # sums over all points of products of four polynomials, as matrix products
    pairs = [np.einsum("ni,nk->nik", one, one).reshape(len(one), -1) for one in (down, across)]
    sums = pairs[0].T @ (there.astype(float) @ pairs[1])
    whole = sums.reshape((degree + 1,) * 4)
    gram = np.array([[whole[i, k, j, m] for k, m in places] for i, j in places])
    factors = np.zeros((degree + 1, degree + 1))
    factors[tuple(zip(*places))] = np.linalg.solve(gram, loads)
    levelled: np.ndarray = heights - down @ factors @ across.T
    return levelled


def _degree(form: str) -> int | None:
    if form in ("none", "mean", "line"):
        return {"none": None, "mean": 0, "line": 1}[form]
    head, _, tail = form.partition("-")
    if head == "polynomial" and tail.isdigit() and int(tail) <= 8:
        return int(tail)
    raise InputError("of a map is none, mean, line or polynomial-0 to polynomial-8", where="form", value=form)


def _without_outliers(area: HeightMap, form: str, sigmas: float) -> tuple[HeightMap, int]:
    """The map with heights far off its form masked, and their number."""
    level = _levelled(area.heights, form)
    off = np.abs(level - np.nanmedian(level))
    far = off > sigmas * 1.4826 * np.nanmedian(off)
    return replace(area, heights=np.where(far, np.nan, area.heights)), int(np.count_nonzero(far))


def _smoothed(heights: np.ndarray, area: HeightMap, cutoff: float) -> np.ndarray:
    """Heights after the Gaussian low-pass of a cut-off (m), weights normalised over the known points."""
    there = np.isfinite(heights)
    down, across = (gaussian_kernel(cutoff, step) for step in (area.spacing_y, area.spacing_x))
    summed = _low(heights if there.all() else np.where(there, heights, 0.0), down, across)
    if there.all():
        ones = [np.convolve(np.ones(n), k, "full")[k.size // 2 :][:n] for n, k in zip(heights.shape, (down, across))]
        summed /= ones[0][:, None]
        summed /= ones[1]
        return summed
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(there, summed / _low(there.astype(float), down, across), np.nan)


def _low(values: np.ndarray, down: np.ndarray, across: np.ndarray) -> np.ndarray:
    """Sums under a kernel along y and one along x; heights beyond the map count as none."""
    from scipy.ndimage import correlate1d
    from scipy.signal import oaconvolve

    for axis, kernel in enumerate((down, across)):
        if kernel.size <= DIRECT:
            values = correlate1d(values, kernel, axis=axis, mode="constant")
        else:
            values = oaconvolve(values, np.expand_dims(kernel, 1 - axis), mode="same", axes=axis)
    return values
