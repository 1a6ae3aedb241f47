"""Tables of the published forms of every effect, from what the generator of rigs says of them."""

from __future__ import annotations

import inspect
import re
from itertools import groupby

import scores
from markdown_tables import table

HEAD = (
    "form",
    "law, its constants those of the generator",
    "range",
    "planted on",
    "the catalogue's law can become it",
    "right; right or tied; of",
)
PHYSICS = ("film", "shear", "contact", "boundary", "load", "loss", "property", "law", "measurement")
BATTERIES = ("score.txt", "score_rigs.txt", "score_forms.txt")


def formula(law: object) -> str:
    """What the docstring of a law states, without its examples, on one line.

    >>> formula(formula).startswith("What the docstring of a law states, without")
    True
    """
    text = (inspect.getdoc(law) or "").partition(">>>")[0]
    return re.sub(r"([*\[\]])", r"\\\1", re.sub(r"\s+", " ", text).strip().replace("``", "`"))


def tables() -> str:
    """Every effect with its forms, and how often each was named in the stored batteries together."""
    from mixedlub.effects import catalogue
    from mixedlub.validation.forms import every_form

    stages = {name: effect.stage for name, effect in catalogue().items()}
    stored = [path.read_text(encoding="utf-8") for name in BATTERIES if (path := scores.FOLDER / name).exists()]
    counts = scores.by_form(stored)
    listed = sorted(every_form(), key=lambda one: (PHYSICS.index(stages[one.effect]), one.effect, one.source))
    parts = []
    for effect, forms in groupby(listed, key=lambda one: one.effect):
        rows = []
        for one in forms:
            form = next(iter(one.on.values()))
            knobs = "; ".join(f"{k.name} {k.typical[0]:g} to {k.typical[1]:g}" for k in form.knobs)
            range_ = f"{form.holds}; planted with {knobs}" if form.holds else knobs
            within = "yes" if set(one.within) == set(one.on) else ", ".join(one.within) or "no"
            named = "; ".join(map(str, counts.get((effect, one.source), ("-",))))
            rows.append((one.source, formula(form.law), range_, ", ".join(one.on), within, named))
        parts.append(f"### {effect}\n\n{table(HEAD, rows)}")
    return "\n\n".join(parts)
