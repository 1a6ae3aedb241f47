"""One profile, evaluated: the row that goes into ``profile.json``."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, replace

import numpy as np

from profiles import InputError, Profile
from profiles.profile import of_profile
from roughness.asperities import Asperities, mccool_asperities
from roughness.clipping import clipping
from roughness.cutoffs import choose_cutoffs, short_cutoff_for
from roughness.defects import mask_edges, mask_outliers, without_edges
from roughness.elements import element_parameters
from roughness.guards import profile_warnings
from roughness.material_ratio import core_parameters, core_profile
from roughness.moments import Moments, moments
from roughness.parameters import FEWEST, HeightParameters, height_parameters, named_convention
from roughness.prepare import remove_form, roughness_profile
from roughness.probability import NormalProbability, normal_probability
from roughness.spectrum import correlation_length
from roughness.uncertainty import bootstrap, short_cutoff_band, smoothed_moments

ROUNDING = 1e-13
"""Second differences of a straight trace, over its largest height, are below this rounding error."""

_LENGTHS = ("Ra", "Rq", "Rz", "Rt", "Rp", "Rv", "Rz1max")


@of_profile
def evaluation_profile(
    trace: Profile,
    *,
    form: str = "line",
    cutoff: float | str | None = "auto",
    short_cutoff: float | str | None = "auto",
    method: str = "gaussian",
    outliers: float | None = None,
    trim_cutoffs: float = 0.0,
    edges: bool = True,
) -> Profile:
    """The roughness profile of a trace by the usual steps: edges, form, outliers, lambda_s, lambda_c.

    Cut-offs in m, None for none, or ``auto``: cut-offs that the file states as already applied are kept, without a
    second filter or line removal, else ISO 4288 and ISO 3274 choose. A short cut-off of fewer than two points is left
    out. Edges of the part are cut, unless ``edges`` is False; ``outliers`` masks points beyond this number of robust
    sigmas. The ends are kept by local regression, which on Gaussian surfaces estimates Rq, m2 and m4 at least as well
    as a profile cut by half a cut-off, as by instruments (``trim_cutoffs`` 0.5). ``method`` as in
    :func:`roughness_profile`.
    """
    _refuse_useless(trace)
    if found := clipping(trace):
        trace = replace(trace, origin={**trace.origin, "clipped": found})
    filtered = cutoff == "auto" and "cutoff" in trace.cutoffs
    if filtered and form == "line":
        profile = trace
    else:
        bounded = mask_edges(trace) if edges and not filtered else trace
        profile = remove_form(bounded if filtered else without_edges(bounded), form)
    if outliers is not None:
        profile = mask_outliers(profile, sigmas=outliers)
    limit = trace.cutoffs.get("cutoff") if cutoff == "auto" else _length(cutoff, "cut-off")
    if limit is None and cutoff == "auto":
        chosen = choose_cutoffs(profile)
        if chosen.cutoff <= profile.length:
            limit, step = chosen.cutoff, f"cut-off {chosen.cutoff * 1e3:g} mm by {chosen.reason}"
        else:
            step = f"no cut-off: the trace of {profile.length * 1e3:.3g} mm is shorter than any"
        profile = replace(profile, steps=(*profile.steps, step))
    if short_cutoff == "auto":
        short = None if "short_cutoff" in trace.cutoffs or filtered else _short(limit)
        if short is not None and short < 2.0 * trace.spacing:
            coarse = f"step {trace.spacing * 1e6:.3g} um is too coarse for {short * 1e6:g} um"
            step = f"short cut-off not applied: {coarse}"
            profile, short = replace(profile, steps=(*profile.steps, step)), None
    else:
        short = _length(short_cutoff, "short cut-off")
    return roughness_profile(
        profile,
        cutoff=None if filtered else limit,
        short_cutoff=short,
        method=method,
        trim_cutoffs=trim_cutoffs,
    )


@of_profile
def trace_record(
    trace: Profile,
    *,
    form: str = "line",
    cutoff: float | str | None = "auto",
    short_cutoff: float | str | None = "auto",
    method: str = "gaussian",
    outliers: float | None = None,
    trim_cutoffs: float = 0.0,
    edges: bool = True,
    convention: str | None = None,
    sections: int | None = None,
) -> tuple[Profile, dict[str, object]]:
    """A trace as read, evaluated: its roughness profile and its ``profile.json`` row.

    Preparation as in :func:`evaluation_profile`, the rest as in :func:`profile_record`. The row carries the
    asperities at half, one and two short cut-offs, as far as the trace shows them.
    """

    def prepare(before: Profile, long: float | str | None, short: float | str | None) -> Profile:
        return evaluation_profile(
            before,
            form=form,
            cutoff=long,
            short_cutoff=short,
            method=method,
            outliers=outliers,
            trim_cutoffs=trim_cutoffs,
            edges=edges,
        )

    profile = prepare(trace, cutoff, short_cutoff)
    limit = profile.cutoffs.get("short_cutoff")
    band: tuple[Moments, ...] = ()
    if limit is not None and "short_cutoff" not in trace.cutoffs:
        kept = profile.cutoffs.get("cutoff") if "cutoff" not in trace.cutoffs else cutoff
        band = short_cutoff_band(trace, limit, lambda before, short: prepare(before, kept, short))
    return profile, profile_record(profile, convention=convention, sections=sections, raw=trace, band=band)


@of_profile
def profile_record(
    profile: Profile,
    *,
    convention: str | None = None,
    sections: int | None = None,
    raw: Profile | None = None,
    band: Sequence[Moments] = (),
) -> dict[str, object]:
    """The ``profile.json`` row of an evaluated profile; units in the names, None for undefined values.

    ``raw`` is the trace as read, for the height step and the tip, which filters hide. ``band`` holds the moments at
    other short cut-offs; without it the profile is smoothed to twice its short cut-off. Convention and sections default
    to the rules of the file (``origin``) if the profile has the cut-offs of the file, else to ISO 4287:1997 and to
    whole cut-offs.
    """
    own, sections_of_file = rules_of_the_file(profile, profile if raw is None else raw)
    convention = convention or own
    sections = sections or sections_of_file
    heights = height_parameters(profile, convention=convention, sections=sections)
    found = moments(profile)
    try:
        gaussian = normal_probability(profile)
    except InputError:
        gaussian = None
    warnings = profile_warnings(profile, heights, found, gaussian, raw=raw)
    parameters = _parameters(profile, heights, gaussian, sections)
    if parameters.pop("s_shaped") is False:
        warnings.append("the material ratio curve is not S-shaped: the Rk family is undefined and left out")
        parameters |= dict.fromkeys(("Rk_um", "Rpk_um", "Rvk_um", "Mr1_percent", "Mr2_percent"))
    row = {
        "file": str(profile.origin.get("file", profile.name)),
        "steps": list(profile.steps),
        "parameters": parameters,
        "moments": _moments(found),
        "asperities": {**_asperities(mccool_asperities(found)), **_trust(profile, found, sections, band)},
        "gaussian": _gaussian(gaussian),
        "warnings": warnings,
    }
    return {name: _plain(value) for name, value in row.items()}


def rules_of_the_file(profile: Profile, raw: Profile) -> tuple[str, int | None]:
    """Convention and number of sections that go with the heights."""
    convention, sections = raw.origin.get("convention"), raw.origin.get("sampling_lengths")
    if "cutoff" not in raw.cutoffs or dict(profile.cutoffs) != dict(raw.cutoffs):
        return "ISO 4287:1997", None
    return str(convention or "ISO 4287:1997"), sections if isinstance(sections, int) else None


def _parameters(
    profile: Profile, heights: HeightParameters, gaussian: NormalProbability | None, sections: int | None
) -> dict[str, object]:
    rule = named_convention(heights.convention)
    values = asdict(heights)
    row: dict[str, object] = {f"{n}_um": values[n] * 1e6 for n in _LENGTHS}
    row |= {"Rsk": heights.Rsk, "Rku": heights.Rku, "Rdq": heights.Rdq}
    evaluated = core_profile(profile, convention=rule.name, sections=sections)
    core = core_parameters(evaluated, method=rule.core)
    row |= {"Rk_um": core.Rk * 1e6, "Rpk_um": core.Rpk * 1e6, "Rvk_um": core.Rvk * 1e6}
    row |= {"Mr1_percent": core.Mr1, "Mr2_percent": core.Mr2, "s_shaped": core.s_shaped}
    row |= {"Rk_length_mm": core.length * 1e3}
    layers = None if gaussian is None else gaussian.lines
    if layers is not None and not 0 < layers.plateau_sigma < layers.valley_sigma:
        layers = None
    row |= {
        "Rpq_um": None if layers is None else layers.plateau_sigma * 1e6,
        "Rvq_um": None if layers is None else layers.valley_sigma * 1e6,
        "Rmq_percent": None if layers is None else layers.material_percent,
    }
    elements = element_parameters(profile, discrimination=rule.discrimination, sections=sections)
    row |= {"RSm_um": elements.RSm * 1e6, "Rc_um": elements.Rc * 1e6}
    row |= {"correlation_length_um": correlation_length(profile) * 1e6}
    return row | {"sections": heights.sections, "convention": heights.convention}


def _moments(found: Moments) -> dict[str, object]:
    return {
        "m0_um2": found.m0 * 1e12,
        "m2": found.m2,
        "m4_per_um2": found.m4 * 1e-12,
        "spacing_um": None if found.spacing is None else found.spacing * 1e6,
        "short_cutoff_um": None if found.short_cutoff is None else found.short_cutoff * 1e6,
        "cutoff_mm": None if found.cutoff is None else found.cutoff * 1e3,
        "estimator": found.estimator,
    }


def _asperities(found: Asperities) -> dict[str, object]:
    return {
        "density_per_mm2": found.density * 1e-6,
        "radius_um": found.radius * 1e6,
        "sigma_um": found.sigma * 1e6,
        "plane_offset_um": found.plane_offset * 1e6,
        "nayak": found.nayak,
        "model": found.model,
    }


def _trust(profile: Profile, found: Moments, sections: int | None, band: Sequence[Moments]) -> dict[str, object]:
    """Asperities at other short cut-offs, and their interval from resampled sampling lengths."""
    doubled = 2.0 * (found.short_cutoff or 2.0 * profile.spacing)
    if not band and doubled < profile.length / 2:
        band = (found, smoothed_moments(profile, doubled))
    result: dict[str, object] = {
        "short_cutoff_band": [{**_moments(m), **_asperities(mccool_asperities(m))} for m in band],
    }
    try:
        interval = bootstrap(profile, sections=sections)
    except InputError:
        return result
    scale = {"density": ("density_per_mm2", 1e-6), "radius": ("radius_um", 1e6)}
    result["bootstrap90"] = {
        label: [bound * factor for bound in interval[name]] for name, (label, factor) in scale.items()
    }
    return result


def _gaussian(found: NormalProbability | None) -> dict[str, object]:
    if found is None:
        return {"verdict": "not_gaussian", "from_percent": None, "to_percent": None}
    row: dict[str, object] = {
        "verdict": found.verdict,
        "from_percent": round(found.from_percent, 3),
        "to_percent": round(found.to_percent, 3),
        "sigma_um": found.sigma * 1e6,
        "p_value": found.p_value,
        "independent_heights": found.independent_heights,
        "contact_ratio_at_1_2_3_sigma": list(found.contact_ratio),
        "words": found.words,
    }
    if found.plateau is not None:
        row["plateau"] = {
            "Rpq_um": found.plateau.plateau_sigma * 1e6,
            "Rvq_um": found.plateau.valley_sigma * 1e6,
            "Rmq_percent": found.plateau.material_percent,
            "knee_um": found.plateau.knee_height * 1e6,
            "mean_um": found.plateau.plateau_mean * 1e6,
        }
    return row


def _plain(value: object) -> object:
    """Value with None in place of nan and infinity, which JSON does not have."""
    if isinstance(value, dict):
        return {k: _plain(v) for k, v in value.items()}
    if isinstance(value, list):
        return [_plain(v) for v in value]
    if isinstance(value, float):
        return float(value) if math.isfinite(value) else None
    return value


def _refuse_useless(trace: Profile) -> None:
    """Raise an error for too few heights, equal heights, or heights on a straight line within rounding."""
    heights = trace.heights[trace.valid] if trace.valid.any() else trace.heights
    place = str(trace.origin.get("file", f"profile {trace.name!r}"))
    if trace.heights.size < FEWEST:
        raise InputError(f"a trace needs at least {FEWEST} points, has {trace.heights.size}", where=place)
    if np.ptp(heights) == 0.0:
        stuck = "all heights are the same: a stuck stylus or an empty channel; there is no roughness"
        raise InputError(stuck, where=place, value=f"{heights[0] * 1e6:.6g} um")
    if np.abs(np.diff(trace.heights, 2)).max() <= ROUNDING * np.abs(trace.heights).max():
        raise InputError("all heights lie on one straight line; there is no roughness", where=place)


def _length(value: float | str | None, what: str) -> float | None:
    if value is None or (isinstance(value, (int, float)) and value > 0):
        return value
    raise InputError("must be a length above zero, None or 'auto'", where=what, value=value)


def _short(cutoff: float | None) -> float | None:
    return None if cutoff is None else short_cutoff_for(cutoff).short_cutoff
