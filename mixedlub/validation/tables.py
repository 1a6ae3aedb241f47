"""Plain text about a scored battery: counts by kind of rig or flaw of the recording, and all wrong answers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from mixedlub.validation.measures import Pair, crossed, outliers_false, outliers_found, right, tied, together


def _count(hits: Sequence[bool]) -> str:
    return f"{sum(hits)}/{len(hits)}" if hits else "-"


def counts(pairs: Mapping[str, Sequence[Pair]], title: str = "by kind") -> str:
    """Counts of groups of cases, one column a group, one line a question."""

    def of(some: Sequence[Pair], *groups: str, clear: bool = False) -> list[Pair]:
        return [(t, a) for t, a in some if t.group in groups and (t.identifiable or not clear)]

    one = ("single", "measurement")
    questions = {
        "right, one effect, identifiable": lambda s: [right(t, a) for t, a in of(s, *one, clear=True)],
        "  physics": lambda s: [right(t, a) for t, a in of(s, "single", clear=True)],
        "  instrument faults": lambda s: [right(t, a) for t, a in of(s, "measurement", clear=True)],
        "right or tied, one effect, all": lambda s: [tied(t, a) for t, a in of(s, *one)],
        "both of a pair": lambda s: [t.label <= a.verdict for t, a in of(s, "pair")],
        "a pair, exactly or tied": lambda s: [tied(t, a) for t, a in of(s, "pair")],
        "all of three": lambda s: [together(t, a) for t, a in of(s, "triple")],
        "none where nothing is missing": lambda s: [right(t, a) for t, a in of(s, "none")],
        "false alarms": lambda s: [a.detected for t, a in of(s, "none")],
        "unknown where so and identifiable": lambda s: [
            "unknown" in a.verdict for t, a in of(s, "unknown", clear=True)
        ],
        "fault called physics or reverse": lambda s: [crossed(t, a) for t, a in of(s, *one, clear=True)],
        "every wild reading found": lambda s: [outliers_found(t, a) == 1 for t, a in s if t.outliers],
        "cases with good readings flagged": lambda s: [outliers_false(t, a) > 0 for t, a in s],
    }
    width = max(17, *(len(name) + 2 for name in pairs))
    lines = [f"{title:36s}" + "".join(f"{name:>{width}s}" for name in pairs)]
    for text, ask in questions.items():
        lines.append(f"{text:36s}" + "".join(f"{_count(ask(some)):>{width}s}" for some in pairs.values()))
    return "\n".join(lines) + "\n"


def by_form(pairs: Mapping[str, Sequence[Pair]]) -> str:
    """Counts by form of a single effect: right, right or tied, identifiable cases, cases."""
    found: dict[tuple[str, str], list[Pair]] = {}
    for truth, answer in (pair for some in pairs.values() for pair in some):
        if truth.group in ("single", "measurement") and truth.forms:
            found.setdefault((truth.effects[0], truth.forms[0]), []).append((truth, answer))
    lines = [f"{'by form':28s}  {'source':64s}  right  tied  identifiable  cases"]
    for (effect, source), some in sorted(found.items()):
        counts = (
            sum(right(t, a) for t, a in some),
            sum(tied(t, a) for t, a in some),
            sum(t.identifiable for t, _ in some),
            len(some),
        )
        lines.append(f"{effect:28s}  {source:64s}  {counts[0]:5d}  {counts[1]:4d}  {counts[2]:12d}  {counts[3]:5d}")
    return "\n".join(lines) + "\n"


def _named(label: frozenset[str]) -> str:
    return "+".join(sorted(label))


def wrong(pairs: Mapping[str, Sequence[Pair]]) -> str:
    """List of wrong verdicts: truth, verdict, other tied explanations, largest probabilities."""
    lines = ["verdicts that are not the truth (* identifiable; vis: visibility of the effect)"]
    for kind, some in pairs.items():
        for truth, answer in sorted(some, key=lambda pair: pair[0].case):
            if right(truth, answer) or (truth.group == "unknown" and "unknown" in answer.verdict):
                continue
            mark = "*" if truth.identifiable else " "
            more = ", ".join(_named(one) for one in answer.tied[1:])
            ranked = sorted(answer.probabilities.items(), key=lambda item: -item[1])[:3]
            shares = ", ".join(f"{name} {p:.2f}" for name, p in ranked)
            lines.append(
                f"{truth.case} {kind:16s} {truth.group:11s}{mark} vis {truth.visibility:5.1f}  {_named(truth.label)}"
                f" -> {_named(answer.verdict)}"
                + (f"  tied: {more}" if more else "")
                + f"  [{shares}]"
                + (f"  follows {_named(truth.laws)}" if truth.laws else "")
            )
    return "\n".join(lines) + "\n"
