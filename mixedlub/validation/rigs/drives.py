"""Friction of whole drives against signed speed: screws, actuators, spindles."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mixedlub.validation.planted.drives import presliding, stirring, under_load
from mixedlub.validation.planted.measurement import channel, force_cell
from mixedlub.validation.rig import Act, Chain, Form, Knob, Rig, play, strength
from mixedlub.validation.sample_rig import between, pick, progress, repeated, rounded

PAIRS = (
    ("stribeck", "direction_dependence"),
    ("stribeck", "load_dependent_friction"),
    ("grease_temperature", "stribeck"),
    ("periodic_mesh", "zero_drift"),
    ("friction_modifier_film", "stribeck"),
    ("stribeck", "presliding"),
    ("load_dependent_friction", "force_offset"),
    ("stribeck", "fluid_drag"),
)
BROAD = 0.5
OF_TORQUE = ("plain", "plain", "slow", "temperature", "load", "additive", "position", "current")
OF_FORCE = ("plain", "slow", "temperature", "load", "load", "load", "additive", "position")
"""Programmes of a drive and of a tribometer, each weighted by its number of entries."""


@dataclass(frozen=True)
class Drive:
    """Dry torque (unsigned), drag at each speed over its size at full speed, and readings of the channel."""

    dry: np.ndarray
    drag: np.ndarray
    constant: np.ndarray
    sign: np.ndarray
    speed: np.ndarray
    level: float
    running: np.ndarray
    recorded: np.ndarray


def _run(d: Drive) -> Drive:
    return replace(d, running=d.dry * d.sign + d.drag)


def _show(d: Drive) -> Drive:
    return replace(d, recorded=d.running + d.constant)


CHAIN: Chain = (("parts", None), ("running", _run), ("loss", _show), ("sensor", None))


def _added(d: Drive, more: np.ndarray) -> Drive:
    return replace(d, running=d.running + more)


def gaussian(d: Drive, strength: float, width: float) -> Drive:
    """0.3 strength of the level times exp(-(v/width)^2)."""
    return _added(d, 0.3 * strength * d.level * np.exp(-((d.speed / width) ** 2)) * d.sign)


def lorentzian(d: Drive, strength: float, width: float) -> Drive:
    """0.3 strength of the level over 1 + (v/width)^2."""
    return _added(d, 0.3 * strength * d.level / (1 + (d.speed / width) ** 2) * d.sign)


def bo_pavelescu(d: Drive, strength: float, width: float, exponent: float) -> Drive:
    """0.3 strength of the level times exp(-|v/width|^n), n the exponent."""
    return _added(d, 0.3 * strength * d.level * np.exp(-(np.abs(d.speed / width) ** exponent)) * d.sign)


def makkar(d: Drive, strength: float, width: float) -> Drive:
    """0.3 strength of the level times 1 - tanh(|v|/width)."""
    return _added(d, 0.3 * strength * d.level * (1 - np.tanh(np.abs(d.speed) / width)) * d.sign)


def unlike_flanks(d: Drive, strength: float, viscous: float) -> Drive:
    """Dry part and drag that differ between the directions, by slightly unequal shares."""
    side = 0.1 * strength * d.sign
    return replace(d, dry=d.dry * (1 + side), drag=d.drag * (1 + viscous * side))


def carreau_grease(d: Drive, strength: float, index: float) -> Drive:
    """Drag times (1 + (8 strength v)^2)^((n - 1)/2), v over full speed, n the index."""
    rate = strength * np.abs(d.speed) * 8
    return replace(d, drag=d.drag * (1 + rate**2) ** (0.5 * (index - 1)))


def cross_grease(d: Drive, strength: float, power: float) -> Drive:
    """Drag over 1 + (4 strength v)^p, v over full speed, p the power."""
    return replace(d, drag=d.drag / (1 + (strength * np.abs(d.speed) * 4) ** power))


def eyring_grease(d: Drive, strength: float) -> Drive:
    """Drag times asinh(x)/x, x = 6 strength v, v over full speed."""
    rate = np.maximum(6 * strength * np.abs(d.speed), 1e-9)
    return replace(d, drag=d.drag * np.arcsinh(rate) / rate)


def _speed_forms() -> tuple[Form, ...]:
    rise = strength(0.0, 8.0)
    width = Knob("width", 0.01, 0.5, (0.04, 0.2))
    shear = strength(0.0, 20.0, (0.5, 2.0))
    return (
        Form("stribeck", "running", gaussian, (rise, width), "Gaussian", within=True),
        Form("stribeck", "running", lorentzian, (rise, width), "Hess and Soom 1990"),
        Form("stribeck", "running", bo_pavelescu, (rise, width, Knob("exponent", 0.4, 3.0, (0.6, 2.0))),
             "Bo, Pavelescu", within=True),
        Form("stribeck", "running", makkar, (rise, width), "Makkar et al. 2005"),
        Form("direction_dependence", "parts", unlike_flanks,
             (strength(-6.0, 6.0), Knob("viscous", 0.6, 1.6, (0.8, 1.3))), "two flanks", within=True),
        Form("grease_shear_thinning", "parts", carreau_grease, (shear, Knob("index", 0.2, 0.9, (0.35, 0.75))),
             "Carreau"),
        Form("grease_shear_thinning", "parts", cross_grease, (shear, Knob("power", 0.3, 0.95, (0.5, 0.85))), "Cross"),
        Form("grease_shear_thinning", "parts", eyring_grease, (shear,), "Eyring"),
    )  # fmt: skip


def _temperature_forms(celsius: np.ndarray) -> tuple[Form, ...]:
    kelvin = celsius + 273.15

    def vogel(d: Drive, strength: float) -> Drive:
        """Drag times exp(strength (700/(t + 95) - 700/135)), t in C."""
        return replace(d, drag=d.drag * np.exp(strength * (700 / (celsius + 95) - 700 / 135)))

    def arrhenius(d: Drive, strength: float) -> Drive:
        """Drag times exp(2800 strength (1/T - 1/313.15)), T in K."""
        return replace(d, drag=d.drag * np.exp(2800 * strength * (1 / kelvin - 1 / 313.15)))

    def power(d: Drive, strength: float) -> Drive:
        """Slotte's power of the temperature over 45 C below the freezing point."""
        return replace(d, drag=d.drag * ((celsius + 45) / 85) ** (-2.2 * strength))

    size = (strength(0.0, 3.0, (0.6, 1.5)),)
    return tuple(
        Form("grease_temperature", "parts", law, size, source, within=within)
        for law, source, within in ((vogel, "Vogel", True), (arrhenius, "Arrhenius", True), (power, "Slotte", False))
    )


