"""The friction laws as text: a table of all, and pages."""

from __future__ import annotations

from mixedlub.chain.friction_law import PLACES, FrictionLaw
from mixedlub.friction import catalogue, find
from mixedlub.report.format_reference import aligned


def friction_text(name: str | None = None) -> str:
    """Page of a friction law, or table of all friction laws in 80 columns."""
    if name is not None:
        return find(name).page()
    lines = [f"{len(catalogue())} friction laws. `mixedlub friction-laws NAME` shows the page of one, and"]
    lines += ['[options] friction = "NAME" chooses it in a study. The number counts independent']
    lines += ["sources for its constants; 0: the coefficients are yours."]
    for place, words in PLACES.items():
        lines += ["", words]
        lines += aligned([_row(law) for law in catalogue().values() if law.place == place])
    return "\n".join(lines)


def _row(law: FrictionLaw) -> tuple[str, str, str]:
    ranges = f"range: {'; '.join(law.ranges())}" if law.valid else "no range printed"
    zero = "; diverges at the pitch point" if law.diverges_at_pitch_point else ""
    return law.name, str(law.sources), f"{law.status}; {ranges}{zero}"
