"""Table of the thermal balance of a gearbox: the ways of its heat to the surroundings."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator

from mixedlub.efficiency.part_tables import NotNegative, Positive
from mixedlub.schema.section import Number, Section, key

Share = Annotated[Number, Field(ge=0.0, le=1.0)]


class Housing(Section):
    """Heat of the oil through the wall of the housing to the air."""

    area_m2: Positive = key("outer surface, ribs included as far as they act", example=0.45)
    coefficient_W_m2K: NotNegative = key("heat transfer from the wall to the air by convection", example=12.0)
    emissivity: Share = key("of the wall, for radiation to surroundings of ambient temperature", 0.0, example=0.85)
    oil_side_W_m2K: Positive | None = key(
        "heat transfer from the oil to the wall on that area; left out: the wall is as warm as the oil",
        None,
        example=200.0,
    )


class Cooler(Section):
    """Cooler of the sump oil."""

    conductance_W_K: Positive = key("heat per kelvin between sump and coolant", example=40.0)
    coolant_temperature_C: Number = key("temperature of the coolant as it enters", example=25.0)


class OilFlow(Section):
    """Oil that leaves warm for a tank and returns."""

    flow_l_min: Positive = key("oil flow", example=2.0)
    return_temperature_C: Number = key("temperature of the oil as it returns", example=50.0)


class Thermal(Section):
    """Ways of the heat of a gearbox with one oil sump; all losses heat the sump."""

    ambient_temperature_C: Number = key("temperature of air, surroundings and foundation", 20.0)
    housing: Housing | None = key("the housing", None)
    foundation_W_K: NotNegative = key("conductance to the surroundings by foundation, shafts and couplings", 0.0)
    cooler: Cooler | None = key("a cooler", None)
    oil_flow: OilFlow | None = key("oil that circulates through a tank", None)
    teeth_W_K: dict[str, Positive] = key(
        "STAGE = VALUE: conductance from the teeth of a stage of one gear pair to the oil; its film is then that of "
        "oil at the temperature of the teeth. Left out: the film has the sump's temperature, and the teeth are "
        "reported by ISO/TR 15144-1",
        {},
        example={"first": 120.0},
    )
    highest_temperature_C: Number = key("temperature of the sump above which no balance is sought", 150.0)
    heat_capacity_kJ_K: Positive | None = key(
        "heat capacity of oil, wheels and housing together, for temperatures over the duty cycle; left out: every "
        "operating point is steady",
        None,
        example=25.0,
    )
    start_temperature_C: Number | None = key(
        "sump at the start of the duty cycle; left out: the temperature at which the cycle closes", None, example=20.0
    )

    @property
    def coldest_C(self) -> float:
        """Lowest temperature to which heat can go."""
        cooled = [] if self.cooler is None else [self.cooler.coolant_temperature_C]
        returned = [] if self.oil_flow is None else [self.oil_flow.return_temperature_C]
        out = self.foundation_W_K > 0.0 or self.housing is not None
        return min([*cooled, *returned, *([self.ambient_temperature_C] if out else [])])

    @model_validator(mode="after")
    def _a_way_out(self) -> Thermal:
        housing = self.housing
        if housing is not None and housing.coefficient_W_m2K == 0.0 and housing.emissivity == 0.0:
            raise ValueError("housing: neither coefficient_W_m2K nor emissivity is above 0, so that it keeps all heat")
        if housing is None and self.foundation_W_K == 0.0 and self.cooler is None and self.oil_flow is None:
            raise ValueError("no way for the heat: give housing, foundation_W_K, cooler or oil_flow")
        if self.highest_temperature_C <= self.coldest_C:
            rule = f"must be above {self.coldest_C:g} °C, to which the heat goes"
            raise ValueError(f"highest_temperature_C: {self.highest_temperature_C:g}: {rule}")
        if self.start_temperature_C is not None:
            if self.heat_capacity_kJ_K is None:
                raise ValueError("start_temperature_C needs heat_capacity_kJ_K")
            if not self.coldest_C <= self.start_temperature_C < self.highest_temperature_C:
                rule = f"must be from {self.coldest_C:g} to below {self.highest_temperature_C:g} °C"
                raise ValueError(f"start_temperature_C: {self.start_temperature_C:g}: {rule}")
        return self
