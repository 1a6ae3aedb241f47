"""Power loss of spur gear pairs: involute kinematics, load sharing, all pairings of surfaces at each load.

A ring gear has a negative number of teeth; every length is positive.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
from typing import Any

import numpy as np

from mixedlub.validation.contact import (
    PRIORS,
    Inputs,
    contact_model,
    contact_theta,
    friction_chain,
    oil_of,
    record_power,
    solid_of,
    surfaces_of,
)
from mixedlub.validation.planted import FORMS, OUTSIDE
from mixedlub.validation.rig import Case, Form, Model, Rig
from mixedlub.validation.sample_rig import (
    FLOOR,
    STEEL,
    UNCERTAINTY,
    draw_levels,
    draw_oil,
    draw_pairings,
    draw_surfaces,
    draw_temperatures,
    programme,
    rounded,
)
from profiles.errors import InputError

NOT_HERE = ("contact_creep", "odd_slip_power")
"""Effects of one slide-roll ratio; every gear reading mixes many."""
COARSE, FINE = 48, 240
"""Points along the path of contact: for rival fits, and for recordings."""
COATED = 0.12
"""Share of rigs with a coating."""
POWER_LOSS = friction_chain(record=record_power)
GEARS: tuple[dict[str, Any], ...] = (
    {"teeth": [17, 26], "normal_module_mm": 4.2333333, "pressure_angle_deg": 22.5, "face_width_mm": 14.0,
     "tip_diameter_mm": [80.4, 118.5], "torques": (40.0, 160.0), "speeds": (500.0, 3500.0)},
    {"teeth": [16, 24], "normal_module_mm": 4.5, "pressure_angle_deg": 20.0, "face_width_mm": 14.0,
     "tip_diameter_mm": [82.46, 118.36], "profile_shift": [0.1817, 0.1715], "centre_distance_mm": 91.5,
     "torques": (60.0, 300.0), "speeds": (400.0, 3500.0)},
    {"teeth": [28, 28], "normal_module_mm": 3.175, "pressure_angle_deg": 20.0, "face_width_mm": 6.35,
     "tip_diameter_mm": [95.25, 95.25], "torques": (25.0, 90.0), "speeds": (600.0, 6000.0)},
    {"teeth": [23, 37], "normal_module_mm": 3.0, "pressure_angle_deg": 20.0, "face_width_mm": 20.0,
     "tip_diameter_mm": [75.0, 117.0], "torques": (40.0, 220.0), "speeds": (500.0, 4500.0)},
    {"teeth": [35, 40], "normal_module_mm": 2.5, "pressure_angle_deg": 20.0, "face_width_mm": 18.0,
     "tip_diameter_mm": [92.5, 105.0], "torques": (50.0, 200.0), "speeds": (500.0, 5000.0)},
)  # fmt: skip


@dataclass(frozen=True)
class Gears:
    """A spur pair in the transverse plane; lengths in m, pinion first.

    ``tip``: tip radii; ``centre``: operating centre distance, derived from the shifts if None.
    """

    teeth: tuple[int, int]
    module: float
    pressure_angle: float
    tip: tuple[float, float]
    face_width: float
    shift: tuple[float, float] = (0.0, 0.0)
    centre: float | None = None

    @property
    def side(self) -> int:
        """1 for an external pair, -1 for a ring gear, whose centre lies on the pinion's side of the contact."""
        return 1 if self.teeth[1] > 0 else -1


def involute(angle: float) -> float:
    """Involute function tan(a) - a.

    >>> round(involute(np.radians(20.0)), 6)
    0.014904
    """
    return float(np.tan(angle) - angle)


