"""Friction over time: under constant conditions, in traction curves, in repeated Stribeck curves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mixedlub.validation.contact import PRIORS, contact_model, contact_theta
from mixedlub.validation.planted import FORMS, OUTSIDE, viscosity_temperature
from mixedlub.validation.planted.film import OF_HISTORIES
from mixedlub.validation.planted.histories import Track, creeps, histories
from mixedlub.validation.planted.measurement import channel, force_cell
from mixedlub.validation.rig import Act, Chain, Form, Knob, Rig, play, strength
from mixedlub.validation.rigs import ball
from mixedlub.validation.sample_rig import (
    UNCERTAINTY,
    between,
    draw_oil,
    draw_surfaces,
    pick,
    progress,
    repeated,
    rounded,
)

PAIRS = (
    ("friction_run_in", "contact_creep"),
    ("tribofilm_growth", "contact_creep"),
    ("tribofilm_growth", "film_heating"),
    ("running_in", "limiting_shear_stress"),
    ("tribofilm_growth", "inlet_shear_heating"),
    ("friction_run_in", "force_offset"),
    ("tribofilm_growth", "force_drift"),
)
BROAD = 0.6
ALSO_IN_CONTACT = (
    "film_heating",
    "limiting_shear_stress",
    "skewed_heights",
    "micro_ehl",
    "running_in",
    "boundary_film_temperature",
    "boundary_speed_dependence",
    "viscosity_drift",
)


BARE: Chain = (("boundary", None), ("loss", lambda t: replace(t, recorded=t.level)), ("sensor", None))


def _breaks(time: np.ndarray) -> tuple[Form, ...]:
    """Forms of friction that no slow surface state produces."""

    def multiplied(state: Any, factor: np.ndarray) -> Any:
        return replace(state, recorded=state.recorded * factor)

    def humming(state: Any, strength: float, waves: float) -> Any:
        """A slow rotation in the rig: 14 to 25 swings in the programme."""
        return multiplied(state, 1 + 0.06 * strength * np.sin(2 * np.pi * waves * time))

    def chattering(state: Any, strength: float, waves: float) -> Any:
        """A vibration builds up: its swings grow with the test."""
        return multiplied(state, 1 + 0.1 * strength * time * np.sin(2 * np.pi * waves * time))

    def alternating(state: Any, strength: float) -> Any:
        """Every second reading belongs to the other direction of a reciprocating stroke."""
        return multiplied(state, 1 + 0.05 * strength * (-1.0) ** np.arange(len(time)))

    either = strength(-5.0, 8.0)
    return (
        Form("humming", "loss", humming, (either, Knob("waves", 12.0, 28.0, (14.0, 25.0))), "constructed"),
        Form("chattering", "loss", chattering, (either, Knob("waves", 8.0, 25.0, (10.0, 20.0))), "constructed"),
        Form("alternating", "loss", alternating, (either,), "constructed"),
    )


def _all(found: dict[str, tuple[Form, ...]]) -> tuple[Form, ...]:
    return tuple(form for forms in found.values() for form in forms)


def _numbered(columns: dict[str, np.ndarray], seconds: float) -> dict[str, np.ndarray]:
    """Columns with run numbers and times; the place in the programme follows from the time alone."""
    columns = repeated(columns, 1)
    count = len(columns["run"])
    columns["time_s"] = np.round(np.linspace(seconds / count, seconds, count), 1)
    return columns


def _held(rng: np.random.Generator, settings: dict[str, Any], columns: dict[str, np.ndarray], time: np.ndarray) -> Rig:
    return on_track(settings, columns, time, np.full(len(time), between(rng, 0.04, 0.13)))


def on_track(settings: dict[str, Any], columns: Mapping[str, np.ndarray], time: np.ndarray, middle: np.ndarray) -> Rig:
    """A track with unknown oil and surfaces: the base model is the ``middle`` coefficient with a broad prior."""
    slip = columns.get("slide_roll_ratio", np.ones(len(time)))

    def factor(z: np.ndarray) -> float:
        return float(np.exp(BROAD * z[0]))

    def model(z: np.ndarray, acts: Sequence[Act]) -> np.ndarray:
        level = middle * factor(z)
        return np.asarray(play(BARE, Track(level, level), acts).recorded)

    curves = len(np.unique(slip)) > 4
    forms = _all(histories(time)) + (creeps(slip) if curves else ()) + channel(time, curves, False, False)
    if "load_N" in columns:
        forms += force_cell(columns["load_N"], time)
    return Rig(
        settings=settings,
        columns=dict(columns),
        names=("boundary_friction",),
        model=model,
        theta=lambda z: {"boundary_friction": float(middle[0]) * factor(z)},
        forms=forms,
        outside=_breaks(time),
    )


def _settings(**sections: Any) -> dict[str, Any]:
    recording = {"quantity": "friction_coefficient"}
    return {"schema": "mixedlub-case/1", "kind": "friction_history", **sections, "recording": recording}


def draw_steady(rng: np.random.Generator) -> Rig:
    """Friction under constant conditions, as a log or as means of rubbing steps."""
    count = int(pick(rng, (24, 40, 60, 100, 200)))
    columns = _numbered({"placeholder": np.zeros(count)}, between(rng, 600, 2e5))
    del columns["placeholder"]
    if rng.random() < 0.5:
        held = {"load_N": (20.0, 75.0), "entrainment_speed_m_s": (0.05, 0.5), "oil_temperature_C": (40.0, 130.0)}
        columns |= {name: np.full(count, between(rng, *span, 2)) for name, span in held.items()}
        columns["slide_roll_ratio"] = np.full(count, pick(rng, (0.5, 1.0, 2.0)))
    return _held(rng, _settings(), columns, progress(count))


def draw_loads(rng: np.random.Generator) -> Rig:
    """Friction at one speed under a few loads in repeated steps, up, or up and down."""
    least = between(rng, 2, 20, 2)
    loads = [rounded(w, 3) for w in np.geomspace(least, between(rng, 4, 15) * least, int(rng.integers(3, 6)))]
    steps = np.repeat(loads if rng.random() < 0.5 else [*loads, *loads[-2:0:-1]], int(rng.integers(1, 4)))
    again = max(int(rng.uniform(40, 120) / len(steps)), 2)
    columns = _numbered({"load_N": np.tile(steps, again)}, between(rng, 1200, 1e5))
    columns["entrainment_speed_m_s"] = np.full(len(steps) * again, between(rng, 0.01, 0.5, 2))
    return _held(rng, _settings(), columns, progress(len(steps) * again))


def draw_traction(rng: np.random.Generator) -> Rig:
    """Repeated traction curves on one track, slips from below one per mille on."""
    slips = np.array([rounded(s, 3) for s in np.geomspace(0.0006, between(rng, 0.1, 0.3), int(rng.integers(10, 19)))])
    cycles = int(rng.integers(4, 11))
    columns = _numbered({"slide_roll_ratio": np.tile(slips, cycles)}, between(rng, 3000, 3e5))
    columns["entrainment_speed_m_s"] = np.full(slips.size * cycles, between(rng, 0.01, 0.05, 2))
    return _held(rng, _settings(), columns, progress(slips.size * cycles))


def _curves(rng: np.random.Generator) -> np.ndarray:
    """Bath, load, slip and falling speed of every reading: repeated sequences of Stribeck curves."""
    speeds = np.array([rounded(u, 3) for u in np.geomspace(between(rng, 0.01, 0.03), 3.0, int(rng.integers(8, 14)))])
    baths = pick(rng, ([60.0], [100.0], [60.0, 100.0], [40.0, 70.0, 100.0], [25.0, 60.0, 95.0, 130.0]))
    slips = pick(rng, ([0.5], [0.5], [0.1, 0.5], [0.05, 0.3, 1.0]))
    loads = pick(rng, ([between(rng, 20, 60, 2)], [between(rng, 20, 60, 2)], [5.0, 20.0, 60.0], [10.0, 40.0]))
    if len(baths) * len(slips) * len(loads) > 9:
        slips = slips[:1]
    again = max(int(rng.uniform(60, 180) / (len(speeds) * len(baths) * len(slips) * len(loads))), 2)
    curve = [(t, w, s, u) for t in baths for w in loads for s in slips for u in speeds[::-1]]
    return np.tile(np.array(curve), (again, 1))


def draw_stribeck(rng: np.random.Generator) -> Rig:
    """Stribeck curves of a ball on a disc between rubbing steps, with oil and surfaces described."""
    grid = _curves(rng)
    surfaces = draw_surfaces(rng, False)
    names = list(surfaces)
    first, second = str(rng.choice(names[:2])), str(rng.choice(names))
    columns = _numbered(
        {
            "load_N": grid[:, 1],
            "entrainment_speed_m_s": grid[:, 3],
            "slide_roll_ratio": grid[:, 2],
            "oil_temperature_C": grid[:, 0],
            "surface_1": np.full(len(grid), first, dtype=object),
            "surface_2": np.full(len(grid), second, dtype=object),
        },
        between(rng, 5000, 1e5),
    )
    settings = _settings(
        boundary_friction=0.1,
        contact={
            "geometry": "point",
            "radius_mm": [9.525, float("inf")],
            "youngs_modulus_GPa": [207.0, 207.0],
            "poisson_ratio": [0.3, 0.3],
        },
        lubricant=draw_oil(rng),
        surfaces={name: surfaces[name] for name in dict.fromkeys((first, second))},
        uncertainty=UNCERTAINTY,
    )
    units = np.array([1e-12, 1.0, 1e12])
    moments = sum(np.array(list(surfaces[name].values())[:3]) * units for name in (first, second))
    time = progress(len(grid))
    inputs = ball.inputs_of(settings, {**columns, "sequence": time}, moments)
    found = histories(time)
    several = np.ptp(grid[:, 0]) > 0
    shown = [name for name in ALSO_IN_CONTACT if several or "temperature" not in name]
    usable = [replace(form, rarity=0.6) for name in shown for form in FORMS[name]]
    forms = (
        *found["friction_run_in"],
        *found["tribofilm_growth"],
        *OF_HISTORIES,
        *usable,
        *viscosity_temperature.of_contacts(inputs),
    )
    broken = [OUTSIDE[name] for name in ("speed_band", "speed_ripple")]
    return Rig(
        settings=settings,
        columns=columns,
        names=PRIORS,
        model=contact_model(settings, lambda: inputs, ball.FRICTION),
        theta=contact_theta(settings),
        forms=forms + channel(time, True, True, False) + force_cell(grid[:, 1], time),
        outside=(*broken, *_breaks(time)[:1]),
    )


def draw(rng: np.random.Generator) -> Rig:
    """One of the four programmes."""
    return pick(rng, (draw_steady, draw_steady, draw_loads, draw_traction, draw_stribeck))(rng)