def _additive_forms(content: np.ndarray) -> tuple[Form, ...]:
    share = content / content.max()

    def lowered(d: Drive, strength: float, covered: np.ndarray) -> Drive:
        return replace(d, dry=d.dry * np.clip(1 - 0.35 * strength * covered, 0.02, None))

    def filled(d: Drive, strength: float, half: float) -> Drive:
        """1 - e^(-v/half) of the film, v the additive content over its maximum."""
        return lowered(d, strength, -np.expm1(-share / half))

    def hill(d: Drive, strength: float, half: float) -> Drive:
        """v^1.4/(v^1.4 + half^1.4) of the film, v the additive content over its maximum."""
        return lowered(d, strength, share**1.4 / (share**1.4 + half**1.4))

    def temkin(d: Drive, strength: float, half: float) -> Drive:
        """ln(1 + v/half)/ln(1 + 1/half) of the film, v the additive content over its maximum."""
        return lowered(d, strength, np.log1p(share / half) / np.log1p(1 / half))

    knobs = (strength(0.0, 2.4), Knob("half", 0.02, 0.6, (0.05, 0.3)))
    return tuple(
        Form("friction_modifier_film", "parts", law, knobs, source)
        for law, source in ((filled, "exponential filling"), (hill, "Hill 1910"), (temkin, "Temkin 1940"))
    )


def _position_forms(angle: np.ndarray) -> tuple[Form, ...]:
    turn = np.radians(angle)

    def two_tones(d: Drive, strength: float, order: float, phase: float) -> Drive:
        """0.2 strength of the level times sin(n a + phase) + 0.2 sin(2 n a + 0.5), a the turn, n the order."""
        wave = np.sin(order * turn + phase) + 0.2 * np.sin(2 * order * turn + 0.5)
        return replace(d, running=d.running + 0.2 * strength * d.level * wave)

    def triangle(d: Drive, strength: float, order: float, phase: float) -> Drive:
        """0.2 strength of the level times a triangular wave of the turn."""
        wave = 2 / np.pi * np.arcsin(np.sin(order * turn + phase))
        return replace(d, running=d.running + 0.2 * strength * d.level * wave)

    most = 0.3 * len(np.unique(angle)) / max(np.ptp(angle) / 360, 1e-3)
    teeth = Knob("order", 1.0, min(40.0, most), (2.0, min(30.0, most)))
    knobs = (strength(0.0, 6.0), teeth, Knob("phase", 0.0, 6.283, (0.0, 6.0)))
    return (
        Form("periodic_mesh", "running", two_tones, knobs, "mesh tone with its second"),
        Form("periodic_mesh", "running", triangle, knobs, "triangular error of pitch"),
    )


