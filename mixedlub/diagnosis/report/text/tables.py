"""Tables of what was fitted: the parameters of the answer's effects, and what calibration was moved to."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.case.forward import Forward
from mixedlub.chain.effect import Effect, Parameter
from mixedlub.chain.plain_text import plain_equation, with_symbol
from mixedlub.chain.priors import Between, BetweenLog, Prior
from mixedlub.chain.quantities import GLOSSARY
from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.labels import effect_words, in_reach, number, with_names
from mixedlub.diagnosis.report.text.answer import effect_records, interval, verdict_fit
from mixedlub.schema.findings import collected
from mixedlub.schema.table import Table
from mixedlub.schema.units import unit_of

STRAINED = 2.0
"""Standard deviations from which an input counts as strained."""
UNTOLD = 0.8
"""Share of the prior's 90 % interval from which a fitted one counts as no narrower, where the prior is normal."""
UNDETERMINED = "not determined by these readings"
FAR = 3.0
"""Standard deviations of its prior from which a parameter is far outside of what is usual."""
UNMOVED = 1e-6
"""Sigmas by which a parameter moves readings, for one standard deviation of its prior, that are none."""
RPM = 30.0 / np.pi
"""Turns a minute in a radian a second."""
SURE = 0.9
"""Probability from which an effect is sure."""
COLUMNS = ("effect", "parameter", "value", "90 % interval", "unit", "meaning")

Cells = tuple[tuple[str, ...], ...]


def parameters(d: Diagnosis) -> tuple[tuple[str, ...], Cells]:
    """Fitted parameters of the answer's effects, with a sentence on those that the readings hardly tell."""
    if not d.posterior.verdict.effects:
        return (), ()
    refined = verdict_fit(d)
    moved = np.max(np.abs(refined.fit.slopes), axis=0) > UNMOVED
    moved |= np.abs(refined.z) > UNMOVED
    start = d.search.problem.calibration_size
    every_company = d.posterior.inclusion(d.search)
    table, said = [COLUMNS], []
    for e, record in zip(d.search.problem.effects(d.posterior.verdict), effect_records(d), strict=True):
        places = range(start, start + len(e.parameters))
        start += len(e.parameters)
        if e.free_form:
            continue
        every = list(zip(e.parameters, record["parameters"], places, strict=True))
        told = [(p, fitted, i) for p, fitted, i in every if p.sudden or moved[i]]
        said += _unmoved(e, [p for p, _, i in every if not (p.sudden or moved[i])])
        vague = [p.name.replace("_", " ") for p, _, i in told if refined.spread[i] >= UNTOLD]
        alone = _untold(replace(e, parameters=tuple(p for p, _, _ in told)), vague)
        fitted_ones = [(p, fitted) for p, fitted, _ in told]
        said += alone or _cancelling(e, fitted_ones, every_company[e.id])
        off = [(p, fitted) for p, fitted in fitted_ones if _switches_off(d, e, p)]
        said += _reaching_nothing(e, off, every_company[e.id])
        for p, fitted, i in told:
            usual = float(p.prior.value(0.0))
            scaled, unit = in_reach((fitted["value"], fitted["low90"], fitted["high90"]), p.unit, usual)
            value, low, high = (number(x) for x in scaled)
            name = with_symbol(p.name, plain_equation(p.symbol))
            far = _far(p.prior, p.unit) if abs(refined.z[i]) > FAR and not p.sudden else ""
            said += _stretched(e, p, far)
            marks = [mark for mark, holds in ((UNDETERMINED, refined.spread[i] >= UNTOLD), (far, far)) if holds]
            mark = f"[{'; '.join(marks)}] " if marks else ""
            table.append(
                (effect_words(e.id), name, value, f"{low} to {high}", unit, f"{mark}{_meaning(d, p, fitted['value'])}")
            )
    return tuple(said), tuple(table) if len(table) > 1 else ()


