"""Heat of the mesh in a study: loss of the model without effects, at every condition."""

from __future__ import annotations

from collections.abc import Mapping
from inspect import signature
from typing import Any

import numpy as np

from mixedlub.chain.model import Law, Model, Parameters
from mixedlub.effects.bulk_temperature import rise_of_teeth
from mixedlub.laws.heating import TOOTH_RISE_EXPONENT
from mixedlub.study.pieces import PIECE_PAIRINGS, PIECE_POINTS, Inputs, reach, split, taken
from profiles.errors import InputError

LOSS = "power_loss"
BULK = "bulk_temperature"
"""Effect of the tooth temperature."""


def heat_inputs(model: Model, inputs: Inputs, shape: tuple[int, int, int, int], points: int) -> dict[str, Any]:
    """Inputs of effects that read the heat of the mesh, by a model without effects that gives the power loss.

    The loss (W) has an axis for each condition; bands of traces use the same loss. The scale (W), at which laws with
    different exponents agree, cancels for the exponent of the standard.
    """
    loss = np.empty(shape)
    with np.errstate(all="ignore"):
        for block in split(shape, reach(shape, points, PIECE_POINTS, PIECE_PAIRINGS)):
            loss[block] = model(taken(inputs, block))[LOSS][..., 0]
    return {"nominal_loss": loss[..., None], "reading_scale": 1.0}


def check_exponent(parameters: Parameters) -> None:
    """Raise an error for an exponent of the heat other than the standard's: it needs a measured loss for the scale."""
    given = parameters.get(BULK, {}).get("exponent", TOOTH_RISE_EXPONENT)
    if given != TOOTH_RISE_EXPONENT:
        rule = (
            f"must be {TOOTH_RISE_EXPONENT:g}, as in ISO/TR 15144-1: another exponent needs a recorded loss at which "
            "it gives the rise of the standard, which a computation without recordings does not have"
        )
        raise InputError(rule, where=f"effects.{BULK}.exponent", value=given)


def rating_inputs(inputs: Inputs, parameters: Parameters) -> Mapping[str, Any]:
    """Oil temperature at the inlet, before any effect warms the oil, and temperature rise of the teeth over it (K)."""
    law: Law = rise_of_teeth
    rise: Any = 0.0
    if BULK in parameters:
        read = [inputs[name] for name in signature(law).parameters if name not in parameters[BULK]]
        rise = law(*read, **parameters[BULK])
    return {
        "entering_viscosity": inputs["viscosity"],
        "entering_coefficient": inputs["pressure_viscosity"],
        "bulk_rise": rise,
    }
