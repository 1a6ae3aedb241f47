"""Cut-offs for a profile: the tables of ISO 4288, ISO 21920-3 and ISO 3274."""

from __future__ import annotations

from dataclasses import dataclass

from profiles import InputError, Profile
from profiles.errors import nearest
from profiles.profile import of_profile
from roughness.elements import element_parameters
from roughness.parameters import height_parameters
from roughness.prepare import roughness_profile

# Upper limits in m (ISO 4288:1996, tables 1 to 3; the settings classes of ISO 21920-3:2021 keep them)
_BY_RA = ((0.02e-6, 0.08e-3), (0.1e-6, 0.25e-3), (2e-6, 0.8e-3), (10e-6, 2.5e-3), (80e-6, 8e-3))
_BY_RZ = ((0.1e-6, 0.08e-3), (0.5e-6, 0.25e-3), (10e-6, 0.8e-3), (50e-6, 2.5e-3), (200e-6, 8e-3))
_BY_RSM = ((0.04e-3, 0.08e-3), (0.13e-3, 0.25e-3), (0.4e-3, 0.8e-3), (1.3e-3, 2.5e-3), (4e-3, 8e-3))
_RULES = {"Ra": _BY_RA, "Rz": _BY_RZ, "RSm": _BY_RSM}

# ISO 3274:1996, table 1: cut-off, short cut-off, largest tip radius, largest spacing
_SHORT = (
    (0.08e-3, 2.5e-6, 2e-6, 0.5e-6),
    (0.25e-3, 2.5e-6, 2e-6, 0.5e-6),
    (0.8e-3, 2.5e-6, 2e-6, 0.5e-6),
    (2.5e-3, 8e-6, 5e-6, 1.5e-6),
    (8e-3, 25e-6, 10e-6, 5e-6),
)


@dataclass(frozen=True)
class CutoffChoice:
    """Cut-off lambda_c, short cut-off lambda_s, largest tip radius and spacing (m), and the reason."""

    cutoff: float
    short_cutoff: float
    tip_radius: float
    spacing: float
    reason: str


def cutoff_for(parameter: str, value: float) -> float:
    """Cut-off lambda_c (m) for a value of Ra, Rz or RSm (m). ISO 4288:1996, 7.

    >>> cutoff_for("Ra", 0.45e-6), cutoff_for("Ra", 0.036e-6), cutoff_for("RSm", 0.42e-3)
    (0.0008, 0.00025, 0.0025)
    """
    if parameter not in _RULES:
        raise InputError(f"has no rule; {nearest(parameter, _RULES)}", where="cut-off by", value=parameter)
    table = _RULES[parameter]
    return next((cutoff for limit, cutoff in table if value <= limit), table[-1][1])


def short_cutoff_for(cutoff: float) -> CutoffChoice:
    """Short cut-off, tip and spacing for a cut-off (m). ISO 3274:1996, table 1.

    >>> short_cutoff_for(0.8e-3).short_cutoff, short_cutoff_for(2.5e-3).short_cutoff
    (2.5e-06, 8e-06)
    """
    row = min(_SHORT, key=lambda r: abs(r[0] - cutoff))
    return CutoffChoice(cutoff, *row[1:], reason=f"ISO 3274 table 1 for a cut-off of {cutoff * 1e3:g} mm")


@of_profile
def choose_cutoffs(profile: Profile) -> CutoffChoice:
    """Cut-offs of a levelled trace by the rule of ISO 4288:1996, 7.2.

    From 0.8 mm, measure Ra, Rz and RSm and take their cut-off until a cut-off repeats; of two alternating cut-offs, the
    longer. Periodic profiles (equal element widths) go by RSm, others by Ra and Rz. A trace too short for the cut-off
    takes the longest that fits.
    """
    fits = [row[0] for row in _SHORT if row[0] <= 0.6 * profile.length] or [_SHORT[0][0]]
    cutoff = min(0.8e-3, fits[-1])
    seen: list[float] = []
    while cutoff not in seen:
        seen.append(cutoff)
        trial = roughness_profile(profile, cutoff=min(cutoff, profile.length))
        heights = height_parameters(trial)
        wanted = max(cutoff_for("Ra", heights.Ra), cutoff_for("Rz", heights.Rz))
        elements = element_parameters(trial)
        by = f"Ra {heights.Ra * 1e6:.3g} um, Rz {heights.Rz * 1e6:.3g} um"
        if elements.count >= 4 and elements.width_variation < 0.25:
            wanted = cutoff_for("RSm", elements.RSm)
            by = f"periodic, RSm {elements.RSm * 1e6:.3g} um"
        cutoff = min(wanted, fits[-1])
        short = " (trace too short for more)" if cutoff < wanted else ""
    settled = max(cutoff, seen[-1])
    found = short_cutoff_for(settled)
    return CutoffChoice(settled, found.short_cutoff, found.tip_radius, found.spacing, reason=f"ISO 4288: {by}{short}")
