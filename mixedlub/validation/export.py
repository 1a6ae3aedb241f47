"""Batteries as a benchmark for other programs: an open part with truths, a blind part, scorer, and data card."""

from __future__ import annotations

import json
import shutil
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.validation import benchmark_entrant, benchmark_scorer
from mixedlub.validation.answers import Truth, read_truth
from mixedlub.validation.baselines import BASELINES, RIGS
from mixedlub.validation.battery import generate, plan
from mixedlub.validation.planted import MEASUREMENT
from mixedlub.validation.rig import NAMES
from mixedlub.validation.run import Progress, answer_all, quiet, unsealed
from mixedlub.validation.sample_case import Order
from profiles.errors import InputError

OPEN_SHARE = 1 / 3
"""Judgement. Share of the cases with an open truth, for the entrants to learn from."""
ABOUT = "benchmark.json"
CHEAP = "recalibration only"
"""Baseline that takes a second a case; the others take minutes and scikit-learn."""
NOTHING = "nothing is missing"
FILES = {
    "system.toml": "the rig: kind, contact or gears, oil, surfaces, known uncertainty and noise",
    "recordings.csv": "the readings with their conditions",
    "conditions.csv": "conditions whose readings are withheld, to be predicted",
    "load_share.csv": "gear cases: load shares of the tooth pairs",
    "truth.json": "open part: what was planted, the calibration, the outliers, and the noise-free reading of every run",
}


def export(
    out: Path,
    cases: int,
    seed: int,
    kinds: Sequence[str],
    jobs: int = 2,
    baselines: bool = True,
    progress: Progress = quiet,
    dealt: Callable[[int, int, Sequence[str]], list[Order]] = plan,
) -> list[dict[str, Any]]:
    """Write ``benchmark``, to be given away, and ``sealed``, to be kept; returns the scores of the baselines.

    The same seed gives the same files. The seed stands in ``sealed`` alone, since it deals the truths again.
    """
    if any(out.iterdir() if out.is_dir() else ()) and not (out / "sealed" / "battery.json").exists():
        raise InputError("holds other files; name a new folder", where=str(out))

    def deal(done: int, total: int) -> None:
        progress("deal", done, total)

    folders = generate(out / "sealed", seed, cases, kinds, jobs, deal, dealt)
    n_open = round(OPEN_SHARE * len(folders))
    opened, blind = folders[:n_open], folders[n_open:]
    truths = {folder.name: read_truth(folder) for folder in folders}
    about = _about(list(truths.values()), dealt.__name__)
    given = out / "benchmark"
    for folder in opened:
        shutil.copytree(folder, given / "open" / folder.name, dirs_exist_ok=True)
    (given / "blind").mkdir(parents=True, exist_ok=True)
    answered = [unsealed(folder, given / "blind") for folder in blind]
    scripts = {"score.py": benchmark_scorer, "entrant.py": benchmark_entrant}
    texts = {name: Path(str(module.__file__)).read_text(encoding="utf-8") for name, module in scripts.items()}
    texts[ABOUT] = json.dumps(about, indent=1)
    sealed = _sealed_truths(blind, out)
    scores = [_scored(name, answered, out, sealed, about, jobs, progress) for name in _rivals(kinds, baselines)]
    texts["baselines.json"] = json.dumps(scores, indent=1)
    texts["README.md"] = card([truths[f.name] for f in opened], [truths[f.name] for f in blind], scores, dealt.__name__)
    for name, text in texts.items():
        (given / name).write_text(text, encoding="utf-8")
    return scores


def _about(truths: Sequence[Truth], dealing: str) -> dict[str, Any]:
    """Facts that the scorer needs: ids of effects, of instrument faults and of other laws."""
    follows = any(truth.laws for truth in truths)
    return {
        "format": "mixedlub-benchmark/1",
        "dealt_by": dealing,
        "ids": sorted({name for truth in truths for name in truth.candidates}),
        "measurement": sorted(MEASUREMENT),
        "laws": sorted(NAMES),
        "follows_other_laws": follows,
    }


def _sealed_truths(blind: Sequence[Path], out: Path) -> Path:
    """Folder with the truths of the blind cases alone, for the scorer."""
    for folder in blind:
        place = out / "sealed" / "blind_truth" / folder.name
        place.mkdir(parents=True, exist_ok=True)
        shutil.copy(folder / "truth.json", place)
    return out / "sealed" / "blind_truth"


