"""Values of `[rig]`: what a condition of a rig can be set to."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite
from typing import Annotated, Any

from pydantic import BeforeValidator, ValidationInfo

PAIRINGS, STEPS = "pairings", "steps"


def _number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and isfinite(value)


def _settable(value: Any, info: ValidationInfo) -> Any:
    """A range as a pair, steps as a rising list in a table, or pairs of names."""
    if isinstance(value, Mapping):
        if set(value) != {STEPS}:
            raise ValueError("must be a range [low, high] or { steps = [...] }")
        steps = value[STEPS]
        if not isinstance(steps, list | tuple) or not steps or not all(map(_number, steps)):
            raise ValueError("steps must be a list of numbers")
        if sorted(set(steps)) != list(steps):
            raise ValueError("steps must rise")
        return {STEPS: [float(step) for step in steps]}
    if not isinstance(value, list | tuple) or not value:
        raise ValueError("must be a range [low, high] or { steps = [...] }")
    if all(isinstance(pair, list | tuple) for pair in value):
        if any(len(pair) != 2 or not all(isinstance(name, str) for name in pair) for pair in value):
            raise ValueError('must be pairs of surfaces: [["a", "b"], ...]')
        return [list(pair) for pair in value]
    if len(value) != 2 or not all(map(_number, value)):
        raise ValueError("must be two numbers, [low, high], or { steps = [...] }")
    low, high = value
    if low >= high:
        raise ValueError("low must be below high; one value is { steps = [value] }")
    return [float(low), float(high)]


Settable = Annotated[Any, BeforeValidator(_settable)]
