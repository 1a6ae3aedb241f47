"""The surfaces on the page: spectral moments and asperities, and traces."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.report.figures import Drawn
from mixedlub.report.style import styled
from mixedlub.rig.surface import Surface
from mixedlub.schema.findings import Finding, collected, finding
from mixedlub.schema.surface_file import SurfaceSection
from mixedlub.study.plan import Study
from profiles import Profile
from roughness.mccool import nayak_parameter, summit_density, summit_radius

if TYPE_CHECKING:
    from roughness import NormalProbability

    Judged = dict[str, NormalProbability]

MOST_CURVES = 8
EXCERPT = 1.5e-3
"""Length of trace drawn (m): single asperities remain visible."""
SCALE_RATIO = 5.0
"""Highest over lowest trace above which each has a separate scale: a common scale would flatten the lowest."""


def surface_rows(study: Study) -> list[tuple[str, ...]]:
    """Name, Rq (um), rms slope, rms curvature (1/mm), Nayak bandwidth, summits per mm2 and their radius (um)."""
    surfaces = list(study.surfaces.values())[: 4 * MOST_CURVES]
    m0, m2, m4 = (np.array([getattr(s, name) for s in surfaces]) for name in ("m0", "m2", "m4"))
    # the isotropic surface that stands for one with a lay has geometric means of both directions
    m2, m4 = (np.sqrt(across * np.array(along)) for across, along in zip((m2, m4), _along(surfaces)))
    columns = (
        (np.sqrt(m0) * 1e6, ".3f"),
        (np.sqrt(m2), ".4f"),
        (np.sqrt(m4) * 1e-3, ".3g"),
        (nayak_parameter(m0, m2, m4), ".3g"),
        (summit_density(m2, m4) * 1e-6, ".0f"),
        (summit_radius(m4) * 1e6, ".3g"),
    )
    cells = [[format(value, form) for value in values] for values, form in columns]
    return [(s.name, *row) for s, row in zip(surfaces, zip(*cells, strict=True), strict=True)]


def _along(surfaces: Sequence[Surface]) -> tuple[list[float], list[float]]:
    """m2 and m4 along the lay, or in the only known direction of surfaces without a lay."""
    return [s.m2_along or s.m2 for s in surfaces], [s.m4_along or s.m4 for s in surfaces]


def traced(study: Study) -> dict[str, Profile]:
    """Filtered profiles of the surfaces given as traces, at most as many as a figure holds."""
    named = [name for name in study.surfaces if study.file.surfaces[name].files][:MOST_CURVES]
    with collected():
        profiles = {name: study.rig.profile(name) for name in named}
    return {name: replace(profile, name=name) for name, profile in profiles.items()}


def surface_figures(study: Study, profiles: Mapping[str, Profile], judged: Judged) -> Iterator[Drawn]:
    """Traces and normal probability plots of the surfaces given as traces."""
    if not profiles:
        return
    from roughness.plots import probability_figure, trace_figure

    count = sum(bool(study.file.surfaces[name].files) for name in study.surfaces)
    first = "" if len(profiles) == count else f" (the first {len(profiles)} of {count})"
    heights = [float(np.ptp(profile.heights)) for profile in profiles.values()]
    separate_scales = max(heights) > SCALE_RATIO * min(heights)
    scale = "each to its own scale of height, as they differ much" if separate_scales else "all to one scale"
    with styled():
        yield Drawn(
            "traces",
            f"Roughness profiles{first}, {scale}: 1.5 mm from the middle of each.",
            trace_figure(*profiles.values(), excerpt=EXCERPT, one_scale=not separate_scales),
        )
        yield Drawn(
            "probability",
            f"Normal probability plots of the profile heights{first}. A Gaussian surface follows the straight line, "
            "and the band holds 99 of 100 Gaussian profiles of the same autocorrelation. The line describes the "
            "heights between the two ticks; a profile of few independent heights shows no more than the middle of "
            "the distribution.",
            probability_figure(*profiles.values(), results=list(judged.values())),
        )


def judgement(profiles: Mapping[str, Profile]) -> Judged:
    """The normal probability plot of each profile, evaluated."""
    from roughness import normal_probability

    return {name: normal_probability(profile) for name, profile in profiles.items()}


def height_notes(profiles: Mapping[str, Profile], judged: Judged, gaussian: bool = True) -> list[Finding]:
    """Warnings of `mixedlub profile` on the roughness parameters of each trace.

    With ``gaussian`` heights, including warnings on the height distribution.
    """
    from roughness import height_parameters, moments
    from roughness.guards import height_warnings, shape_warnings

    found = []
    for name, profile in profiles.items():
        texts = height_warnings(profile, height_parameters(profile), moments(profile), judged[name])
        of_shape = () if gaussian else tuple(shape_warnings(judged[name]))
        found += [finding("trace_quality", text, f"surfaces.{name}") for text in texts if text not in of_shape]
    return found


def not_gaussian(judged: Judged) -> list[Finding]:
    """Findings on surfaces with non-Gaussian heights, as the asperity theory assumes Gaussian heights."""
    odd = [
        f"{name} ({result.verdict.replace('_', ' ')})"
        for name, result in judged.items()
        if result.verdict in ("plateau", "not_gaussian")
    ]
    if not odd:
        return []
    text = f"the asperity theory assumes Gaussian heights, which these surfaces do not have: {', '.join(odd)}"
    return [finding("heights_not_gaussian", text)]


def provenance(study: Study) -> list[tuple[str, str]]:
    """Source of each surface: moments as given, or a trace with its processing steps."""
    sections = study.file.surfaces
    shown = list(study.surfaces.items())[: 4 * MOST_CURVES]
    return [(name, _origin(sections[name], s)) for name, s in shown]


def _origin(section: SurfaceSection, surface: Surface) -> str:
    """Files of a surface, and the processing steps of the first, or the cut-offs of a map."""
    if section.map is not None:
        used = (("short cut-off", surface.short_cutoff), ("cut-off", surface.cutoff))
        cutoffs = (f"no {name}" if length is None else f"{name} {1e6 * length:.6g} um" for name, length in used)
        return f"map {section.map}: {', '.join(cutoffs)}"
    if not section.files:
        return "moments as given"
    along = f"; along the lay {', '.join(section.traces_along)}" if section.traces_along else ""
    return f"{', '.join(section.files)}{along}: {'; '.join(surface.steps)}"
