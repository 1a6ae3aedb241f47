"""Torque read while the machine changes speed: what its inertia takes, and whether readings can tell it."""

from __future__ import annotations

import numpy as np

from mixedlub.case.forward import Forward
from mixedlub.schema.findings import Finding, finding

ALIKE = 0.999
"""Judgement. Share of the acceleration in a constant and the speed, above which friction takes up inertia."""


def inertia_in_torque(forward: Forward) -> list[Finding]:
    """Finding on a recorded torque that contains inertia which no reading separates from friction."""
    if "drive_acceleration" not in forward.inputs:
        return []
    speed, change = (np.ravel(forward.inputs[name]) for name in ("drive_speed", "drive_acceleration"))
    columns = np.column_stack([np.sign(speed), speed, np.ones(speed.size)])
    left = change - columns @ np.linalg.lstsq(columns, change, rcond=None)[0]
    if float(left @ left) > (1.0 - ALIKE) * float(change @ change):
        return []
    text = (
        f"the machine changes speed by up to {np.max(np.abs(change)):.3g} rad/s2 while its torque is read, so that the "
        "torque contains inertia; its acceleration is a straight line over speed, as dry and viscous friction are, so "
        "that these readings cannot tell them apart: add a coast-down or readings at steady speed"
    )
    return [finding("inertia_not_separable", text)]
