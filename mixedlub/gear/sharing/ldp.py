"""Load shared by elastic teeth; `mixedlub.gear.distribution` solves it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from mixedlub.gear.distribution import LdpSharing
from mixedlub.gear.sharing.model import SharingModel
from mixedlub.schema.section import Number, Section, key


class Keys(Section):
    tip_relief_um: tuple[Number, Number] = key('model "ldp": tip relief', (0.0, 0.0), example=[15, 15])
    relief_length_mm: tuple[Number, Number] = key(
        'model "ldp": length of the relief along the profile', (0.0, 0.0), example=[2, 2]
    )
    lead_crown_um: Number = key('model "ldp": crown over the face, both flanks together', 0.0, example=3.0)
    misalignment_um: Number = key('model "ldp": misalignment over the face width', 0.0)


def elastic(section: Any, folder: Path) -> LdpSharing:
    """The sharing of elastic teeth with the modifications that a file states."""
    return LdpSharing(
        tip_relief=(section.tip_relief_um[0] * 1e-6, section.tip_relief_um[1] * 1e-6),
        relief_length=(section.relief_length_mm[0] * 1e-3, section.relief_length_mm[1] * 1e-3),
        lead_crown=section.lead_crown_um * 1e-6,
        misalignment=section.misalignment_um * 1e-6,
    )


MODEL = SharingModel(name="ldp", meaning="elastic teeth", build=elastic, keys=Keys)
