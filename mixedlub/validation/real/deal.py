"""Cases dealt from the recordings: planted, hidden, paired and untouched, each with its truth beside it."""

from __future__ import annotations

import shutil
import zlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.validation.answers import IDENTIFIABLE
from mixedlub.validation.case_folder import plain, read_case, write
from mixedlub.validation.planted import MEASUREMENT
from mixedlub.validation.real.backgrounds import KINDS, background
from mixedlub.validation.real.source import SOURCE, Concealed, Recording
from mixedlub.validation.rig import Case, Form, Rig
from mixedlub.validation.rivals import Target, rivals, sensitivity, visibility
from mixedlub.validation.sample_case import solve
from profiles.errors import InputError

PLANTED, HIDDEN, PAIRED, UNTOUCHED = CLASSES = ("planted", "hidden", "paired", "untouched")
VISIBLE = (10.0, 30.0)
"""Root of the chi-square of a planted effect after recalibration, as clear as in the other batteries."""
MOST_WEIGHED = 120
"""Readings that count for the visibility and the rivals of a planted effect: dense logs repeat themselves."""
WITHHELD = 0.1
"""Share of the readings withheld, at least two."""
MOST_ROWS = 500
"""Rows of a case: longer recordings are thinned evenly."""
OVER_TIME = frozenset({"sensor_drift", "zero_drift", "force_drift", "viscosity_drift", "stepped", "refilled"})
"""Effects over the programme, planted only on recordings with a clock."""
PLANTED_EACH = 3
"""Effects planted on each recording, one a case: two of the catalogue, one outside it."""
LEAST_NOISE = 0.003
"""Least noise over the median reading: below it a recording rather has rounded or averaged readings."""
REQUIRED = {
    "viscosity": frozenset({"temperature_C"}),
    "film": frozenset({"load_N", "oil_temperature_C", "slide_roll_ratio", "entrainment_speed_m_s"}),
    "friction_history": frozenset({"time_s"}),
    "disc": frozenset({"load_N", "oil_temperature_C", "slide_roll_ratio", "entrainment_speed_m_s"}),
    "gear_pair": frozenset({"torque_Nm", "speed_rpm", "oil_temperature_C", "pinion_surface", "gear_surface"}),
}
"""Columns without which a kind is not read; a hidden one has its median at every reading."""


@dataclass(frozen=True)
class Dealt:
    """A case to write: its class and recording, the case itself, and its truth."""

    label: str
    recording: Recording
    case: Case
    truth: dict[str, Any]


def deal(found: Sequence[Recording], out: Path, seed: int) -> list[Path]:
    """Write all cases under neutral names in random order; those already written stay."""
    dealt = [one for recording in found for one in cases_of(recording, seed)]
    if not dealt:
        raise InputError("there is no recording with readings", where="--real")
    order = np.random.default_rng([seed, 6]).permutation(len(dealt))
    places = []
    for number, index in enumerate(order):
        place = out / f"case_{number:03d}"
        if not (place / "truth.json").exists():
            shutil.rmtree(place, ignore_errors=True)
            _write(place, dealt[index], np.random.default_rng([seed, 7, number]))
        places.append(place)
    return places


def cases_of(recording: Recording, seed: int) -> list[Dealt]:
    """All cases of a recording."""
    rng = np.random.default_rng([seed, zlib.crc32(recording.name.encode())])
    case = _thinned(read_case(recording.folder))
    found = [Dealt(UNTOUCHED, recording, case, _untouched(recording))]
    found += [_hidden(recording, case, one) for one in recording.hidden if one.column in case.columns]
    found += [_paired(recording, case, one) for one in recording.paired if one.values]
    if recording.understood and recording.named and case.kind in KINDS:
        with np.errstate(all="ignore"):
            found += _planted(recording, case, rng)
    return found


def _thinned(case: Case) -> Case:
    count = len(case.columns["run"])
    rows = np.unique(np.linspace(0, count - 1, min(count, MOST_ROWS)).astype(int))
    return replace(case, columns={name: column[rows] for name, column in case.columns.items()})


