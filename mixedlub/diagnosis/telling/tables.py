"""Tables of what was fitted: the parameters of the answer's effects, and what calibration was moved to."""

from __future__ import annotations

import inspect

import numpy as np

from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.labels import effect_words, in_reach, number, with_names
from mixedlub.diagnosis.telling.answer import effect_records, interval, verdict_fit
from mixedlub.effect import Effect, Parameter
from mixedlub.headers import unit_of
from mixedlub.report.plain import plain_equation, with_symbol

STRAINED = 2.0
"""Standard deviations from which an input counts as strained."""
UNTOLD = 0.8
"""Share of the prior's 90 % interval from which a fitted one counts as no narrower, where the prior is normal."""
AS_BEFORE = "as wide as before the readings"
COLUMNS = ("effect", "parameter", "value", "90 % interval", "unit", "meaning")

Table = tuple[tuple[str, ...], ...]


def parameters(d: Diagnosis) -> tuple[tuple[str, ...], Table]:
    """Fitted parameters of the answer's effects, with a sentence on those that the readings hardly tell."""
    if isinstance(d.posterior.verdict, str) or d.posterior.verdict == ():
        return (), ()
    place = d.found.problem.calibration_size
    spread = verdict_fit(d).spread
    table, said = [COLUMNS], []
    for e, record in zip(d.found.problem.effects(d.posterior.verdict), effect_records(d), strict=True):
        own = spread[place : place + len(e.parameters)]
        place += len(e.parameters)
        if e.free_form:
            continue
        vague = [p.name.replace("_", " ") for p, s in zip(e.parameters, own, strict=True) if s >= UNTOLD]
        said += _untold(e, vague)
        for p, fitted, s in zip(e.parameters, record["parameters"], own, strict=True):
            scaled, unit = in_reach(
                (fitted["value"], fitted["low90"], fitted["high90"]), p.unit, float(p.prior.value(0.0))
            )
            value, low, high = (number(x) for x in scaled)
            name = with_symbol(p.name, plain_equation(p.symbol))
            mark = f"[{AS_BEFORE}] " if s >= UNTOLD else ""
            table.append((effect_words(e.id), name, value, f"{low} to {high}", unit, f"{mark}{_meaning(d, e, p)}"))
    return tuple(said), tuple(table) if len(table) > 1 else ()


def _untold(e: Effect, vague: list[str]) -> list[str]:
    """What is known of an effect although some of its parameters are not."""
    if not vague:
        return []
    many = "intervals" if len(vague) > 1 else "interval"
    wide = f"the 90 % {many} of {' and '.join(vague)} {'are' if len(vague) > 1 else 'is'} {AS_BEFORE}"
    if len(e.parameters) == 1:
        return [f"{with_names(effect_words(e.id))}: {wide}: its size is hardly known."]
    return [f"{with_names(effect_words(e.id))}: {wide}. Only the combined effect of the parameters is known."]


def _meaning(d: Diagnosis, e: Effect, p: Parameter) -> str:
    """What a parameter means; the typical reading that it is a share of, as a number with its unit."""
    if "typical" not in p.meaning or "reading_scale" not in inspect.signature(e.law).parameters:
        return p.meaning
    forward = d.found.problem.forward
    size = float(forward.inputs["reading_scale"]) * forward.scale
    return f"{p.meaning} ({number(size)} {unit_of(d.case.quantity)}".rstrip() + ")"


def calibration(d: Diagnosis) -> tuple[tuple[str, ...], Table]:
    """What calibration was moved to under the verdict."""
    if not d.found.problem.forward.calibrations:
        return ("The case lets calibration move nothing.",), ()
    z, spread = _calibrated(d)
    table = [("input", "stated", "moved to", "90 % interval", "off what was stated", "meaning")]
    strained = []
    for i, c in enumerate(d.found.problem.forward.calibrations):
        value, low, high = interval(c.parameter.prior, z[i], spread[i])
        name = with_names(c.name.replace("_", " "), first=False)
        meaning = c.parameter.meaning
        if not meaning.startswith("factor on "):
            meaning = f"value{'' if c.parameter.unit == '-' else f' in {c.parameter.unit}'}: {meaning}"
        table.append(
            (name, number(c.nominal), number(value), f"{number(low)} to {number(high)}", f"{z[i]:+.1f} sd", meaning)
        )
        if abs(z[i]) > STRAINED:
            strained.append(name)
    said = [f"Strained: {', '.join(strained)} more than {STRAINED:g} sd from what was stated."] if strained else []
    said.append(
        "1 sd is the uncertainty of the input, stated by the case or assumed where it states none: within 2 sd it was "
        "moved no further than expected."
    )
    if len(d.posterior.tied) > 1:
        said.append("That is with the first of the tied answers; another one moves inputs elsewhere.")
    return tuple(said), tuple(table)


def _calibrated(d: Diagnosis) -> tuple[np.ndarray, np.ndarray]:
    """Coordinates of the calibration under the verdict, and their sd."""
    if d.posterior.verdict == "unknown":
        return d.found.unknown.z, np.sqrt(np.diag(d.found.unknown.covariance))
    refined = verdict_fit(d)
    return refined.z, refined.spread
