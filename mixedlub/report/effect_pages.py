"""The catalogue as text: each effect with its signature, the effects it resembles, and the test that separates them.

All content comes from the effect's file or is computed on the standard rigs of `mixedlub.case.reference_rigs`.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path

import numpy as np

from mixedlub.case import reference_rigs
from mixedlub.chain.effect import Effect
from mixedlub.chain.model import Model
from mixedlub.chain.plain_text import entry
from mixedlub.effects import catalogue, find
from mixedlub.kinds import NATIVE, kind
from mixedlub.own_laws import ABSENT, ENDING, check_usable, read_law
from profiles.errors import InputError

RIGS = NATIVE
"""Standard rigs by kind, in the order of the pages."""
SAME_SIGNATURE = 0.95
"""Cosine of two signatures above which the standard rig cannot distinguish the effects."""

NEGLIGIBLE = 0.02
"""Change of the share, over its largest size, below which a condition counts as irrelevant."""

_RIG_INDENT = 20


def shown(effect: Effect) -> dict[str, float]:
    """Parameter values that show the effect: the prior median, or one sd above it if the median is null."""
    middle = effect.prior_medians
    return {p.name: p.prior.value(1.0) if middle[p.name] == p.null else middle[p.name] for p in effect.parameters}


@cache
def share(effect_id: str, rig: str) -> np.ndarray | None:
    """Relative change of each reading of a standard rig by the effect; None if it cannot act."""
    forward = reference_rigs.forward(rig)
    effect = next((e for e in forward.effects() if e.id == effect_id), None)
    if effect is None:
        return None
    base = forward.predict()
    return (forward.predict(None, {effect_id: shown(effect)}) - base) / base


@cache
def share_of_law(effect_id: str, law: str, rig: str) -> np.ndarray:
    """Relative change of each reading of a standard rig by a named law of the effect, as in a study."""
    forward = reference_rigs.forward(rig)
    effect = next(e for e in forward.effects() if e.id == effect_id)
    base = forward.predict()
    return np.asarray((forward.predict(None, {effect_id: effect.law_values(law)}) - base) / base)


def changes(effect: Effect, rig: str) -> dict[str, float]:
    """Change of the effect's share from the lowest to the highest levels of each condition, over its largest size.

    The conditions are those varied on the rig (absolute values where they have a sign) and the quantities named in the
    effect's fingerprint. For an effect that follows the test programme, it is the position in the programme alone.
    """
    shares = share(effect.id, rig)
    if shares is None or not shares.any():
        return {}
    if "sequence" in effect.reads:
        position = np.ravel(reference_rigs.forward(rig).inputs["sequence"])
        sides = {"sequence": (position < 0.2, position > 0.8)}
    else:
        sides = _sides(effect, rig)
    largest = np.abs(shares).max()
    return {c: float((shares[high].mean() - shares[low].mean()) / largest) for c, (low, high) in sides.items()}


def _sides(effect: Effect, rig: str) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Rows at the lowest and at the highest levels of each condition."""
    forward = reference_rigs.forward(rig)
    sides = {}
    for condition, (column, _) in reference_rigs.conditions(rig).items():
        values = forward.table[column]
        if condition == "surfaces":
            sides["roughness"] = (values == "superfinished", values == "coarse")
        elif condition != "sequence":
            sides[condition] = _thirds(values)
    made = {name for name, _ in forward.chain} | set(forward.inputs)
    named = [q for q in effect.fingerprint if q in made and q not in sides]
    states = Model(forward.chain, tuple(forward.inputs), named)(forward.inputs)
    rows = (len(forward.table), 1)
    return sides | {q: _thirds(v[:, 0]) for q, v in states.items() if np.shape(v) == rows and np.ptp(v) > 0}