def _truth(
    right: frozenset[str], also: frozenset[str] = frozenset(), unknown: bool = False, **more: Any
) -> dict[str, Any]:
    return {
        "right": sorted(right - {"unknown"}),
        "also": sorted(also),
        "unknown_right": unknown or "unknown" in right,
        "where": [],
        "identifiable": True,
        "lost": False,
        **more,
    }


def _hidden(recording: Recording, case: Case, one: Concealed) -> Dealt:
    values = case.columns[one.column]
    if one.right and all(value == values[0] for value in values):
        rule = "does not change in this recording, so nothing is concealed with it; leave out the entry, or its 'right'"
        raise InputError(rule, where=f"{recording.folder / SOURCE}: hidden", value=one.column)
    return Dealt(HIDDEN, recording, _without(case, one), _concealed(recording, one))


def _without(case: Case, one: Concealed) -> Case:
    """The case without a column and its copies; one that its kind requires keeps its median."""
    columns = dict(case.columns)
    for name in (one.column, *one.beside):
        column = columns.pop(name, None)
        if column is not None and name in REQUIRED.get(case.kind, ()):
            usual = np.median(column.astype(float)) if column.dtype != object else column[0]
            columns[name] = np.full(len(column), usual)
    return replace(case, columns=columns)


def _concealed(recording: Recording, one: Concealed) -> dict[str, Any]:
    """Truth of a case without a column; where nothing is lost with it, as of the recording itself."""
    if not one.right:
        return {**_untouched(recording), "channel": one.column}
    return _truth(one.right, recording.acts, where=sorted(one.where), channel=one.column, lost=True)


def _untouched(recording: Recording) -> dict[str, Any]:
    return _truth(recording.acts, unknown=not recording.named)


def _paired(recording: Recording, case: Case, one: Concealed) -> Dealt:
    column = case.columns[one.column]
    kind = str if column.dtype == object else float
    groups = [np.flatnonzero(column.astype(kind) == kind(value)) for value in one.values]
    if not all(len(rows) for rows in groups):
        raise InputError("names a group without rows", where=f"{recording.folder}: paired", value=list(one.values))
    rows = np.concatenate(groups)
    columns = {name: values[rows] for name, values in _without(case, one).columns.items()}
    columns["run"] = np.arange(1, len(rows) + 1)
    if "time_s" in columns:
        columns["time_s"] = _in_a_row([case.columns["time_s"][group].astype(float) for group in groups])
    return Dealt(PAIRED, recording, replace(case, columns=columns), _concealed(recording, one))


def _in_a_row(clocks: Sequence[np.ndarray]) -> np.ndarray:
    """Clocks one after the other, with a usual step between them."""
    made, now = [], 0.0
    for clock in clocks:
        made.append(now + clock - clock.min())
        now = float(made[-1].max()) + float(np.ptp(clock)) / max(len(clock) - 1, 1)
    return np.concatenate(made)


def _planted(recording: Recording, case: Case, rng: np.random.Generator) -> list[Dealt]:
    """Cases with one planted effect each, as clear above the noise as those of the other batteries."""
    rig = background(case, rng)
    readings = rig.model(np.zeros(len(rig.names)), ())
    sd = noise_of(case, readings)
    barred = recording.acts | (frozenset() if {"time_s", "sequence"} & set(case.columns) else OVER_TIME)
    pool = [form for form in rig.forms if form.rarity > 0 and form.id not in barred]
    outside = [form for form in rig.outside if form.id not in barred]
    ids = sorted({form.id for form in pool})
    chosen = [str(name) for name in (*rng.permutation(ids), *rng.permutation(sorted({form.id for form in outside})))]
    found: list[Dealt] = []
    for name in chosen:
        named = name in ids
        if sum(one.truth["named"] == named for one in found) >= (PLANTED_EACH - 1 if named else 1):
            continue
        forms = [form for form in (pool if named else outside) if form.id == name]
        dealt = _with(recording, case, rig, forms[int(rng.integers(len(forms)))], readings, sd, rng)
        found += [dealt] if dealt else []
    return found


