"""Load shared by elastic teeth; `mixedlub.gear.distribution` solves it."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal

from mixedlub.gear.distribution import LdpSharing
from mixedlub.gear.sharing.model import SharingModel
from mixedlub.schema.section import Number, Section, key

Pair = tuple[Number, Number]
End = Literal["none", "front", "back"]
NONE = (0.0, 0.0)


class Keys(Section):
    tip_relief_um: Pair = key('model "ldp": tip relief', NONE, example=[15, 15])
    relief_length_mm: Pair = key('model "ldp": length of the relief along the profile', NONE, example=[2, 2])
    lead_crown_um: Number = key('model "ldp": crown over the face, both flanks together', 0.0, example=3.0)
    misalignment_um: Number = key(
        'model "ldp": misalignment over the face width, with the slope deviations of the leads', 0.0
    )
    root_relief_um: Pair = key('model "ldp": root relief', NONE)
    root_relief_length_mm: Pair = key(
        'model "ldp": its length along the profile, from where the tip of the mate reaches', NONE
    )
    relief_form: Literal["linear", "parabolic"] = key(
        'model "ldp": form of all reliefs',
        "linear",
        values={"linear": "grows evenly from its start", "parabolic": "grows with the square, without a kink"},
    )
    end_relief_um: Pair = key('model "ldp": end relief at the front and the back of the face, both flanks', NONE)
    end_relief_length_mm: Pair = key('model "ldp": its lengths over the face', NONE)
    profile_slope_deviation_um: Pair = key(
        'model "ldp": profile slope deviation of pinion and gear; above 0, material lacks at the tip', NONE
    )
    lead_deviation_um: tuple[Number, ...] = key(
        'model "ldp": gap over the face at equal steps from front to back, as of bent shafts', (), example=[0, 8, 0]
    )
    torque_end: tuple[End, End] = key(
        'model "ldp": end of the face at which torque enters pinion and gear, so that they twist: "front" (where face '
        'positions begin) or "back"; "none": a body that does not twist',
        ("none", "none"),
        example=["front", "none"],
    )
    body_diameter_mm: Pair | None = key(
        'model "ldp": diameters of the solid bodies that twist; left out: midway from reference to root circle',
        None,
        example=[64.0, 102.0],
    )
    foundation: Literal["weber", "sainsot"] = key(
        'model "ldp": what the teeth stand on',
        "weber",
        example="sainsot",
        values={"weber": "a half plane", "sainsot": "a ring, which needs the bores; about a fifth softer"},
    )
    bore_diameter_mm: Pair | None = key('model "ldp": bores of the ring', None, example=[30.0, 30.0])


def elastic(section: Any, folder: Path) -> LdpSharing:
    """The sharing of elastic teeth with the modifications that a file states."""
    bore, body = section.bore_diameter_mm, section.body_diameter_mm
    return LdpSharing(
        tip_relief=_pair(section.tip_relief_um, 1e-6),
        relief_length=_pair(section.relief_length_mm, 1e-3),
        root_relief=_pair(section.root_relief_um, 1e-6),
        root_relief_length=_pair(section.root_relief_length_mm, 1e-3),
        relief_form=section.relief_form,
        lead_crown=section.lead_crown_um * 1e-6,
        misalignment=section.misalignment_um * 1e-6,
        end_relief=_pair(section.end_relief_um, 1e-6),
        end_relief_length=_pair(section.end_relief_length_mm, 1e-3),
        profile_slope_deviation=_pair(section.profile_slope_deviation_um, 1e-6),
        lead_deviation=tuple(value * 1e-6 for value in section.lead_deviation_um),
        torque_end=section.torque_end,
        body_radius=None if body is None else _pair(body, 0.5e-3),
        foundation=section.foundation,
        bore_radius=None if bore is None else _pair(bore, 0.5e-3),
    )


def _pair(values: tuple[float, float], unit: float) -> tuple[float, float]:
    return values[0] * unit, values[1] * unit


MODEL = SharingModel(name="ldp", meaning="elastic teeth", build=elastic, keys=Keys)
