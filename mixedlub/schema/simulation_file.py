"""Tables of `system.toml` beside the user's own simulation: conditions and uncertain inputs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import ValidationError, model_validator
from pydantic_core import PydanticCustomError

from mixedlub.schema.section import Number, Section, key


class Condition(Section):
    unit: str | None = key(
        'unit of the column, "-" for a pure number; left out: the unit at the end of its name, or a column of names',
        None,
        example="bar",
    )
    meaning: str = key("meaning of the column", "", example="pressure at the inlet")


class SimulationInput(Section):
    """An uncertain input of the user's own simulation: a relative standard deviation, or a value with its own."""

    relative: Number | None = key("standard deviation over the value; the logarithm is normal", None, ge=0.0)
    value: Number | None = key("value in the simulation", None)
    sd: Number | None = key("standard deviation, in the unit of the value", None, ge=0.0)
    unit: str = key("unit of the value", "-")

    @model_validator(mode="after")
    def _one_form(self) -> SimulationInput:
        given = (self.relative is not None, self.value is not None, self.sd is not None)
        if given not in ((True, False, False), (False, True, True)):
            raise ValueError("is a relative standard deviation, or { value = ..., sd = ... }")
        return self

    @property
    def spread(self) -> float:
        """Standard deviation, relative or in the unit of the value."""
        return float(self.relative if self.sd is None else self.sd)  # type: ignore[arg-type]


def simulation_input(name: str, given: Any) -> SimulationInput:
    """Uncertain input of a number, its relative standard deviation, or of a table."""
    try:
        return SimulationInput.model_validate(given if isinstance(given, Mapping) else {"relative": given})
    except ValidationError:
        rule = "must be a relative standard deviation from 0, or { value = ..., sd = ... }"
        raise PydanticCustomError("simulation_input", "{name} {rule}", {"name": name, "rule": rule}) from None
