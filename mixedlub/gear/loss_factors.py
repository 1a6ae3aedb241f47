"""Tooth loss factors: lost power over mesh friction and input power, P = mu_m H_V P_a.

Closed factors follow from the data sheet; the local factor weights the sliding speed with the local load.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mixedlub.gear.geometry import GearPair
from mixedlub.gear.mesh import Mesh


@dataclass(frozen=True)
class LossFactor:
    """A closed loss factor: its value and, for a pair outside it, the valid range."""

    name: str
    value: float
    outside: str = ""


def local_loss_factor(mesh: Mesh, torque: object) -> np.ndarray:
    r"""Loss factor of the local load, H_VL; shape of ``torque`` (N m, on the pinion).

    H_VL = 1/t INT INT (f_N/F_tb) (v_g/v_tb) dy dt over the path of contact of one tooth pair, with f_N the normal force
    per face width, v_g the sliding speed, F_tb = T1/r_b1 and v_tb = omega1 r_b1. The time t is the time of one base
    pitch, so that P = mu H_VL P_a; with the time of engagement the loss would be low by the contact ratio.

    Source: Wimmer 2006, as equation 2 of "Measurement and Modelling of Friction for Cylindrical Gears with Pitch Line
    Velocities up to 100 m/s".

    >>> from mixedlub.gear.mesh import mesh
    >>> from mixedlub.gear.sharing.rigid import RigidSharing
    >>> fzg = GearPair((16, 24), 4.5e-3, math.radians(20), 14e-3, 0.0, (0.1817, 0.1715), (41.23e-3, 59.18e-3), 91.5e-3)
    >>> print(round(float(local_loss_factor(mesh(fzg, RigidSharing()), 100.0)), 4))
    0.195
    """
    carried = mesh.load_share(torque) * mesh.weight * np.abs(mesh.sliding_per_speed)
    return carried.sum(axis=-1) / mesh.pair.base_radius[0]


def _scale(pair: GearPair) -> float:
    """pi (1/z_1 + 1/z_2), z_2 negative for a ring gear."""
    return math.pi * (1 / pair.teeth[0] + 1 / pair.teeth[1])


def _square_mean(pair: GearPair) -> float:
    return (pair.approach_ratio**2 + pair.recess_ratio**2) / pair.contact_ratio


def ohlendorf(pair: GearPair) -> float:
    """Loss factor of rigid teeth, `GearPair.loss_factor`; contact ratios from 1 to 2.

    Exact for spur teeth with equal sharing. Source: Ohlendorf 1958; the same in Niemann and Winter,
    Maschinenelemente II.
    """
    return pair.loss_factor


def buckingham(pair: GearPair) -> float:
    r"""H_V = pi (1/z_1 + 1/z_2) (eps_1^2 + eps_2^2)/eps_alpha: the plain mean of the sliding speed over the path.

    Source: Buckingham 1949, Analytical Mechanics of Gears, his efficiency in arcs of approach and recess.
    """
    return _scale(pair) * _square_mean(pair)


def iso_tr_14179_1(pair: GearPair) -> float:
    r"""H_V = cos^2(beta)/M, M = 2 cos(alpha_wt) (H_s + H_t)/(H_s^2 + H_t^2).

    H_s = (u+1) [sqrt(r_a2^2/r_w2^2 - cos^2 alpha_wt) - sin alpha_wt] at the start of contact, H_t at its end the same
    of the pinion with (u+1)/u. For spur gears this is Buckingham's factor. Source: ISO/TR 14179-1, mesh losses, where
    P = f_m T_1 n_1 cos^2(beta)/(9549 M).
    """
    cosine, sine = math.cos(pair.working_pressure_angle), math.sin(pair.working_pressure_angle)
    first, second = (tip / rolling for tip, rolling in zip(pair.tip_radii, pair.operating_radius, strict=True))
    start = (pair.teeth_ratio + 1) * (math.sqrt(second**2 - cosine**2) - sine)
    end = (pair.teeth_ratio + 1) / pair.teeth_ratio * (math.sqrt(first**2 - cosine**2) - sine)
    advantage = 2 * cosine * (start + end) / (start**2 + end**2)
    return math.cos(pair.helix_angle) ** 2 / advantage


def iso_tr_15144_1(pair: GearPair) -> float:
    r"""Ohlendorf's factor below a contact ratio of 2; from there H_V = 0.5 eps_alpha pi (1/z_1 + 1/z_2)/cos(beta_b).

    Source: ISO/TR 15144-1, bulk temperature.
    """
    if pair.contact_ratio < 2:
        return ohlendorf(pair)
    return 0.5 * pair.contact_ratio * _scale(pair) / math.cos(pair.base_helix_angle)


CLOSED: dict[str, tuple[Callable[[GearPair], float], tuple[float, float]]] = {
    "ohlendorf": (ohlendorf, (1.0, 2.0)),
    "niemann_winter": (ohlendorf, (1.0, 2.0)),
    "buckingham": (buckingham, (0.0, math.inf)),
    "iso_tr_14179_1": (iso_tr_14179_1, (0.0, math.inf)),
    "iso_tr_15144_1": (iso_tr_15144_1, (1.0, math.inf)),
}
"""Closed loss factors by name, each with the contact ratios for which it holds."""


def loss_factors(pair: GearPair) -> tuple[LossFactor, ...]:
    """All closed loss factors of a pair, marked if its contact ratio lies outside their range.

    >>> fzg = GearPair((16, 24), 4.5e-3, math.radians(20), 14e-3, 0.0, (0.1817, 0.1715), (41.23e-3, 59.18e-3), 91.5e-3)
    >>> print({factor.name: round(factor.value, 3) for factor in loss_factors(fzg)}["buckingham"])
    0.235
    """
    found = []
    for name, (law, (low, high)) in CLOSED.items():
        inside = low <= pair.contact_ratio <= high
        text = "" if inside else f"holds for contact ratios from {low:g} to {high:g}, not {pair.contact_ratio:.4g}"
        if law is buckingham and pair.helix_angle != 0:
            text = "holds for spur gears"
        found.append(LossFactor(name, law(pair), text))
    return tuple(found)
