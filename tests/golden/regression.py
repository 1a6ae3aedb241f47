"""Whether a change of the code changed a number: diagnoses and a study before and after, compared.

    python tests/golden/regression.py collect BEFORE [CASE ...]     with the code as it was
    python tests/golden/regression.py collect AFTER [CASE ...]      with the code as it is
    python tests/golden/regression.py compare BEFORE AFTER

Without cases it takes those of `examples` and, where they exist, the practice cases beside the project. ``collect``
runs the `mixedlub` that the interpreter finds, so PYTHONPATH chooses the version. On one machine the study's
table must be the same byte for byte; verdicts must be the same, probabilities and predictions agree within 1e-9 of the
larger.
"""

from __future__ import annotations

import csv
import json
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
STUDY = PROJECT / "examples" / "study_21_pairings.toml"
CASES = (
    PROJECT / "examples" / "case",
    *sorted((PROJECT / "examples" / "worked").glob("*_campaign")),
    *sorted((PROJECT.parent / "shared" / "cases").glob("case_*")),
)
TOLERANCE = 1e-9


def mixedlub(*arguments: str | Path) -> None:
    subprocess.run([sys.executable, "-m", "mixedlub", *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)


def collect(out: Path, cases: list[Path]) -> None:
    out.mkdir(parents=True, exist_ok=True)
    mixedlub("study", STUDY, "--no-figures", "--out", out / "study")

    def diagnosed(case: Path) -> None:
        mixedlub("diagnose", case, "--out", out / "cases" / case.name)
        print(case.name, flush=True)

    with ThreadPoolExecutor(2) as pool:
        list(pool.map(diagnosed, cases))


def differences(one: object, other: object, place: str = "") -> list[str]:
    """Where two JSON values differ; numbers within TOLERANCE are the same."""
    if isinstance(one, dict) and isinstance(other, dict):
        keys = sorted({*one, *other})
        return [text for key in keys for text in differences(one.get(key), other.get(key), f"{place}.{key}")]
    if isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        return [text for n, pair in enumerate(zip(one, other)) for text in differences(*pair, f"{place}[{n}]")]
    if isinstance(one, (int, float)) and isinstance(other, (int, float)):
        same = abs(one - other) <= TOLERANCE * max(abs(one), abs(other), 1e-300)
    else:
        same = one == other
    return [] if same else [f"{place}: {one!r} -> {other!r}"]


def answer(folder: Path) -> dict[str, object]:
    """The numbers of an answer: its JSON without sentences, and its table of predictions."""
    told = json.loads((folder / "diagnosis.json").read_text(encoding="utf-8"))
    numbers = {
        key: value
        for key, value in told.items()
        if key not in ("warnings", "findings", "next_tests", "next_batch", "tests_beyond", "location", "case")
    }
    with (folder / "predictions.csv").open(encoding="utf-8", newline="") as file:
        rows = [
            {key: float(cell) if cell else None for key, cell in row.items() if key in PREDICTED}
            for row in csv.DictReader(file)
        ]
    return {**numbers, "rows": told["location"]["rows"], "predictions": rows}


PREDICTED = ("run", "base", "calibrated", "predicted", "low90", "high90", "mismatch_z")


def compare(before: Path, after: Path) -> int:
    found = []
    for name in ("results.csv",):
        if (before / "study" / name).read_bytes() != (after / "study" / name).read_bytes():
            found.append(f"study: {name} is not the same file")
    for folder in sorted((before / "cases").iterdir()):
        texts = differences(answer(folder), answer(after / "cases" / folder.name), folder.name)
        found += texts[:5] + ([f"{folder.name}: and {len(texts) - 5} more"] if len(texts) > 5 else [])
    print("\n".join(found) or "the same numbers")
    return 1 if found else 0


if __name__ == "__main__":
    verb, *rest = sys.argv[1:] or [""]
    if verb == "collect" and rest:
        collect(Path(rest[0]), [Path(case) for case in rest[1:]] or list(CASES))
    elif verb == "compare" and len(rest) == 2:
        sys.exit(compare(Path(rest[0]), Path(rest[1])))
    else:
        sys.exit(__doc__)