def _far(prior: Prior, unit: str) -> str:
    """How a parameter stands that is far outside of what its prior holds for usual, with what that is.

    >>> from mixedlub.chain.priors import Normal
    >>> _far(Normal(0.0, 0.1), "-"), _far(Between(0.0, 0.05), "1/K")
    ('far outside of what is usual (-0.164 to 0.164)', 'at the end of what it may be (0 to 0.05)')
    """
    if isinstance(prior, Between | BetweenLog):
        how, ends = "at the end of what it may be", (prior.low, prior.high)
    else:
        how, ends = "far outside of what is usual", interval(prior, 0.0, 1.0)[1:]
    low, high = (number(x) for x in in_reach(ends, unit, float(prior.value(0.0)))[0])
    return f"{how} ({low} to {high})"


def _stretched(e: Effect, p: Parameter, far: str) -> list[str]:
    """That an effect with a parameter so far off may be named for want of a better name."""
    if not far:
        return []
    return [
        f"{with_names(effect_words(e.id))}: {p.name.replace('_', ' ')} is {far}. Its name is a stretch: something else "
        "may act alike."
    ]


def _unmoved(e: Effect, parameters: list[Parameter]) -> list[str]:
    """That no reading depends on these parameters, which the table therefore leaves out."""
    if not parameters:
        return []
    names = " and ".join(with_symbol(p.name, plain_equation(p.symbol)) for p in parameters)
    return [f"{with_names(effect_words(e.id))}: no reading here depends on {names}, which the table leaves out."]


def _untold(e: Effect, vague: list[str]) -> list[str]:
    """What is known of an effect although some of its parameters are not."""
    if not vague:
        return []
    wide = f"{' and '.join(vague)} {'are' if len(vague) > 1 else 'is'} {UNDETERMINED}"
    if len(e.parameters) == 1:
        return [f"{with_names(effect_words(e.id))}: {wide}."]
    return [f"{with_names(effect_words(e.id))}: {wide}. Only the combined effect of the parameters is known."]


def _meaning(d: Diagnosis, p: Parameter, value: float) -> str:
    """What a parameter means; with what it is a share of, and what that makes, as numbers with their unit."""
    if not p.of:
        return p.meaning
    size, unit = _whole(d, p.of)
    made = f"{number(value * size)} {unit}{p.unit.removeprefix('-').removeprefix('1')}"
    return f"{p.meaning} ({f'{number(size)} {unit}'.rstrip()}): {made.rstrip()}"


def _whole(d: Diagnosis, name: str) -> tuple[float, str]:
    """An input that a parameter is a share of, as calibrated, and its unit."""
    forward = d.search.problem.forward
    if name == "reading_scale":
        return float(forward.inputs[name]) * forward.scale, unit_of(d.case.quantity)
    if name == "reference_speed":
        size, turning = float(forward.inputs[name]), "speed_rpm" in forward.table
        return (size * RPM, "rpm") if turning else (size, "m/s")
    for c, z in zip(forward.calibrations, _calibrated(d)[0], strict=False):
        if name in c.needs:
            moved = c.apply(forward.inputs, c.parameter.prior.value(float(z)))
            return float(moved[name]), c.parameter.unit.removeprefix("-")
    return float(forward.inputs[name]), GLOSSARY[name].unit


def _cancelling(e: Effect, told: list[tuple[Parameter, dict[str, float]]], probability: float) -> list[str]:
    """That an effect is sure although each of its parameters alone may be nothing."""
    ends = [(p, p.null, f["low90"], f["high90"]) for p, f in told if p.null is not None]
    if len(ends) < 2 or probability < SURE or not all(low < null < high for _, null, low, high in ends):
        return []
    names = " and ".join(p.name.replace("_", " ") for p, *_ in ends)
    return [
        f"{with_names(effect_words(e.id))}: each of {names} alone may be nothing, not all at once: only their combined "
        "effect is known."
    ]


def _switches_off(d: Diagnosis, e: Effect, p: Parameter) -> bool:
    """Whether an effect of the answer does nothing at the null of one parameter, the others as fitted."""
    if p.null is None:
        return False
    problem, key, z = d.search.problem, d.posterior.verdict, verdict_fit(d).z
    values = problem.parameters(key, z)
    others = {name: fitted for name, fitted in values.items() if name != e.id}
    at_null = {**others, e.id: {**values[e.id], p.name: p.null}}
    one, other = (problem.forward.run(problem.calibration(z), told).prediction for told in (at_null, others))
    return bool(np.allclose(one, other, rtol=1e-9))


