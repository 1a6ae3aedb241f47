"""Tables of the battery on real recordings: its recordings with their sources, and its misses."""

from __future__ import annotations

from pathlib import Path

import scores
from markdown_tables import table

FOLDER = Path(__file__).parents[2] / "benchmarks/recordings"
HEAD = ("source", "recordings", "kinds", "split", "licence")


def pieces() -> dict[str, str]:
    """Markdown by name that the page includes."""
    text = (scores.FOLDER / "score_real.txt").read_text(encoding="utf-8")
    score = scores.all_rows(scores.scores(text)[scores.TOOL])
    return {"score_real": score, "missed_real": _misses(text), "recordings": _of_sources()}


def _of_sources() -> str:
    """One row a source."""
    from mixedlub.validation.real.source import Recording, described

    found: dict[str, list[Recording]] = {}
    for one in described(FOLDER):
        found.setdefault(one.source, []).append(one)
    return table(HEAD, (_row(several) for several in found.values()))


def _row(several: list) -> tuple[str, ...]:
    facts = several[0].facts
    title = f"[{facts['title']}]({facts['url']}), {facts['authors']} ({facts['year']})"
    kinds = ", ".join(sorted({one.kind for one in several}))
    return (title, str(len(several)), kinds, several[0].split, facts["licence"])


def _misses(text: str) -> str:
    """Counts by kind, and the answers that are not right, as they stand in the score."""
    first = text.index("right answers")
    last = text.find("refused or broken", first)
    return "```text\n" + text[first : last if last >= 0 else text.index("\nsources\n")].rstrip() + "\n```"
