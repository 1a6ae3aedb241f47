"""Score the answers of a program to a benchmark: python score.py ANSWERS [--truth FOLDER | --check FOLDER].

ANSWERS holds a folder for each case with diagnosis.json and, if readings are predicted, predictions.csv. This file
needs Python 3.11 alone, no package. It is copied into every exported benchmark as score.py.
"""

from __future__ import annotations

import argparse
import csv
import json
import math
import sys
from pathlib import Path
from statistics import NormalDist, median
from typing import Any

FLOOR = 1e-4
"""Definition. Least probability in the log score."""
NEAR_ONE = 0.9
"""Definition. Probability from which an answer claims something."""
LEAST_SHARE = 0.1
"""Definition. Share of readings off and not off from which a location is scored."""
NO_EFFECT = {"none", "unknown"}
Case = dict[str, Any]


class Wrong(Exception):
    """Answers that cannot be scored: file and rule."""


def names(label: Any) -> frozenset[str]:
    """Ids of an explanation, which may be a single text."""
    return frozenset([label] if isinstance(label, str) else label)


def read_json(file: Path) -> Any:
    """Content of a JSON file."""
    try:
        return json.loads(file.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise Wrong(f"{file}: is missing") from None
    except ValueError as error:
        raise Wrong(f"{file}: is no JSON ({error})") from None


def read_answer(folder: Path) -> Case:
    """Answer to a case: verdict, probabilities and optional parts."""
    file = folder / "diagnosis.json"
    record = table_of(file, "the file", read_json(file))
    for key in ("verdict", "probabilities"):
        if key not in record:
            raise Wrong(f"{file}: key {key!r} is missing")
    verdict = ids_of(file, "verdict", record["verdict"])
    tied, outliers = record.get("tied", []), record.get("outlier_runs", [])
    if not isinstance(tied, list):
        raise Wrong(f"{file}: tied must be a list of explanations")
    probabilities = table_of(file, "probabilities", record["probabilities"])
    if not all(type(p) in (int, float) and 0.0 <= p <= 1.0 for p in probabilities.values()):
        raise Wrong(f"{file}: probabilities must be numbers from 0 to 1")
    detected = table_of(file, "mismatch", record.get("mismatch", {})).get("detected", verdict != {"none"})
    if not isinstance(detected, bool):
        raise Wrong(f"{file}: mismatch.detected must be true or false")
    located = table_of(file, "location", record.get("location", {})).get("rows", {})
    try:
        location = {int(run): float(z) for run, z in table_of(file, "location.rows", located).items()}
    except (TypeError, ValueError, OverflowError):
        raise Wrong(f"{file}: location.rows must be numbers by run") from None
    if not (isinstance(outliers, list) and all(type(run) is int for run in outliers)):
        raise Wrong(f"{file}: outlier_runs must be a list of runs")
    return {
        "verdict": verdict,
        "tied": [ids_of(file, "tied", one) for one in tied],
        "probabilities": probabilities,
        "detected": detected,
        "outliers": set(outliers),
        "location": location,
        "predictions": read_predictions(folder / "predictions.csv"),
    }


def table_of(file: Path, key: str, value: Any) -> Case:
    """Value that must be a JSON object."""
    if not isinstance(value, dict):
        raise Wrong(f"{file}: {key} must be an object with keys")
    return value


def ids_of(file: Path, key: str, label: Any) -> frozenset[str]:
    """Ids of an explanation of an answer."""
    ids = [label] if isinstance(label, str) else label
    if not (isinstance(ids, list) and ids and all(isinstance(one, str) for one in ids)):
        raise Wrong(f"{file}: an explanation in {key} must be an id or a list of ids")
    return names(ids)


def read_predictions(file: Path) -> dict[int, dict[str, float]]:
    """Predicted readings by run; empty without a file."""
    if not file.exists():
        return {}
    wanted = ("predicted", "low90", "high90")
    try:
        with file.open(encoding="utf-8", newline="") as stream:
            found = {int(row["run"]): {name: float(row[name]) for name in wanted} for row in csv.DictReader(stream)}
    except (KeyError, TypeError, ValueError, csv.Error) as error:
        raise Wrong(f"{file}: needs numbers in run, predicted, low90 and high90 ({error})") from None
    for run, one in found.items():
        if not -math.inf < one["low90"] <= one["predicted"] <= one["high90"] < math.inf:
            raise Wrong(f"{file}: run {run} needs finite numbers with low90 <= predicted <= high90")
    return found


def read_truth(folder: Path) -> Case:
    """Truth of a case, with its rows by run."""
    truth: Case = read_json(folder / "truth.json")
    columns = truth["rows"]
    rows = [dict(zip(columns, values, strict=True)) for values in zip(*columns.values(), strict=True)]
    truth["rows"] = {row["run"]: row for row in rows}
    truth["label"], truth["laws"] = names(truth["label"]), names(truth.get("laws", ()))
    return truth


def physics(label: frozenset[str], truth: Case, about: Case) -> frozenset[str]:
    """Explanation without laws, where the rig follows other laws than the base model."""
    return label if not truth["laws"] else label - set(about["laws"]) or frozenset({"none"})


def is_right(truth: Case, answer: Case, about: Case) -> bool:
    """Whether the verdict is the truth."""
    return physics(answer["verdict"], truth, about) == truth["label"]


def is_tied(truth: Case, answer: Case, about: Case) -> bool:
    """Whether the verdict or an explanation tied with it is the truth."""
    return any(physics(one, truth, about) == truth["label"] for one in (answer["verdict"], *answer["tied"]))


def is_crossed(truth: Case, answer: Case, about: Case) -> bool:
    """Whether a fault of an instrument is called physics, or the other way round."""
    named, faults = physics(answer["verdict"], truth, about) - NO_EFFECT, set(about["measurement"])
    return bool(named - faults) if truth["label"] <= faults else bool(named & faults)


def log_score(truth: Case, answer: Case, about: Case) -> float:
    """Sum of the log probabilities of the true states, over all ids."""
    total = 0.0
    for name in [*about["ids"], *(["unknown"] if about["follows_other_laws"] else sorted(NO_EFFECT))]:
        p = min(max(answer["probabilities"].get(name, FLOOR), FLOOR), 1 - FLOOR)
        total += math.log(p if name in truth["label"] else 1 - p)
    return total


def held_ratio(truth: Case, answer: Case) -> float:
    """Rms error of the predictions over the error of the base model, at withheld conditions; 1 without predictions."""
    squares = {"predicted": 0.0, "base": 0.0}
    for run, row in withheld(truth):
        told = predicted(truth, answer, run)["predicted"] if answer["predictions"] else row["base"]
        for column, value in (("predicted", told), ("base", row["base"])):
            squares[column] += ((value - row["truth"]) / row["sd"]) ** 2
    return math.sqrt(squares["predicted"] / squares["base"]) if squares["base"] > 0 else math.nan


def coverage(truth: Case, answer: Case) -> float:
    """Probability that a new reading lies in the predicted interval, at withheld conditions."""
    normal, inside = NormalDist(), []
    for run, row in withheld(truth):
        low, high = (predicted(truth, answer, run)[end] for end in ("low90", "high90"))
        inside.append(normal.cdf((high - row["truth"]) / row["sd"]) - normal.cdf((low - row["truth"]) / row["sd"]))
    return sum(inside) / len(inside)


def withheld(truth: Case) -> list[tuple[int, Case]]:
    """Runs with withheld readings, by number."""
    return [(run, row) for run, row in truth["rows"].items() if row["withheld"]]


def predicted(truth: Case, answer: Case, run: int) -> dict[str, float]:
    """Predictions of a run; an error if there are none."""
    if run not in answer["predictions"]:
        raise Wrong(f"{truth['case']}: predictions.csv lacks run {run}, a condition of conditions.csv")
    found: dict[str, float] = answer["predictions"][run]
    return found


def location(truth: Case, answer: Case) -> float:
    """Chance that a reading that is off has the larger mismatch; nan where nearly all or none are off."""
    scored = [(r, row) for r, row in truth["rows"].items() if not row["withheld"] and r not in truth["outliers"]]
    off = {r: abs(row["truth"] - row["base"]) > row["sd"] for r, row in scored}
    if not LEAST_SHARE <= sum(off.values()) / len(off) <= 1 - LEAST_SHARE:
        return math.nan
    size = {r: abs(answer["location"].get(r, 0.0)) for r in off}
    pairs = [(size[r], size[s]) for r in off if off[r] for s in off if not off[s]]
    return sum((a > b) + 0.5 * (a == b) for a, b in pairs) / len(pairs)


def wilson(share: float, count: int) -> tuple[float, float]:
    """Wilson's 90 % interval of a share (J. Am. Stat. Assoc. 22 (1927) 209)."""
    z = NormalDist().inv_cdf(0.95)
    middle = (share + z * z / (2 * count)) / (1 + z * z / count)
    half = z / (1 + z * z / count) * math.sqrt(share * (1 - share) / count + z * z / (4 * count * count))
    return max(middle - half, 0.0), min(middle + half, 1.0)


def figures(cases: list[tuple[Case, Case]], about: Case) -> list[dict[str, Any]]:
    """All figures of the answered cases, each with its count and, for shares, its interval."""
    one, some = {"single", "measurement"}, {"single", "measurement", "pair"}

    def of(groups: set[str], clear: bool = False) -> list[tuple[Case, Case]]:
        return [(t, a) for t, a in cases if t["class"] in groups and (t["identifiable"] or not clear)]

    claims = [
        float(name in t["label"] | t["laws"])
        for t, a in cases
        for name, p in a["probabilities"].items()
        if p > NEAR_ONE
    ]
    spoiled = [(t, a, set(t["outliers"])) for t, a in cases]
    clean = {t["case"]: sum(not row["withheld"] for row in t["rows"].values()) - len(t["outliers"]) for t, _ in cases}
    told = of(some) if any(a["predictions"] for _, a in cases) else []
    ties = [len({a["verdict"], *a["tied"]}) for _, a in of(one)]
    places = [location(t, a) for t, a in of(some | {"unknown"})]
    shares = {
        "right": [float(is_right(t, a, about)) for t, a in of(one, clear=True)],
        "tied": [float(is_tied(t, a, about)) for t, a in of(one)],
        "pair_both": [float(t["label"] <= a["verdict"]) for t, a in of({"pair"})],
        "pair_exact": [float(is_right(t, a, about)) for t, a in of({"pair"})],
        "none": [float(is_right(t, a, about)) for t, a in of({"none"})],
        "false_alarm": [float(a["detected"]) for t, a in of({"none"})],
        "power": [float(a["detected"]) for t, a in of(one)],
        "unknown": [float("unknown" in a["verdict"]) for t, a in of({"unknown"}, clear=True)],
        "crossed": [float(is_crossed(t, a, about)) for t, a in of(one, clear=True)],
        "claims": claims,
    }
    rows = [row(key, sum(hits) / len(hits) if hits else math.nan, len(hits), True) for key, hits in shares.items()]
    n_spoiled, n_clean = sum(len(runs) for _, _, runs in spoiled), sum(clean.values())
    found = sum(len(runs & a["outliers"]) for _, a, runs in spoiled)
    wrongly = sum(len(a["outliers"] - runs) for _, a, runs in spoiled)
    ratios = [value for t, a in told if not math.isnan(value := held_ratio(t, a))]
    covered = [coverage(t, a) for t, a in cases if a["predictions"]]
    logs = [log_score(t, a, about) for t, a in cases]
    known = [value for value in places if not math.isnan(value)]
    return [
        *rows[:2],
        row("ties", sum(ties) / len(ties) if ties else math.nan, len(ties)),
        *rows[2:],
        row("outliers_found", found / n_spoiled if n_spoiled else math.nan, n_spoiled, True),
        row("outliers_false", min(wrongly / n_clean, 1.0), n_clean, True),
        row("held_out", median(ratios) if ratios else math.nan, len(ratios)),
        row("coverage", sum(covered) / len(covered) if covered else math.nan, len(covered)),
        row("location", sum(known) / len(known) if known else math.nan, len(known)),
        row("log_score", sum(logs) / len(logs), len(logs)),
    ]


def row(key: str, value: float, count: int, share: bool = False) -> dict[str, Any]:
    """Figure as a record; null for a figure of no case."""
    low, high = wilson(value, count) if share and count else (math.nan, math.nan)
    return {
        "key": key,
        **{n: None if math.isnan(v) else v for n, v in (("value", value), ("low", low), ("high", high))},
    } | {"count": count}


TEXTS = {
    "right": "right verdict, one effect, identifiable",
    "tied": "right or honestly tied, one effect, all",
    "ties": "explanations named where one effect is hidden",
    "pair_both": "both effects of a pair named",
    "pair_exact": "pair named exactly",
    "none": "none where nothing is missing",
    "false_alarm": "mismatch detected where nothing is missing",
    "power": "mismatch detected where one effect is hidden",
    "unknown": "unknown where so and identifiable",
    "crossed": "fault called physics or physics fault",
    "claims": "claims above 0.9 that are right",
    "outliers_found": "outlier readings found",
    "outliers_false": "good readings flagged as outliers",
    "held_out": "withheld: error of predicted over the base model",
    "coverage": "90 % predictive intervals cover",
    "location": "location AUROC",
    "log_score": "log score of the probabilities, a case",
}


def table(rows: list[dict[str, Any]]) -> str:
    """Figures as text, one a line."""
    lines = [f"{'figure':46s} {'value':>8s} {'90 %':>17s} {'n':>6s}"]
    for one in rows:
        value = "-" if one["value"] is None else f"{one['value']:.3g}"
        span = "" if one["low"] is None else f"[{one['low']:.3g}, {one['high']:.3g}]"
        lines.append(f"{TEXTS[one['key']]:46s} {value:>8s} {span:>17s} {one['count']:6d}")
    return "\n".join(lines)


def scored(answers: Path, truths: Path, about: Case) -> list[dict[str, Any]]:
    """Figures of the answers to all cases of a folder of truths."""
    folders = sorted(file.parent for file in truths.glob("*/truth.json"))
    if not folders:
        raise Wrong(f"{truths}: holds no case with a truth.json")
    missing = [folder.name for folder in folders if not (answers / folder.name / "diagnosis.json").exists()]
    if missing:
        raise Wrong(f"{answers}: {len(missing)} of {len(folders)} cases are not answered, the first is {missing[0]}")
    return figures([(read_truth(folder), read_answer(answers / folder.name)) for folder in folders], about)


def main(arguments: list[str] | None = None) -> int:
    """Print and keep the score, or check the form of answers."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("answers", type=Path)
    parser.add_argument("--truth", type=Path, default=Path(__file__).parent / "open", help="cases with truth.json")
    parser.add_argument("--check", type=Path, help="cases without truth: only check that all are answered")
    given = parser.parse_args(arguments)
    try:
        if given.check is not None:
            folders = sorted(file.parent for file in given.check.glob("*/system.toml"))
            for folder in folders:
                read_answer(given.answers / folder.name)
            print(f"{len(folders)} cases answered")
            return 0
        rows = scored(given.answers, given.truth, read_json(Path(__file__).parent / "benchmark.json"))
    except Wrong as error:
        print(error, file=sys.stderr)
        return 2
    (given.answers / "score.json").write_text(json.dumps(rows, indent=1), encoding="utf-8")
    print(table(rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
