"""The concealed effects by name: those the catalogue should name, and those outside any catalogue.

Sources say where a form comes from. Constants that a docstring does not call published are usual sizes,
chosen so that a strength of about 1 is what such a rig could show.
"""

from __future__ import annotations

from mixedlub.proof.concealed import boundary, contact, film, load, loss, measurement, oil, outside, shear
from mixedlub.proof.concealed.kinds import Concealed, Knob

_ROOMS = (film, shear, contact, boundary, load, loss, oil, measurement)

NAMED: dict[str, Concealed] = {effect.id: effect for room in _ROOMS for effect in room.EFFECTS}
OUTSIDE: dict[str, Concealed] = {effect.id: effect for effect in outside.EFFECTS}
MIMICS = outside.MIMICS
MEASUREMENT = frozenset(effect.id for effect in measurement.EFFECTS) | {
    "fringe_order",
    "fringe_step",
    "torque_constant",
    "zero_drift",
}

__all__ = ["MEASUREMENT", "MIMICS", "NAMED", "OUTSIDE", "Concealed", "Knob"]
