"""The whole proof in one call: deal the battery, have it diagnosed, score it beside the baselines."""

from __future__ import annotations

import json
import shutil
import time
from collections.abc import Callable, Sequence
from concurrent.futures import as_completed
from pathlib import Path

from mixedlub.validation.answers import Truth, read_answer, read_truth
from mixedlub.validation.baselines import BASELINES, refuse_without_learners
from mixedlub.validation.battery import generate
from mixedlub.validation.oracle import oracle
from mixedlub.validation.score import Score, score
from mixedlub.validation.workers import workers

Diagnose = Callable[[Path, Path], object]
Progress = Callable[[str, int, int], None]
TOOL = "mixedlub diagnose"
CEILING = "oracle"


def quiet(stage: str, done: int, total: int) -> None:
    """Progress to nobody."""


def unsealed(case: Path, into: Path) -> Path:
    """A copy of a case folder without its truth: what a tool is given."""
    place = into / case.name
    if not place.exists():
        aside = into / f".{case.name}"
        shutil.rmtree(aside, ignore_errors=True)
        shutil.copytree(case, aside, ignore=shutil.ignore_patterns("truth.json"))
        aside.rename(place)
    return place


def answer(diagnose: Diagnose, case: Path, out: Path) -> str:
    """Have one case answered and timed, unless it was before; the answer appears whole or not at all."""
    if (out / "seconds.json").exists():
        return case.name
    aside = out.parent / f".{out.name}"
    shutil.rmtree(aside, ignore_errors=True)
    shutil.rmtree(out, ignore_errors=True)
    aside.mkdir(parents=True)
    begun = time.perf_counter()
    diagnose(case, aside)
    (aside / "seconds.json").write_text(json.dumps(round(time.perf_counter() - begun, 3)), encoding="utf-8")
    aside.rename(out)
    return case.name


def answer_all(diagnose: Diagnose, cases: Sequence[Path], out: Path, jobs: int, name: str, progress: Progress) -> None:
    """Answers of one tool to all cases, in ``jobs`` processes (the tool must then be importable)."""
    out.mkdir(parents=True, exist_ok=True)
    if jobs == 1:
        for done, case in enumerate(cases):
            answer(diagnose, case, out / case.name)
            progress(name, done + 1, len(cases))
        return
    with workers(jobs) as pool:
        work = [pool.submit(answer, diagnose, case, out / case.name) for case in cases]
        for done, future in enumerate(as_completed(work)):
            future.result()
            progress(name, done + 1, len(cases))


def have_answered(out: Path, sealed: Sequence[Path], diagnose: Diagnose, jobs: int, progress: Progress) -> list[Path]:
    """Have sealed cases answered into ``out/answers``; returns their copies without the truth."""
    opened = out / "cases"
    opened.mkdir(parents=True, exist_ok=True)
    given = [unsealed(case, opened) for case in sealed]
    answer_all(diagnose, given, out / "answers", jobs, "diagnose", progress)
    return given


def scored(truths: Sequence[Truth], answers: Path, tool: str) -> Score:
    """The score of the answers in a folder, one sub-folder a case."""
    return score([(truth, read_answer(answers / truth.case)) for truth in truths], tool)


def prove(
    out: Path,
    diagnose: Diagnose,
    cases: int,
    seed: int,
    jobs: int = 2,
    baselines: bool = True,
    progress: Progress = quiet,
) -> list[Score]:
    """Deal, diagnose, score and draw into ``out``; a run broken off goes on where it stopped.

    Returns the tool's score first, then one a baseline, last the oracle that knows the hidden laws. Writes
    ``score.json``, ``score.txt``, one ``score_NAME.json`` a baseline and the figures as SVG.
    """
    if baselines:
        refuse_without_learners()
    sealed = generate(out / "sealed", seed, cases, jobs, lambda done, total: progress("deal", done, total))
    given = have_answered(out, sealed, diagnose, jobs, progress)
    truths = [read_truth(case) for case in sealed]
    scores = [scored(truths, out / "answers", TOOL)]
    for name, method in {**BASELINES, CEILING: oracle}.items() if baselines else ():
        place = out / "baselines" / name.replace(" ", "_")
        answer_all(method, given, place, jobs, name, progress)
        scores.append(scored(truths, place, name))
    if baselines:
        scores[0] = scores[0].above(scores[1:-1])
    write(out, scores)
    return scores


def write(out: Path, scores: Sequence[Score]) -> None:
    """Tables and figures of the scores, the tool's first."""
    from mixedlub.validation import figures

    scores[0].save(out / "score.json")
    (out / "score.txt").write_text("\n".join(one.text() for one in scores), encoding="utf-8")
    for one in scores[1:]:
        one.save(out / f"score_{one.tool.replace(' ', '_')}.json")
    pictures = out / "figures"
    pictures.mkdir(exist_ok=True)
    figures.score_table(scores).savefig(pictures / "score_table.svg")
    figures.reliability(scores).savefig(pictures / "reliability.svg")
    figures.identification(scores).savefig(pictures / "identification.svg")
    figures.confusion(scores[0]).savefig(pictures / "confusion.svg")
