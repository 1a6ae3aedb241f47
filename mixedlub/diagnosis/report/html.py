"""The answer as one self-contained HTML page."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from importlib.resources import files

from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.explanation import NOTHING
from mixedlub.diagnosis.labels import number, words_of
from mixedlub.diagnosis.report.figures.charts import colour_of
from mixedlub.diagnosis.report.figures.style import inline
from mixedlub.diagnosis.report.text.headline import p_words, percent
from mixedlub.diagnosis.report.text.words import (
    ALIKE,
    GAIN,
    LEFT_OUT,
    MISMATCH,
    NEXT,
    UNNAMED,
    WHERE,
    Section,
    equation_sentence,
)
from mixedlub.report.equations import equation
from mixedlub.running.version import installed_version

CAPTIONS = {
    "recorded_against_simulated": (
        MISMATCH,
        "Recorded against simulated, and the residuals (sigma): left the base model after calibration within its "
        "stated uncertainty, right with the answer.",
    ),
    "residual_map": (
        WHERE,
        "Residuals over the test conditions; the tiles of a block are the readings taken there (surfaces and the "
        "other conditions, in the same order everywhere). Red: the rig reads more than simulated; grey "
        "with a cross: outlier.",
    ),
    "roll_angle_map": (
        WHERE,
        "Residuals of tooth friction over roll angle, one line a test condition. Red: the rig reads more than "
        "simulated.",
    ),
    "profiles": (WHERE, "Mean residual along each condition, with two standard errors."),
    "missing_part": (
        LEFT_OUT,
        "The missing part of the reading: recorded minus base model at the answer's calibration, with one "
        "standard deviation, and the answer's prediction. Readings of one level are drawn next to each other.",
    ),
    "absorbing_stages": (
        UNNAMED,
        "How well each stage of the chain could take up what is missing, were a factor there free to vary with every "
        "condition: the longer the bar, the better. One nat is a factor 2.7 in the odds.",
    ),
    "empirical_form": (
        UNNAMED,
        "The missing part against the empirical form; the line is the form, the band two standard deviations of its "
        "coefficient. A description within the recorded conditions, not physics.",
    ),
    "evidence": (ALIKE, "The explanations that were weighed, by probability."),
    "confusability": (
        ALIKE,
        "Which effects look similar at the recorded conditions after recalibration; those of the "
        "answer in bold. Right: how large each would be at its typical strength.",
    ),
    "heldout": (GAIN, "Error on whole levels of conditions that were left out of the fit."),
    "intervals": (GAIN, "Recorded readings against the 90 % predictive intervals."),
    "next_test": (NEXT, "The recommended tests among the recorded conditions, and the information expected from each."),
}
"""Section and caption of each figure."""
INSTEAD = {WHERE: MISMATCH, LEFT_OUT: UNNAMED}
"""Section for the figures of an empty section: nothing is missing, or no named effect."""
SPREADS = (
    " Before: calibrated as if nothing were missing, which spreads the shortfall over all conditions; the text above "
    "keeps the answer's calibration instead, so that signs may differ."
)


@dataclass(frozen=True)
class Picture:
    """A drawing with its caption."""

    drawing: str
    caption: str


def render(d: Diagnosis, parts: Iterable[Section], drawings: Mapping[str, str]) -> str:
    """Render the HTML page; ``drawings`` are SVG by figure name."""
    from jinja2 import Environment, StrictUndefined
    from markupsafe import Markup

    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    source = files("mixedlub.diagnosis.report").joinpath("page.html").read_text(encoding="utf-8")
    template = environment.from_string(source)
    parts = list(parts)
    titles = {part.title for part in parts}
    pictures: dict[str, list[Picture]] = defaultdict(list)
    for name, (section, caption) in CAPTIONS.items():
        if name in drawings:
            section = section if section in titles else INSTEAD.get(section, section)
            more = SPREADS if name == "residual_map" and d.posterior.verdict != NOTHING else ""
            pictures[section].append(Picture(Markup(inline(drawings[name], name)), caption + more))
    return template.render(
        title=f"{d.case.name}: what the simulation leaves out",
        case=d.case.name,
        colour=colour_of(d, d.posterior.verdict),
        parts=_with_pictures(parts, pictures),
        cards=_cards(d),
        description=d.case.system.description or "",
        base_model=d.case.kind.base_model,
        equations={sentence: Markup(svg) for sentence, svg in _equations(d).items()},
        pictures=pictures,
        version=installed_version(),
        readings=d.readings.size,
        quantity=words_of(d.case.quantity),
        level=f"{100 * d.test.level:g} %",
    )


def _with_pictures(parts: Iterable[Section], pictures: Mapping[str, list[Picture]]) -> list[Section]:
    """Sections, with empty sections added for figures without a section."""
    sections = list(parts)
    titles = {part.title for part in sections}
    return sections + [Section(title, ()) for title in pictures if title not in titles]


def _equations(d: Diagnosis) -> dict[str, str]:
    """Drawings of the verdict's equations, by the sentence they replace."""
    return {
        equation_sentence(e): equation(bare(e.equation))
        for e in d.search.problem.effects_of(d.posterior.verdict.effects)
    }


def bare(tex: str) -> str:
    """Equation in the syntax of the drawing: brackets without sizes, every fraction in braces."""
    tex = re.sub(r"\\[bB]igg?[lr]?(?![a-zA-Z])", "", tex)
    return re.sub(r"\\frac\s+(\w)\s*(\w)", r"\\frac{\1}{\2}", tex)


def _cards(d: Diagnosis) -> list[tuple[str, str]]:
    """Key numbers of the answer, with labels."""
    p = d.test.p_value
    cards = [
        (p_words(p), "chance of such a mismatch when nothing is missing (p)"),
        (percent(d.posterior.weights[d.posterior.verdict]), "probability of the first explanation"),
        (f"{d.heldout.before:.2f}", "sigma, error on left-out levels with calibration alone"),
    ]
    if d.posterior.verdict != NOTHING:
        cards.append((f"{d.heldout.after:.2f}", "sigma, the same with the answer"))
    cards.append((number(float(len(d.outlier_runs))), f"outliers among {d.readings.size} readings"))
    return cards
