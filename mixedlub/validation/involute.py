"""Spur-gear kinematics along the line of action, from the involute itself."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from profiles.errors import InputError


@dataclass(frozen=True)
class Gears:
    """A spur pair in the transverse plane; lengths in m, pinion first.

    ``tip`` are tip radii; ``centre`` the operating centre distance, from the shifts if None.
    """

    teeth: tuple[int, int]
    module: float
    pressure_angle: float
    tip: tuple[float, float]
    face_width: float
    shift: tuple[float, float] = (0.0, 0.0)
    centre: float | None = None


def involute(angle: float) -> float:
    """Involute function tan(a) - a.

    >>> round(involute(np.radians(20.0)), 6)
    0.014904
    """
    return float(np.tan(angle) - angle)


def operating_angle(gears: Gears) -> float:
    """Working pressure angle (rad): inv(a_w) = inv(a) + 2 tan(a)(x1 + x2)/(z1 + z2), or from the centre."""
    from scipy.optimize import brentq

    z1, z2 = gears.teeth
    if gears.centre is not None:
        return float(np.arccos(0.5 * gears.module * (z1 + z2) * np.cos(gears.pressure_angle) / gears.centre))
    target = involute(gears.pressure_angle) + 2 * np.tan(gears.pressure_angle) * sum(gears.shift) / (z1 + z2)
    return float(brentq(lambda angle: involute(angle) - target, 1e-3, 1.2, xtol=1e-14))


@dataclass(frozen=True)
class ContactPath:
    """The path of contact: distances (m) from the pinion's base tangent point, base radii, base pitch."""

    start: float
    low_single: float
    pitch: float
    high_single: float
    end: float
    tangent_length: float
    base_radius: tuple[float, float]
    base_pitch: float

    @property
    def contact_ratio(self) -> float:
        return (self.end - self.start) / self.base_pitch


def path_of_contact(gears: Gears) -> ContactPath:
    """Start, single-contact limits, pitch point and end of the path, by intersecting the tip circles.

    Valid for contact ratios between 1 and 2. FZG type C gears have a contact ratio of 1.4375.

    >>> fzg = Gears((16, 24), 4.5e-3, np.radians(20.0), (41.23e-3, 59.18e-3), 14e-3, centre=91.5e-3)
    >>> round(path_of_contact(fzg).contact_ratio, 3)
    1.438
    """
    working = operating_angle(gears)
    base = tuple(0.5 * gears.module * z * np.cos(gears.pressure_angle) for z in gears.teeth)
    length = (base[0] + base[1]) * np.tan(working)
    start = length - np.sqrt(gears.tip[1] ** 2 - base[1] ** 2)
    end = np.sqrt(gears.tip[0] ** 2 - base[0] ** 2)
    pitch = np.pi * gears.module * np.cos(gears.pressure_angle)
    if not (start > 0 and end < length and pitch < end - start < 2 * pitch):
        raise InputError(
            "the path of contact must lie between the base tangent points, with contact ratio 1 to 2",
            where="gears",
            value=round(float((end - start) / pitch), 3),
        )
    return ContactPath(
        start=float(start),
        low_single=float(end - pitch),
        pitch=float(base[0] * np.tan(working)),
        high_single=float(start + pitch),
        end=float(end),
        tangent_length=float(length),
        base_radius=(float(base[0]), float(base[1])),
        base_pitch=float(pitch),
    )
