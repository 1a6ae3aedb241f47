"""Tables of the fit: parameters of the answer's effects, and the calibrated inputs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mixedlub.case.folder import Case
from mixedlub.case.forward import Forward
from mixedlub.chain.effect import Effect, Parameter
from mixedlub.chain.plain_text import plain_equation, with_symbol
from mixedlub.chain.priors import LogUniform, Prior, Uniform
from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.labels import effect_words, enumerated, in_reach, number, with_names
from mixedlub.diagnosis.report.text.answer import calibrated_at, effect_records, interval, verdict_fit, whole
from mixedlub.diagnosis.settings.report import FAR, SAME_READING, STRAINED, SURE, UNMOVED, VAGUE
from mixedlub.schema.findings import collected
from mixedlub.schema.table import Table

UNDETERMINED = "about as uncertain as before the readings"
COLUMNS = ("effect", "parameter", "value", "90 % interval", "unit", "meaning")

Cells = tuple[tuple[str, ...], ...]


def parameters(d: Diagnosis) -> tuple[tuple[str, ...], Cells]:
    """Sentences on poorly determined parameters, and the table of fitted parameters of the answer's effects."""
    if not d.posterior.verdict.effects:
        return (), ()
    refined = verdict_fit(d)
    moved = np.max(np.abs(refined.fit.slopes), axis=0) > UNMOVED
    moved |= np.abs(refined.z) > UNMOVED
    start = d.search.problem.calibration_size
    inclusion = d.posterior.inclusion(d.search)
    table, sentences = [COLUMNS], []
    for e, record in zip(d.search.problem.effects(d.posterior.verdict), effect_records(d), strict=True):
        places = range(start, start + len(e.parameters))
        start += len(e.parameters)
        if e.descriptive:
            continue
        rows = list(zip(e.parameters, record["parameters"], places, strict=True))
        shown = [(p, fitted, i) for p, fitted, i in rows if p.change_point or moved[i]]
        sentences += _unmoved(e, [p for p, _, i in rows if not (p.change_point or moved[i])])
        vague = [p.name.replace("_", " ") for p, _, i in shown if refined.spread[i] >= VAGUE]
        alone = _undetermined(replace(e, parameters=tuple(p for p, _, _ in shown)), vague)
        fitted_ones = [(p, fitted) for p, fitted, _ in shown]
        sentences += alone or _cancelling(e, fitted_ones, inclusion[e.id])
        switching = [(p, fitted) for p, fitted in fitted_ones if _switches_off(d, e, p)]
        sentences += _interval_with_null(e, switching, inclusion[e.id])
        for p, fitted, i in shown:
            typical = float(p.prior.value(0.0))
            scaled, unit = in_reach((fitted["value"], fitted["low90"], fitted["high90"]), p.unit, typical)
            value, low, high = (number(x) for x in scaled)
            name = with_symbol(p.name, plain_equation(p.symbol))
            far = _far(p.prior, p.unit) if abs(refined.z[i]) > FAR and not p.change_point else ""
            sentences += _doubtful(e, p, far)
            marks = [mark for mark, holds in ((UNDETERMINED, refined.spread[i] >= VAGUE), (far, far)) if holds]
            mark = f"[{'; '.join(marks)}] " if marks else ""
            table.append(
                (effect_words(e.id), name, value, f"{low} to {high}", unit, f"{mark}{_meaning(d, p, fitted['value'])}")
            )
    return tuple(sentences), tuple(table) if len(table) > 1 else ()


def _far(prior: Prior, unit: str) -> str:
    """Words for a parameter far outside its prior, with the prior's 90 % range.

    >>> from mixedlub.chain.priors import Normal
    >>> _far(Normal(0.0, 0.1), "-"), _far(Uniform(0.0, 0.05), "1/K")
    ('far outside its expected range (-0.164 to 0.164)', 'at the limit of its range (0 to 0.05)')
    """
    if isinstance(prior, Uniform | LogUniform):
        how, ends = "at the limit of its range", (prior.low, prior.high)
    else:
        how, ends = "far outside its expected range", interval(prior, 0.0, 1.0)[1:]
    low, high = (number(x) for x in in_reach(ends, unit, float(prior.value(0.0)))[0])
    return f"{how} ({low} to {high})"


def _doubtful(e: Effect, p: Parameter, far: str) -> list[str]:
    """Warning that another effect may explain a parameter far outside its prior."""
    if not far:
        return []
    return [
        f"{with_names(effect_words(e.id))}: {p.name.replace('_', ' ')} is {far}. This effect is doubtful: "
        "something else may act in the same way."
    ]


def _unmoved(e: Effect, parameters: list[Parameter]) -> list[str]:
    """Sentence on parameters without influence on any reading, which the table omits."""
    if not parameters:
        return []
    names = enumerated([with_symbol(p.name, plain_equation(p.symbol)) for p in parameters])
    return [f"{with_names(effect_words(e.id))}: no reading here depends on {names}, which the table leaves out."]


def _undetermined(e: Effect, vague: list[str]) -> list[str]:
    """Sentence on parameters that the readings do not determine."""
    if not vague:
        return []
    wide = f"{' and '.join(vague)} {'are' if len(vague) > 1 else 'is'} {UNDETERMINED}"
    if len(e.parameters) == 1:
        return [f"{with_names(effect_words(e.id))}: {wide}."]
    return [f"{with_names(effect_words(e.id))}: {wide}. Only the combined effect of the parameters is known."]


