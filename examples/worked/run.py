"""The worked example from the first mismatch to the improved model; writes README.md and pictures/ beside itself.

python make_rig.py && python run.py
"""

from __future__ import annotations

import json
import textwrap
from pathlib import Path
from string import Template
from typing import TYPE_CHECKING

import numpy as np

from mixedlub.diagnosis.diagnose import Diagnosis, diagnose_case
from mixedlub.diagnosis.explanation import NOTHING
from mixedlub.diagnosis.labels import conditions_text, effect_words, explanation_words
from mixedlub.diagnosis.report.figures import figures
from mixedlub.diagnosis.report.figures.charts import evidence
from mixedlub.diagnosis.report.figures.maps import residual_map
from mixedlub.diagnosis.report.figures.style import AFTER, BEFORE, GRID, INK, MUTED, blank, look
from mixedlub.diagnosis.report.text import words

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HERE = Path(__file__).resolve().parent


def first_mismatch(d: Diagnosis) -> Figure:
    """What the plain simulation says of the readings, before anything is fitted."""
    recorded, base = d.search.problem.y, d.recorded.base
    speed = d.recorded.table["speed_rpm"]
    figure = blank(6.4, 2.8)
    left, right = figure.subplots(1, 2)
    top = 1.08 * float(max(recorded.max(), base.max()))
    left.plot([0.0, top], [0.0, top], color=INK, lw=0.8)
    left.scatter(base, recorded, s=14, color=BEFORE, linewidths=0)
    left.set(xlabel="simulated power loss (W)", ylabel="recorded power loss (W)", xlim=(0, top), ylim=(0, top))
    right.axhline(0.0, color=INK, lw=0.8)
    right.errorbar(speed, recorded - base, yerr=d.recorded.sd, fmt="o", ms=3, color=BEFORE, elinewidth=0.6)
    right.set(xlabel="speed (rpm)", ylabel="recorded − simulated (W)")
    return figure


def withheld(d: Diagnosis, truth: np.ndarray) -> Figure:
    """Predictions at conditions that were never shown, against the truth."""
    assert d.wanted is not None
    order = np.argsort(truth)
    place = np.arange(truth.size)
    share = 100.0 / truth[order]
    figure = blank(6.4, 2.8)
    axes = figure.add_subplot()
    axes.axhline(0.0, color=INK, lw=0.8)
    low, high = (share * (v[order] - truth[order]) for v in (d.wanted.low90, d.wanted.high90))
    axes.fill_between(place, low, high, step="mid", color=GRID, lw=0, label="90 % interval for a new reading")
    for values, colour, name in (
        (d.wanted.base, MUTED, "simulation as delivered"),
        (d.wanted.calibrated, BEFORE, "recalibrated"),
        (d.wanted.predicted, AFTER, "with the missing physics"),
    ):
        axes.plot(place, share * (values - truth)[order], "o", ms=3.6, color=colour, label=name)
    axes.set(xlabel="withheld condition, sorted by true loss", ylabel="prediction − truth (%)")
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=4, columnspacing=1.0, handletextpad=0.3)
    return figure


def error(values: np.ndarray, truth: np.ndarray) -> str:
    """Root mean square error in per cent."""
    return f"{100.0 * float(np.sqrt(np.mean((values / truth - 1.0) ** 2))):.1f} %"


