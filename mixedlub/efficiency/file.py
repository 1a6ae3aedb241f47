"""Format of a file of `mixedlub efficiency`: one class per table."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from mixedlub.chain.part_law import GIVES, Kind
from mixedlub.parts import of_kind
from mixedlub.schema.section import Number, NumberOrName, Section, Whole, key
from mixedlub.schema.surface_file import SurfaceSection
from mixedlub.schema.system_file import Gears, Lubricant
from mixedlub.study.schema import Numbers, Options, each_once

Side = Literal["pinion", "gear"]
SIDES = {"pinion": "first entry of [gears]", "gear": "second entry"}
Positive = Annotated[Number, Field(gt=0.0)]
MOST_CONDITIONS = 250_000
"""Largest number of torques times speeds of a map."""
NotNegative = Annotated[Number, Field(ge=0.0)]


def _law(kind: Kind, example: str) -> Any:
    names = ", ".join(of_kind(kind))
    return key(f"law of its {GIVES[kind]} ({names}); `mixedlub parts LAW` shows its page", example=example)


class Part(Section):
    """Keys of every part."""

    law: str = key("law", example="palmgren")
    coefficients: dict[str, Number] = key("NAME = VALUE: coefficients of the law, by the names of its page", {})
    factor: NotNegative = key("factor on its loss, as for walls and deflectors of a housing", 1.0)
    count: Whole = key("how many of it there are", 1, ge=1, le=1000)


class Bearing(Part):
    """Rolling bearing, with its position on the shaft or its shares of the forces."""

    law: str = _law("bearing", "skf_deep_groove")
    shaft: Side = key("the shaft that it carries", example="pinion", values=SIDES)
    series: str | None = key("series of SKF's tables, or type of Palmgren's; or coefficients", None, example="62")
    bore_mm: Positive = key("bore", example=35.0)
    outside_diameter_mm: Positive = key("outside diameter", example=72.0)
    static_rating_N: Positive | None = key("static load rating C0; only laws that read it", None, example=15300.0)
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
    radial_load_N: NotNegative = key("radial load besides", 0.0)
    axial_load_N: NotNegative = key("axial load besides, as of preload", 0.0)

    @model_validator(mode="after")
    def _ring(self) -> Bearing:
        if self.outside_diameter_mm <= self.bore_mm:
            raise ValueError(f"outside_diameter_mm {self.outside_diameter_mm:g} must be above bore_mm {self.bore_mm:g}")
        return self


class Seal(Part):
    law: str = _law("seal", "iso_tr_14179_2")
    shaft: Side = key("the shaft that it seals", example="pinion", values=SIDES)
    series: str | None = key("type of bearing whose seals they are; only skf_bearing_seals", None)
    diameter_mm: Positive = key("diameter of the shaft at the lip", example=35.0)


class Windage(Part):
    law: str = _law("windage", "diab")
    wheel: Side = key("the wheel", example="gear", values=SIDES)


class Churning(Part):
    law: str = _law("churning", "changenet_velex")
    wheel: Side = key("the wheel that dips into oil", example="gear", values=SIDES)
    immersion_mm: Positive | None = key("depth below the oil level; only laws that read it", None, example=20.0)
    oil_volume_l: Positive | None = key("volume of the oil; only laws that read it", None, example=2.0, unit="l")


class Pocketing(Part):
    law: str = _law("pocketing", "incompressible")
    exit_area_mm2: Positive = key("area through which a tooth space is emptied", example=40.0, unit="mm²")


class Jet(Part):
    law: str = _law("jet", "ariura")
    wheel: Side = key("the wheel that the jet meets", example="pinion", values=SIDES)
    oil_flow_l_min: Positive = key("oil that meets the teeth", example=2.5, unit="l/min")
    jet_speed_m_s: NotNegative = key("speed of the jet", 0.0)


class Other(Part):
    law: str = _law("other", "own_torque")
    shaft: Side = key("the shaft that it brakes", example="pinion", values=SIDES)


class SharedShaft(Section):
    """Second wheel on a shaft common to two stages."""

    distance_mm: Number = key(
        "from the middle of the driven wheel of the stage before to the middle of the driving wheel of this one",
        example=60.0,
    )
    angle_deg: Number = key(
        "from the mate of the stage before to the mate of this one, seen from the shaft, in its sense of rotation",
        180.0,
    )


class Flanks(Section):
    pinion: SurfaceSection = key("surface of the pinion")
    gear: SurfaceSection = key("surface of the gear")


class Stage(Section):
    """Gear pair with oil, surfaces and other parts."""

    driving: Side = key("the side that drives", "pinion", values=SIDES)
    oil_temperature_C: Number = key("temperature of its oil", example=80.0)
    boundary_friction: Number = key("friction coefficient of touching asperities", 0.1)
    gears: Gears = key("two entries: pinion, gear")
    lubricant: Lubricant | None = key("what is left out is typical of the base stock, and a note says so", None)
    surfaces: Flanks = key("surfaces of both flanks")
    options: Options = key("laws of the mesh, as in a study", Options())
    effects: dict[str, dict[str, NumberOrName]] = key(
        "EFFECT = { PARAMETER = VALUE }: physics of the mesh beyond the base model, as in a study; losses outside the "
        "mesh are the tables below",
        {},
        example={"rolling_resistance": {"law": "Biboulet and Houpert"}},
    )
    pinion_thrust: Literal["positive", "negative"] | None = key(
        "side to which the axial force on the pinion points, along position_mm; only of helical gears with positions",
        None,
        values={"positive": "towards growing positions", "negative": "towards falling positions"},
        alternative=True,
    )
    shared_shaft: SharedShaft | None = key(
        "its driving wheel on the shaft of the driven wheel of the stage before; only with positions", None
    )
    bearings: dict[str, Bearing] = key("one table a bearing, by a name of your own", {})
    seals: dict[str, Seal] = key("one table a seal", {})
    windage: dict[str, Windage] = key("one table a wheel in air", {})
    churning: dict[str, Churning] = key("one table a wheel in oil", {})
    pocketing: dict[str, Pocketing] = key("squeezing of oil and air out of the tooth spaces", {})
    jets: dict[str, Jet] = key("one table a jet of oil", {})
    others: dict[str, Other] = key("pumps, clutches and other parts with a torque of your own", {})


class Conditions(Section):
    torque_Nm: Numbers = key("torques at the input, from 0", example={"from": 0, "to": 200, "count": 9})
    speed_rpm: Numbers = key("speeds of the input", example={"from": 500, "to": 4000, "count": 8})

    @model_validator(mode="after")
    def _turning(self) -> Conditions:
        check_conditions(self.torque_Nm, self.speed_rpm)
        each_once(self.torque_Nm)
        each_once(self.speed_rpm)
        if (count := len(self.torque_Nm) * len(self.speed_rpm)) > MOST_CONDITIONS:
            raise ValueError(f"a map has at most {MOST_CONDITIONS} conditions, not {count}")
        return self


class Duty(Section):
    """Time at operating points; entries of the three lists correspond."""

    torque_Nm: tuple[Number, ...] = key("torques at the input", example=[150, 60, 0], min_length=1)
    speed_rpm: tuple[Number, ...] = key("speeds of the input", example=[1000, 3000, 3500], min_length=1)
    duration_h: tuple[NotNegative, ...] = key("hours", example=[10, 200, 40], min_length=1)

    @model_validator(mode="after")
    def _together(self) -> Duty:
        counts = [len(self.torque_Nm), len(self.speed_rpm), len(self.duration_h)]
        if len(set(counts)) > 1:
            raise ValueError(f"the three lists go together, but have {counts[0]}, {counts[1]} and {counts[2]} entries")
        check_conditions(self.torque_Nm, self.speed_rpm)
        return self


class Cycle(Section):
    """Condition of the mesh cycle and of the breakdown."""

    torque_Nm: Positive | None = key("torque at the input; left out: the largest of the map", None, example=200.0)
    speed_rpm: Positive | None = key("speed of the input; left out: the largest of the map", None, example=4000.0)
    positions: Whole = key("positions over a base pitch", 64, ge=4, le=10_000)


class EfficiencyFile(Section):
    """Gear stages in series, map of conditions, and duty cycle."""

    schema_: Literal["mixedlub-efficiency/1"] = key(
        "format of the file", example="mixedlub-efficiency/1", alias="schema"
    )
    title: str = key("title of the figures", "Gearbox", example="Two-stage gearbox")
    conditions: Conditions = key(
        "the map: every torque at every speed; each a list, or { from = LOW, to = HIGH, count = N }"
    )
    cycle: Cycle = key("the condition of the mesh cycle and of the breakdown", Cycle())
    duty: Duty | None = key("operating points with hours: energy and mean efficiency", None)
    stages: dict[str, Stage] = key("one table a stage, in the order of the power", min_length=1)

    @model_validator(mode="after")
    def _loaded_cycle(self) -> EfficiencyFile:
        if self.cycle.torque_Nm is None and max(self.conditions.torque_Nm) == 0.0:
            raise ValueError("all torques of the map are 0, at which no efficiency exists: give cycle.torque_Nm")
        return self


def check_conditions(torque: tuple[float, ...], speed: tuple[float, ...]) -> None:
    """Raise an error for negative torques and shafts at rest."""
    if min(torque) < 0.0:
        rule = f"torque_Nm: {min(torque):g} is below 0; name the side that drives with `driving` of the stage"
        raise ValueError(rule)
    if min(speed) <= 0.0:
        raise ValueError(f"speed_rpm: {min(speed):g}; a shaft at rest has no loss and no efficiency: above 0")
