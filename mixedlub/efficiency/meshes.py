"""Losses of one mesh at many torques and speeds, with the chain and the checks of a study."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.gear import LdpSharing
from mixedlub.study import Study, batch
from mixedlub.study.plan import mesh_inputs
from mixedlub.study.range_flags import as_words, flags

MOST_SOLVED = 40
"""Torques for which contact problems are solved; between them the share is linear in the logarithm of torque."""
LEAST_TORQUE = 1e-3
"""Torque (N m, or over the largest) at which contact without torque is computed: rolling does not depend on it."""


def load_shares(study: Study, torque: np.ndarray) -> np.ndarray:
    """Share of each point of the mesh at torques (N m) of the pinion, shape (N, M).

    >>> from mixedlub.efficiency import meshes
    >>> meshes.MOST_SOLVED
    40
    """
    known, place = np.unique(torque, return_inverse=True)
    if known.size <= MOST_SOLVED or not isinstance(study.rig.sharing, LdpSharing):
        return np.asarray(study.mesh.load_share(known)[place])
    solved = np.geomspace(known[0], known[-1], MOST_SOLVED)
    share = study.mesh.load_share(solved)
    at = np.interp(np.log(known), np.log(solved), np.arange(MOST_SOLVED))
    low = np.minimum(at.astype(int), MOST_SOLVED - 2)
    part = (at - low)[:, None]
    return np.asarray(((1.0 - part) * share[low] + part * share[low + 1])[place])


def mesh_losses(study: Study, torque: np.ndarray, speed: np.ndarray) -> tuple[np.ndarray, np.ndarray, list[str]]:
    """Sliding and rolling loss (W) of a mesh, and validity of each condition.

    ``torque`` (N m) and ``speed`` (rad/s) of the pinion have one entry a condition. Without torque nothing slides under
    load, and rolling is that of a vanishing load.
    """
    pressed = np.maximum(torque, LEAST_TORQUE * max(1.0, float(torque.max())))
    share = load_shares(study, pressed)[None, None, :, None, :]
    own = mesh_inputs(study.mesh, share, pressed.reshape(1, 1, -1, 1, 1), speed.reshape(1, 1, -1, 1, 1))
    plan = replace(study.plan, inputs={**study.plan.inputs, **own}, shape=(1, 1, torque.size, 1))
    values = {name: np.empty(plan.shape) for name in batch.names(plan)}
    for block, found in batch.run(plan, blocks(torque.size, plan.points)):
        for name, part in found.items():
            values[name][block] = part
    index, words = as_words(flags(plan, values), plan.shape)
    sliding, rolling = (values[name].ravel() for name in ("mesh_loss", "rolling_loss"))
    return sliding * (torque / pressed), rolling, [words[i] for i in index.ravel()]


def blocks(conditions: int, points: int) -> list[batch.Block]:
    """Ranges of conditions, as many as processors can work on at once."""
    most = max(1, min(-(-conditions // (2 * batch.processors())), batch.BLOCK_POINTS // points))
    return batch.split((1, 1, conditions, 1), (1, 1, most, 1))
