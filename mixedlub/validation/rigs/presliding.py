"""How much of its sliding value friction reaches over a short travel: published laws of contacts that first give way.

Every reading starts from rest with all contacts relaxed and lasts as long as the others, so that its travel goes with
speed. ``travel`` is over the one that sliding friction would take at the stiffness the contacts begin with.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from mixedlub.validation.planted.kinds import Knob, strength
from mixedlub.validation.rigs.stage import Form

SHOWN_BELOW = 1 / 300
"""A drive that is never slower than this share of its full speed has no reading before sliding."""


def bristles(travel: np.ndarray) -> np.ndarray:
    """Mean over a reading of the LuGre bristle dz/dx = 1 - z/z_s at one speed: 1 - (1 - e^-x)/x.

    Canudas de Wit, Olsson, Astrom and Lischinsky, IEEE Trans. Autom. Control 40 (1995) 419, without its damping.
    """
    x = np.maximum(travel, 1e-9)
    return np.asarray(1 + np.expm1(-x) / x)


def ball_bearing(travel: np.ndarray, exponent: float) -> np.ndarray:
    """At the end of a reading of dF/dx = (1 - F)^i, i > 1: 1 - (1 + (i - 1) x)^(-1/(i - 1)).

    Dahl, AIAA J. 14 (1976) 1675, whose ball bearings have an i between 1 and 2.
    """
    return np.asarray(1 - (1 + (exponent - 1) * travel) ** (-1 / (exponent - 1)))


def partial_slip(travel: np.ndarray) -> np.ndarray:
    """At the end of a reading of an elastic ball whose slip ring grows inwards: 1 - (1 - 2 x/3)^(3/2), 1 from 3/2 on.

    Mindlin, J. Appl. Mech. 16 (1949) 259.
    """
    return np.asarray(1 - np.maximum(1 - travel / 1.5, 0.0) ** 1.5)


def hysteretic(travel: np.ndarray) -> np.ndarray:
    """At the end of a reading of dF/dx = 1 - F^2: tanh x.

    Bouc 1967 and Wen, J. Eng. Mech. 102 (1976) 249, of exponent 2 on first loading; Andersson, Soderberg and Bjorklund,
    Tribol. Int. 40 (2007) 580, take the tangent itself. Cited from memory, the exponent and the tangent unchecked.

    >>> [round(float(f), 6) for f in hysteretic(np.array([0.0, 1.0]))]
    [0.0, 0.761594]
    """
    return np.asarray(np.tanh(travel))


def presliding(share: np.ndarray) -> tuple[Form, ...]:
    """Forms for a drive at signed speeds over its full speed, where some are slow enough."""
    if np.abs(share).min() > SHOWN_BELOW:
        return ()

    def given(d: Any, strength: float, reached: Callable[[np.ndarray], np.ndarray]) -> Any:
        """All friction but the drag of the oil is borne by contacts; 0.4 % of full speed is a travel of one."""
        if strength <= 0:
            return d
        part = reached(np.abs(share) / (0.004 * strength))
        return replace(d, running=d.drag + part * (d.running - d.drag))

    def lugre(d: Any, strength: float) -> Any:
        return given(d, strength, bristles)

    def dahl(d: Any, strength: float, exponent: float) -> Any:
        return given(d, strength, lambda travel: ball_bearing(travel, exponent))

    def bouc_wen(d: Any, strength: float) -> Any:
        return given(d, strength, hysteretic)

    def mindlin(d: Any, strength: float) -> Any:
        return given(d, strength, partial_slip)

    size = strength(0.0, 12.0, (0.4, 2.0))
    exponent = Knob("exponent", 1.1, 2.5, (1.4, 2.0))
    return (
        Form("presliding", "running", lugre, (size,), "bristles, Canudas de Wit et al. 1995"),
        Form("presliding", "running", dahl, (size, exponent), "ball bearings, Dahl 1976"),
        Form("presliding", "running", bouc_wen, (size,), "smooth hysteresis, Bouc 1967, Wen 1976"),
        Form("presliding", "running", mindlin, (size,), "partial slip, Mindlin 1949", within=True),
    )
