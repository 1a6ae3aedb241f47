"""Complete validation in one call: deal a battery, have it diagnosed, score it next to the baselines."""

from __future__ import annotations

import json
import shutil
import time
import traceback
from collections.abc import Callable, Sequence
from concurrent.futures import as_completed
from dataclasses import dataclass
from pathlib import Path

from mixedlub.validation.answers import Truth, read_answer, read_truth, silent
from mixedlub.validation.baselines import BASELINES, RIGS, refuse_without_learners
from mixedlub.validation.battery import MARK, generate, plan, read_mark, workers
from mixedlub.validation.measures import Pair
from mixedlub.validation.oracle import oracle
from mixedlub.validation.outside import OUTSIDE_FIGURES
from mixedlub.validation.poor import POOR_FIGURES
from mixedlub.validation.rigs import CONTACTS, KINDS
from mixedlub.validation.sample_case import Order
from mixedlub.validation.score import FIGURES, Measured, Score, score
from mixedlub.validation.solved.figures import SOLVED_FIGURES
from mixedlub.validation.tables import by_form, counts, wrong
from mixedlub.validation.worlds.figures import WORLD_FIGURES
from profiles.errors import InputError

Diagnose = Callable[[Path, Path], object]
Progress = Callable[[str, int, int], None]
TOOL = "mixedlub diagnose"
CEILING = "oracle"
BROKEN, REFUSED = "broken.txt", "refused.txt"
FIGURES_BY: dict[str, tuple[Measured, ...]] = {
    "plan": FIGURES,
    "plan_worlds": WORLD_FIGURES,
    "plan_poor": POOR_FIGURES,
    "plan_forms": FIGURES,
    "plan_outside": OUTSIDE_FIGURES,
    "plan_solved": SOLVED_FIGURES,
}
"""Figures of each battery by the name of its planner."""


def quiet(stage: str, done: int, total: int) -> None:
    """Report no progress."""


@dataclass(frozen=True)
class Steady:
    """A diagnosis that writes its error as the answer to a case that it refuses or breaks down on."""

    diagnose: Diagnose

    def __call__(self, case: Path, out: Path) -> None:
        try:
            self.diagnose(case, out)
        except InputError as refusal:
            (out / REFUSED).write_text(str(refusal), encoding="utf-8")
        # Any error of the tool under test is its failure on this case, not the end of the validation.
        except Exception:
            (out / BROKEN).write_text(traceback.format_exc(), encoding="utf-8")


def unsealed(case: Path, into: Path) -> Path:
    """Copy of a case folder without its truth, for the tool under test."""
    target = into / case.name
    if not target.exists():
        aside = into / f".{case.name}"
        shutil.rmtree(aside, ignore_errors=True)
        shutil.copytree(case, aside, ignore=shutil.ignore_patterns("truth.json"))
        aside.rename(target)
    return target


def answer(diagnose: Diagnose, case: Path, out: Path) -> str:
    """Have a case answered and timed unless already answered; the answer appears whole or not at all."""
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
    """Have all cases answered by one tool, in ``jobs`` processes (the tool must then be importable)."""
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


def answered(diagnose: Diagnose, sealed: Sequence[Path], out: Path, jobs: int, progress: Progress) -> list[Path]:
    """Have copies of the sealed cases answered into ``answers``, and return these copies."""
    (out / "cases").mkdir(parents=True, exist_ok=True)
    cases = [unsealed(case, out / "cases") for case in sealed]
    answer_all(Steady(diagnose), cases, out / "answers", jobs, "diagnose", progress)
    return cases


def failure(out: Path, case: str) -> tuple[str, str]:
    """File of a breakdown or refusal on a case and its last line; both empty if the case was answered."""
    for name in (BROKEN, REFUSED):
        file = out / "answers" / case / name
        if file.exists():
            return name, file.read_text(encoding="utf-8").strip().splitlines()[-1].replace(f"{out}/", "")
    return "", ""


def validate(
    out: Path,
    diagnose: Diagnose,
    cases: int,
    seed: int,
    kinds: Sequence[str] = CONTACTS,
    jobs: int = 2,
    baselines: bool = False,
    progress: Progress = quiet,
    dealt: Callable[[int, int, Sequence[str]], list[Order]] = plan,
) -> dict[str, Score]:
    """Deal, diagnose, score and draw into ``out``; an interrupted run is resumed.

    ``dealt`` gives the orders of the cases: rigs of the base model, or of other laws. Returns the scores written by
    ``judge``. ``baselines`` are answered too, and last the oracle that knows the planted laws, on kinds of rig that
    their case folder describes completely.
    """
    if baselines:
        if not set(kinds) <= set(RIGS):
            raise InputError(f"baselines have models of {' and '.join(RIGS)} alone", where="kinds", value=list(kinds))
        refuse_without_learners()

    def deal(done: int, total: int) -> None:
        progress("deal", done, total)

    sealed = generate(out / "sealed", seed, cases, kinds, jobs, deal, dealt)
    open_cases = answered(diagnose, sealed, out, jobs, progress)
    rivals = {name: out / "baselines" / name.replace(" ", "_") for name in (*BASELINES, CEILING) if baselines}
    for name, answers in rivals.items():
        answer_all({**BASELINES, CEILING: oracle}[name], open_cases, answers, jobs, name, progress)
    return judge(out, sealed, rivals)


