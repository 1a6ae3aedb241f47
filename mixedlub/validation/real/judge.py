"""The battery on real recordings in one call: deal, diagnose, score."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

from mixedlub.validation.real.deal import CLASSES, deal
from mixedlub.validation.real.figures import FIGURES, Located, Pair, Truth, read_located, read_truth, right
from mixedlub.validation.real.source import SPLITS, Recording, licences, recordings
from mixedlub.validation.run import Diagnose, Progress, answered, failure, quiet
from mixedlub.validation.score import Score, finite
from profiles.errors import InputError

TOOL = "mixedlub diagnose"


def validate(
    folder: Path, out: Path, diagnose: Diagnose, split: str, seed: int, jobs: int = 2, progress: Progress = quiet
) -> Score:
    """Deal, diagnose and score the recordings of one split; an interrupted run is resumed."""
    if split not in SPLITS:
        raise InputError(f"must be among {', '.join(SPLITS)}", where="--split", value=split)
    found = [one for one in recordings(folder) if one.split == split]
    sealed = deal(found, out / "sealed", seed)
    answered(diagnose, sealed, out, jobs, progress)
    return judge(out, sealed, found)


def judge(out: Path, sealed: Sequence[Path], found: Sequence[Recording]) -> Score:
    """Score of the answers; writes ``score.txt`` and ``score.json``.

    Wrong answers are listed one by one on sources of the development alone, so that those of the test stay unseen.
    """
    pairs: list[Pair] = []
    failed: list[str] = []
    for truth in map(read_truth, sealed):
        kept, last = failure(out, truth.case)
        if kept:
            failed.append(f"{_told(truth)}  {kept.removesuffix('.txt')}: {last}")
        else:
            pairs.append((truth, read_located(out / "answers" / truth.case)))
    if not pairs:
        raise InputError("there is no answered case to score", where=str(out))
    score = Score(TOOL, tuple(figure.row(pairs) for figure in FIGURES), (), (), {})
    text = [score.text(), _by_kind(pairs)]
    if found[0].split == SPLITS[0]:
        text += ["answers that are not right", *map(_wrong, (p for p in pairs if not right(*p))), ""]
    text += ["refused or broken, not counted above", *failed, ""] if failed else []
    text += ["sources", *licences(found), ""]
    (out / "score.txt").write_text("\n".join(text), encoding="utf-8")
    rows = [{**asdict(row), "met": row.met} for row in score.rows]
    record = {"tool": TOOL, "split": found[0].split, "cases": len(pairs), "rows": finite(rows)}
    (out / "score.json").write_text(json.dumps(record, indent=1, allow_nan=False), encoding="utf-8")
    return score


def _by_kind(pairs: Sequence[Pair]) -> str:
    """Right answers over cases, one line a kind, one column a class."""
    kinds = sorted({truth.kind for truth, _ in pairs})
    lines = [f"{'right answers':18s}" + "".join(f"{label:>12s}" for label in CLASSES)]
    for kind in kinds:
        of = [[right(t, a) for t, a in pairs if t.kind == kind and t.label == label] for label in CLASSES]
        lines.append(f"{kind:18s}" + "".join(f"{f'{sum(hits)}/{len(hits)}' if hits else '-':>12s}" for hits in of))
    return "\n".join(lines) + "\n"


def _told(truth: Truth) -> str:
    return f"{truth.case} {truth.recording:52s} {truth.label:9s}"


def _wrong(pair: Pair) -> str:
    truth, found = pair
    wanted = "+".join(sorted(truth.right)) or "-"
    wanted += " or unknown" if truth.unknown_right else ""
    ranked = sorted(found.answer.probabilities.items(), key=lambda item: -item[1])[:3]
    shares = ", ".join(f"{name} {p:.2f}" for name, p in ranked)
    mark = " " if truth.identifiable else "~"
    return f"{_told(truth)}{mark} {wanted} -> {_named(found)}  [{shares}]  at {', '.join(found.places[:2])}"


def _named(found: Located) -> str:
    return " | ".join("+".join(sorted(one)) for one in (found.answer.verdict, *found.answer.tied[1:]))
