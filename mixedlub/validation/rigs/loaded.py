"""Friction of drives and tribometers under several loads: losses that grow with it, Stribeck curves that move with it.

Loads are over the largest of the programme; a loss of a law is over its own there, so that a strength is the loss at
full load over half of the dry friction.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from mixedlub.validation.planted.kinds import Knob, strength
from mixedlub.validation.rigs.stage import Form


def with_square(share: np.ndarray, bend: float) -> np.ndarray:
    """Proportional to load and, where parts give and rub, to its square: (1 - b) w + b w^2, for loads up to 1.

    The first two terms of any loss that is smooth in load and gone without it.

    >>> [float(w) for w in with_square(np.array([0.0, 0.5, 1.0]), 0.5)]
    [0.0, 0.375, 1.0]
    """
    return np.asarray((1 - bend) * share + bend * share**2)


def adhering(share: np.ndarray, pull: float) -> np.ndarray:
    """Proportional to the area of an elastic ball that adheres: (w + w_a)^(2/3) less that without load.

    Derjaguin, Muller and Toporov, J. Colloid Interface Sci. 53 (1975) 314: Hertz's area under the load and the
    ``pull`` w_a of adhesion together, over the largest load. Stiff bodies; the part without load is dry friction.
    Cited from memory; the power is Hertz's.

    >>> [round(float(w), 6) for w in adhering(np.array([0.0, 1 / 8, 1.0]), 0.0)]
    [0.0, 0.25, 1.0]
    """
    area = (share + pull) ** (2 / 3) - pull ** (2 / 3)
    return np.asarray(area / ((1 + pull) ** (2 / 3) - pull ** (2 / 3)))


def over_hersey(speed: np.ndarray, share: np.ndarray, width: float, power: float) -> np.ndarray:
    """Share of boundary friction left at a Hersey number, 1/(1 + H^2), H = (speed/width)/w^power.

    Hersey 1914 has power 1; Hess and Soom, J. Tribol. 112 (1990) 147, have this fall over speed by the root of load,
    both from memory and not checked against the papers. Speeds over full speed, of one oil at one temperature.

    >>> [round(float(left), 3) for left in over_hersey(np.array([0.0, 0.1, 0.1]), np.array([1.0, 1.0, 0.25]), 0.1, 0.5)]
    [1.0, 0.5, 0.2]
    """
    return np.asarray(1 / (1 + (speed / (width * share**power)) ** 2))


def under_load(load: np.ndarray) -> tuple[Form, ...]:
    """Forms where a load is recorded."""
    share = load / load.max()

    def lost(d: Any, strength: float, part: np.ndarray) -> Any:
        return replace(d, running=d.running + 0.5 * strength * d.level * part * d.sign)

    def loaded(d: Any, strength: float, exponent: float) -> Any:
        return lost(d, strength, share**exponent)

    def bending(d: Any, strength: float, bend: float) -> Any:
        return lost(d, strength, with_square(share, bend))

    def sticking(d: Any, strength: float, pull: float) -> Any:
        return lost(d, strength, adhering(share, pull))

    def hersey(d: Any, strength: float, width: float, power: float) -> Any:
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
