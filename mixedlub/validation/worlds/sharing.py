"""Load sharing between the tooth pairs of spur gears, by other rules than the table of the case."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mixedlub.validation.contact import Contact
from mixedlub.validation.rig import SHARING, Law

Share = Callable[[np.ndarray, float], np.ndarray]
"""Share of one pair at a place of the path (in base pitches from its start), at a contact ratio between 1 and 2."""


def _alone(place: np.ndarray, ratio: float) -> np.ndarray:
    return np.asarray((place > ratio - 1) & (place < 1))


def equal(place: np.ndarray, ratio: float) -> np.ndarray:
    """Half for each of two pairs in contact: rigid teeth."""
    return np.where(_alone(place, ratio), 1.0, 0.5)


def trapezoid(place: np.ndarray, ratio: float) -> np.ndarray:
    """A third at the ends, rising to two thirds up to single contact (ISO/TR 15144-1, after Niemann).

    >>> [round(float(trapezoid(np.array(x), 1.5)), 3) for x in (0.0, 0.25, 0.75, 1.25)]
    [0.333, 0.5, 1.0, 0.5]
    """
    inside = np.minimum(place, ratio - place) / (ratio - 1)
    return np.where(_alone(place, ratio), 1.0, (1 + np.clip(inside, 0.0, 1.0)) / 3)


def by_iso_6336(place: np.ndarray, ratio: float) -> np.ndarray:
    """Shares as the stiffnesses of both pairs, from ISO 6336-1's c' and mesh stiffness c' (0.75 ratio + 0.25).

    The stiffness of a pair is c' in the middle of its path and falls as a parabola; the mean gives the mesh stiffness.
    The standard prints no shape. Independent of the torque: no Hertz flattening, no errors of the teeth.
    """

    def stiffness(x: np.ndarray) -> np.ndarray:
        return np.asarray(1 - 0.75 * (1 - 1 / ratio) * (2 * x / ratio - 1) ** 2)

    own = stiffness(place)
    other = stiffness(np.where(place < ratio - 1, place + 1, place - 1))
    return np.where(_alone(place, ratio), 1.0, own / (own + other))


def _law(name: str, source: str, share: Share) -> Law:
    def enter(c: Contact) -> Contact:
        whole = c.rig.conditions["torque_Nm"].astype(float)[:, None] / c.rig.extras["base_radius"]
        force = whole * share(c.rig.phase, c.rig.extras["contact_ratio"])
        return replace(c, force=force, line_load=force / c.rig.width)

    return Law(SHARING, name, source, enter)


EVERY = (
    _law("equal", "rigid teeth", equal),
    _law("trapezoid of thirds", "ISO/TR 15144-1", trapezoid),
    _law("stiffness of ISO 6336", "ISO 6336-1", by_iso_6336),
)
