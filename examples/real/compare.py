"""Worked pages: what was seen, what the tool says blind, what is known, side by side.

python examples/real/build.py --data ../shared/data/recordings --out out/real
python examples/real/compare.py --cases out/real --out out/real/pages.md
"""

from __future__ import annotations

import argparse
import tomllib
from pathlib import Path

import numpy as np

from mixedlub.case.folder import read_case
from mixedlub.diagnosis.assessment.identifiability import confusion
from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case
from mixedlub.diagnosis.report.text.alternatives import undetectable_effects
from mixedlub.diagnosis.report.text.answer import as_json
from profiles.errors import InputError

KNOWN = tomllib.loads((Path(__file__).parent / "known.toml").read_text(encoding="utf-8"))
HEAD = """# Real recordings, side by side

The diagnosis saw the readings and the rig, nothing of the right-hand text. Written by `compare.py`.
"""


def page(folder: Path) -> str:
    """One recording: seen, said, known."""
    case, known = read_case(folder), KNOWN[folder.name]
    rows = [("Seen", known["seen"])]
    try:
        rows += said(diagnose_case(folder))
    except InputError as refusal:
        rows.append(("Said", f"refused: {refusal}"))
    rows.append(("Known", known["known"]))
    body = "\n".join(f"| {name} | {text} |" for name, text in rows)
    return f"## {case.name}\n\n| | |\n|---|---|\n{body}\n"


def said(d: Diagnosis) -> list[tuple[str, str]]:
    """The answer in table rows."""
    answer = as_json(d)
    ties = " or ".join(" + ".join(names) for names in answer["tied"])
    weights = sorted(answer["probabilities"].items(), key=lambda item: -item[1])[:4]
    mismatch, fit = answer["mismatch"], answer["fit"]
    rows = [
        ("Mismatch", f"{'yes' if mismatch['detected'] else 'no'} (p = {mismatch['p_value']:.2g})"),
        ("Verdict", ties),
        ("Probabilities", ", ".join(f"{name} {p:.2f}" for name, p in weights)),
        ("Where", answer["location"]["text"]),
        ("Held out", f"{fit['heldout_before']:.2f} to {fit['heldout_after']:.2f} sigma, {fit['split']}"),
    ]
    for effect in answer["effects"]:
        values = "; ".join(
            f"{p['name'].replace('_', ' ')} {p['value']:.3g} ({p['low90']:.3g} to {p['high90']:.3g}) {p['unit']}"
            for p in effect["parameters"][:4]
        )
        rows.append((effect["id"], values))
    hidden = undetectable_effects(d, confusion(d.search))
    if answer["verdict"] != ["none"] and hidden:
        rows.append(("Too weak to show", ", ".join(hidden)))
    rows += [("Reading", text) for text in faults(d)]
    check = d.check
    if check is None or check.correlation is None:
        return rows
    text = f"predicted reading against {check.column.replace('_', ' ')}, never fitted: r = {check.correlation:.3f}"
    return [*rows, ("Check", text)]


def faults(d: Diagnosis) -> list[str]:
    """What the instrument did wrong at the readings that are outliers."""
    found = []
    table, y = d.recorded.table, d.search.problem.y
    for run in d.outlier_runs:
        row = int(np.flatnonzero(table["run"] == run)[0])
        excess, sd = float(y[row] - d.recorded.predicted[row]), float(d.recorded.sd[row])
        fault = d.case.kind.instrument_fault(table, row, excess, sd)
        found.append(f"run {run} set aside" + ("" if fault is None else f": {fault}"))
    return found[:5]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cases", type=Path, required=True, help="folder that build.py wrote")
    parser.add_argument("--out", type=Path, default=Path("out/real/pages.md"), help="page to write")
    arguments = parser.parse_args()
    folders = [arguments.cases / name for name in KNOWN if (arguments.cases / name).is_dir()]
    arguments.out.parent.mkdir(parents=True, exist_ok=True)
    arguments.out.write_text("\n".join([HEAD, *(page(folder) for folder in folders)]), encoding="utf-8")
    print(arguments.out)
