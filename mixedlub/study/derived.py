"""Outputs of a study that follow from others once all conditions are computed."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from mixedlub.gear import GearPair
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.laws.safety import flash_safety, integral_safety, integral_temperature
from mixedlub.study.heat import BULK
from mixedlub.study.plan import MOST_CONTACT_RATIO, Plan
from mixedlub.study.schema import Safety


def derived(plan: Plan, pair: GearPair, values: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Power taken in, efficiencies, Ohlendorf's loss factor, normalised loss and others, in the shape of the study."""
    total, power = values["power_loss"], _input_power(plan)
    inlet = np.broadcast_to(np.asarray(plan.inputs["oil_temperature"])[..., 0], plan.shape)
    oil = inlet - plan.options.bulk_temperature_rise_K
    bulk = inlet + np.asarray(plan.inputs["bulk_rise"] + np.zeros(1))[..., 0]
    contact = bulk + values["flash_temperature"]
    found = {
        "normalised_loss": total / total.max(),
        "input_power": np.broadcast_to(power, plan.shape),
        "efficiency": 1.0 - total / power,
        "tooth_efficiency": 1.0 - (values["mesh_loss"] + values["rolling_loss"]) / power,
        "least_film_parameter": values["least_film"] / values["composite_roughness"],
        "asperity_load_share": np.minimum(values["asperity_load_ratio"], 1.0),
        "contact_temperature": contact,
        **_rated(plan.safety, values, oil, bulk, contact),
    }
    if BULK in plan.parameters:
        found["bulk_temperature"] = bulk
    if plan.spur and pair.contact_ratio <= MOST_CONTACT_RATIO:
        found["loss_factor"] = np.full(plan.shape, pair.loss_factor)
    return found


def _rated(
    safety: Safety | None, values: Mapping[str, np.ndarray], oil: np.ndarray, bulk: np.ndarray, contact: np.ndarray
) -> dict[str, np.ndarray]:
    """Margins against the limits that a study states; temperatures in K."""
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


def _input_power(plan: Plan) -> np.ndarray:
    """Torque times angular speed of the pinion (W)."""
    return np.asarray(plan.inputs["torque"] * plan.inputs["pinion_speed"])[..., 0]
