"""Losses of a mesh at many torques and speeds, with chain and checks of a study."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from mixedlub.chain.model import Model
from mixedlub.chain.ranges import EXTRAPOLATED, Reached
from mixedlub.chain.slots import SLOTS
from mixedlub.gear import LdpSharing
from mixedlub.study import Study, batch
from mixedlub.study.heat import LOSS, heat_inputs
from mixedlub.study.inputs import mesh_inputs
from mixedlub.study.pieces import split
from mixedlub.study.plan import HEAT, Plan
from mixedlub.study.validity import reached

MOST_SOLVED = 40
"""Torques with solved contact problems; in between, the share is linear in the logarithm of torque."""
LEAST_TORQUE = 1e-3
"""Torque (N m, or over the largest) for contact without torque; rolling does not depend on it."""
MOST_POINTS = 2_000_000
"""Contact points with inputs held in memory at a time."""

OF_ASPERITIES = ("asperities_overloaded", "asperities_above_hardness", "area_ratio_limited", "bandwidth_limited")
"""Flags of asperities, irrelevant to a friction law without asperities."""
LOCAL = ("friction", "rolling_force")
"""Quantities that determine the loss of a contact point."""

Shares = Callable[[np.ndarray], np.ndarray]


def load_shares(study: Study, torque: np.ndarray) -> Shares:
    """Load shares at any of these pinion torques (N m), as a function from N torques to shares (N, M).

    Contact problems of elastic teeth are solved here, once.
    """
    known = np.unique(torque)
    if not isinstance(study.rig.sharing, LdpSharing):
        return study.mesh.load_share
    if known.size <= MOST_SOLVED:
        share = study.mesh.load_share(known)
        return lambda wanted: share[np.searchsorted(known, wanted)]
    solved = np.geomspace(known[0], known[-1], MOST_SOLVED)
    at_solved = study.mesh.load_share(solved)

    def between(wanted: np.ndarray) -> np.ndarray:
        at = np.interp(np.log(wanted), np.log(solved), np.arange(MOST_SOLVED))
        low = np.minimum(at.astype(int), MOST_SOLVED - 2)
        part = (at - low)[:, None]
        return np.asarray((1.0 - part) * at_solved[low] + part * at_solved[low + 1])

    return between


def mesh_losses(
    study: Study, torque: np.ndarray, speed: np.ndarray, warm: np.ndarray | None = None
) -> tuple[np.ndarray, np.ndarray, Reached]:
    """Sliding and rolling loss (W) of a mesh, and its limits with the values of each condition.

    ``torque`` (N m) and ``speed`` (rad/s) of the pinion and oil temperature ``warm`` (K) by condition. Without torque,
    sliding loss is zero, rolling loss is at vanishing load, and limits of the contact are not judged.
    """
    pressed = np.maximum(torque, LEAST_TORQUE * max(1.0, float(torque.max())))
    shares = load_shares(study, pressed)
    step = max(1, MOST_POINTS // study.plan.points)
    parts = [
        _computed(
            study,
            shares,
            pressed[start : start + step],
            speed[start : start + step],
            None if warm is None else warm[start : start + step],
        )
        for start in range(0, torque.size, step)
    ]
    sliding, rolling = (np.concatenate([part[index] for part in parts]) for index in (0, 1))
    limits = [
        (limit, np.where(torque > 0.0, np.concatenate([part[2][i][1] for part in parts]), np.nan))
        for i, (limit, _) in enumerate(parts[0][2])
    ]
    return sliding * (torque / pressed), rolling, limits


def _computed(
    study: Study, shares: Shares, torque: np.ndarray, speed: np.ndarray, warm: np.ndarray | None
) -> tuple[np.ndarray, np.ndarray, Reached]:
    """Losses and limits as in `mesh_losses`, for loaded conditions, all at once."""
    plan = replace(study.plan, inputs=conditioned(study, shares, torque, speed, warm), shape=(1, 1, torque.size, 1))
    values = {name: np.empty(plan.shape) for name in batch.names(plan)}
    # As many blocks as keep every processor busy to the end.
    most = max(1, -(-torque.size // (2 * batch.processors())))
    for block, found in batch.run(plan, split(plan.shape, (1, 1, most, 1))):
        for name, part in found.items():
            values[name][block] = part
    idle = _idle(plan)
    limits = [
        (limit, np.broadcast_to(value, plan.shape).ravel())
        for limit, value in reached(plan, values)
        if limit.code not in idle
    ]
    return values["mesh_loss"].ravel(), values["rolling_loss"].ravel(), limits


def conditioned(
    study: Study, shares: Shares, torque: np.ndarray, speed: np.ndarray, warm: np.ndarray | None = None
) -> dict[str, Any]:
    """Mesh inputs at pinion torques (N m), speeds (rad/s) and oil temperatures (K) along the third axis, frictional
    heat included."""
    plan, share = study.plan, shares(torque)[None, None, :, None, :]
    own = mesh_inputs(study.mesh, share, torque.reshape(1, 1, -1, 1, 1), speed.reshape(1, 1, -1, 1, 1))
    inputs = {**plan.inputs, **own}
    if warm is not None:
        kelvin = (warm + plan.options.bulk_temperature_rise_K).reshape(1, 1, -1, 1, 1)
        inputs |= {**study.oil.inputs(kelvin), "oil_temperature": kelvin}
        entering = {"entering_viscosity": "viscosity", "entering_coefficient": "pressure_viscosity"}
        inputs |= {name: inputs[own] for name, own in entering.items() if name in inputs}
    if HEAT in inputs:
        bare = Model(plan.chain(plan.options), tuple(inputs), (LOSS,))
        inputs |= heat_inputs(bare, inputs, (1, 1, torque.size, 1), plan.points)
    return inputs


def _idle(plan: Plan) -> set[str]:
    """Codes of quantities without effect on the loss: a friction law need not depend on film and asperities."""
    model = Model(plan.chain(plan.options), tuple(plan.inputs), LOCAL, plan.effects)
    made = {name for step in model.steps for name in step.outputs}
    chosen = {slot.choices[getattr(plan.options, slot.option)].law.__name__: slot.quantity for slot in SLOTS}
    idle = {f"{EXTRAPOLATED}:{name}" for name, quantity in chosen.items() if quantity not in made}
    idle |= set() if "area_ratio" in made else set(OF_ASPERITIES)
    return idle | (set() if "film_thickness" in made else {"film_above_contact_width"})