def _rivals(kinds: Sequence[str], baselines: bool) -> tuple[str, ...]:
    return (NOTHING, CHEAP) if baselines and set(kinds) <= set(RIGS) else (NOTHING,)


def _scored(
    name: str, cases: Sequence[Path], out: Path, truths: Path, about: dict[str, Any], jobs: int, progress: Progress
) -> dict[str, Any]:
    """Score of a baseline on the blind part."""
    answers = out / "sealed" / "answers" / name.replace(" ", "_")
    if name == NOTHING:
        benchmark_entrant.main(cases[0].parent, answers)
    else:
        answer_all(BASELINES[name], cases, answers, jobs, name, progress)
    return {"name": name, "figures": benchmark_scorer.scored(answers, truths, about)}


def card(opened: Sequence[Truth], blind: Sequence[Truth], scores: Sequence[dict[str, Any]], dealing: str) -> str:
    """Data card with the way to enter."""
    counts = {name: Counter(t.kind for t in some) for name, some in (("open", opened), ("blind", blind))}
    kinds = sorted({truth.kind for truth in (*opened, *blind)})
    readings = np.median([int((~truth.withheld).sum()) for truth in (*opened, *blind)])
    lines = [
        "# Missing physics in rigs: a benchmark",
        "",
        "Each case is a simulated rig with its recording. Between the base model that the case describes and the rig",
        "that made the readings there is a difference: an effect, two, a fault of an instrument, an effect outside any",
        "list, or nothing. Say which, how sure you are, and predict the withheld readings.",
        "",
        "## Contents",
        "",
        "| part | cases | what |",
        "|---|---|---|",
        f"| `open` | {len(opened)} | cases with their truths, to learn from |",
        f"| `blind` | {len(blind)} | cases without truths, to be answered |",
        "| `score.py` | | the scorer; needs Python alone |",
        "| `entrant.py` | | the smallest entry, to start from |",
        f"| `{ABOUT}` | | ids of the effects, faults and laws |",
        "| `baselines.json` | | scores of baselines on the blind part |",
        "",
        *(f"- `{name}`: {words}" for name, words in FILES.items()),
        "",
        "## Enter",
        "",
        "1. Write a program that reads a case folder and writes `ANSWERS/CASE/diagnosis.json`: `verdict` (ids, or",
        "   `none`, or `unknown`), `tied` (explanations that the data do not separate, the verdict first),",
        "   `probabilities` (by id, with `none` and `unknown`), `mismatch.detected`, `outlier_runs`, and",
        "   `location.rows` (run to the size of what is missing, in standard deviations).",
        "2. If it predicts, `ANSWERS/CASE/predictions.csv` with `run, predicted, low90, high90` for the runs of",
        "   `conditions.csv`: the prediction and its 90 % interval for a reading, which holds the prediction. A case",
        "   without it counts as the base model, with its true parameters, if other cases are predicted.",
        "3. Try it on the open part: `python entrant.py open ANSWERS`, then `python score.py ANSWERS`.",
        "4. Answer the blind part: `python entrant.py blind ANSWERS`, then `python score.py ANSWERS --check blind`.",
        "5. Send ANSWERS to the author of this folder, who scores them: `python score.py ANSWERS --truth TRUTHS`.",
        "",
        "## Data card",
        "",
        f"- Dealt by `{dealing}` of mixedlub. The rigs are a second model, written apart from it, with another",
        "  discretisation; effects are planted in published forms, and in forms outside the package's list.",
        f"- {readings:g} readings a case (median). Noise is stated, as a share and an absolute part, by a column of",
        "  standard deviations, or by repeats alone.",
        "- An effect is identifiable if no other explanation comes within 9 of its noise-free chi-square.",
        "- Nothing was measured on a machine: a good score here is no proof on real recordings.",
        "- The data are free of rights of others and may be used under the licence of mixedlub, MIT.",
        "",
        "| kind | open | blind |",
        "|---|---|---|",
        *(f"| {kind} | {counts['open'][kind]} | {counts['blind'][kind]} |" for kind in kinds),
        "",
        "## Baselines on the blind part",
        "",
    ]
    lines += [f"### {one['name']}\n\n```\n{benchmark_scorer.table(one['figures'])}\n```\n" for one in scores]
    return "\n".join(lines)
