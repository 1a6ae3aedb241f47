"""Figures of a battery of rigs of full physics: discs and gears separately, and losses beside the mesh."""

from __future__ import annotations

from collections.abc import Callable

from mixedlub.validation.answers import Answer, Truth
from mixedlub.validation.measures import false_physics, right, tied, unknown_suspected
from mixedlub.validation.score import FIGURES, Measured, any_case, at_least, at_most, chosen, share

LOSSES = frozenset({"windage", "bearing_drag"})


def _counts(
    group: str, kind: str = "", full: bool | None = None, loss: bool = False
) -> Callable[[Truth, Answer], bool]:
    """Cases of a class and kind, with or without full solutions as base, with a loss beside the mesh or not."""
    return lambda truth, answer: (
        truth.group == group
        and kind in ("", truth.kind)
        and full in (None, truth.full_base)
        and (bool(truth.label & LOSSES) is loss or group == "none")
    )


_OWN = (
    share("tied_discs", "discs: what is concealed, right or tied", _counts("single", "disc"), tied, at_least(0.85)),
    share("tied_gears", "gears: what is concealed, right or tied", _counts("single", "gear_pair"), tied,
           at_least(0.80)),
    share("tied_losses", "gears: a loss beside the mesh, right or tied",
           _counts("single", "gear_pair", loss=True), tied, at_least(0.85)),
    share("none", "no effect, maybe another rheology or balance: none or laws", _counts("none"), right,
           at_least(0.90)),
    share("none_formulas", "  the formulas as base", _counts("none", full=False), right),
    share("none_full", "  full solutions as base", _counts("none", full=True), right),
    share("unknown_false", "  unknown above 0.5", _counts("none"), unknown_suspected),
    share("false_physics", "a false effect at 0.9 or more", any_case, false_physics, at_most(0.04)),
)  # fmt: skip
_AS_EVER = ("outliers_found", "outliers_false", "held_out", "coverage", "location", "seconds", "slowest")
SOLVED_FIGURES: tuple[Measured, ...] = (*_OWN, *chosen(FIGURES, *_AS_EVER))
