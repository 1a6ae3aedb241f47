r"""Moments of a surface by Ra, Rq or Rz alone: a stated assumption with its band.

Heights are Gaussian. The slope follows the roughness as on machined metal surfaces: three published correlations of the
mean absolute slope m with the rms roughness (um) are

.. math:: m = 0.152\,R_q^{0.4},\quad m = 0.124\,R_q^{0.743},\quad m = 0.076\,R_q^{0.52}

(C. J. Tanner, M. Fahoum, Wear 36 (1976) 299; V. W. Antonetti, T. D. Whittle, R. E. Simons, ASME HTD 170 (1991) 35;
M. A. Lambert, L. S. Fletcher, J. Thermophys. Heat Transfer 11 (1997) 129; as collected by M. Bahrami et al., Appl.
Mech. Rev. 59 (2006) 1; not checked against the three papers). The curvature follows the slope as on traces after a
short cut-off of 2.5 um.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

import numpy as np

from profiles import InputError
from profiles.units import length
from roughness.asperities import mccool_asperities
from roughness.moments import Moments

SLOPES = ((0.152, 0.4), (0.124, 0.743), (0.076, 0.52))
"""Source. Factor and exponent of the mean slope over Rq (um); Bahrami et al. 2006, table 1."""
CURVATURE = (0.33, 0.75, 1.7)
"""Judgement. Lowest, middle (their geometric mean) and highest m4/m2 (1/um2); eleven traces after 2.5 um have 0.33 to
1.5."""
CORRELATED = 1.6e-6
"""Source. Largest Rq (m) of the correlation of Antonetti et al.; Bahrami et al. 2006, table 1."""
RANGE = (0.02e-6, 10e-6)
"""Judgement. Range of Rq (m) in which the assumption is meant: polished to coarsely turned."""
PER_RQ = {"Ra": (1.11, math.sqrt(math.pi / 2.0), 1.4), "Rq": (1.0, 1.0, 1.0), "Rz": (1 / 7.0, 1 / 5.0, 1 / 3.4)}
"""Judgement. Lowest, middle and highest Rq over the known number: of Gaussian heights in the middle; finishes from
turned to plateau-honed have Rq/Ra 1.11 to 1.4 and Rz/Rq 3.4 to 7."""
LEAST_NAYAK = 1.5
"""Source. Least m0 m4/m2^2 of an isotropic Gaussian surface; Nayak 1971."""
_WRITTEN = re.compile(r"(R[aqz]):(.*)\Z")


@dataclass(frozen=True)
class AssumedMoments:
    """Moments (SI), the changes of their logarithms at the ends of their bands by doubt, and the assumption."""

    m0: float
    m2: float
    m4: float
    axes: tuple[dict[str, float], ...]
    words: str

    def ends(self, name: str) -> tuple[float, float]:
        """Ends of the band of a moment, all doubts together."""
        reach = math.sqrt(sum(axis.get(name, 0.0) ** 2 for axis in self.axes))
        value = float(getattr(self, name))
        return value * math.exp(-reach), value * math.exp(reach)


def one_number(text: str) -> tuple[str, float] | None:
    """Name and value (m) of a text as ``Ra:0.4um``; None for any other text.

    >>> one_number("Ra:0.4um"), one_number("ground.txt")
    (('Ra', 4e-07), None)
    """
    match = _WRITTEN.match(text)
    if match is None:
        return None
    return match[1], length(match[2].strip(), text)


def assumed_moments(name: str, value: float) -> AssumedMoments:
    """Moments of a surface by Ra, Rq or Rz (m), and their bands; the band of Rq moves all three moments at once.

    >>> found = assumed_moments("Rq", 0.4e-6)
    >>> round(found.m0 * 1e12, 3), round(found.m2, 4), [round(end, 4) for end in found.ends("m2")]
    (0.16, 0.0072, [0.0015, 0.036])
    """
    if name not in PER_RQ:
        raise InputError("is Ra, Rq or Rz", where="known number", value=name)
    low, middle, high = (value * ratio for ratio in PER_RQ[name])
    if not RANGE[0] <= middle <= RANGE[1]:
        rule = f"moments are assumed for Rq from {RANGE[0] * 1e6:g} to {RANGE[1] * 1e6:g} um; measure a trace"
        raise InputError(rule, where=f"{name} (um)", value=round(value * 1e6, 9))
    slopes = [math.sqrt(math.pi / 2.0) * factor * (middle * 1e6) ** exponent for factor, exponent in SLOPES]
    m2 = float(np.exp(np.mean(np.log(slopes)))) ** 2
    m0, m4 = middle**2, CURVATURE[1] * m2 * 1e12
    raised = max(1.0, 1.02 * LEAST_NAYAK * m2**2 / (m0 * m4))
    rough = math.log(high / low)
    exponent = float(np.mean([exponent for _, exponent in SLOPES]))
    # machined surfaces lie as far off the middle as the three correlations lie apart
    slope = 2.0 * math.log(max(slopes) / min(slopes))
    bent = 0.5 * math.log(CURVATURE[2] / CURVATURE[0])
    axes = (
        {"m0": rough, "m2": exponent * rough, "m4": exponent * rough},
        {"m2": slope, "m4": slope},
        {"m4": bent},
    )
    words = (
        f"only {name} {value * 1e6:.4g} um is known: Gaussian heights with Rq {middle * 1e6:.4g} um, a slope as on "
        "machined surfaces of that roughness (three published correlations), and a curvature as traces have it at a "
        "short cut-off of 2.5 um are assumed"
    )
    if middle > CORRELATED:
        words += f"; Rq lies above {CORRELATED * 1e6:g} um, beyond the range of one of the three correlations"
    if raised > 1.0:
        words += "; the curvature is raised to the least of a Gaussian surface"
    return AssumedMoments(m0, m2, m4 * raised, tuple(axis for axis in axes if any(axis.values())), words)


def assumed_record(name: str, value: float) -> dict[str, object]:
    """Row of ``profile.json`` of a surface by one number: moments and asperities with the ends of their bands."""
    found = assumed_moments(name, value)
    own = Moments(found.m0, found.m2, found.m4, short_cutoff=2.5e-6, estimator="assumed")
    a = mccool_asperities(own)
    ends = {key: found.ends(key) for key in ("m0", "m2", "m4")}
    scale = {"m0": ("m0_um2", 1e12), "m2": ("m2", 1.0), "m4": ("m4_per_um2", 1e-12)}
    band = {label: [end * size for end in ends[key]] for key, (label, size) in scale.items()}
    rq = math.sqrt(found.m0)
    return {
        "assumption": found.words,
        "assumed": {"Ra_um": rq * 1e6 / PER_RQ["Ra"][1], "Rq_um": rq * 1e6, "Rz_um": rq * 1e6 / PER_RQ["Rz"][1]},
        "moments": {
            "m0_um2": found.m0 * 1e12,
            "m2": found.m2,
            "m4_per_um2": found.m4 * 1e-12,
            "short_cutoff_um": 2.5,
            "band": band,
        },
        "asperities": {
            "density_per_mm2": a.density * 1e-6,
            "radius_um": a.radius * 1e6,
            "sigma_um": a.sigma * 1e6,
            "nayak": a.nayak,
        },
        "warnings": [found.words],
    }