def _current_forms(motor: np.ndarray) -> tuple[Form, ...]:
    """Forms for a torque derived from a motor current, recorded in a separate column."""

    def lost(d: Drive, strength: float, bend: float, law: Callable[[np.ndarray], np.ndarray]) -> Drive:
        ratio = np.abs(motor) / np.abs(motor).max()
        return replace(d, recorded=d.recorded + motor * 0.06 * strength * (1 - bend + bend * law(ratio)))

    def saturating(d: Drive, strength: float, bend: float) -> Drive:
        """Missing torque: the constant falls as k/(1 + c T)."""
        return lost(d, strength, bend, lambda ratio: 2 * ratio / (1 + ratio))

    def bent(d: Drive, strength: float, bend: float) -> Drive:
        """The constant falls with the square of the current."""
        return lost(d, strength, bend, lambda ratio: ratio**2)

    knobs = (strength(0.0, 8.0), Knob("bend", 0.0, 1.0, (0.3, 1.0)))
    return (
        Form("torque_constant", "sensor", saturating, knobs, "saturation as a fraction"),
        Form("torque_constant", "sensor", bent, knobs, "saturation as a square"),
    )


def _outside(columns: Mapping[str, np.ndarray], time: np.ndarray) -> tuple[Form, ...]:
    def ringing(d: Drive, strength: float, centre: float, width: float) -> Drive:
        """Friction rises in one band of speed, at a resonance of the drive."""
        return _added(d, 0.2 * strength * d.level * np.exp(-0.5 * ((np.abs(d.speed) - centre) / width) ** 2) * d.sign)

    def lifting(d: Drive, strength: float, where: float) -> Drive:
        """A seal lifts off beyond a speed and its friction vanishes."""
        return _added(d, -0.15 * strength * d.level * (np.abs(d.speed) > where) * d.sign)

    def stepped(d: Drive, strength: float, when: float) -> Drive:
        """Friction changes from one moment on."""
        return _added(d, 0.15 * strength * d.level * (time > when) * d.sign)

    def dented(d: Drive, strength: float, where: float) -> Drive:
        """One place of the screw is dented."""
        near = (columns["position_deg"] % 360.0 - where + 180) % 360 - 180
        return _added(d, 0.3 * strength * d.level * np.exp(-0.5 * (near / 15) ** 2) * d.sign)

    either = strength(-5.0, 8.0)
    if "position_deg" in columns:
        return (Form("dented", "running", dented, (either, Knob("where", 40.0, 320.0, (60.0, 300.0))), "constructed"),)
    return (
        Form("ringing", "running", ringing,
             (either, Knob("centre", 0.3, 0.8, (0.35, 0.75)), Knob("width", 0.03, 0.12, (0.05, 0.1))), "constructed"),
        Form("lifting", "running", lifting, (either, Knob("where", 0.3, 0.8, (0.35, 0.7))), "constructed"),
        Form("stepped", "running", stepped, (either, Knob("when", 0.2, 0.8, (0.3, 0.7))), "constructed"),
    )  # fmt: skip


def _speeds(rng: np.random.Generator, top: float, creep: bool) -> np.ndarray:
    """Speeds of both directions, evenly spaced or geometric; three to four decades if ``creep``."""
    count = int(rng.integers(14, 25) if creep else rng.integers(8, 17))
    if creep:
        half = np.geomspace(top / between(rng, 1000, 20000), top, count)
    elif rng.random() < 0.6:
        half = np.geomspace(top / between(rng, 30, 120), top, count)
    else:
        half = np.linspace(top / (2 * count), top, count)
    half = np.array([rounded(v, 3) for v in half])
    return np.concatenate([half, -half])


def _grid(rng: np.random.Generator, speeds: np.ndarray, name: str, levels: Sequence[float]) -> dict[str, np.ndarray]:
    return {"speed": np.tile(speeds, len(levels)), name: np.repeat(np.array(levels, dtype=float), len(speeds))}


