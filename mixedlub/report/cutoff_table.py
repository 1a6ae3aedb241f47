"""Sensitivity of the line of loss over composite roughness to the short cut-off of the traces."""

from __future__ import annotations

from pathlib import Path

from mixedlub.schema.findings import collected
from mixedlub.study import Results, read_study, run_study
from mixedlub.study.fits import FEWEST_PAIRINGS, over_roughness
from mixedlub.study.plan import Study
from profiles.errors import InputError

FACTORS = (0.5, 1.0, 2.0, 3.2)
"""Short cut-offs relative to the study; the last takes 2.5 um to the next of ISO 3274, 8 um."""
MOST_TRACES, MOST_ROWS = 12, 20_000
"""Largest number of traces and of recomputed conditions."""


def cutoff_rows(results: Results) -> list[tuple[str, str, str, str]]:
    """Short cut-off, least and largest R^2, largest boundary area ratio; empty without traces with a cut-off."""
    study = results.study
    with collected():
        own = {name: study.rig.profile(name).cutoffs.get("short_cutoff") for name in _traced(study)}
    few = len(study.pairings) < FEWEST_PAIRINGS or len(own) > MOST_TRACES or study.conditions > MOST_ROWS
    if few or not own or None in own.values():
        return []
    rows = []
    for factor in FACTORS:
        try:
            found = results if factor == 1.0 else _at(study, {name: factor * (own[name] or 0.0) for name in own})
        except InputError:
            continue
        used = sorted({factor * (cutoff or 0.0) * 1e6 for cutoff in own.values()})
        fits = over_roughness(found).square
        label = " to ".join(f"{value:.3g}" for value in dict.fromkeys((used[0], used[-1])))
        rows.append((label, f"{fits.min():.3f}", f"{fits.max():.3f}", f"{found['area_ratio'].max():.2f}"))
    return rows


def _traced(study: Study) -> list[str]:
    return [name for name in study.surfaces if study.file.surfaces[name].files]


def _at(study: Study, cutoffs: dict[str, float]) -> Results:
    """The study with other short cut-offs (m) of its traces."""
    surfaces = dict(study.file.surfaces)
    for name, cutoff in cutoffs.items():
        surfaces[name] = surfaces[name].model_copy(update={"short_cutoff_um": cutoff * 1e6})
    file = study.file.model_copy(update={"surfaces": surfaces})
    with collected():
        return run_study(read_study(Path(study.rig.folder) / f"{study.name}.toml", file))
