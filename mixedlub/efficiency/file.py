"""Format of a file of `mixedlub efficiency`: one class per table."""

from __future__ import annotations

from typing import Literal

from pydantic import model_validator

from mixedlub.efficiency.part_tables import (
    SIDES,
    Bearing,
    Churning,
    Flanks,
    Jet,
    NotNegative,
    Other,
    Pocketing,
    Positive,
    Seal,
    Side,
    Windage,
)
from mixedlub.efficiency.planetary_file import PlanetaryStage
from mixedlub.efficiency.thermal_file import Thermal
from mixedlub.schema.lubricant_section import Lubricant
from mixedlub.schema.section import Number, NumberOrName, Section, Whole, key
from mixedlub.schema.system_file import Gears
from mixedlub.study.schema import Numbers, Options, each_once

MOST_CONDITIONS = 250_000
"""Largest number of torques times speeds of a map."""


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
    torque_Nm: Numbers = key(
        "torques at the input; below 0: coast, in which the output drives", example={"from": 0, "to": 200, "count": 9}
    )
    speed_rpm: Numbers = key("speeds of the input", example={"from": 500, "to": 4000, "count": 8})
    oil_temperature_C: Numbers | None = key(
        "temperatures of the oil in every stage, an axis of the map; left out: the map has those of the stages",
        None,
        example=[40, 90],
    )

    @model_validator(mode="after")
    def _turning(self) -> Conditions:
        check_speeds(self.speed_rpm)
        for name in ("torque_Nm", "speed_rpm", "oil_temperature_C"):
            try:
                each_once(getattr(self, name) or ())
            except ValueError as error:
                raise ValueError(f"{name}: {error}") from None
        count = len(self.torque_Nm) * len(self.speed_rpm) * len(self.oil_temperature_C or (0.0,))
        if count > MOST_CONDITIONS:
            raise ValueError(f"a map has at most {MOST_CONDITIONS} conditions, not {count}")
        return self


class Duty(Section):
    """Time at operating points; entries of the three lists correspond."""

    torque_Nm: tuple[Number, ...] = key("torques at the input; below 0: coast", example=[150, 60, 0], min_length=1)
    speed_rpm: tuple[Number, ...] = key("speeds of the input", example=[1000, 3000, 3500], min_length=1)
    duration_h: tuple[NotNegative, ...] = key("hours", example=[10, 200, 40], min_length=1)

    @model_validator(mode="after")
    def _together(self) -> Duty:
        counts = [len(self.torque_Nm), len(self.speed_rpm), len(self.duration_h)]
        if len(set(counts)) > 1:
            raise ValueError(f"the three lists go together, but have {counts[0]}, {counts[1]} and {counts[2]} entries")
        check_speeds(self.speed_rpm)
        return self


class Cycle(Section):
    """Condition of the mesh cycle and of the breakdown."""

    torque_Nm: Positive | None = key(
        "torque at the input; left out: the largest of the map, of coast alone the lowest",
        None,
        example=200.0,
    )
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
    thermal: Thermal | None = key(
        "ways of the heat to the surroundings: the sump temperature at which they carry all losses, at every condition "
        "and over the duty cycle",
        None,
    )
    stages: dict[str, Stage] = key("one table a stage of one gear pair, in the order of the power", {})
    planetary: dict[str, PlanetaryStage] = key("one table a planetary stage, in the order of the power", {})
    order: tuple[str, ...] = key(
        "names of all stages in the order of the power; needed where there are stages of both kinds",
        (),
        example=["first"],
    )

    @model_validator(mode="after")
    def _ordered(self) -> EfficiencyFile:
        named = (*self.stages, *self.planetary)
        if not named:
            raise ValueError("needs a table stages.NAME or planetary.NAME")
        if twice := sorted(set(self.stages) & set(self.planetary)):
            raise ValueError(f"stages and planetary: two stages have the name {twice[0]!r}")
        if self.order and sorted(self.order) != sorted(named):
            raise ValueError(f"order must name each stage once: {', '.join(named)}")
        if not self.order and self.stages and self.planetary:
            raise ValueError(f"order is needed where there are stages of both kinds, as order = {list(named)}")
        return self

    @property
    def in_order(self) -> tuple[str, ...]:
        """Names of the stages in the order of the power."""
        return self.order or (*self.stages, *self.planetary)

    @model_validator(mode="after")
    def _loaded_cycle(self) -> EfficiencyFile:
        if self.cycle.torque_Nm is None and not any(self.conditions.torque_Nm):
            raise ValueError("all torques of the map are 0, and a mesh cycle needs loaded teeth: give cycle.torque_Nm")
        return self

    @model_validator(mode="after")
    def _one_temperature(self) -> EfficiencyFile:
        if self.thermal is not None and self.conditions.oil_temperature_C is not None:
            raise ValueError("thermal finds the temperature of the oil: leave out conditions.oil_temperature_C")
        if self.thermal is not None and self.coasts:
            raise ValueError("thermal balances the heat of drive alone: leave out torques below 0, or thermal")
        return self

    @property
    def coasts(self) -> bool:
        """Whether the output drives at any condition."""
        torques = (*self.conditions.torque_Nm, *(self.duty.torque_Nm if self.duty else ()))
        return min(torques) < 0.0

    def at_oil(self, temperature: float) -> EfficiencyFile:
        """The file with the oil of all stages at a temperature (degC)."""
        there = {"oil_temperature_C": temperature}
        stages, planetary = (
            {name: one.model_copy(update=there) for name, one in some.items()} for some in (self.stages, self.planetary)
        )
        return self.model_copy(update={"stages": stages, "planetary": planetary})


def check_speeds(speed: tuple[float, ...]) -> None:
    """Raise an error for shafts at rest."""
    if min(speed) <= 0.0:
        raise ValueError(f"speed_rpm: {min(speed):g}; a shaft at rest has no loss and no efficiency: above 0")
