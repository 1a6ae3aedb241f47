"""The proof on the other kinds of case: deal, have them diagnosed, score over all and by kind, list what is wrong."""

from __future__ import annotations

import json
import traceback
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from mixedlub.validation.answers import Answer, Truth, read_answer, read_truth, silent
from mixedlub.validation.measures import crossed, outliers_false, outliers_found, right, tied
from mixedlub.validation.prove import TOOL, Diagnose, Progress, have_answered, quiet
from mixedlub.validation.rigs.battery import ROOMS, generate
from mixedlub.validation.score import Score, score
from profiles.errors import InputError

Pair = tuple[Truth, Answer]
SHOWN = 3
BROKEN, REFUSED = "broken.txt", "refused.txt"


def prove_rigs(
    out: Path, diagnose: Diagnose, cases: int, seed: int, jobs: int = 2, progress: Progress = quiet
) -> dict[str, Score]:
    """The score over all kinds under ``all``, then one a kind; a run broken off goes on where it stopped.

    Writes ``score.json`` and ``score_KIND.json``, ``score.txt`` with all figures, the counts by kind and the
    wrong answers.
    """
    sealed = generate(out / "sealed", seed, cases, jobs, lambda done, total: progress("deal", done, total))
    have_answered(out, sealed, Steady(diagnose), jobs, progress)
    return judge(out, sealed)


@dataclass(frozen=True)
class Steady:
    """A diagnosis that refuses a case or breaks down on it leaves what it said instead, and the proof goes on."""

    diagnose: Diagnose

    def __call__(self, case: Path, out: Path) -> None:
        try:
            self.diagnose(case, out)
        except InputError as refusal:
            (out / REFUSED).write_text(str(refusal), encoding="utf-8")
        # Whatever goes wrong in the tool on trial is its failure on this case and no end of the trial.
        except Exception:
            (out / BROKEN).write_text(traceback.format_exc(), encoding="utf-8")


def judge(out: Path, sealed: Sequence[Path]) -> dict[str, Score]:
    """Scores of the answers: a case the tool broke down on is answered wrong, one it refused is no case."""
    pairs: dict[str, list[Pair]] = {kind: [] for kind in ROOMS}
    unnamed: list[Pair] = []
    asked: set[str] = set()
    broken: list[str] = []
    refused: list[str] = []
    for case in sealed:
        told = json.loads((case / "truth.json").read_text(encoding="utf-8"))
        asked |= {name for name in told["alternatives"] if name != "none" and "+" not in name}
        asked |= set(told["effects"]) if told["class"] != "unknown" else set()
        answered = out / "answers" / case.name
        for name, those in ((BROKEN, broken), (REFUSED, refused)):
            if (answered / name).exists():
                last = (answered / name).read_text(encoding="utf-8").strip().splitlines()[-1].replace(f"{out}/", "")
                those.append(
                    f"{case.name} {told['rig']:16s} {told['class']:11s}  {'+'.join(told['effects'])} -> {last}"
                )
        if (answered / REFUSED).exists():
            continue
        truth = read_truth(case)
        pair = truth, silent(truth) if (answered / BROKEN).exists() else read_answer(answered)
        pairs[told["rig"]].append(pair)
        unnamed += [pair] if told.get("unnamed_oil") else []
    ids = sorted(asked)
    whole = [pair for kind in pairs.values() for pair in kind]
    scores = {"all": score(whole, TOOL, ids)}
    scores |= {kind: score(some, f"{TOOL}, {kind}", ids) for kind, some in pairs.items() if some}
    scores["all"].save(out / "score.json")
    for kind in pairs:
        if kind in scores:
            scores[kind].save(out / f"score_{kind}.json")
    columns = {**pairs, "film, unnamed": unnamed} if unnamed else pairs
    text = [scores["all"].text(), by_kind(columns), wrong(pairs)]
    text += ["broke down without an answer, counted as wrong above", *broken, ""] if broken else []
    text += ["refused as bad input, counted nowhere above", *refused, ""] if refused else []
    (out / "score.txt").write_text("\n".join(text), encoding="utf-8")
    return scores


def _count(hits: Sequence[bool]) -> str:
    return f"{sum(hits)}/{len(hits)}" if hits else "-"


def by_kind(pairs: dict[str, list[Pair]]) -> str:
    """Counts by kind, one line a question."""

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
        "none where nothing is missing": lambda s: [right(t, a) for t, a in of(s, "none")],
        "false alarms": lambda s: [a.detected for t, a in of(s, "none")],
        "unknown where so and identifiable": lambda s: [
            "unknown" in a.verdict for t, a in of(s, "unknown", clear=True)
        ],
        "fault called physics or reverse": lambda s: [crossed(t, a) for t, a in of(s, *one, clear=True)],
        "every wild reading found": lambda s: [outliers_found(t, a) == 1 for t, a in s if t.outliers],
        "cases with good readings flagged": lambda s: [outliers_false(t, a) > 0 for t, a in s],
    }
    lines = [f"{'by kind':36s}" + "".join(f"{kind:>17s}" for kind in pairs)]
    for text, ask in questions.items():
        lines.append(f"{text:36s}" + "".join(f"{_count(ask(some)):>17s}" for some in pairs.values()))
    return "\n".join(lines) + "\n"


def _named(label: frozenset[str]) -> str:
    return "+".join(sorted(label))


def wrong(pairs: dict[str, list[Pair]]) -> str:
    """Every case whose verdict is not the truth: truth, verdict, what is tied, the largest probabilities."""
    lines = ["verdicts that are not the truth (* identifiable; vis: sds the effect stands out by)"]
    for kind, some in pairs.items():
        for truth, answer in sorted(some, key=lambda pair: pair[0].case):
            if right(truth, answer) or (truth.group == "unknown" and "unknown" in answer.verdict):
                continue
            mark = "*" if truth.identifiable else " "
            more = ", ".join(_named(one) for one in answer.tied[1:])
            ranked = sorted(answer.probabilities.items(), key=lambda item: -item[1])[:SHOWN]
            shares = ", ".join(f"{name} {p:.2f}" for name, p in ranked)
            lines.append(
                f"{truth.case} {kind:16s} {truth.group:11s}{mark} vis {truth.visibility:5.1f}  {_named(truth.label)}"
                f" -> {_named(answer.verdict)}" + (f"  tied: {more}" if more else "") + f"  [{shares}]"
            )
    return "\n".join(lines) + "\n"