def _thirds(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rows in the lowest and in the highest third of the levels, at least one level each."""
    size = np.abs(values)
    levels = np.unique(size)
    some = max(len(levels) // 3, 1)
    return size <= levels[some - 1], size >= levels[-some]


def fingerprint(effect: Effect, rig: str) -> dict[str, str]:
    """Sign of `changes`: how the effect's share of the reading changes with each condition."""
    return {c: "0" if abs(v) < NEGLIGIBLE else "+" if v > 0 else "-" for c, v in changes(effect, rig).items()}


@cache
def signatures(rig: str) -> Mapping[str, tuple[np.ndarray, float]]:
    """The `signature` at the values of `shown`, for each effect that changes the readings of the rig."""
    forward = reference_rigs.forward(rig)
    base = forward.predict()
    changes = {effect.id: share(effect.id, rig) for effect in forward.effects()}
    projected = {name: signature(change * base, rig) for name, change in changes.items() if change is not None}
    return {name: (vector, remaining) for name, (vector, remaining) in projected.items() if remaining > 0.0}


def signature(change: np.ndarray, rig: str) -> tuple[np.ndarray, float]:
    """The part of a change of the readings that calibration cannot reproduce.

    Returned are a unit vector over the rows, in standard deviations, and the share of the change that remains after
    projecting out one column per calibrated input.
    """
    sd, inputs = _calibrated(rig)
    whole = change / sd
    remainder = whole - inputs @ (inputs.T @ whole)
    size = float(np.linalg.norm(remainder))
    return (remainder / size, size / float(np.linalg.norm(whole))) if size > 0.0 else (remainder, 0.0)


@cache
def _calibrated(rig: str) -> tuple[np.ndarray, np.ndarray]:
    """Noise of the standard rig's readings, and an orthonormal basis of their changes by calibration."""
    forward = reference_rigs.forward(rig)
    base = forward.predict()
    noise = forward.case.system.recording.noise
    assert noise is not None
    sd = np.hypot(noise.relative * base, noise.absolute)
    moved = [forward.predict({c.name: c.parameter.prior.value(0.5)}) - base for c in forward.calibrations]
    inputs, _ = np.linalg.qr((np.array(moved) / sd).T)
    return sd, inputs


def lookalikes(effect_id: str, rig: str) -> dict[str, float]:
    """Other effects with a cosine above 0.95 between the signatures on the standard rig, nearest first."""
    known = signatures(rig)
    if effect_id not in known:
        return {}
    reference = known[effect_id][0]
    cosines = {other: float(reference @ vector) for other, (vector, _) in known.items() if other != effect_id}
    similar = {other: c for other, c in cosines.items() if abs(c) > SAME_SIGNATURE}
    return dict(sorted(similar.items(), key=lambda item: -abs(item[1])))


def effects_text(effect_id: str | None = None) -> str:
    """Page of an effect, or of the law in a file, or table of all effects."""
    if effect_id is not None and effect_id.endswith(ENDING):
        return _own_page(Path(effect_id))
    return _table() if effect_id is None else _page(find((effect_id,))[0])


def _own_page(path: Path) -> str:
    """Page of the law in a file, with its change of the readings of each standard rig on which it can act."""
    law = read_law(path, {c.name for rig in RIGS for c in kind(rig).columns if c.dtype == "number"})
    lines, unable = ["on the standard rig of each kind of recording, at the stated values"], []
    for rig in RIGS:
        forward = reference_rigs.forward(rig)
        inputs = {**forward.inputs, **forward.columns_of([law])}
        try:
            check_usable(law, forward.chain, inputs, "reading", rig.replace("_", " "))
        except InputError as error:
            unable.append((rig, error))
            continue
        base, changed = (Model(forward.chain, tuple(inputs), ("reading",), own) for own in ((), (law,)))
        change = changed(inputs, {law.id: law.law_values()})["reading"] / base(inputs)["reading"] - 1.0
        low, middle, high = (f"{100 * v:.3g}" for v in np.quantile(change, (0.0, 0.5, 1.0)))
        lines.append(entry(f"  {rig}", f"{low} to {high} % of the reading, half of them below {middle} %", _RIG_INDENT))
    if len(unable) == len(RIGS):
        raise max((error for _, error in unable), key=lambda error: ABSENT not in error.rule)
    named = ", ".join(rig for rig, _ in unable)
    return "\n".join([law.page(), "", *lines, *([entry("  cannot act", f"on {named}", _RIG_INDENT)] if named else [])])


def _table() -> str:
    effects = tuple(catalogue().values())
    lines = [f"{len(effects)} effects. `mixedlub effects ID` shows one."]
    widest = max(len(e.id) for e in effects)
    stage = ""
    for e in effects:
        if e.stage != stage:
            stage = e.stage
            lines += ["", stage]
        lines.append(entry(f"  {e.id}", e.summary, widest + 4))
    return "\n".join(lines)


def _page(effect: Effect) -> str:
    return "\n".join([effect.page(), "", *_on_rigs(effect)])


def _on_rigs(effect: Effect) -> list[str]:
    lines = ["on the standard rig of each kind of recording"]
    for rig in RIGS:
        values = share(effect.id, rig)
        if values is None or not values.any():
            continue
        low, middle, high = (f"{100 * v:.3g}" for v in np.quantile(values, (0.0, 0.5, 1.0)))
        signs = ", ".join(f"{condition} {sign}" for condition, sign in fingerprint(effect, rig).items())
        similar = ", ".join(f"{other} ({c:+.2f})" for other, c in lookalikes(effect.id, rig).items())
        about = {
            f"  {rig}": f"{low} to {high} % of the reading, half of them below {middle} %",
            "    fingerprint": f"share of the reading with growing {signs}" if signs else "none",
            "    looks like": similar or "no other, after calibration",
        }
        if effect.id in signatures(rig):
            about["    calibration"] = f"leaves {100 * signatures(rig)[effect.id][1]:.0f} % of it"
        about |= _of_laws(effect, rig)
        lines += [entry(name, text, _RIG_INDENT) for name, text in about.items()]
    shares = {rig: share(effect.id, rig) for rig in RIGS}
    unable = ", ".join(rig for rig, values in shares.items() if values is None)
    hidden = ", ".join(rig for rig, values in shares.items() if values is not None and not values.any())
    lines += [entry("  cannot act", f"on {unable}", _RIG_INDENT)] if unable else []
    return [*lines, entry("  shows nothing", f"on {hidden}", _RIG_INDENT)] if hidden else lines


def _of_laws(effect: Effect, rig: str) -> dict[str, str]:
    """Influence of each published law of the effect on the gears of studies, by heading."""
    if rig != "gear_pair":
        return {}
    own = next(e for e in reference_rigs.forward(rig).effects() if e.id == effect.id)
    found = []
    for law in own.laws_within_reach or {"": {}}:
        low, middle, high = (f"{100 * v:.3g}" for v in np.quantile(share_of_law(effect.id, law, rig), (0.0, 0.5, 1.0)))
        named = f"{law}: " if law else ""
        off = low == high == "0"
        found.append(f"{named}{'nothing without a number' if off else f'{low} to {high} %, half below {middle} %'}")
    return {"    as published": "; ".join(found)}
