"""Kinds of rig in a battery, one module a kind, and the shares of their cases.

A module draws rigs with their conditions, calibrated inputs and effects, most effects in several published forms.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from mixedlub.validation.planted import FORMS, MEASUREMENT
from mixedlub.validation.rig import Rig
from mixedlub.validation.rigs import discs, drives, films, gears, histories, rings, tooth_contacts, viscosities

Partners = tuple[str, tuple[str, ...], float]
"""An effect, its possible partners in a pair, and the weight of such a pair."""


@dataclass(frozen=True)
class Kind:
    """Draw of rigs of a kind, and effects planted in pairs.

    ``draw_without_data_sheet`` draws a rig with an unknown oil, on which effects in ``needs_data_sheet`` are invisible.
    """

    draw: Callable[[np.random.Generator], Rig]
    pairs: tuple[Partners, ...]
    draw_without_data_sheet: Callable[[np.random.Generator], Rig] | None = None
    needs_data_sheet: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Family:
    """Kinds with a common deck of effects, and the shares of their cases.

    ``classes``: shares of the classes. Shares of cases: ``outliers``, by class, with outliers; ``small``, with few
    readings; ``mis_set``, among cases without effects, with the whole calibration one to two prior standard deviations
    off; ``sd_column``, with a noise column. ``noise``: bounds of the noise (percent); ``noise_alone``: without effects.
    ``scattered``: bounds of the share of readings withheld at random; in a share ``blocks`` of the cases a whole level
    of a condition with at least ``levels`` levels is withheld too, an inner level or (``ends``) any. All shares are
    judgement: enough cases for each figure of the score.
    """

    kinds: tuple[str, ...]
    classes: dict[str, float]
    outliers: dict[str, float]
    small: float = 0.0
    mis_set: float = 0.5
    sd_column: float = 0.15
    noise: tuple[float, float] = (0.3, 5.0)
    noise_alone: tuple[float, float] = (0.3, 5.0)
    scattered: tuple[float, float] = (0.05, 0.12)
    blocks: float = 0.6
    levels: int = 4
    ends: bool = False


def _fixed(pairs: Sequence[tuple[str, str]]) -> tuple[Partners, ...]:
    return tuple((first, (second,), 1.0) for first, second in pairs)


def _of_other_stages(absent: Sequence[str]) -> tuple[Partners, ...]:
    """Pairs of every physical effect with any effect after another stage."""
    first = {name: forms[0] for name, forms in FORMS.items() if name not in absent}
    return tuple(
        (name, tuple(other for other in first if first[other].hook != form.hook), form.rarity)
        for name, form in first.items()
        if name not in MEASUREMENT
    )


KINDS: dict[str, Kind] = {
    "gear_pair": Kind(gears.draw, _of_other_stages(gears.NOT_HERE)),
    "disc": Kind(discs.draw, _of_other_stages(discs.NOT_HERE)),
    "film": Kind(films.draw, _fixed(films.PAIRS), films.draw_without_data_sheet, films.NEEDS_DATA_SHEET),
    "friction_history": Kind(histories.draw, _fixed(histories.PAIRS)),
    "friction_map": Kind(drives.draw, _fixed(drives.PAIRS)),
    "viscosity": Kind(viscosities.draw, _fixed(viscosities.PAIRS)),
    "mesh_friction": Kind(tooth_contacts.draw, _fixed(tooth_contacts.PAIRS)),
    "ring_gear": Kind(rings.draw_ring, _of_other_stages(gears.NOT_HERE)),
    "planetary": Kind(rings.draw_planetary, _of_other_stages(gears.NOT_HERE)),
}
"""Kinds of rig by the kind of their cases; cases of ring gears and of planetary meshes are gear pairs."""
CLASSES = ("none", "single", "pair", "measurement", "unknown")
CONTACTS = ("gear_pair", "disc")
RINGS = ("ring_gear", "planetary")
"""Kinds that are dealt only by name."""
OTHERS = tuple(kind for kind in KINDS if kind not in (*CONTACTS, *RINGS))


def _of_meshes(kinds: tuple[str, ...]) -> Family:
    """Gears or discs, whose cases have shares of their own."""
    return Family(
        kinds,
        classes=dict(zip(CLASSES, (0.16, 0.44, 0.13, 0.11, 0.16))),
        outliers=dict(zip(CLASSES, (0.5, 0.2, 0.1, 0.2, 0.15))),
        small=0.12,
        mis_set=0.0,
        sd_column=0.0,
        noise=(0.35, 5.0),
        noise_alone=(0.4, 4.0),
        scattered=(0.06, 0.14),
        blocks=0.8,
        levels=3,
        ends=True,
    )


FAMILIES = (
    _of_meshes(CONTACTS),
    *(
        Family(
            (kind,),
            classes=dict(zip(CLASSES, (0.175, 0.40, 0.10, 0.15, 0.175))),
            outliers=dict(zip(CLASSES, (0.5, 0.15, 0.0, 0.15, 0.1))),
        )
        for kind in OTHERS
    ),
    _of_meshes(RINGS),
)


def family_of(kind: str) -> Family:
    return next(family for family in FAMILIES if kind in family.kinds)
