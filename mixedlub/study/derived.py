"""Outputs of a study computed from other outputs after all conditions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from mixedlub.gear import GearPair
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.laws.safety import flash_safety, integral_safety, integral_temperature
from mixedlub.study.bands import HIGH, LOW
from mixedlub.study.heat import BULK
from mixedlub.study.plan import MOST_CONTACT_RATIO, Plan
from mixedlub.study.schema import Safety


def following(plan: Plan, inputs: Mapping[str, Any], values: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Outputs computed from the outputs at each condition of a part with these inputs; they also have bands."""
    total, power = values["power_loss"], _input_power(inputs)
    inlet, bulk = _temperatures(inputs)
    contact = bulk + values["flash_temperature"]
    return {
        "efficiency": 1.0 - total / power,
        "tooth_efficiency": 1.0 - (values["mesh_loss"] + values["rolling_loss"]) / power,
        "least_film_parameter": values["least_film"] / values["composite_roughness"],
        "asperity_load_share": np.minimum(values["asperity_load_ratio"], 1.0),
        "contact_temperature": contact,
        **_rated(plan.safety, values, inlet - plan.options.bulk_temperature_rise_K, bulk, contact),
    }


def derived(plan: Plan, pair: GearPair, values: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Outputs computed for the whole study, including those without bands or needing all conditions."""
    most = values["power_loss"].max()
    found = {
        **following(plan, plan.inputs, values),
        "input_power": np.broadcast_to(_input_power(plan.inputs), plan.shape),
        **{
            end + "normalised_loss": values[end + "power_loss"] / most
            for end in ("", LOW, HIGH)
            if end + "power_loss" in values
        },
    }
    if BULK in plan.parameters:
        found["bulk_temperature"] = np.broadcast_to(_temperatures(plan.inputs)[1], plan.shape)
    if plan.spur and pair.contact_ratio <= MOST_CONTACT_RATIO:
        found["loss_factor"] = np.full(plan.shape, pair.loss_factor)
    return found


def _temperatures(inputs: Mapping[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """Temperatures (K) of the oil at the inlet and of the teeth."""
    inlet = np.asarray(inputs["oil_temperature"])[..., 0]
    return inlet, inlet + np.asarray(inputs["bulk_rise"] + np.zeros(1))[..., 0]


def _rated(
    safety: Safety | None, values: Mapping[str, np.ndarray], oil: np.ndarray, bulk: np.ndarray, contact: np.ndarray
) -> dict[str, np.ndarray]:
    """Margins against the limits of a study; temperatures in K."""
    found: dict[str, np.ndarray] = {}
    if safety is None:
        return found
    if safety.scuffing_temperature_C is not None:
        found["flash_safety"] = flash_safety(contact, oil, safety.scuffing_temperature_C + ZERO_CELSIUS)
    if safety.integral_scuffing_temperature_C is not None and safety.flash_weight is not None:
        limit = safety.integral_scuffing_temperature_C + ZERO_CELSIUS
        found["integral_temperature"] = integral_temperature(bulk, values["mean_flash"], safety.flash_weight)
        found["integral_safety"] = integral_safety(found["integral_temperature"], limit)
    if safety.permissible_film_ratio is not None:
        found["micropitting_safety"] = values["least_specific_film"] / safety.permissible_film_ratio
    return found


def _input_power(inputs: Mapping[str, Any]) -> np.ndarray:
    """Torque times angular speed of the pinion (W)."""
    return np.asarray(inputs["torque"] * inputs["pinion_speed"])[..., 0]