def _meaning(d: Diagnosis, p: Parameter, value: float) -> str:
    """Meaning of a parameter; for a relative parameter also its reference and its absolute value, with unit."""
    if not p.relative_to:
        return p.meaning
    size, unit = whole(d, p.relative_to)
    absolute = f"{number(value * size)} {unit}{p.unit.removeprefix('-').removeprefix('1')}"
    return f"{p.meaning} ({f'{number(size)} {unit}'.rstrip()}): {absolute.rstrip()}"


def _cancelling(e: Effect, fitted: list[tuple[Parameter, dict[str, float]]], probability: float) -> list[str]:
    """Sentence on a certain effect with several parameters that may each be null alone."""
    ends = [(p, p.null, f["low90"], f["high90"]) for p, f in fitted if p.null is not None]
    if len(ends) < 2 or probability < SURE or not all(low < null < high for _, null, low, high in ends):
        return []
    names = enumerated([p.name.replace("_", " ") for p, *_ in ends])
    return [
        f"{with_names(effect_words(e.id))}: each of {names} alone may have no effect, but not all at once: only their "
        "combined effect is known."
    ]


def _switches_off(d: Diagnosis, e: Effect, p: Parameter) -> bool:
    """Whether an effect of the answer vanishes at the null value of a parameter, with the others as fitted."""
    if p.null is None:
        return False
    problem, key, z = d.search.problem, d.posterior.verdict, verdict_fit(d).z
    values = problem.parameters(key, z)
    others = {name: fitted for name, fitted in values.items() if name != e.id}
    at_null = {**others, e.id: {**values[e.id], p.name: p.null}}
    one, other = (problem.forward.run(problem.calibration(z), effects).prediction for effects in (at_null, others))
    return bool(np.allclose(one, other, rtol=SAME_READING))


def _interval_with_null(e: Effect, fitted: list[tuple[Parameter, dict[str, float]]], probability: float) -> list[str]:
    """Sentence on a certain effect with the null of its switching parameter inside the 90 % interval."""
    ends = [(p, f["low90"] < p.null < f["high90"]) for p, f in fitted if p.null is not None]
    names = [p.name.replace("_", " ") for p, within in ends if within]
    if len(names) != 1 or probability < SURE:
        return []
    return [
        f"{with_names(effect_words(e.id))}: the 90 % interval of {names[0]} contains the value without effect, as "
        "other parameters may compensate for much of it. That the effect acts is certain; its size is not."
    ]


def calibration(d: Diagnosis) -> tuple[tuple[str, ...], Cells]:
    """Sentences and table of the calibrated inputs under the verdict."""
    if not d.search.problem.forward.calibrations:
        return ("The case lets calibration move nothing.",), ()
    z, spread = calibrated_at(d)
    sources = _sources(d.case)
    table = [("input", "stated", "moved to", "90 % interval", "moved by", "meaning")]
    strained = []
    for i, c in enumerate(d.search.problem.forward.calibrations):
        if c.base_law and abs(z[i]) < 1.0:
            continue
        value, low, high = interval(c.parameter.prior, z[i], spread[i])
        name = with_names(c.name.replace("_", " ").replace(".", ": "), first=False)
        meaning = c.parameter.meaning
        if not c.factor:
            meaning = f"value{'' if c.parameter.unit == '-' else f' in {c.parameter.unit}'}: {meaning}"
        table.append(
            (
                name,
                f"{number(c.nominal)}{sources.get(c.name, '')}",
                number(value),
                f"{number(low)} to {number(high)}",
                f"{z[i]:+.1f} sd",
                meaning,
            )
        )
        if round(abs(z[i]), 1) > STRAINED:
            strained.append(name)
    sentences = [f"Strained: {', '.join(strained)} more than {STRAINED:g} sd from what was stated."] if strained else []
    sentences.append(
        "1 sd is the uncertainty of the input, stated by the case or assumed where it states none: within 2 sd it was "
        "moved no further than expected."
    )
    sentences += one_way(d.search.problem.forward)
    if len(d.posterior.tied) > 1:
        sentences.append("That is with the first of the tied answers; another one moves inputs elsewhere.")
    return tuple(sentences), tuple(table)


def _sources(case: Case) -> dict[str, str]:
    """Source of the inputs not stated by the case: the readings for inputs that scale with them, else an assumption."""
    quantity, rows = case.quantity, case.recordings
    assert rows is not None
    doubled = Table({**rows.columns, quantity: 2.0 * rows[quantity]}, rows.source)
    with collected():
        as_recorded, with_doubled = (case.kind.extra_calibration(case.system, table) for table in (rows, doubled))
    return {
        c.name: " (assumed)" if c.nominal == moved.nominal else " (from the readings)"
        for c, moved in zip(as_recorded, with_doubled, strict=True)
        if c.name not in case.system.uncertainty.stated
    }


def one_way(forward: Forward) -> list[str]:
    """Sentence on a drive that turned one way only: dry friction and payload are then not separable."""
    constant = {"coulomb_torque", "payload_torque"}
    names = [c.name.replace("_", " ") for c in forward.calibrations if constant & set(c.needs)]
    speed, fitted = (np.asarray(forward.inputs.get(name, 0.0)) for name in ("drive_speed", "gears_fitted"))
    if len(names) < len(constant) or speed.min() <= 0.0 <= speed.max() or np.ptp(fitted):
        return []
    return [
        f"The drive turned one way only, which does not distinguish {' from '.join(names)}: only their combined effect "
        "is known."
    ]