def operating_angle(gears: Gears) -> float:
    """Working pressure angle (rad): inv(a_w) = inv(a) + 2 tan(a)(x1 + x2)/(z1 + z2), or from the centre."""
    from scipy.optimize import brentq

    z1, z2 = gears.teeth
    if gears.centre is not None:
        return float(np.arccos(0.5 * gears.module * abs(z1 + z2) * np.cos(gears.pressure_angle) / gears.centre))
    target = involute(gears.pressure_angle) + 2 * np.tan(gears.pressure_angle) * sum(gears.shift) / (z1 + z2)
    return float(brentq(lambda angle: involute(angle) - target, 1e-3, 1.2, xtol=1e-14))


@dataclass(frozen=True)
class ContactPath:
    """The path of contact: distances (m) from the pinion's base tangent point, base radii, base pitch.

    ``side``: -1 if both base tangent points lie on the same side of the contact, as on a ring gear, else 1.
    """

    start: float
    low_single: float
    pitch: float
    high_single: float
    end: float
    tangent_length: float
    base_radius: tuple[float, float]
    base_pitch: float
    side: int = 1

    @property
    def pitch_radii(self) -> float:
        """Sum of both pitch radii (m): the centre distance of an external pair."""
        return float(np.hypot(self.pitch, self.base_radius[0]) * (1 + self.base_radius[1] / self.base_radius[0]))

    def of_wheel(self, position: np.ndarray) -> np.ndarray:
        """Distance (m) from the wheel's base tangent point: the wheel's radius of curvature."""
        return self.tangent_length - self.side * position

    @property
    def contact_ratio(self) -> float:
        return (self.end - self.start) / self.base_pitch


def path_of_contact(gears: Gears) -> ContactPath:
    """Start, single-contact limits, pitch point and end of the path, by intersecting the tip circles.

    Valid for contact ratios between 1 and 2. FZG type C gears have a contact ratio of 1.4375.

    >>> fzg = Gears((16, 24), 4.5e-3, np.radians(20.0), (41.23e-3, 59.18e-3), 14e-3, centre=91.5e-3)
    >>> round(path_of_contact(fzg).contact_ratio, 3)
    1.438
    """
    working, side = operating_angle(gears), gears.side
    base = tuple(0.5 * gears.module * abs(z) * np.cos(gears.pressure_angle) for z in gears.teeth)
    length = (base[1] + side * base[0]) * np.tan(working)
    start = side * (length - np.sqrt(gears.tip[1] ** 2 - base[1] ** 2))
    end = np.sqrt(gears.tip[0] ** 2 - base[0] ** 2)
    pitch = np.pi * gears.module * np.cos(gears.pressure_angle)
    if not (start > 0 and side * end < length and pitch < end - start < 2 * pitch):
        raise InputError(
            "the path of contact must lie between the base tangent points, with contact ratio 1 to 2",
            where="gears",
            value=round(float((end - start) / pitch), 3),
        )
    return ContactPath(
        start=float(start),
        low_single=float(end - pitch),
        pitch=float(base[0] * np.tan(working)),
        high_single=float(start + pitch),
        end=float(end),
        tangent_length=float(length),
        base_radius=(float(base[0]), float(base[1])),
        base_pitch=float(pitch),
        side=side,
    )


def gears_of(settings: Mapping[str, Any]) -> Gears:
    table = settings["gears"]
    if table.get("helix_angle_deg", 0.0) != 0.0:
        raise InputError("gears must be spur gears", where="gears.helix_angle_deg", value=table["helix_angle_deg"])
    centre = table.get("centre_distance_mm")
    return Gears(
        teeth=tuple(table["teeth"]),
        module=1e-3 * table["normal_module_mm"],
        pressure_angle=float(np.radians(table["pressure_angle_deg"])),
        tip=tuple(0.5e-3 * abs(d) for d in table["tip_diameter_mm"]),
        face_width=1e-3 * table["face_width_mm"],
        shift=tuple(table.get("profile_shift", (0.0, 0.0))),
        centre=None if centre is None else 1e-3 * abs(centre),
    )


