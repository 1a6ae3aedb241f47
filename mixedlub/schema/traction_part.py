"""Traction part of an oil: Eyring stress and limiting stress over pressure and temperature, fitted together."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.section import Number, Section, key

EYRING = {"eyring_pressure_exponent": "pressure_exponent", "eyring_fall_per_K": "fall"}
"""Keys of the part and parameters of the effect `shear_law`."""
LIMIT = {
    "limit_over_pressure": "coefficient",
    "limit_sharpness": "sharpness",
    "limit_fall_per_K": "fall",
    "limit_offset": "offset",
}
"""Keys of the part and parameters of the effect `limiting_shear_stress`."""
WORDS = {"shear_law": "Eyring stress", "limiting_shear_stress": "limiting stress"}
"""Stresses of the part by the effects that they become."""
MOST_PRESSURE = 8.0
"""Judgement. Largest Hertz pressure (GPa) of readings: hard steel yields far below."""
WITHOUT_RATE = {"rate_exponent": 0.0, "rate_onset": 8.0}
"""Definition. Parameters of `shear_law` for a stress independent of the shear rate."""
FITTED: Mapping[str, str] = {
    "fitted": "fitted to readings of this oil",
    "stated": "printed by the source",
    "typical": "not told by the readings: typical of oils",
}
Ends = tuple[Number, Number]


class TractionNumber(Section):
    value: Number = key("the number", example=5.2)
    sd: Annotated[Number, Field(ge=0.0)] = key("its standard deviation; 0: none stated", 0.0, example=0.3)
    status: Literal["fitted", "stated", "typical"] = key("where it comes from", "fitted", values=FITTED)


class Traction(Section):
    """Eyring stress and limiting stress over pressure and temperature."""

    eyring_stress_MPa: TractionNumber = key("Eyring stress at 1 GPa and 80 °C", example={"value": 5.2, "sd": 0.3})
    eyring_pressure_exponent: TractionNumber = key("exponent of pressure in it", TractionNumber(value=0.0))
    eyring_fall_per_K: TractionNumber = key("its relative fall per kelvin", TractionNumber(value=0.0))
    limit_over_pressure: TractionNumber | None = key(
        "limiting stress over pressure at 1 GPa and 40 °C; left out: no limit", None, example={"value": 0.05}
    )
    limit_sharpness: TractionNumber = key("sharpness of the transition to the limit", TractionNumber(value=2.5))
    limit_fall_per_K: TractionNumber = key("relative fall of the limit per kelvin", TractionNumber(value=0.0))
    limit_offset: TractionNumber = key(
        "share of the limit at 1 GPa that does not grow with pressure", TractionNumber(value=0.0)
    )
    pressure_GPa: Ends = key("Hertz pressures of the readings", example=[0.6, 1.5])
    temperature_C: Ends = key("oil temperatures of the readings", example=[40.0, 120.0])
    source: str = key("the readings, and the viscosity law of the fit", example="discs of our laboratory, Roelands")

    @model_validator(mode="after")
    def _possible_law(self) -> Traction:
        over = self.limit_over_pressure
        rules = (
            ("eyring_stress_MPa", 0.02 <= self.eyring_stress_MPa.value <= 500.0, "must be from 0.02 to 500 MPa"),
            ("limit_over_pressure", over is None or 0.0 < over.value < 1.0, "must be between 0 and 1"),
            ("limit_sharpness", self.limit_sharpness.value > 0.0, "must be above 0"),
            ("limit_fall_per_K", self.limit_fall_per_K.value >= 0.0, "must not be below 0"),
            ("limit_offset", 0.0 <= self.limit_offset.value <= 1.0, "must be from 0 to 1"),
        )
        for name, holds, rule in rules:
            if not holds:
                raise ValueError(f"{name}: {getattr(self, name).value:g}: {rule}")
        for name in ("pressure_GPa", "temperature_C"):
            low, high = getattr(self, name)
            if low > high:
                raise ValueError(f"{name}: {high:g}: must be at least {low:g}, the first of the two")
        if not 0.0 < self.pressure_GPa[1] <= MOST_PRESSURE:
            raise ValueError(f"pressure_GPa: {self.pressure_GPa[1]:g}: must be above 0, at most {MOST_PRESSURE:g} GPa")
        if over is None and (lone := sorted(self.model_fields_set & set(LIMIT) - {"limit_over_pressure"})):
            raise ValueError(f"{lone[0]} needs limit_over_pressure")
        return self

    def told(self, stated: Collection[str]) -> Iterator[Finding]:
        """Findings on the stresses in use, and on stresses replaced by ``stated`` effects."""
        (low, high), (cold, hot) = self.pressure_GPa, self.temperature_C
        words = {name: WORDS[name] for name in self.effects(uncertain=False)}
        if read := " and ".join(text for name, text in words.items() if name not in stated):
            text = f"{read} by the traction part of the oil, from readings at {low:g} to {high:g} GPa and "
            yield finding("traction_read", f"{text}{cold:g} to {hot:g} °C ({self.source})", "lubricant.traction")
        for name in (name for name in words if name in stated):
            text = f"takes the place of the law of the {words[name]} in the traction part of the oil"
            yield finding("traction_unread", text, f"effects.{name}")

    def effects(self, *, uncertain: bool) -> dict[str, dict[str, Any]]:
        """Section ``[effects]`` for this part; ``uncertain``: with standard deviations."""
        found = {"shear_law": {**WITHOUT_RATE, **self._parameters(EYRING, uncertain)}}
        if self.limit_over_pressure is not None:
            found["limiting_shear_stress"] = self._parameters(LIMIT, uncertain)
        return found

    def _parameters(self, names: Mapping[str, str], uncertain: bool) -> dict[str, float]:
        found = {}
        for own, name in names.items():
            number = getattr(self, own)
            found[name] = number.value
            # A limit's parameter of zero has no lognormal uncertainty.
            if uncertain and number.sd > 0.0 and (number.value > 0.0 or own in EYRING):
                found[f"{name}_sd"] = number.sd
        return found


def eyring_stress_of(part: Any) -> Any:
    """Eyring stress (MPa) of a traction part, parsed or as in a file; None if it has none."""
    if isinstance(part, Traction):
        return part.eyring_stress_MPa.value
    stress = part.get("eyring_stress_MPa") if isinstance(part, Mapping) else None
    return stress.get("value") if isinstance(stress, Mapping) else None
