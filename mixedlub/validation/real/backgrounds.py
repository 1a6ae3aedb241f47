"""Real readings as the base of a rig of the generator, so that its effects can be planted on them.

The readings take the place of the base law: without effects the model gives them back, whatever the rig did. The
generator's forms act on them through its own chain.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mixedlub.validation.contact import Calibration, Contact, start
from mixedlub.validation.rig import Act, Case, Form, Rig, play
from mixedlub.validation.rigs import ball, drives, films, histories, viscosities
from mixedlub.validation.sample_rig import draw_oil, progress

Readings = Callable[[np.ndarray, Sequence[Act]], np.ndarray]


def background(case: Case, rng: np.random.Generator) -> Rig:
    """Rig of a recorded case with its readings as the base model."""
    return KINDS[case.kind](case, np.asarray(case.columns[case.quantity], dtype=float), rng)


def _sequence(case: Case) -> np.ndarray:
    columns, count = case.columns, len(case.columns["run"])
    if "sequence" in columns:
        return np.asarray(columns["sequence"], dtype=float)
    if "time_s" in columns:
        time = np.asarray(columns["time_s"], dtype=float)
        return np.asarray((time - time.min()) / max(np.ptp(time), 1e-9))
    return progress(count)


def _rig(case: Case, names: Sequence[str], model: Readings, forms: Sequence[Form], outside: Sequence[Form]) -> Rig:
    return Rig(
        settings=case.settings,
        columns=case.columns,
        names=tuple(names),
        model=model,
        theta=lambda z: {},
        forms=tuple(forms),
        outside=tuple(outside),
    )


def _history(case: Case, readings: np.ndarray, rng: np.random.Generator) -> Rig:
    return histories.on_track(case.settings, case.columns, _sequence(case), readings)


def _viscosity(case: Case, readings: np.ndarray, rng: np.random.Generator) -> Rig:
    celsius = np.asarray(case.columns["temperature_C"], dtype=float)
    place = (celsius - celsius.mean()) / 50.0
    flat, known = np.zeros_like(readings), ((40.0, 100.0), (1.0, 1.0))

    def model(z: np.ndarray, acts: Sequence[Act]) -> np.ndarray:
        still = 1e-3 * readings * np.exp(0.3 * z[0] + 0.3 * z[1] * place + 0.05 * z[2] * place**2)
        sample = viscosities.Sample(celsius, flat, still, flat, flat, readings, still, known)
        return np.asarray(play(viscosities.CHAIN, sample, acts).recorded)

    time = _sequence(case)
    forms = viscosities.forms_over(time)
    return _rig(case, ("level", "slope", "bow"), model, forms, viscosities.outside_of(case.columns, time))


def _drive(case: Case, readings: np.ndarray, rng: np.random.Generator) -> Rig:
    as_torque = "speed_rpm" in case.columns
    speed = np.asarray(case.columns["speed_rpm" if as_torque else "sliding_speed_m_s"], dtype=float)
    share, flat = speed / np.abs(speed).max(), np.ones(len(speed))
    plain = np.stack([np.sign(share), share, flat], axis=1)
    (dry, drag, _), *_ = np.linalg.lstsq(plain, readings, rcond=None)
    dry = max(abs(dry), 0.1 * float(np.median(np.abs(readings))))

    def model(z: np.ndarray, acts: Sequence[Act]) -> np.ndarray:
        rest = readings - plain[:, :2] @ [dry, drag]
        level, viscous = dry * np.exp(0.5 * z[0]), drag * share * np.exp(z[1])
        state = drives.Drive(level * flat, viscous, rest + dry * z[2], np.sign(share), share, level, flat, flat)
        return np.asarray(play(drives.CHAIN, state, acts).recorded)

    forms, outside = drives.forms_of(case.columns, share, _sequence(case), as_torque)
    return replace(_rig(case, ("dry", "drag", "constant"), model, forms, outside), signed=True)


def _film(case: Case, readings: np.ndarray, rng: np.random.Generator) -> Rig:
    settings: dict[str, Any] = {**case.settings, "lubricant": draw_oil(rng) | case.settings.get("lubricant", {})}
    columns = _filled(case)
    inputs = ball.inputs_of(settings, columns, np.ones(3) * 1e-12)
    place = np.log(inputs.speed_1 + inputs.speed_2)
    place = (place - place.mean()) / max(float(np.ptp(place)), 1e-9)
    now = start(inputs, Calibration())

    def model(z: np.ndarray, acts: Sequence[Act]) -> np.ndarray:
        def measured(c: Contact) -> Contact:
            thicker = (c.viscosity / now.viscosity) ** ball.SPEED_EXPONENT
            return replace(c, film=1e-9 * readings[:, None] * thicker * np.exp(0.2 * z[0] + 0.1 * z[1] * place))

        return np.asarray(play(ball.film_chain(measured), now, acts).recorded)

    return films.read_by(rng, replace(_rig(case, ("level", "exponent"), model, (), ()), columns=columns), False)


def _filled(case: Case) -> dict[str, np.ndarray]:
    count = len(case.columns["run"])
    return {
        **case.columns,
        "slide_roll_ratio": case.columns.get("slide_roll_ratio", np.zeros(count)),
        "sequence": _sequence(case),
    }


KINDS: dict[str, Callable[[Case, np.ndarray, np.random.Generator], Rig]] = {
    "friction_history": _history,
    "viscosity": _viscosity,
    "friction_map": _drive,
    "film": _film,
}
"""Kinds of recording on which effects can be planted."""