def _reaching_nothing(e: Effect, told: list[tuple[Parameter, dict[str, float]]], probability: float) -> list[str]:
    """That an effect is sure although the interval of one that switches it off, a parabola's, takes in nothing."""
    ends = [(p, f["low90"] < p.null < f["high90"]) for p, f in told if p.null is not None]
    names = [p.name.replace("_", " ") for p, within in ends if within]
    if len(names) != 1 or probability < SURE:
        return []
    return [
        f"{with_names(effect_words(e.id))}: the 90 % interval of {names[0]} takes in no effect, as other parameters "
        "may make up for much of it. The readings exclude no effect at all: that it acts is known better than how much."
    ]


def calibration(d: Diagnosis) -> tuple[tuple[str, ...], Cells]:
    """What calibration was moved to under the verdict."""
    if not d.search.problem.forward.calibrations:
        return ("The case lets calibration move nothing.",), ()
    z, spread = _calibrated(d)
    given = _given(d.case)
    table = [("input", "stated", "moved to", "90 % interval", "moved by", "meaning")]
    strained = []
    for i, c in enumerate(d.search.problem.forward.calibrations):
        value, low, high = interval(c.parameter.prior, z[i], spread[i])
        name = with_names(c.name.replace("_", " "), first=False)
        meaning = c.parameter.meaning
        if not c.factor:
            meaning = f"value{'' if c.parameter.unit == '-' else f' in {c.parameter.unit}'}: {meaning}"
        table.append(
            (
                name,
                f"{number(c.nominal)}{given.get(c.name, '')}",
                number(value),
                f"{number(low)} to {number(high)}",
                f"{z[i]:+.1f} sd",
                meaning,
            )
        )
        if round(abs(z[i]), 1) > STRAINED:
            strained.append(name)
    said = [f"Strained: {', '.join(strained)} more than {STRAINED:g} sd from what was stated."] if strained else []
    said.append(
        "1 sd is the uncertainty of the input, stated by the case or assumed where it states none: within 2 sd it was "
        "moved no further than expected."
    )
    said += one_way(d.search.problem.forward)
    if len(d.posterior.tied) > 1:
        said.append("That is with the first of the tied answers; another one moves inputs elsewhere.")
    return tuple(said), tuple(table)


def _given(case: Case) -> dict[str, str]:
    """Where inputs come from that the case does not state: those that follow the readings are taken from them."""
    quantity, rows = case.quantity, case.recordings
    assert rows is not None
    doubled = Table({**rows.columns, quantity: 2.0 * rows[quantity]}, rows.source)
    with collected():
        here, there = (case.kind.extra_calibration(case.system, table) for table in (rows, doubled))
    return {
        c.name: " (assumed)" if c.nominal == moved.nominal else " (from the readings)"
        for c, moved in zip(here, there, strict=True)
    }


def one_way(forward: Forward) -> list[str]:
    """That a drive which turned one way only does not tell dry friction from a payload."""
    constant = {"coulomb_torque", "payload_torque"}
    names = [c.name.replace("_", " ") for c in forward.calibrations if constant & set(c.needs)]
    speed, fitted = (np.asarray(forward.inputs.get(name, 0.0)) for name in ("drive_speed", "gears_fitted"))
    if len(names) < len(constant) or speed.min() <= 0.0 <= speed.max() or np.ptp(fitted):
        return []
    return [
        f"The drive turned one way only, which does not tell {' from '.join(names)}: only what they make together is "
        "known."
    ]


def _calibrated(d: Diagnosis) -> tuple[np.ndarray, np.ndarray]:
    """Coordinates of the calibration under the verdict, and their sd."""
    if d.posterior.verdict.is_discrepancy:
        return d.search.discrepancy.z, np.sqrt(np.diag(d.search.discrepancy.covariance))
    refined = verdict_fit(d)
    return refined.z, refined.spread
