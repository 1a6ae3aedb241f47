"""Tables of parts and flanks, common to stages of gear pairs and planetary stages."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from mixedlub.chain.part_law import GIVES, Kind
from mixedlub.parts import of_kind
from mixedlub.schema.section import Number, Section, Whole, key
from mixedlub.schema.surface_file import SurfaceSection

Side = Literal["pinion", "gear"]
SIDES = {"pinion": "first entry of [gears]", "gear": "second entry"}
Positive = Annotated[Number, Field(gt=0.0)]
NotNegative = Annotated[Number, Field(ge=0.0)]


def law_key(kind: Kind, example: str) -> Any:
    names = ", ".join(of_kind(kind))
    return key(f"law of its {GIVES[kind]} ({names}); `mixedlub parts LAW` shows its page", example=example)


class Part(Section):
    """Keys of every part."""

    law: str = key("law", example="palmgren")
    coefficients: dict[str, Number] = key("NAME = VALUE: coefficients of the law, by the names of its page", {})
    factor: NotNegative = key("factor on its loss, as for walls and deflectors of a housing", 1.0)
    count: Whole = key("how many of it there are", 1, ge=1, le=1000)


class RollingBearing(Part):
    """Rolling bearing by its sizes and additional loads."""

    law: str = law_key("bearing", "skf_deep_groove")
    series: str | None = key("series of SKF's tables, or type of Palmgren's; or coefficients", None, example="62")
    bore_mm: Positive = key("bore", example=35.0)
    outside_diameter_mm: Positive = key("outside diameter", example=72.0)
    static_rating_N: Positive | None = key("static load rating C0; only laws that read it", None, example=15300.0)
    radial_load_N: NotNegative = key("radial load besides", 0.0)
    axial_load_N: NotNegative = key("axial load besides, as of preload", 0.0)

    @model_validator(mode="after")
    def _ring(self) -> RollingBearing:
        if self.outside_diameter_mm <= self.bore_mm:
            raise ValueError(f"outside_diameter_mm {self.outside_diameter_mm:g} must be above bore_mm {self.bore_mm:g}")
        return self


class Bearing(RollingBearing):
    """Rolling bearing, with its position on the shaft or its shares of the forces."""

    shaft: Side = key("the shaft that it carries", example="pinion", values=SIDES)
    position_mm: Number | None = key(
        "position along the shaft from the middle of its wheel, counted to the same side on all shafts; loads then "
        "follow from the balance of two bearings, in place of shares",
        None,
        example=-25.0,
        alternative=True,
    )
    axial: Literal["fixed", "loose", "positive", "negative"] | None = key(
        "with positions: axial force that it takes; without position_mm it carries thrust alone",
        None,
        values={
            "fixed": "in both directions",
            "loose": "none, as where it is left out",
            "positive": "a force towards growing positions",
            "negative": "a force towards falling positions",
        },
        alternative=True,
    )
    radial_share: NotNegative = key("share of the mesh force that it carries; adds up to 1 over the shaft", 0.5)
    axial_share: NotNegative = key(
        "share of the axial force of a helical mesh that it carries; adds up to 1 over the shaft", 0.0
    )


class Seal(Part):
    law: str = law_key("seal", "iso_tr_14179_2")
    shaft: Side = key("the shaft that it seals", example="pinion", values=SIDES)
    series: str | None = key("type of bearing whose seals they are; only skf_bearing_seals", None)
    diameter_mm: Positive = key("diameter of the shaft at the lip", example=35.0)


class Windage(Part):
    law: str = law_key("windage", "diab")
    wheel: Side = key("the wheel", example="gear", values=SIDES)


class Churning(Part):
    law: str = law_key("churning", "changenet_velex")
    wheel: Side = key("the wheel that dips into oil", example="gear", values=SIDES)
    immersion_mm: Positive | None = key("depth below the oil level; only laws that read it", None, example=20.0)
    oil_volume_l: Positive | None = key("volume of the oil; only laws that read it", None, example=2.0, unit="l")


class Pocketing(Part):
    law: str = law_key("pocketing", "incompressible")
    exit_area_mm2: Positive = key("area through which a tooth space is emptied", example=40.0, unit="mm²")


class Jet(Part):
    law: str = law_key("jet", "ariura")
    wheel: Side = key("the wheel that the jet meets", example="pinion", values=SIDES)
    oil_flow_l_min: Positive = key("oil that meets the teeth", example=2.5, unit="l/min")
    jet_speed_m_s: NotNegative = key("speed of the jet", 0.0)


class Other(Part):
    law: str = law_key("other", "own_torque")
    shaft: Side = key("the shaft that it brakes", example="pinion", values=SIDES)


class Flanks(Section):
    pinion: SurfaceSection = key("surface of the pinion")
    gear: SurfaceSection = key("surface of the gear")