def story(first: Diagnosis, second: Diagnosis, truth: dict) -> dict[str, str]:
    """Every number of the README."""
    assert second.wanted is not None
    recorded, base = first.search.problem.y, first.recorded.base
    true_loss = np.array([row["loss_W"] for row in truth["withheld"].values()])
    concealed = np.array([row["concealed_W"] for row in truth["withheld"].values()])
    added = second.wanted.mismatch_z * second.wanted.sd
    explained = {s.title: " ".join(s.sentences) for s in words.sections(second)}
    calibrations = second.search.problem.forward.calibrations
    z = {c.name: float(v) for c, v in zip(calibrations, second.search.null_fit.z, strict=False)}
    fitted = {c["input"]: c["z"] for c in calibration(second)}
    rows = [
        f"| {name.replace('_', ' ')} | {true:+.1f} | {z[name]:+.1f} | {fitted[name]:+.1f} |"
        for name, true in truth["misset_in_sd"].items()
    ]
    return {
        "first_readings": str(recorded.size),
        "second_readings": str(second.search.problem.y.size),
        "first_bias": f"{float(np.mean(recorded - base)):+.1f} W",
        "first_rms": f"{float(np.sqrt(np.mean(((recorded - base) / first.recorded.sd) ** 2))):.1f}",
        "first_p": f"{first.test.p_value:.1g}",
        "first_verdict": "Something is missing, but what?" if first.test.detected else "That is not enough to be sure.",
        "first_headline": words.headline(first),
        "first_test": conditions_text(first.next_tests[0].conditions),
        "first_rivals": ", ".join(explanation_words(n.split("+")) for n in first.next_tests[0].separates),
        "second_p": f"{second.test.p_value:.1g}",
        "second_headline": words.headline(second),
        "second_where": explained.get(words.WHERE, ""),
        "second_left_out": left_out(second),
        "second_alike": explained.get(words.ALIKE, ""),
        "heldout_before": f"{second.heldout.before:.2f}",
        "heldout_after": f"{second.heldout.after:.2f}",
        "outliers": ", ".join(f"run {run}" for run in second.outlier_runs) or "none",
        "spoilt": ", ".join(str(run) for run in truth["spoilt_runs"]),
        "concealed": ", ".join(effect_words(name) for name in truth["concealed"]),
        "knobs": ", ".join(f"{k.replace('_', ' ')} {v:g}" for v_ in truth["concealed"].values() for k, v in v_.items()),
        "error_base": error(second.wanted.base, true_loss),
        "error_calibrated": error(second.wanted.calibrated, true_loss),
        "error_predicted": error(second.wanted.predicted, true_loss),
        "concealed_W": f"{concealed.min():.1f} to {concealed.max():.1f} W",
        "added_error": f"{float(np.sqrt(np.mean((added - concealed) ** 2))):.1f} W",
        "inside": str(int(np.sum((true_loss > second.wanted.low90) & (true_loss < second.wanted.high90)))),
        "withheld": str(true_loss.size),
        "calibration": "\n".join(rows),
    }


def left_out(d: Diagnosis) -> str:
    """What was left out, a paragraph a sentence, equations as code."""
    said = [text for s in words.sections(d) if s.title == words.LEFT_OUT for text in s.sentences]
    return "\n\n".join(f"`{t.removeprefix('Equation: ')}`" if t.startswith("Equation: ") else t for t in said)


def calibration(d: Diagnosis) -> list[dict]:
    """Calibrated inputs under the verdict, in standard deviations from what was stated."""
    refined = d.refined[NOTHING if d.posterior.verdict.is_discrepancy else d.posterior.verdict]
    return [
        {"input": c.name, "z": float(z)} for c, z in zip(d.search.problem.forward.calibrations, refined.z, strict=False)
    ]


def main() -> None:
    """Diagnose both campaigns, draw, and tell the story."""
    first = diagnose_case(HERE / "first_campaign")
    second = diagnose_case(HERE / "second_campaign")
    truth = json.loads((HERE / "truth.json").read_text(encoding="utf-8"))
    true_loss = np.array([row["loss_W"] for row in truth["withheld"].values()])
    pictures = HERE / "pictures"
    pictures.mkdir(exist_ok=True)
    with look():
        drawn = {
            "1_first_mismatch": first_mismatch(first),
            "2_first_evidence": evidence(first),
            "3_recorded_against_simulated": figures.recorded_against_simulated(second),
            "4_residual_map": residual_map(second),
            "5_missing_part": figures.missing_part(second),
            "6_withheld": withheld(second, true_loss),
        }
        for name, figure in drawn.items():
            assert figure is not None
            figure.savefig(pictures / f"{name}.png", dpi=110, metadata={"Software": None})
    text = Template((HERE / "story.md").read_text(encoding="utf-8")).substitute(story(first, second, truth))
    text = "\n\n".join(wrapped(block) for block in text.strip().split("\n\n")) + "\n"
    (HERE / "README.md").write_text(text, encoding="utf-8")
    print(text)


def wrapped(block: str) -> str:
    """A paragraph folded; tables, pictures, code and headings as they are."""
    if block.startswith(("|", "!", "#", "    ")):
        return block
    quote = "> " if block.startswith("> ") else ""
    words = " ".join(line.removeprefix(quote) for line in block.splitlines())
    return textwrap.fill(
        words, 116, initial_indent=quote, subsequent_indent=quote, break_long_words=False, break_on_hyphens=False
    )


if __name__ == "__main__":
    main()
