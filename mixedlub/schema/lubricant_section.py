"""Section `[lubricant]` of a rig: an oil by name or file, and its own numbers."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import ValidationInfo, field_validator, model_validator

from mixedlub.schema.oil_file import STOCKS, STRESS, TRACTION, Base, KnownCoefficient, oil_names, with_oil
from mixedlub.schema.section import Number, Section, key
from mixedlub.schema.traction_part import Traction, eyring_stress_of

Pair = tuple[Number, Number]


class Lubricant(Section):
    oil: str | None = key(
        f"oil by name ({', '.join(oil_names())}), or its file NAME.toml, relative to this one; what this section "
        "states itself wins",
        None,
        example="n100",
        alternative=True,
    )
    name: str = key("name of the oil, for the report", "unnamed oil", example="sample oil")
    base: Base | None = key(
        "base stock, whose typical oil fills what is left out; left out: mineral",
        None,
        example="mineral",
        values=STOCKS,
    )
    temperature_C: Pair | None = key("two temperatures, those of the next two keys", None, example=[40.0, 100.0])
    kinematic_viscosity_mm2_s: Pair | None = key(
        "kinematic viscosity there; ASTM D341 between and beyond", None, example=[30.0, 6.2]
    )
    pressure_viscosity_per_GPa: Pair | None = key(
        "pressure-viscosity coefficient there; linear between and beyond", None, example=[18.0, 14.0]
    )
    known_pressure_viscosity: KnownCoefficient | None = key(
        "instead of both: a coefficient known at one temperature, and its way to others",
        None,
        example={"coefficient_per_GPa": 14.2, "temperature_C": 54.0, "carried": "roelands"},
        alternative=True,
    )
    pressure_modulus_MPa: Pair | None = key(
        'A of the modulus equation there, for viscosity_law = "modulus"; linear between and beyond',
        None,
        example=[55.6, 71.4],
    )
    pressure_modulus_slope: Pair | None = key("B of the modulus equation there", None, example=[0.03, 0.04])
    density_15C_kg_m3: Number | None = key("density at 15 °C", None, example=850.0)
    density_change_per_K: Number | None = key("relative fall of the density", None, example=7e-4)
    eyring_stress_MPa: Number | None = key("Eyring stress of the film", None, example=5.0)
    traction: Traction | None = key(
        "instead of it: Eyring stress and limiting stress over pressure and temperature, as `mixedlub fit` and "
        "`mixedlub evaluate two-disc` write them into the file of an oil",
        None,
        example={
            "eyring_stress_MPa": {"value": 5.2, "sd": 0.3},
            "pressure_GPa": [0.6, 1.5],
            "temperature_C": [40.0, 120.0],
            "source": "discs of our laboratory, Roelands",
        },
        alternative=True,
    )
    thermal_conductivity_W_mK: Number | None = key("thermal conductivity of the oil", None, example=0.14)
    specific_heat_J_kgK: Number | None = key("specific heat of the oil", None, example=2000.0)

    @field_validator(
        "kinematic_viscosity_mm2_s",
        "pressure_viscosity_per_GPa",
        "pressure_modulus_MPa",
        "pressure_modulus_slope",
        mode="before",
    )
    @classmethod
    def _at_both_temperatures(cls, given: Any) -> Any:
        if isinstance(given, int | float):
            raise ValueError("must be two numbers, at the two temperatures: [..., ...]")
        return given

    @model_validator(mode="after")
    def _both_of_the_modulus(self) -> Lubricant:
        if (self.pressure_modulus_MPa is None) != (self.pressure_modulus_slope is None):
            raise ValueError("the modulus equation needs both pressure_modulus_MPa and pressure_modulus_slope")
        return self

    @model_validator(mode="after")
    def _one_coefficient(self) -> Lubricant:
        if self.known_pressure_viscosity is not None:
            if self.pressure_viscosity_per_GPa is not None:
                raise ValueError("known_pressure_viscosity takes the place of pressure_viscosity_per_GPa: give one")
            if self.known_pressure_viscosity.carried == "gold" and self.base is None:
                raise ValueError('known_pressure_viscosity.carried = "gold" needs base, for the exponent of Gold')
        return self

    @model_validator(mode="before")
    @classmethod
    def _of_its_oil(cls, given: Any, info: ValidationInfo) -> Any:
        """Complete the section by its oil."""
        named = given.get("oil") if isinstance(given, Mapping) else None
        full = given if not isinstance(named, str) else with_oil(given, (info.context or {}).get("folder", Path()))
        if isinstance(full, Mapping) and full.get(STRESS) is None:
            stress = eyring_stress_of(full.get(TRACTION))
            full = full if stress is None else {**full, STRESS: stress}
        return full

    @model_validator(mode="after")
    def _one_stress(self) -> Lubricant:
        if self.traction is not None and self.eyring_stress_MPa != self.traction.eyring_stress_MPa.value:
            raise ValueError("traction has an Eyring stress of its own: leave eyring_stress_MPa or traction out")
        return self
