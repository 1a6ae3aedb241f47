"""Torque that the fluid about a turning part takes, by published measures of discs, rotors in gaps, and fans.

A Reynolds number is that at full speed; the torque of a law is over its own there, so that a strength is the drag at
full speed over the dry friction.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from mixedlub.validation.planted.kinds import Knob, strength
from mixedlub.validation.rigs.stage import Form

TRANSITION = 3e5
"""Reynolds number (omega R^2/nu) at the rim of a free disc from which its boundary layer is turbulent."""
GAP = ((10.0, -1.0), (2.0, -0.6), (1.03, -0.5), (0.065, -0.2))
Moment = Callable[[np.ndarray], np.ndarray]


def free_disc(reynolds: np.ndarray) -> np.ndarray:
    """Moment coefficient of both sides, torque over rho omega^2 R^5/2.

    3.87 Re^-1/2 (Cochran 1934) where laminar and 0.146 Re^-1/5 (von Karman 1921) where turbulent. Inside the radius of
    transition a disc stays laminar: that part of the turbulent torque is exchanged for the laminar one, as Prandtl does
    for a plate (Schlichting, Boundary-Layer Theory, chapter 21).
    """
    reynolds = np.maximum(reynolds, 1e-9)
    inside = (0.146 * TRANSITION**-0.2 - 3.87 * TRANSITION**-0.5) * (TRANSITION / reynolds) ** 2.5
    return np.where(reynolds < TRANSITION, 3.87 * reynolds**-0.5, 0.146 * reynolds**-0.2 - inside)


def rotor_in_gap(reynolds: np.ndarray) -> np.ndarray:
    """Moment coefficient of a rotor in a bore over (gap/radius)^0.3, by omega R t/nu: linear drag, then vortices.

    Bilgen and Boulos, J. Fluids Eng. 95 (1973) 122: four powers, of which the largest holds.
    """
    reynolds = np.maximum(reynolds, 1e-9)
    return np.asarray(np.max([factor * reynolds**power for factor, power in GAP], axis=0))


def torque_share(share: np.ndarray, reynolds: float, moment: Moment) -> np.ndarray:
    """Signed torque over that at full speed, for speeds over full speed."""
    full = float(moment(np.array([reynolds]))[0])
    return np.asarray(share * np.abs(share) * moment(reynolds * np.abs(share)) / full)


def stirring(share: np.ndarray, real: bool) -> tuple[Form, ...]:
    """Forms for a drive at signed speeds over its full speed; where none is ``real`` they are rivals only."""

    def dragged(d: Any, strength: float, torque: np.ndarray) -> Any:
        return replace(d, running=d.running + 0.7 * strength * d.level * torque)

    def disc(d: Any, strength: float, reynolds: float) -> Any:
        return dragged(d, strength, torque_share(share, 1e5 * reynolds, free_disc))

    def rotor(d: Any, strength: float, reynolds: float) -> Any:
        return dragged(d, strength, torque_share(share, 1e3 * reynolds, rotor_in_gap))

    def fan(d: Any, strength: float) -> Any:
        return dragged(d, strength, share * np.abs(share))

    size, rarity = strength(0.0, 12.0, (0.4, 2.0)), float(real)
    turning = Knob("reynolds", 1.0, 100.0, (4.0, 20.0))
    swirling = Knob("reynolds", 0.06, 20.0, (0.3, 6.0))
    return (
        Form("fluid_drag", "running", disc, (size, turning), "disc turning turbulent, von Karman 1921", rarity=rarity),
        Form("fluid_drag", "running", rotor, (size, swirling), "rotor in a gap, Bilgen, Boulos 1973", rarity=rarity),
        Form("fluid_drag", "running", fan, (size,), "fan laws, ISO 5801", rarity=rarity, within=True),
    )
