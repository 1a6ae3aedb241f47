"""What a study file may say: one class a section, validated once, every error with its place."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, Field, model_validator

from mixedlub.schema.system_file import Float, Gears, Lubricant, Number, Section, SurfaceSection, Whole

MOST_LEVELS = 100_000


def _levels(value: Any) -> Any:
    """A list as it stands, or ``{from, to, count}`` spelt out."""
    if not isinstance(value, dict):
        return value
    if set(value) != {"from", "to", "count"}:
        raise ValueError("is a list, or { from = LOW, to = HIGH, count = N }")
    low, high, count = value["from"], value["to"], value["count"]
    if isinstance(count, bool) or not isinstance(count, int) or not 2 <= count <= MOST_LEVELS:
        raise ValueError(f"count is a whole number from 2 to {MOST_LEVELS}")
    if not all(isinstance(end, (int, float)) and np.isfinite(end) for end in (low, high)):
        raise ValueError("from and to are finite numbers")
    return np.linspace(low, high, count).tolist()


def _once(values: tuple[Any, ...]) -> tuple[Any, ...]:
    doubled = sorted({v for v in values if values.count(v) > 1}, key=str) if len(values) < 1000 else []
    if doubled or len(set(values)) < len(values):
        raise ValueError(f"each level once, but {doubled[0] if doubled else 'one'} appears again")
    return values


Numbers = Annotated[tuple[Number, ...], Field(min_length=1), BeforeValidator(_levels)]
Names = Annotated[tuple[str, ...], Field(min_length=1)]


class Conditions(Section):
    """The factorial: every torque at every speed and oil temperature."""

    place = "conditions"

    torque_Nm: Numbers
    speed_rpm: Numbers
    oil_temperature_C: Numbers

    @model_validator(mode="after")
    def _each_once(self) -> Conditions:
        for name in ("torque_Nm", "speed_rpm", "oil_temperature_C"):
            try:
                _once(getattr(self, name))
            except ValueError as error:
                raise ValueError(f"{name}: {error}") from None
        return self


class Pairings(Section):
    """Which surface meets which: ``every`` unordered pair of some, or ``pinion`` list against ``gear`` list."""

    every: Names | None = None
    pinion: Names | None = None
    gear: Names | None = None

    @model_validator(mode="after")
    def _one_way(self) -> Pairings:
        lists = (self.pinion, self.gear)
        if (self.every is None) == (None in lists) or (self.every is not None and lists != (None, None)):
            raise ValueError("needs either every = [...], or both pinion = [...] and gear = [...]")
        for names in (self.every, *lists):
            _once(names or ())
        return self


class Options(Section):
    """Readings of the model on which its authors leave room; the defaults are those of the base model."""

    film: Literal["dowson_toyoda_central", "dowson_higginson_minimum"] = "dowson_toyoda_central"
    viscosity_law: Literal["roelands", "barus"] = "roelands"
    viscosity_pressure: Literal["maximum", "mean"] = "maximum"
    effective_viscosity: Literal["asinh", "secant"] = "asinh"
    contact_pressure: Literal["maximum", "mean"] = "maximum"
    averaging: Literal["mesh_integral", "paper"] = "mesh_integral"
    conditions_of: Literal["pinion", "gear"] = "pinion"
    bulk_temperature_rise_K: Annotated[Float, Field(ge=-100, le=200)] = 0.0
    path_points: Annotated[Whole, Field(ge=8, le=10_000)] = 48
    face_slices: Annotated[Whole, Field(ge=1, le=1000)] | None = None


class StudyFile(Section):
    """A study file."""

    schema_: Literal["mixedlub-study/1"] = Field(alias="schema")
    title: str = "Study"
    description: str = ""
    boundary_friction: Number = 0.1
    gears: Gears
    lubricant: Lubricant | None = None
    surfaces: Annotated[dict[str, SurfaceSection], Field(min_length=1)]
    pairings: Pairings | None = None
    conditions: Conditions
    options: Options = Options()
    effects: Annotated[dict[str, dict[str, Number]], Field(default_factory=dict)]