def _with(
    recording: Recording,
    case: Case,
    rig: Rig,
    form: Form,
    readings: np.ndarray,
    sd: np.ndarray,
    rng: np.random.Generator,
) -> Dealt | None:
    """The case with an effect planted on its readings; None if no strength makes it clear and possible."""
    values = {knob.name: float(rng.uniform(*knob.typical)) for knob in form.knobs}
    if form.knobs[0].low < 0 and rng.random() < 0.4:
        values["strength"] = -values["strength"]
    rest = np.zeros(len(rig.names))
    some = np.unique(np.linspace(0, len(readings) - 1, MOST_WEIGHED).astype(int))
    slopes = sensitivity(rig, rest)[some]

    def strong(factor: float) -> dict[str, float]:
        return values if form.rigid else {**values, "strength": values["strength"] * factor}

    def seen(factor: float) -> float:
        more = rig.model(rest, [form.hide(strong(factor))]) - readings
        return visibility(more[some], sd[some], slopes)

    goal = float(rng.uniform(*VISIBLE))
    size = abs(values["strength"])
    values = strong(solve(seen, goal, 0.1, max(1.0, min(4.0, 0.98 * form.knobs[0].high / size)), falling=False))
    planted = rig.model(rest, [form.hide(values)])
    if not VISIBLE[0] * 0.7 < seen(1.0) or not np.isfinite(planted).all() or (planted[readings > 0] <= 0).any():
        return None
    target = Target(rig, some, planted[some], sd[some])
    others = rivals(target, (form,), (values,), rest, form.rank)
    named = form in rig.forms
    truth = _truth(
        frozenset({form.id}) if named else frozenset(),
        recording.acts,
        unknown=not named,
        named=named,
        fault=form.id in MEASUREMENT,
        form=form.source,
        visibility=round(seen(1.0), 2),
        strength=round(values["strength"], 4),
        identifiable=bool(min(others.values()) > IDENTIFIABLE),
        alternatives=others,
        planted=plain(planted - readings),
    )
    columns = {**case.columns, case.quantity: planted}
    return Dealt(PLANTED, recording, replace(case, columns=columns), truth)


def noise_of(case: Case, readings: np.ndarray) -> np.ndarray:
    """Noise of each reading: as the case states it, else from the scatter of neighbours in the recording."""
    least = LEAST_NOISE * float(np.median(np.abs(readings)))
    stated = case.settings["recording"].get("noise", {})
    if f"{case.quantity}_sd" in case.columns:
        return np.maximum(case.columns[f"{case.quantity}_sd"].astype(float), least)
    if "relative" in stated or "absolute" in stated:
        return np.maximum(np.hypot(stated.get("relative", 0.0) * readings, stated.get("absolute", 0.0)), least)
    bends = readings[2:] - 2.0 * readings[1:-1] + readings[:-2]
    return np.full(len(readings), max(1.4826 * float(np.median(np.abs(bends))) / np.sqrt(6.0), least))


def _write(place: Path, dealt: Dealt, rng: np.random.Generator) -> None:
    case, quantity = dealt.case, dealt.case.quantity
    columns = {name: column for name, column in case.columns.items() if name != quantity}
    count = len(columns["run"])
    withheld = np.zeros(count, dtype=bool)
    withheld[rng.choice(count, max(2, round(WITHHELD * count)), replace=False)] = True
    recording = dealt.recording
    answer = {
        "recording": recording.name,
        "source": recording.source,
        "split": recording.split,
        "kind": case.kind,
        "class": dealt.label,
        "acts": sorted(recording.acts),
        "understood": recording.understood,
        "faults": sorted(recording.fault_runs) if dealt.label == UNTOUCHED else [],
        **dealt.truth,
        "rows": {
            "run": [int(run) for run in columns["run"]],
            "withheld": [bool(flag) for flag in withheld],
            "reading": plain(case.columns[quantity].astype(float)),
        },
    }
    write(place, replace(case, columns=columns), {quantity: case.columns[quantity].astype(float)}, withheld, answer)
    if (recording.folder / "profiles").is_dir():
        shutil.copytree(recording.folder / "profiles", place / "profiles", dirs_exist_ok=True)
