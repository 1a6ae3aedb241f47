"""Published laws that an effect of the answer becomes at certain parameters: whether the readings allow them."""

from __future__ import annotations

from dataclasses import dataclass

from mixedlub.diagnosis.explanation import Explanation
from mixedlub.diagnosis.inference.nested_laws import published_odds
from mixedlub.diagnosis.search.search import Search
from mixedlub.diagnosis.settings.assessment import LAW_OPEN, LAW_REJECTED


@dataclass(frozen=True)
class Contained:
    """A published law and its log odds against the effect that contains it with all parameters free."""

    effect: str
    law: str
    log_odds: float

    @property
    def text(self) -> str:
        """What the readings say of the law."""
        odds = f"(log odds {self.log_odds:+.1f})"
        if self.log_odds > 0.0:
            return f"The law of {self.law}, which it contains, does as well {odds}."
        if self.log_odds > LAW_OPEN:
            return f"The law of {self.law}, which it contains, cannot be excluded {odds}."
        if self.log_odds > LAW_REJECTED:
            return f"The law of {self.law}, which it contains, does less well {odds}."
        return f"The law of {self.law}, which it contains, is rejected {odds}."


def contained(search: Search, verdict: Explanation) -> tuple[Contained, ...]:
    """Weigh the published laws that a verdict's effects contain, each with the rest of the verdict fitted again."""
    if not verdict.effects:
        return ()
    return tuple(Contained(*law) for law in published_odds(search.problem, search.fits[verdict]))
