"""Outputs of a study that follow from others once all conditions are computed."""

from __future__ import annotations

from collections.abc import Mapping
from inspect import signature

import numpy as np

from mixedlub.chain.model import Law
from mixedlub.effects.bulk_temperature import rise_of_teeth
from mixedlub.gear import GearPair
from mixedlub.study.plan import MOST_CONTACT_RATIO, Plan

BULK = "bulk_temperature"
"""Effect that warms the teeth."""


def derived(plan: Plan, pair: GearPair, values: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Power taken in, efficiencies, Ohlendorf's loss factor, normalised loss and others, in the shape of the study."""
    total, power, bulk = values["power_loss"], _input_power(plan), _bulk(plan)
    found = {
        "normalised_loss": total / total.max(),
        "input_power": np.broadcast_to(power, plan.shape),
        "efficiency": 1.0 - total / power,
        "tooth_efficiency": 1.0 - (values["mesh_loss"] + values["rolling_loss"]) / power,
        "least_film_parameter": values["least_film"] / values["composite_roughness"],
        "asperity_load_share": np.minimum(values["asperity_load_ratio"], 1.0),
        "contact_temperature": values["flash_temperature"] + bulk,
    }
    if BULK in plan.parameters:
        found["bulk_temperature"] = np.broadcast_to(bulk, plan.shape)
    if plan.spur and pair.contact_ratio <= MOST_CONTACT_RATIO:
        found["loss_factor"] = np.full(plan.shape, pair.loss_factor)
    return found


def _bulk(plan: Plan) -> np.ndarray:
    """Temperature of the teeth (K): that of the oil at the inlet, and the rise by the effect that warms them."""
    oil = np.asarray(plan.inputs["oil_temperature"])
    if BULK not in plan.parameters:
        return oil[..., 0]
    law: Law = rise_of_teeth
    read = [plan.inputs[name] for name in signature(law).parameters if name not in plan.parameters[BULK]]
    return np.asarray(oil + law(*read, **plan.parameters[BULK]))[..., 0]


def _input_power(plan: Plan) -> np.ndarray:
    """Torque times angular speed of the pinion (W)."""
    return np.asarray(plan.inputs["torque"] * plan.inputs["pinion_speed"])[..., 0]
