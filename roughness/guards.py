"""Warnings about a profile: the fault, its size and its effect on the numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np

from profiles import Profile
from profiles.maps import HeightMap
from roughness.clipping import clipping
from roughness.defects import CUT
from roughness.moments import Moments, moments
from roughness.noise import height_quantum, noise_moments, tip_limited_wavelength
from roughness.parameters import CONVENTIONS, HeightParameters, height_parameters, section_count
from roughness.prepare import primary_profile
from roughness.probability import NormalProbability, extreme_limit

_HEADER_TOLERANCE = 0.05
_RESULT_TOLERANCE = 0.02
_SAY = 0.05  # of m4, that one place or the height step may hold unsaid
_COMPARED = ("a", "q", "z", "t", "p", "v")


def profile_warnings(
    profile: Profile,
    heights: HeightParameters,
    found: Moments,
    gaussian: NormalProbability | None,
    *,
    raw: Profile | None = None,
) -> list[str]:
    """All warnings of an evaluated profile; ``raw`` is the trace as read, if available."""
    as_read = profile if raw is None else raw
    return [*trace_warnings(profile, found, raw=as_read), *height_warnings(profile, heights, found, gaussian)]


def height_warnings(
    profile: Profile, heights: HeightParameters, found: Moments, gaussian: NormalProbability | None
) -> list[str]:
    """Warnings about the parameters of an evaluated profile and about the shape of its height distribution."""
    return [
        *_band(profile, found),
        *_lengths(profile, heights),
        *_alike(heights, found),
        *_resolution(profile, found),
        *shape_warnings(gaussian),
    ]


def trace_warnings(profile: Profile, found: Moments, *, raw: Profile) -> list[str]:
    """Warnings about a trace as read and the parts cut off it, for any parameters."""
    return [
        *_inferred(raw),
        *overruled(raw),
        *_clipped(raw),
        *_cut(profile),
        *_stated(profile, raw),
        *_instrument(profile, found, raw),
        *_spikes(profile),
    ]


def _band(profile: Profile, found: Moments) -> Iterator[str]:
    alpha = found.bandwidth
    if alpha < 1.5:
        yield (
            f"bandwidth alpha {alpha:.3g} is below 1.5: no isotropic Gaussian surface has it; the summits' "
            "sigma and plane offset are those of 1.5"
        )
    z = profile.heights - profile.heights.mean()
    lag_one = float(z[1:] @ z[:-1] / (z @ z))
    if lag_one < 0.5:
        white = f" (alpha {alpha:.3g}; white noise gives 0 and 1.5)" if 1.4 < alpha < 1.6 else ""
        yield (
            f"neighbouring heights correlate by {lag_one:.2f} only{white}: the trace does not resolve its finest "
            "waves, so m2, m4, radius and density are those of the sampling"
        )
    short = profile.cutoffs.get("short_cutoff")
    if short is None:
        yield (
            "no short cut-off: m2, m4, summit radius and density are set by the sampling interval of "
            f"{profile.spacing * 1e6:.3g} um, not by the surface"
        )
    elif short < 7.99 * profile.spacing:
        low = "m4 by differences comes out low"
        if short < 3.0 * profile.spacing:
            low += ", by a third to two thirds, and m2 by up to an eighth"
        yield (f"{short / profile.spacing:.1f} points a short cut-off of {short * 1e6:.3g} um, fewer than 8: {low}")


def _lengths(profile: Profile, heights: HeightParameters) -> Iterator[str]:
    cutoff = profile.cutoffs.get("cutoff")
    if cutoff is None:
        yield "no cut-off: heights contain waviness and what is left of the form"
    elif (length := profile.heights.size * profile.spacing) < 0.99 * cutoff:
        yield (
            f"one sampling length of {length * 1e3:.3g} mm, shorter than the cut-off of {cutoff * 1e3:.3g} mm and "
            "fewer than the 5 of ISO 4288: Rz comes out low and the moments scatter more"
        )
    elif (count := section_count(profile)) < 5:
        yield (
            f"{count} sampling length{'s' * (count > 1)} of {cutoff * 1e3:.3g} mm, fewer than the 5 of ISO "
            "4288: Rz and the moments scatter more"
        )
    mean = float(profile.heights.mean())
    if abs(mean) > 0.1 * heights.Rq:
        yield (
            f"the mean of the heights lies {mean * 1e6:.3g} um off the zero line: form, edges or spikes are "
            "left in the profile (another form, as polynomial-2, or masked outliers may serve)"
        )
    masked = 1.0 - float(np.mean(profile.valid))
    if masked > 0.05:
        yield f"{100 * masked:.1f} % of the points are masked"


def _alike(heights: HeightParameters, found: Moments) -> Iterator[str]:
    whole = float(np.sqrt(found.m0))
    if heights.sections > 1 and whole > 1.05 * heights.Rq:
        yield (
            f"the rms over the whole, sqrt(m0) {whole * 1e6:.3g} um, is above Rq {heights.Rq * 1e6:.3g} um, the mean "
            f"of {heights.sections} sampling lengths: the surface is not alike along the trace"
        )


def _resolution(profile: Profile, found: Moments) -> Iterator[str]:
    other = moments(profile, estimator="spectral")
    if not 0.7 < found.m4 / other.m4 < 1.4:
        yield (
            f"m4 by differences is {found.m4 / other.m4:.2f} of m4 by spectral integration: the finest waves "
            "are not resolved or not stationary"
        )


def _instrument(profile: Profile, found: Moments, raw: Profile) -> Iterator[str]:
    quantum = height_quantum(raw)
    if quantum is not None:
        added = noise_moments(quantum / np.sqrt(12.0), profile.spacing, profile.cutoffs.get("short_cutoff"))
        share = added[2] / found.m4
        if share > _SAY:
            yield (
                f"the height step of {quantum * 1e9:.3g} nm accounts for {100 * min(share, 1.0):.0f} % of "
                "m4: summit radius comes out small and density large"
            )
    radius = raw.origin.get("tip_radius")
    if isinstance(radius, (int, float)) and radius > 0:
        limit = tip_limited_wavelength(raw, float(radius))
        short = profile.cutoffs.get("short_cutoff", 0.0)
        if limit > max(short, 2 * profile.spacing):
            yield (
                f"below {limit * 1e6:.3g} um the trace shows the tip of {radius * 1e6:.3g} um radius: a "
                "short cut-off above that is needed"
            )


def _spikes(profile: Profile) -> Iterator[str]:
    """Places with more curvature than any Gaussian surface, if a single place dominates m4."""
    bend = np.diff(profile.heights, 2)
    bend[~(profile.valid[2:] & profile.valid[1:-1] & profile.valid[:-2])] = 0.0
    low, high = np.quantile(bend, (0.1, 0.9))
    far = np.abs(bend) > extreme_limit(bend.size) * (high - low) / 2.563
    reach = 1 + math.ceil(profile.cutoffs.get("short_cutoff", 0.0) / profile.spacing)
    near = np.convolve(far, np.ones(2 * reach + 1), "same") > 0.5 if bend.size > 2 * reach else far
    starts = np.flatnonzero(np.diff(near, prepend=False) & near)
    if not starts.size:
        return
    shares = np.add.reduceat(np.where(near, bend, 0.0) ** 2, starts) / (bend @ bend)
    if shares.max() <= _SAY:
        return
    most = int(shares.argmax())
    end = starts[most + 1] if most + 1 < starts.size else bend.size
    at = int(starts[most] + np.abs(bend[starts[most] : end]).argmax() + 1)
    where = f"at {at * profile.spacing * 1e3:.4g} mm, {profile.heights[at] * 1e6:.3g} um off the mean line"
    held = f"{100 * shares.max():.0f} % of m4"
    if starts.size > 1:
        held += f" ({100 * shares.sum():.0f} % with {starts.size - 1} more)"
    yield (
        f"one place, {where}, holds {held}: a spike, dirt or a scratch decides the summits; masking outliers leaves it "
        "out (--outliers 5, or outliers = 5 in a file)"
    )


def _inferred(raw: Profile) -> Iterator[str]:
    for key in ("units_inferred", "units_doubtful", "count_differs"):
        if key in raw.origin:
            yield str(raw.origin[key])


def overruled(raw: Profile | HeightMap) -> Iterator[str]:
    """Units and step of the file that the caller overruled."""
    for what in ("units", "spacing"):
        if f"{what}_overruled" in raw.origin:
            yield f"{what}: {raw.origin[f'{what}_overruled']}"


def _clipped(raw: Profile) -> Iterator[str]:
    """Heights beyond the range of the instrument, and stretches without signal."""
    if found := clipping(raw):
        again = "in a wider range" if found.low or found.high else "or leave the stretch out: the signal was lost there"
        yield (
            f"{found}, unless the part has such flats: Rz, Rsk, Rku, the summits and whether the heights are Gaussian "
            f"are doubtful; measure again {again}"
        )


def _cut(profile: Profile) -> Iterator[str]:
    """Length of the trace cut off as beyond the edges of the part."""
    for step in profile.steps:
        if step.startswith(CUT):
            yield f"{step}: the trace leaves the level of the surface there and does not come back"


def _stated(profile: Profile, raw: Profile) -> Iterator[str]:
    """Parameters printed in the file against parameters of its heights, by the file's rules and before any other
    filter. Roughness printed beside an unfiltered trace is compared with the evaluated profile."""
    stated = raw.origin.get("stated")
    if not isinstance(stated, Mapping):
        return
    short, sections = raw.origin.get("stated_short_cutoff"), raw.origin.get("sampling_lengths")
    named, filtered = str(raw.origin.get("convention")), bool(raw.origin.get("stated_filtered"))
    own = profile if filtered else primary_profile(raw, short, floored=True) if isinstance(short, float) else raw
    ours = height_parameters(
        own,
        convention=named if named in CONVENTIONS else "ISO 4287:1997",
        sections=sections if isinstance(sections, int) else None,
    )
    for name, value in stated.items():
        if name[:1] not in ("R" if filtered else "RP") or name[1:] not in _COMPARED:
            continue
        if not isinstance(value, (int, float)) or not value > 0:
            continue
        found = getattr(ours, f"R{name[1:]}")
        said = f"the file states {name} {value * 1e6:.4g} um, its heights give {found * 1e6:.4g} um"
        if filtered and abs(value / found - 1.0) > _RESULT_TOLERANCE:
            yield f"{said} by the filter taken here: stated {100.0 * (value / found - 1.0):+.0f} %"
        elif not filtered and abs(found / value - 1.0) > _HEADER_TOLERANCE:
            yield f"{said}: header and heights do not belong together, or not to this filter"


def shape_warnings(gaussian: NormalProbability | None) -> Iterator[str]:
    """Warnings about heights that are not Gaussian."""
    if gaussian is None:
        yield "too few differing heights for a probability plot"
        return
    if gaussian.independent_heights < 30:
        yield (
            f"only {gaussian.independent_heights:.0f} independent heights: whether they are Gaussian was "
            "judged by the shape alone"
        )
    if gaussian.misleads:
        ratio = gaussian.contact_ratio[1]
        yield f"called Gaussian, yet real contact at a gap of 2 sigma is {ratio:.2f} times the Gaussian one"
    if gaussian.verdict == "plateau":
        yield gaussian.words
    if gaussian.verdict == "not_gaussian":
        yield f"heights are {gaussian.words.removeprefix('heights ')}"
