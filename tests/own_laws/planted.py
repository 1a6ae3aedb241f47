"""Recordings with a planted law, made by the independent rigs of the proof, beside hypotheses of which one is true."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.validation.case_folder import write
from mixedlub.validation.contact import Contact
from mixedlub.validation.rig import Act, Rig
from mixedlub.validation.rigs import KINDS
from mixedlub.validation.rivals import Target, best, sensitivity, visibility

SEEN = (16.0, 30.0)
"""Root of the chi-square of the planted law after recalibration, as in clear cases of the proof."""
IDENTIFIABLE = 9.0
"""Least chi-square by which every other explanation is worse without noise."""


@dataclass(frozen=True)
class Planted:
    """A law as a file and, written again by hand, as an act on the state of the independent rigs."""

    id: str
    stage: str
    acts_on: str
    expression: str
    size: float
    hook: str
    act: Callable[[Contact, float], Contact]

    @property
    def text(self) -> str:
        """The law file; the prior is centred on no change and two planted sizes wide."""
        return (
            f'id = "{self.id}"\nstage = "{self.stage}"\nacts_on = "{self.acts_on}"\nform = "factor"\n'
            f'expression = "{self.expression}"\n[parameters.a]\nvalue = 0.0\nsd = {2 * self.size}\nnull = 0.0\n'
        )


def _slip(c: Contact) -> np.ndarray:
    return c.sliding / c.entrainment


LAWS = (
    Planted(
        "film_of_slip",
        "film",
        "film_thickness",
        "exp(-a*slide_roll_ratio)",
        0.8,
        "film",
        lambda c, a: replace(c, film=c.film * np.exp(-a * _slip(c))),
    ),
    Planted(
        "boundary_of_pressure",
        "boundary",
        "boundary_friction",
        "(hertz_pressure/1 GPa)^a",
        0.4,
        "boundary",
        lambda c, a: replace(c, boundary_friction=c.boundary_friction * (c.pressure / 1e9) ** a),
    ),
    Planted(
        "area_of_load",
        "contact",
        "area_ratio",
        "min((line_load/100 N/mm)^a, 1/max(area_ratio, 1e-9))",
        0.4,
        "contact",
        lambda c, a: replace(c, area=np.minimum(c.area * (c.line_load / 1e5) ** a, 1.0)),
    ),
    Planted(
        "area_of_speed",
        "contact",
        "area_ratio",
        "min((entrainment_speed/3 m/s)^a, 1/max(area_ratio, 1e-9))",
        0.4,
        "contact",
        lambda c, a: replace(c, area=np.minimum(c.area * (c.entrainment / 3.0) ** a, 1.0)),
    ),
    Planted(
        "shear_of_viscosity",
        "shear",
        "shear_stress",
        "(viscosity/20 mPa s)^a",
        0.4,
        "shear",
        lambda c, a: replace(c, stress=c.stress * (c.viscosity / 0.02) ** a),
    ),
    Planted(
        "shear_of_slip",
        "shear",
        "shear_stress",
        "(1 + 20*slide_roll_ratio)^a",
        0.3,
        "shear",
        lambda c, a: replace(c, stress=c.stress * (1.0 + 20.0 * _slip(c)) ** a),
    ),
    Planted(
        "boundary_of_roughness",
        "boundary",
        "boundary_friction",
        "(m0^0.5/0.3 um)^a",
        0.4,
        "boundary",
        lambda c, a: replace(c, boundary_friction=c.boundary_friction * (c.roughness / 3e-7) ** a),
    ),
)


@dataclass(frozen=True)
class Made:
    """A case folder with four hypotheses, the true one and its size; ``lead`` over all rivals without noise."""

    folder: Path
    truth: str
    size: float
    lead: Callable[[], float]


def _sd(values: np.ndarray, level: float, typical: float) -> np.ndarray:
    return np.hypot(0.01 * level * values, 0.002 * level * typical)


def make(folder: Path, kind: str, seed: int) -> Made:
    """A case with one planted law at random strength, and hypotheses of it and three others."""
    rng = np.random.default_rng([seed, 77])
    rig, z = KINDS[kind].draw(rng), rng.standard_normal(5)
    truth, *others = (LAWS[i] for i in rng.permutation(len(LAWS))[:4])
    size = float(truth.size * rng.choice([-1.0, 1.0]) * rng.uniform(0.6, 1.4))
    act = Act(truth.hook, lambda c: truth.act(c, size))
    values, plain = rig.refined.model(z, [act]), rig.refined.model(z, [])
    typical = float(np.median(np.abs(values)))
    seen = visibility(values - plain, _sd(values, 1.0, typical), sensitivity(rig, z))
    level = float(np.clip(seen / rng.uniform(*SEEN), 0.3, 5.0))
    sd = _sd(values, level, typical)
    noise = {"relative": 0.01 * level, "absolute": 0.002 * level * typical}
    rig = replace(rig, settings={**rig.settings, "recording": {**rig.settings["recording"], "noise": noise}})
    hidden = np.zeros(values.size, bool)
    hidden[:: max(values.size // 4, 1)] = True
    write(folder, rig, {rig.quantity: values + sd * rng.standard_normal(values.size)}, hidden, {})
    (folder / "hypotheses").mkdir()
    for law in (truth, *others):
        (folder / "hypotheses" / f"{law.id}.toml").write_text(law.text, encoding="utf-8")
    return Made(folder, truth.id, size, partial(_lead, rig, ~hidden, values, sd, z, others))


def _lead(rig: Rig, rows: np.ndarray, values: np.ndarray, sd: np.ndarray, z: np.ndarray, others: Any) -> float:
    """Least chi-square of a rival on the coarse rig: nothing, an effect of the proof, or a false hypothesis."""
    kept = np.flatnonzero(rows)
    extra = values - rig.refined.model(z, [])
    target = Target(rig, kept, (rig.model(z, []) + extra)[kept], sd[kept])
    none = best(target, (), z)
    false = [min(_chi_square(target, law, law.size * s, none.z) for s in (-1.0, 1.0)) for law in others]
    named = [best(target, (form,), none.z).chi_square for form in rig.forms]
    return float(min(none.chi_square, *false, *named))


def _chi_square(target: Target, law: Planted, start: float, z: np.ndarray) -> float:
    """Least chi-square of a false hypothesis, from one start."""
    from mixedlub.validation.rivals import descend

    def residual(x: np.ndarray) -> np.ndarray:
        model = target.rig.model(x[:-1], [Act(law.hook, lambda c: law.act(c, float(x[-1])))])[target.rows]
        return np.concatenate([(model - target.values) / target.sd, x[:-1], x[-1:] / (2 * law.size)])

    ends = np.append(np.full(z.size, 6.0), 8.0 * law.size)
    return descend(residual, np.append(z, start), -ends, ends)[1]
