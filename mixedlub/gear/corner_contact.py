"""Contact beyond the ends of the path: the edge of a tip on the flank of its mate, due to bending of the teeth."""

from __future__ import annotations

import numpy as np

from mixedlub.gear.geometry import GearPair

REACH = 0.25
"""Largest distance beyond the path for edge contact, over the base pitch; rigid gaps there are tenths of a module."""


def corner_gap(pair: GearPair, position: np.ndarray) -> np.ndarray:
    r"""Gap (m) along the line of action between the edge of a tip and its mate's flank, outside the path of contact.

    ``position`` (m, any shape): where the flanks of unworn, endless involutes would touch; the gap is zero within the
    path. The edge is the gear's tip before A and the pinion's tip beyond E. Exact for rigid teeth: with the path as the
    x axis through the base tangent point T of the mate, and s the distance to the end of the path, the edge is turned
    back by s/r_b; gap = rho_P - r_b gamma - x, where rho_P is the mate's radius of curvature through the edge and gamma
    the angle by which its involute there turns to meet the path.

    Source: derived; the approach of edge contact that Munro, Morrish and Palmer 1999 approximate by a series.
    """
    position = np.asarray(position, dtype=float)
    length = pair.line_of_action_length
    before = _gap(pair.base_radius, length, pair.path_start, position)
    beyond = _gap(pair.base_radius[::-1], length, length - pair.path_end, length - position)
    return np.where(position < pair.path_start, before, np.where(position > pair.path_end, beyond, 0.0))


def _gap(base: tuple[float, float], length: float, end: float, position: np.ndarray) -> np.ndarray:
    """Gap between the flank of the first wheel (base tangent point at the origin) and the tip edge of the other."""
    mate, own = base
    lacking = np.maximum(end - position, 0.0) / own
    across, up = end - length, -own
    x = length + across * np.cos(lacking) + up * np.sin(lacking)
    y = mate + own - across * np.sin(lacking) + up * np.cos(lacking)
    curvature = np.copysign(np.sqrt(np.maximum(x**2 + y**2 - mate**2, 0.0)), mate)
    turn = np.arctan(curvature / mate) - np.arctan(x / y)
    return curvature - mate * turn - position
