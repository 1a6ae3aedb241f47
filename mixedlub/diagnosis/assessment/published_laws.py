"""Published laws that are special cases of the answer's effects, weighed by the readings."""

from __future__ import annotations

import math
from dataclasses import dataclass

from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.inference.nested_laws import published_odds
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import LAW_OPEN, LAW_REJECTED


@dataclass(frozen=True)
class Contained:
    """A published law and its log odds against the effect with all parameters free."""

    effect: str
    law: str
    log_odds: float

    @property
    def text(self) -> str:
        """Sentence on the agreement of the law with the readings.

        >>> print(Contained("inlet_shear_heating", "Gupta", -0.9).text)
        Its special case "Gupta" fits about as well (odds 1 : 2.5).
        >>> print(Contained("film_law", "Grubin", -2000.0).text)
        Its special case "Grubin" is rejected (odds 1 : 1e869).
        """
        if self.log_odds > -LAW_OPEN:
            how = "fits as well with fewer parameters"
        elif self.log_odds > LAW_OPEN:
            how = "fits about as well"
        elif self.log_odds > LAW_REJECTED:
            how = "fits less well"
        else:
            how = "is rejected"
        return f'Its special case "{self.law}" {how} (odds {self._odds}).'

    @property
    def _odds(self) -> str:
        size = abs(self.log_odds)
        shown = f"{float(f'{math.exp(size):.2g}'):g}" if size < math.log(1e4) else f"1e{size / math.log(10.0):.0f}"
        return f"{shown} : 1" if self.log_odds > 0.0 else f"1 : {shown}"


def contained(search: Search, verdict: Explanation) -> tuple[Contained, ...]:
    """Weigh the published laws in a verdict's effects, each with the rest of the verdict refitted."""
    if not verdict.effects:
        return ()
    return tuple(Contained(*law) for law in published_odds(search.problem, search.fits[verdict]))