def _collected(out: Path, truths: Sequence[Truth]) -> tuple[dict[str, list[Pair]], dict[str, list[str]]]:
    """Truths with their answers by kind, and a line for each case that the tool broke down on or refused."""
    dealt = {truth.kind for truth in truths}
    pairs: dict[str, list[Pair]] = {kind: [] for kind in KINDS if kind in dealt}
    failed: dict[str, list[str]] = {BROKEN: [], REFUSED: []}
    for truth in truths:
        kept, last = failure(out, truth.case)
        if kept:
            line = f"{truth.case} {truth.kind:16s} {truth.group:11s}  {'+'.join(truth.effects)} -> {last}"
            failed[kept].append(line)
        if kept != REFUSED:
            answer = silent(truth) if kept else read_answer(out / "answers" / truth.case)
            pairs[truth.kind].append((truth, answer))
    return pairs, failed


def figures_of(sealed: Path) -> tuple[Measured, ...]:
    """Figures of the battery in a folder, by the planner that dealt it."""
    name = read_mark(sealed)["dealt_by"]
    if name not in FIGURES_BY:
        raise InputError(f"must be among {', '.join(FIGURES_BY)}", where=f"{sealed / MARK}: dealt_by", value=name)
    return FIGURES_BY[name]


def judge(out: Path, sealed: Sequence[Path], rivals: dict[str, Path] | None = None) -> dict[str, Score]:
    """Scores of the answers: over all cases as ``all``, by kind, and of each rival over all by its name.

    A breakdown counts as a wrong answer, a refused case is not counted. Writes ``score.json``, ``score_NAME.json`` for
    each of the others, ``score.txt`` with all figures, counts by kind and form and wrong answers, and SVG figures. The
    file beside the ``sealed`` cases names the battery, which decides the figures.
    """
    folders = sorted({str(case.parent) for case in sealed})
    if len(folders) != 1:
        raise InputError("cases of one battery are needed, in one folder", where="sealed", value=folders)
    figures = figures_of(Path(folders[0]))
    truths = [read_truth(case) for case in sealed]
    ids = sorted({name for truth in truths for name in truth.candidates})
    pairs, failed = _collected(out, truths)
    every_pair = [pair for some in pairs.values() for pair in some]
    unnamed = {f"{kind}, unnamed": [pair for pair in some if pair[0].no_data_sheet] for kind, some in pairs.items()}
    flaws = sorted({flaw for truth in truths for flaw in truth.flaws})
    flawed = {flaw: [pair for pair in every_pair if flaw in pair[0].flaws] for flaw in flaws}
    scores = {"all": score(every_pair, TOOL, ids, figures)}
    scores |= {kind: score(some, f"{TOOL}, {kind}", ids, figures) for kind, some in pairs.items() if some}
    others = {
        name: score([(truth, read_answer(answers / truth.case)) for truth in truths], name, ids)
        for name, answers in (rivals or {}).items()
    }
    baselines = [one for name, one in others.items() if name != CEILING]
    scores["all"] = scores["all"].above(baselines) if baselines else scores["all"]
    scores |= others
    text = [scores["all"].text(), *(one.text() for one in others.values())]
    text += [
        counts({**pairs, **{name: some for name, some in unnamed.items() if some}}),
        *([counts(flawed, "by flaw")] if flawed else []),
        by_form(pairs),
        wrong(pairs),
    ]
    text += ["broke down without an answer, counted as wrong above", *failed[BROKEN], ""] if failed[BROKEN] else []
    text += ["refused as bad input, not counted above", *failed[REFUSED], ""] if failed[REFUSED] else []
    (out / "score.txt").write_text("\n".join(text), encoding="utf-8")
    for name, one in scores.items():
        one.save(out / ("score.json" if name == "all" else f"score_{name.replace(' ', '_')}.json"))
    draw(out / "figures", [scores["all"], *others.values()])
    return scores


def draw(folder: Path, scores: Sequence[Score]) -> None:
    """Draw the figures of the scores, the tool's first."""
    from mixedlub.validation import figures

    folder.mkdir(exist_ok=True)
    figures.score_table(scores).savefig(folder / "score_table.svg")
    figures.reliability(scores).savefig(folder / "reliability.svg")
    figures.identification(scores).savefig(folder / "identification.svg")
    figures.confusion(scores[0]).savefig(folder / "confusion.svg")