def share_at(path: ContactPath, rows: np.ndarray | None, torque: np.ndarray, position: np.ndarray) -> np.ndarray:
    """Load share, readings by points, from rows of (torque, roll angle in degrees, share); equal shares if None."""
    if rows is None:
        single = (position > path.low_single) & (position < path.high_single)
        return np.broadcast_to(np.where(single, 1.0, 0.5), (len(torque), len(position)))
    angle = np.degrees(position / path.base_radius[0])
    known = np.unique(rows[:, 0])
    curves = np.array([np.interp(angle, *rows[rows[:, 0] == level][:, 1:].T) for level in known])
    nearest = np.argmin(np.abs(torque[:, None] - known[None, :]), axis=1)
    return np.asarray(curves[nearest])


def draw_share(rng: np.random.Generator, settings: dict[str, Any], torques: list[float]) -> np.ndarray | None:
    """Load-share rows: ISO-like ramps, or elastic-like ramps that depend on torque; None for equal sharing."""
    style = rng.choice(["rigid", "ramp", "elastic"], p=[0.2, 0.3, 0.5])
    if style == "rigid":
        return None
    path = path_of_contact(gears_of(settings))
    ratio = path.contact_ratio
    place = np.linspace(0.0, ratio, int(rng.integers(61, 92)))
    tip, reach = rng.uniform(0.2, 0.45), rng.uniform(0.0, 0.9)
    rows = []
    for torque in torques:
        end = tip * (torque / max(torques)) ** reach if style == "elastic" else 1 / 3
        bend = rng.uniform(0.8, 1.3) if style == "elastic" else 1.0
        ramp = np.clip(place / (ratio - 1), 0, 1) ** bend
        entering = end + (1 - 2 * end) * ramp
        leaving = end + (1 - 2 * end) * np.clip((ratio - place) / (ratio - 1), 0, 1) ** bend
        share = np.where(place < ratio - 1, entering, np.where(place > 1, leaving, 1.0))
        angle = np.degrees((path.start + place * path.base_pitch) / path.base_radius[0])
        rows.append(np.column_stack([np.full(len(place), torque), np.round(angle, 6), np.round(share, 6)]))
    return np.concatenate(rows)


def inputs_of(case: Case, points: int = FINE, positions: np.ndarray | None = None) -> Inputs:
    """Contacts of a gear pair on ``points`` midpoints of the path, or at ``positions`` (m)."""
    gears = gears_of(case.settings)
    path = path_of_contact(gears)
    length = (path.end - path.start) / points
    position = path.start + length * (np.arange(points) + 0.5) if positions is None else positions
    torque = case.columns["torque_Nm"].astype(float)
    pinion = case.columns["speed_rpm"].astype(float)[:, None] * np.pi / 30
    wheel, away = pinion * gears.teeth[0] / abs(gears.teeth[1]), path.of_wheel(position)
    return Inputs(
        oil=oil_of(case.settings),
        solid=solid_of(case.settings["gears"]),
        radius=(position * away / path.tangent_length)[None, :],
        speed_1=pinion * position,
        speed_2=wheel * away,
        share_force=share_at(path, case.share, torque, position) * torque[:, None] / path.base_radius[0],
        width=gears.face_width,
        temperature=case.columns["oil_temperature_C"].astype(float),
        sequence=case.columns.get("sequence", np.zeros(len(torque))).astype(float),
        conditions=case.columns,
        step=length / path.base_pitch,
        phase=(position - path.start)[None, :] / path.base_pitch,
        extras={
            "contact_ratio": path.contact_ratio,
            "ambient": case.settings["recording"].get("ambient_temperature_C", 25.0),
            "teeth": gears.teeth[0],
            "module": gears.module,
            "pitch_diameter": gears.module * gears.teeth[0],
            "wheel_diameter": gears.module * abs(gears.teeth[1]),
            "ratio": gears.teeth[0] / abs(gears.teeth[1]),
            "base_radius": path.base_radius[0],
            "centre": path.pitch_radii,
        },
        **surfaces_of(case, "pinion_surface", "gear_surface"),
    )