def _programme(rng: np.random.Generator, styles: Sequence[str], top: float, torque: float) -> dict[str, np.ndarray]:
    style = str(pick(rng, styles))
    speeds = _speeds(rng, top, style == "slow")
    if style == "temperature":
        return _grid(
            rng, speeds, "oil_temperature_C", pick(rng, ([10.0, 30.0, 60.0], [20.0, 50.0], [-10.0, 20.0, 45.0, 70.0]))
        )
    if style == "load":
        return _grid(rng, speeds, "load_N", pick(rng, ([10.0, 40.0, 90.0], [0.5, 20.0, 50.0, 100.0])))
    if style == "additive":
        return _grid(
            rng, speeds, "additive_percent", pick(rng, ([0.0, 0.5, 1.0, 3.0, 10.0], [0.0, 0.2, 0.5, 1.0, 2.0]))
        )
    if style == "position":
        angle = np.round(np.linspace(0.0, pick(rng, (360.0, 720.0)), int(rng.integers(70, 201)), endpoint=False), 3)
        steps = np.array([0.25, 0.5]) * top
        return {"speed": steps[np.arange(len(angle)) % 2], "position_deg": angle}
    if style == "current":
        few = np.repeat(speeds[:: max(len(speeds) // 6, 1)], 1)
        loads = np.linspace(0.0, between(rng, 4, 12) * torque, int(rng.integers(4, 7)))
        sides = np.concatenate([loads, -loads[1:]])
        return {"speed": np.tile(few, len(sides)), "motor_torque_Nm": np.round(np.repeat(sides, len(few)), 5)}
    return {"speed": speeds}


def forms_of(
    columns: Mapping[str, np.ndarray], share: np.ndarray, time: np.ndarray, as_torque: bool
) -> tuple[tuple[Form, ...], tuple[Form, ...]]:
    """Forms open to a drive inside and outside the catalogue; ``share``: speed over its largest size."""
    forms = _speed_forms() + presliding(share) + stirring(share, as_torque) + channel(time, False, False, True)
    if "load_N" in columns and not as_torque:
        forms += force_cell(columns["load_N"], time)
    made = {
        "oil_temperature_C": _temperature_forms,
        "load_N": under_load,
        "additive_percent": _additive_forms,
        "position_deg": _position_forms,
        "motor_torque_Nm": _current_forms,
    }
    if "position_deg" in columns:
        forms = channel(time, False, False, True)
    for name, make in made.items():
        if name in columns:
            forms += make(columns[name])
    return forms, _outside(columns, time)


def draw(rng: np.random.Generator) -> Rig:
    """A drive, in newton metres against rpm or as a coefficient against sliding speed."""
    as_torque = rng.random() < 0.75
    top = between(rng, 60, 3000, 2) if as_torque else between(rng, 0.1, 2.0, 2)
    level = between(rng, 0.005, 5.0) if as_torque else between(rng, 0.04, 0.2)
    columns = _programme(rng, OF_TORQUE if as_torque else OF_FORCE, top, level)
    count = len(columns["speed"])
    shuffled = "position_deg" not in columns and rng.random() < 0.7
    places = rng.permutation(count) if shuffled else np.arange(count)
    again = count <= 50 and rng.random() < 0.25
    columns = repeated({name: column[places] for name, column in columns.items()}, 3 if again else 1)
    time = progress(len(columns["run"]))
    speed = columns.pop("speed")
    columns["speed_rpm" if as_torque else "sliding_speed_m_s"] = speed
    columns["sequence"] = time
    quantity = "friction_torque_Nm" if as_torque else "friction_coefficient"
    drag, side = level * rng.uniform(0.3, 1.2), level * rng.uniform(-0.3, 0.3)
    share = speed / np.abs(speed).max()

    def parts(z: np.ndarray) -> tuple[float, float, float]:
        return float(level * np.exp(BROAD * z[0])), float(drag * np.exp(z[1])), float(side + level * z[2])

    def model(z: np.ndarray, acts: Sequence[Act]) -> np.ndarray:
        dry, viscous, constant = parts(z)
        flat = np.ones(len(share))
        state = Drive(dry * flat, viscous * share, constant * flat, np.sign(share), share, dry, flat, flat)
        return np.asarray(play(CHAIN, state, acts).recorded)

    forms, outside = forms_of(columns, share, time, as_torque)
    return Rig(
        signed=True,
        settings={"schema": "mixedlub-case/1", "kind": "friction_map", "recording": {"quantity": quantity}},
        columns=columns,
        names=("dry", "drag", "constant"),
        model=model,
        theta=lambda z: {},
        forms=forms,
        outside=outside,
        repeats=again,
    )
