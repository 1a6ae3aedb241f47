"""Where conditions of a study lie outside the range of the model, by the code of the finding that says why."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from mixedlub.base_model.balanced import EXACT, overloaded
from mixedlub.rig.plausibility import yields
from mixedlub.schema.findings import Finding
from mixedlub.study.batch import BEYOND, FILM_OVER_WIDTH
from mixedlub.study.columns import VALID
from mixedlub.study.plan import Plan
from roughness.mccool import nayak_parameter

EXTRAPOLATED = "law_extrapolated:"
"""Before the name of an effect or law that is used outside the range in which it holds."""
OF_SHARING = EXTRAPOLATED + "load_sharing"
"""Of a law of the load sharing; a note on the gears says which."""


def flags(plan: Plan, values: Mapping[str, np.ndarray], notes: Iterable[Finding] = ()) -> dict[str, np.ndarray]:
    """Boolean arrays of the shape of the study by code, gravest first; codes that apply nowhere are left out.

    ``notes`` are those on the load sharing, whose laws are used outside their range for all conditions or for none.
    """
    within = np.zeros(plan.shape)
    moments = [np.asarray(plan.inputs[name]).reshape(-1, 1, 1, 1) for name in ("m0", "m2", "m4")]
    with np.errstate(divide="ignore", over="ignore"):
        narrow = nayak_parameter(*moments) < 1.5
    found = {
        "pressure_above_yield": yields(values["hertz_pressure"], float(plan.inputs["reduced_modulus"])),
        # Hertz's width is where the film is thin and even: one as thick as that is no film of this contact.
        "film_above_contact_width": values.get(FILM_OVER_WIDTH, within) > 1.0,
        "balance_not_found": values.get("balance_error", within) > EXACT,
        "asperities_overloaded": overloaded(values["asperity_load_ratio"]),
        "film_carries_too_little": values.get("film_below_its_share", within) > 0.0,
        "area_ratio_limited": values["largest_area_ratio"] >= 1.0,
        "bandwidth_limited": np.broadcast_to(narrow, plan.shape),
        **{
            EXTRAPOLATED + law: np.logical_or.reduce(
                [~np.isnan(values[f"{BEYOND}{law}:{quantity}"]) for quantity in valid]
            )
            for law, valid in plan.ranges.items()
        },
    }
    if any(note.code == EXTRAPOLATED.rstrip(":") for note in notes):
        found[OF_SHARING] = np.ones(plan.shape, dtype=bool)
    return {code: where for code, where in found.items() if where.any()}


def as_words(found: Mapping[str, np.ndarray], shape: tuple[int, ...]) -> tuple[np.ndarray, list[str]]:
    """The codes of every condition: an index of the given shape, and the words of each index.

    >>> index, words = as_words({"a": np.array([True, False]), "b": np.array([True, True])}, (2,))
    >>> [words[i] for i in index]
    ['a; b', 'b']
    """
    bits = np.zeros(shape, dtype=int)
    for place, where in enumerate(found.values()):
        bits |= where.astype(int) << place
    sets, index = np.unique(bits, return_inverse=True)
    named = ["; ".join(code for place, code in enumerate(found) if one >> place & 1) for one in sets.tolist()]
    return index.reshape(shape), [text or VALID for text in named]
