"""Effects of whole drives and tribometers: loss under load, friction before sliding, drag of the fluid."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from mixedlub.validation.rig import Form, Knob, strength

TRANSITION = 3e5
"""Reynolds number (omega R^2/nu) at the rim of a free disc from which its boundary layer is turbulent."""
GAP = ((10.0, -1.0), (2.0, -0.6), (1.03, -0.5), (0.065, -0.2))
Moment = Callable[[np.ndarray], np.ndarray]
SHOWN_BELOW = 1 / 300
"""Drives that never run below this share of full speed have no reading before sliding."""


def with_square(share: np.ndarray, bend: float) -> np.ndarray:
    """Loss proportional to load, with a square term of elastic, rubbing parts: (1 - b) w + b w^2, for loads up to 1.

    The first two terms of any loss that is smooth in load and vanishes without load.

    >>> [float(w) for w in with_square(np.array([0.0, 0.5, 1.0]), 0.5)]
    [0.0, 0.375, 1.0]
    """
    return np.asarray((1 - bend) * share + bend * share**2)


def adhering(share: np.ndarray, pull: float) -> np.ndarray:
    """Loss proportional to the contact area of an adhering elastic ball: (w + w_a)^(2/3) less its value without load.

    Derjaguin, Muller and Toporov, J. Colloid Interface Sci. 53 (1975) 314: Hertz's area under the load and the ``pull``
    w_a of adhesion together, over the largest load. Stiff bodies; the part without load is dry friction. Cited from
    memory; the power is Hertz's.

    >>> [round(float(w), 6) for w in adhering(np.array([0.0, 1 / 8, 1.0]), 0.0)]
    [0.0, 0.25, 1.0]
    """
    area = (share + pull) ** (2 / 3) - pull ** (2 / 3)
    return np.asarray(area / ((1 + pull) ** (2 / 3) - pull ** (2 / 3)))


def over_hersey(speed: np.ndarray, share: np.ndarray, width: float, power: float) -> np.ndarray:
    """Share of boundary friction left at a Hersey number, 1/(1 + H^2), H = (speed/width)/w^power.

    Power 1 in Hersey 1914; fall over speed by the root of load in Hess and Soom, J. Tribol. 112 (1990) 147; both from
    memory and not checked against the papers. Speeds over full speed, of one oil at one temperature.

    >>> [round(float(left), 3) for left in over_hersey(np.array([0.0, 0.1, 0.1]), np.array([1.0, 1.0, 0.25]), 0.1, 0.5)]
    [1.0, 0.5, 0.2]
    """
    return np.asarray(1 / (1 + (speed / (width * share**power)) ** 2))


def under_load(load: np.ndarray) -> tuple[Form, ...]:
    """Forms for drives with a recorded load."""
    share = load / load.max()

    def lost(d: Any, strength: float, part: np.ndarray) -> Any:
        return replace(d, running=d.running + 0.5 * strength * d.level * part * d.sign)

    def loaded(d: Any, strength: float, exponent: float) -> Any:
        """A torque proportional to w^n, w the load over the largest, n the exponent."""
        return lost(d, strength, share**exponent)

    def bending(d: Any, strength: float, bend: float) -> Any:
        """A torque proportional to (1 - b) w + b w^2, w the load over the largest, b the bend."""
        return lost(d, strength, with_square(share, bend))

    def sticking(d: Any, strength: float, pull: float) -> Any:
        """A torque proportional to (w + a)^(2/3) - a^(2/3), w the load over the largest, a the pull."""
        return lost(d, strength, adhering(share, pull))

    def hersey(d: Any, strength: float, width: float, power: float) -> Any:
        """A torque proportional to 1/(1 + H^2), H = (speed/width)/w^power, w the load over the largest."""
        return lost(d, 0.6 * strength, over_hersey(d.speed, share, width, power))

    size, rise = strength(0.0, 6.0), strength(0.0, 8.0)
    power = Knob("exponent", 0.8, 1.2, (0.9, 1.1))
    bend, pull = Knob("bend", 0.0, 1.0, (0.3, 0.8)), Knob("pull", 0.0, 0.5, (0.03, 0.2))
    width, lean = Knob("width", 0.01, 0.5, (0.04, 0.2)), Knob("power", 0.4, 1.0, (0.5, 1.0))
    return (
        Form("load_dependent_friction", "running", loaded, (size, power), "near proportion", within=True),
        Form("load_dependent_friction", "running", bending, (size, bend), "proportional and quadratic"),
        Form("load_dependent_friction", "running", sticking, (size, pull), "Derjaguin, Muller and Toporov 1975"),
        Form("stribeck", "running", hersey, (rise, width, lean), "Hess and Soom 1990, over a Hersey number"),
    )


def bristles(travel: np.ndarray) -> np.ndarray:
    """Mean over a reading of the LuGre bristle dz/dx = 1 - z/z_s at one speed: 1 - (1 - e^-x)/x.

    Canudas de Wit, Olsson, Astrom and Lischinsky, IEEE Trans. Autom. Control 40 (1995) 419, without its damping.
    """
    x = np.maximum(travel, 1e-9)
    return np.asarray(1 + np.expm1(-x) / x)


def ball_bearing(travel: np.ndarray, exponent: float) -> np.ndarray:
    """Value at the end of a reading of dF/dx = (1 - F)^i, i > 1: 1 - (1 + (i - 1) x)^(-1/(i - 1)).

    Dahl, AIAA J. 14 (1976) 1675, with i between 1 and 2 for ball bearings.
    """
    return np.asarray(1 - (1 + (exponent - 1) * travel) ** (-1 / (exponent - 1)))


def partial_slip(travel: np.ndarray) -> np.ndarray:
    """Value at the end of a reading of an elastic ball with an inward slip ring: 1 - (1 - 2 x/3)^(3/2), 1 from 3/2 on.

    Mindlin, J. Appl. Mech. 16 (1949) 259.
    """
    return np.asarray(1 - np.maximum(1 - travel / 1.5, 0.0) ** 1.5)


def hysteretic(travel: np.ndarray) -> np.ndarray:
    """Value at the end of a reading of dF/dx = 1 - F^2: tanh x.

    Bouc 1967 and Wen, J. Eng. Mech. 102 (1976) 249, of exponent 2 on first loading; Andersson, Soderberg and Bjorklund,
    Tribol. Int. 40 (2007) 580, take the tangent itself. Cited from memory, the exponent and the tangent unchecked.

    >>> [round(float(f), 6) for f in hysteretic(np.array([0.0, 1.0]))]
    [0.0, 0.761594]
    """
    return np.asarray(np.tanh(travel))


def presliding(share: np.ndarray) -> tuple[Form, ...]:
    """Forms for a drive at signed speeds over its full speed; none if all speeds are too fast."""
    if np.abs(share).min() > SHOWN_BELOW:
        return ()

    def given(d: Any, strength: float, reached: Callable[[np.ndarray], np.ndarray]) -> Any:
        """Contacts bear all friction except oil drag; the unit of travel is 0.4 % of full speed."""
        if strength <= 0:
            return d
        part = reached(np.abs(share) / (0.004 * strength))
        return replace(d, running=d.drag + part * (d.running - d.drag))

    def lugre(d: Any, strength: float) -> Any:
        """Mean of 1 - e^-x over a reading, x the travel in units of 0.4 % strength of full speed."""
        return given(d, strength, bristles)

    def dahl(d: Any, strength: float, exponent: float) -> Any:
        """1 - (1 + (i - 1) x)^(-1/(i - 1)), x the travel, i the exponent."""
        return given(d, strength, lambda travel: ball_bearing(travel, exponent))

    def bouc_wen(d: Any, strength: float) -> Any:
        """tanh x, x the travel."""
        return given(d, strength, hysteretic)

    def mindlin(d: Any, strength: float) -> Any:
        """1 - (1 - 2 x/3)^(3/2) up to x = 3/2, x the travel."""
        return given(d, strength, partial_slip)

    size = strength(0.0, 12.0, (0.4, 2.0))
    exponent = Knob("exponent", 1.1, 2.5, (1.4, 2.0))
    return (
        Form("presliding", "running", lugre, (size,), "bristles, Canudas de Wit et al. 1995"),
        Form("presliding", "running", dahl, (size, exponent), "ball bearings, Dahl 1976"),
        Form("presliding", "running", bouc_wen, (size,), "smooth hysteresis, Bouc 1967, Wen 1976"),
        Form("presliding", "running", mindlin, (size,), "partial slip, Mindlin 1949", within=True),
    )


def free_disc(reynolds: np.ndarray) -> np.ndarray:
    """Moment coefficient of both sides, torque over rho omega^2 R^5/2.

    Laminar 3.87 Re^-1/2 (Cochran 1934), turbulent 0.146 Re^-1/5 (von Karman 1921). Inside the radius of transition a
    disc stays laminar: its turbulent torque is replaced by the laminar torque, as Prandtl does for a plate
    (Schlichting, Boundary-Layer Theory, chapter 21).
    """
    reynolds = np.maximum(reynolds, 1e-9)
    inside = (0.146 * TRANSITION**-0.2 - 3.87 * TRANSITION**-0.5) * (TRANSITION / reynolds) ** 2.5
    return np.where(reynolds < TRANSITION, 3.87 * reynolds**-0.5, 0.146 * reynolds**-0.2 - inside)


def rotor_in_gap(reynolds: np.ndarray) -> np.ndarray:
    """Moment coefficient of a rotor in a bore over (gap/radius)^0.3, by omega R t/nu: linear drag, then vortices.

    Bilgen and Boulos, J. Fluids Eng. 95 (1973) 122: the largest of four powers.
    """
    reynolds = np.maximum(reynolds, 1e-9)
    return np.asarray(np.max([factor * reynolds**power for factor, power in GAP], axis=0))


def torque_share(share: np.ndarray, reynolds: float, moment: Moment) -> np.ndarray:
    """Signed torque over the torque at full speed, for speeds over full speed."""
    full = float(moment(np.array([reynolds]))[0])
    return np.asarray(share * np.abs(share) * moment(reynolds * np.abs(share)) / full)


def stirring(share: np.ndarray, real: bool) -> tuple[Form, ...]:
    """Forms for a drive at signed speeds over its full speed; rivals only unless ``real``."""

    def dragged(d: Any, strength: float, torque: np.ndarray) -> Any:
        return replace(d, running=d.running + 0.7 * strength * d.level * torque)

    def disc(d: Any, strength: float, reynolds: float) -> Any:
        """A torque of Re^-1/2 n^2 where laminar and Re^-1/5 n^2 where turbulent, from Re = 3e5 on."""
        return dragged(d, strength, torque_share(share, 1e5 * reynolds, free_disc))

    def rotor(d: Any, strength: float, reynolds: float) -> Any:
        """A torque of Re^-1, Re^-0.6, Re^-0.5 and Re^-0.2 times n^2, whichever is largest."""
        return dragged(d, strength, torque_share(share, 1e3 * reynolds, rotor_in_gap))

    def fan(d: Any, strength: float) -> Any:
        """A torque proportional to n^2."""
        return dragged(d, strength, share * np.abs(share))

    size, rarity = strength(0.0, 12.0, (0.4, 2.0)), float(real)
    turning = Knob("reynolds", 1.0, 100.0, (4.0, 20.0))
    swirling = Knob("reynolds", 0.06, 20.0, (0.3, 6.0))
    return (
        Form("fluid_drag", "running", disc, (size, turning), "disc turning turbulent, von Karman 1921", rarity=rarity),
        Form("fluid_drag", "running", rotor, (size, swirling), "rotor in a gap, Bilgen, Boulos 1973", rarity=rarity),
        Form("fluid_drag", "running", fan, (size,), "fan laws, ISO 5801", rarity=rarity, within=True),
    )