def forms_on(case: Case, absent: tuple[str, ...]) -> tuple[tuple[Form, ...], tuple[Form, ...]]:
    """Effects inside and outside the catalogue that can be planted; coating insulation only on coated surfaces."""
    coated = any("coating" in surface for surface in case.settings["surfaces"].values())
    absent = absent if coated else (*absent, "coating_insulation")
    named = tuple(form for name, forms in FORMS.items() if name not in absent for form in forms)
    return named, tuple(form for name, form in OUTSIDE.items() if name not in absent)


def rig_on(case: Case, model: Model, absent: tuple[str, ...], fine: Model | None = None) -> Rig:
    """Rig of a case with its model, open to all effects but the absent."""
    forms, outside = forms_on(case, absent)
    return Rig(
        settings=case.settings,
        columns=case.columns,
        share=case.share,
        names=PRIORS,
        model=model,
        fine=fine,
        theta=contact_theta(case.settings),
        forms=forms,
        outside=outside,
        floor=FLOOR,
        signed=True,
    )


def rig_of(case: Case) -> Rig:
    """Rig of the case."""
    inputs = lru_cache(maxsize=None)(lambda points: inputs_of(case, points))
    coarse, fine = (contact_model(case.settings, partial(inputs, points), POWER_LOSS) for points in (COARSE, FINE))
    return rig_on(case, coarse, NOT_HERE, fine)


def draw_case(rng: np.random.Generator, coated: bool, pairs_of_gears: Sequence[Mapping[str, Any]] = GEARS) -> Case:
    """A gear pair and its programme: every pairing, torque, speed and temperature once, in random order."""
    chosen = dict(pairs_of_gears[int(rng.integers(len(pairs_of_gears)))])
    torque_range, speed_range = chosen.pop("torques"), chosen.pop("speeds")
    # Shorter teeth; those of a ring point inwards.
    chosen["tip_diameter_mm"] = [
        rounded(d * (1 - np.sign(z) * rng.uniform(0, 0.004)), 5)
        for z, d in zip(chosen["teeth"], chosen["tip_diameter_mm"])
    ]
    surfaces = draw_surfaces(rng, coated)
    sizes = [(4, 3, 6, 2), (3, 3, 6, 3), (3, 4, 5, 3), (4, 3, 4, 3), (5, 3, 5, 2), (4, 4, 5, 2)]
    pairs, torques, speeds, temperatures = sizes[int(rng.integers(len(sizes)))]
    levels = (
        draw_pairings(rng, list(surfaces), pairs),
        draw_levels(rng, torque_range, torques),
        draw_levels(rng, speed_range, speeds),
        draw_temperatures(rng, temperatures),
    )
    settings: dict[str, Any] = {
        "schema": "mixedlub-case/1",
        "kind": "gear_pair",
        "boundary_friction": 0.1,
        "gears": {**chosen, "helix_angle_deg": 0.0, **STEEL},
        "lubricant": draw_oil(rng),
        "surfaces": surfaces,
        "uncertainty": UNCERTAINTY,
        "recording": {"quantity": "power_loss_W", "includes": "the whole gearbox as the rig measures it"},
    }
    share = draw_share(rng, settings, levels[1])
    settings["gears"]["load_sharing"] = {"model": "rigid"} if share is None else {"table": "load_share.csv"}
    grid = list(itertools.product(*levels))
    rows = [grid[i] for i in rng.permutation(len(grid))]
    names = ("pinion_surface", "gear_surface", "torque_Nm", "speed_rpm", "oil_temperature_C")
    return Case(settings=settings, columns=programme(names, [(*pair, *row) for pair, *row in rows]), share=share)


def draw(rng: np.random.Generator) -> Rig:
    return rig_of(draw_case(rng, rng.random() < COATED))
