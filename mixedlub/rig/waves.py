"""Surfaces in the tables of flattened waves: a row for each spectrum that a run needs."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field

import numpy as np

from mixedlub.base_model.flattened import Flattening, flattening
from mixedlub.laws.flattening import lay_factor
from mixedlub.rig.surface import Surface
from mixedlub.schema.findings import finding, report
from profiles.errors import InputError
from roughness.waves import Waves, lognormal_waves, waves_of

UNDEFORMED, WAVES = "none", "waves"
"""Choices of the option."""
OUTSIDE = "asperity_law"
"""Effect that reads the roughness outside the film beside the asperities inside it."""


@dataclass(frozen=True, eq=False)
class WaveRows:
    """Rows of surfaces, numbered as they are asked for; a surface at another short cut-off has a row of its own."""

    known: dict[tuple[str, float | None], int] = field(default_factory=dict)
    waves: list[tuple[Waves, float]] = field(default_factory=list)

    def inputs(self, first: Sequence[Surface], second: Sequence[Surface]) -> dict[str, np.ndarray]:
        """Chain inputs of pairs of surfaces."""
        sides = (("first_waves", first), ("second_waves", second))
        return {name: np.array([self.row(one) for one in side], dtype=float) for name, side in sides}

    def row(self, surface: Surface) -> int:
        """Row of a surface; waves without a trace are assumed, with a finding."""
        key = surface.name, surface.short_cutoff
        if key not in self.known:
            self.known[key] = len(self.waves)
            self.waves.append((_waves(surface), lay_factor(surface.orientation) if surface.lay else 1.0))
        return self.known[key]

    def tables(self, option: str, cutoff_share: float | None) -> Flattening:
        """Tables of all rows so far."""
        return flattening(self.waves, option == WAVES, cutoff_share)


def wave_rows(option: str, cutoff_share: float | None, effects: Collection[str], place: str) -> WaveRows | None:
    """Empty rows where waves flatten or the short cut-off is tied to the contact; None where neither is chosen."""
    if option == UNDEFORMED and cutoff_share is None:
        return None
    if option == WAVES and "micro_ehl" in effects:
        rule = f'and {place}flattening = "{WAVES}" flatten the roughness twice; leave one of them out'
        raise InputError(rule, where="effects.micro_ehl")
    if OUTSIDE in effects:
        rule = f'reads the roughness outside the film, which {place}flattening = "{WAVES}" and a tied cut-off change'
        raise InputError(f"{rule}; leave one of them out", where=f"effects.{OUTSIDE}")
    return WaveRows()


def _waves(surface: Surface) -> Waves:
    if surface.profiles:
        return waves_of(surface.profiles)
    text = "no trace shows its waves; taken as lognormal, as wide as Nayak's number of its moments says"
    report(finding("waves_assumed", text, f"surfaces.{surface.name}"))
    return lognormal_waves(surface.m0, surface.m2, surface.m4)
