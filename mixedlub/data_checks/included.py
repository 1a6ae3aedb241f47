"""Losses stated as included in a reading but missing in the model of the case."""

from __future__ import annotations

import re

from mixedlub.case.forward import Forward
from mixedlub.schema.findings import Finding, finding, listed

PARTS = ("bearing", "seal", "churn", "windage")
"""Definition. Words by which a text names parts that lose power; effects of theirs begin with them."""
TAKEN_OFF = r"\b(no|not|without|except|excluding|less|minus|subtracted|removed|taken off|tared)\b"
"""Definition. Words by which a text says that losses are not in the reading."""


def unmodelled_losses(includes: str, forward: Forward) -> list[Finding]:
    """A finding where the reading includes losses of parts that no effect of the case has, though one could."""
    if re.search(TAKEN_OFF, includes, re.IGNORECASE):
        return []
    named = {part: [e.id for e in forward.effects() if e.id.startswith(part)] for part in PARTS}
    found = {re.search(rf"\b{part}\w*", includes, re.IGNORECASE): ids for part, ids in named.items() if ids}
    words = {match[0].lower(): ids for match, ids in found.items() if match}
    if not words:
        return []
    ids = ", ".join(one for some in words.values() for one in some)
    text = (
        f"the reading includes {listed(list(words))}, which the base model lacks: the answer may name them as missing; "
        f"what is known of them belongs in [effects] ({ids})"
    )
    return [finding("losses_unmodelled", text, "system.toml: recording.includes")]
