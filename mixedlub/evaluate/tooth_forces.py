"""Normal and friction forces of instrumented teeth from averaged strains, with errors and recentring."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from mixedlub.evaluate.influence import Influence
from mixedlub.evaluate.synchronous import Average
from mixedlub.evaluate.uncertainty import combined
from profiles.errors import InputError

NOISE = "noise of turn"
"""Prefix of the error names of turns: effect of a turn's deviation from the mean."""
ROLL_ANGLE = "roll angle"
"""Name of the error of the roll angle at the pulse."""


@dataclass(frozen=True)
class Meshing:
    """Roll angles (deg) of a wheel: contact from ``low`` to ``high``, pitch point and tooth pitch.

    ``teeth``: instrumented teeth; ``direction``: 1 if contact moves to larger roll angles, as on the driving wheel.
    Teeth may touch up to ``margin`` beyond the path. Within ``smeared`` of the pitch point both directions of friction
    mix, because of the sample spacing and the uncertain roll angle.
    """

    low: float
    pitch_point: float
    high: float
    pitch: float
    teeth: int
    direction: int
    margin: float
    smeared: float = 0.0

    def roll_angle(self, first: np.ndarray, tooth: int) -> np.ndarray:
        """Roll angle of a tooth (from 0) nearest the pitch point; ``first``: of the first instrumented tooth."""
        angle = first - self.direction * tooth * self.pitch
        return angle - 360.0 * np.round((angle - self.pitch_point) / 360.0)

    def is_smeared(self, roll_angle: np.ndarray) -> np.ndarray:
        """Whether friction of both directions mixes at a roll angle near the pitch point."""
        return np.abs(roll_angle - self.pitch_point) < self.smeared

    def touches(self, roll_angle: np.ndarray) -> np.ndarray:
        """Whether a tooth at a roll angle may be in contact."""
        return (roll_angle > self.low - self.margin) & (roll_angle < self.high + self.margin)


@dataclass(frozen=True)
class Meters:
    """Standard deviations: zeros of the gauges, forces of the calibration (relative), roll angle (deg)."""

    zero: float
    calibration_force: float
    roll_angle: float
    largest_condition: float


@dataclass(frozen=True, eq=False)
class Forces:
    """Forces of N tooth positions: ``value`` (N, 2), normal and friction (N), the latter positive towards the tip.

    ``errors`` (N, 2): effect of one standard deviation of each independent error; errors of the recording are named
    NOISE and a number. ``sense``: 1 if friction against the sliding points to the tip, else -1.
    """

    tooth: np.ndarray
    roll_angle: np.ndarray
    single: np.ndarray
    sense: np.ndarray
    condition: np.ndarray
    value: np.ndarray
    errors: Mapping[str, np.ndarray]

    def sd(self, which: int) -> np.ndarray:
        """Standard deviation of the normal (0) or the friction force (1)."""
        return combined({name: moved[:, which] for name, moved in self.errors.items()})

    def sd_own(self, which: int) -> np.ndarray:
        """Part of the standard deviation by noise of the recording, estimated from the turns."""
        return noise_of({name: moved[:, which] for name, moved in self.errors.items()})


def forces_of(
    influence: Influence, meshing: Meshing, first: np.ndarray, average: Average, meters: Meters, name: str
) -> Forces:
    """Forces at shaft angles with contact on instrumented teeth only.

    ``first`` (M,): roll angle of the first instrumented tooth. Least squares over all gauges, weighted with their
    noise. Source: Rebbechi, Oswald and Townsend 1996, NASA TM-107279, equation 6.
    """
    around = range(-2, meshing.teeth + 2)
    roll = np.stack([meshing.roll_angle(first, tooth) for tooth in around], axis=1)
    touching = meshing.touches(roll)
    inside = np.isin(np.arange(touching.shape[1]) - 2, np.arange(meshing.teeth))
    kept = touching.any(axis=1) & ~touching[:, ~inside].any(axis=1)
    on_path = touching & (roll >= meshing.low) & (roll <= meshing.high)
    influence.check(roll[kept][on_path[kept]], f"recordings.{name}")
    kept &= ~(touching & influence.is_outside(roll)).any(axis=1)
    if not kept.any():
        low, high = float(first.min()), float(first.max())
        rule = "no recorded shaft angle has instrumented teeth in contact and no others; tooth 1 has roll angles"
        raise InputError(f"{rule} {low:.4g} to {high:.4g}°", where=f"recordings.{name}: roll_angle_at_pulse_deg")
    roll, touching = roll[kept][:, inside], touching[kept][:, inside]
    parts = []
    for pattern in np.unique(touching, axis=0):
        rows = np.flatnonzero((touching == pattern).all(axis=1))
        part = Average(average.angle[kept][rows], average.mean[kept][rows], average.errors[:, kept][:, rows], 0.0)
        parts.append(_solved(influence, meshing, np.flatnonzero(pattern), roll[rows], part, average.sd, meters, name))
    merged = _joined(parts)
    found = _taken(merged, np.lexsort((merged.roll_angle, merged.tooth)))
    for tooth in np.unique(found.tooth[found.single]):
        rows = found.single & (found.tooth == tooth)
        if rows.sum() > 1:
            # Friction that changes along the path is read at another place than where it acts.
            slope = np.polyfit(found.roll_angle[rows], found.value[rows, 1], 1)[0]
            found.errors[ROLL_ANGLE][rows, 1] += slope * meters.roll_angle
    return found


def _solved(
    influence: Influence,
    meshing: Meshing,
    teeth: np.ndarray,
    roll: np.ndarray,
    strains: Average,
    noise: np.ndarray,
    meters: Meters,
    name: str,
) -> Forces:
    """Forces of simultaneously touching teeth at roll angles (M, K)."""
    matrix = np.concatenate([influence.at(roll[:, t], t) for t in teeth], axis=2)
    condition = np.linalg.cond(matrix)
    worst = int(np.argmax(condition))
    if not condition[worst] <= meters.largest_condition:
        rule = f"condition number of the influence matrix at roll angle {roll[worst, teeth[0]]:.4g}° is too large: "
        rule += "the gauges do not separate the two forces"
        raise InputError(rule, where=f"recordings.{name}", value=float(f"{condition[worst]:.4g}"))
    weight = 1.0 / np.where(noise > 0.0, noise, max(float(noise.max()), 1e-9))
    inverse = np.linalg.pinv(matrix * weight[:, None]) * weight
    forces = np.einsum("mfg,mg->mf", inverse, strains.mean)
    moved_by_turn = np.einsum("mfg,tmg->tmf", inverse, strains.errors)
    common = {f"{NOISE} {turn}": moved for turn, moved in enumerate(moved_by_turn, start=1)}
    for gauge in range(noise.size):
        common[f"zero of gauge {gauge + 1}"] = inverse[:, :, gauge] * meters.zero
    slopes = np.concatenate([influence.slope(roll[:, t], t) for t in teeth], axis=2)
    common[ROLL_ANGLE] = np.einsum("mfg,mgh,mh->mf", inverse, slopes, forces) * meters.roll_angle
    common |= _influence_errors(influence, meshing.teeth, teeth, roll, inverse, forces)
    which = np.arange(forces.shape[1]) % 2
    for index, label in enumerate(("normal", "friction")):
        common[f"{label} forces of the calibration"] = np.where(which == index, forces, 0.0) * meters.calibration_force
    rows, count = roll.shape[0], teeth.size
    angle = roll[:, teeth].ravel()
    return Forces(
        tooth=np.tile(teeth, rows),
        roll_angle=angle,
        single=np.full(angle.size, count == 1),
        sense=np.where((angle - meshing.pitch_point) * meshing.direction >= 0.0, 1.0, -1.0),
        condition=np.repeat(condition, count),
        value=forces.reshape(-1, 2),
        errors={label: moved.reshape(-1, 2) for label, moved in common.items()},
    )


def _influence_errors(
    influence: Influence, every: int, teeth: np.ndarray, roll: np.ndarray, inverse: np.ndarray, forces: np.ndarray
) -> dict[str, np.ndarray]:
    """Effect of errors of influence coefficients on the forces (M, 2 K); zero for teeth out of contact."""
    found = {}
    for tooth in range(every):
        where = np.flatnonzero(teeth == tooth)
        for gauge in range(inverse.shape[2]):
            strain = np.zeros((roll.shape[0], influence.modes.shape[2]))
            if where.size:
                own = forces[:, 2 * where[0] : 2 * where[0] + 2]
                strain = np.einsum("mpf,mf->mp", influence.errors(roll[:, tooth], tooth, gauge), own)
            for mode, moved in enumerate(strain.T, start=1):
                found[f"influence {tooth + 1}, {gauge + 1}, {mode}"] = -inverse[:, :, gauge] * moved[:, None]
    return found


def _joined(parts: list[Forces]) -> Forces:
    def together(name: str) -> np.ndarray:
        return np.concatenate([getattr(part, name) for part in parts])

    names = ("tooth", "roll_angle", "single", "sense", "condition", "value")
    errors = {label: np.concatenate([part.errors[label] for part in parts]) for label in parts[0].errors}
    return Forces(**{name: together(name) for name in names}, errors=errors)


def _taken(forces: Forces, rows: np.ndarray) -> Forces:
    names = ("tooth", "roll_angle", "single", "sense", "condition", "value")
    errors = {label: moved[rows] for label, moved in forces.errors.items()}
    return Forces(**{name: getattr(forces, name)[rows] for name in names}, errors=errors)


def recentred(forces: Forces, meshing: Meshing, asymmetry: float, name: str) -> tuple[Forces, list[float]]:
    """Forces with zero mean friction of each tooth over equal distances before and after the pitch point.

    The mean is over single contact; the offsets removed are returned. A true difference of friction between approach
    and recess is removed too: ``asymmetry`` is the standard deviation of half that difference, as a coefficient.
    """
    value, errors = forces.value.copy(), {label: moved.copy() for label, moved in forces.errors.items()}
    offsets = []
    for tooth in np.unique(forces.tooth):
        rows = forces.tooth == tooth
        window = rows & forces.single & ~meshing.is_smeared(forces.roll_angle)
        weights = centring_weights(forces.roll_angle[window], meshing.pitch_point)
        if weights is None:
            raise InputError(
                f"tooth {tooth + 1} has no single contact on both sides of the pitch point to be centred on",
                where=f"recordings.{name}",
                value=int(window.sum()),
            )
        offsets.append(float(weights @ value[window, 1]))
        for moved in (value, *errors.values()):
            moved[rows, 1] -= weights @ moved[window, 1]
    errors["approach against recess"] = np.stack([np.zeros(len(value)), asymmetry * value[:, 0]], axis=1)
    return replace(forces, value=value, errors=errors), offsets


def centring_weights(angle: np.ndarray, centre: float) -> np.ndarray | None:
    """Weights of values at ascending angles: the weighted sum is the mean over the widest interval around ``centre``.

    Linear interpolation between the angles, but not across the centre, where friction may step. None unless the angles
    surround the centre.

    >>> centring_weights(np.array([-1.0, 0.5, 1.0]), 0.0).round(3) @ np.array([-1.0, 0.5, 1.0])   # an odd function
    np.float64(0.0)
    """
    reach = 0.0 if angle.size < 2 else min(centre - float(angle[0]), float(angle[-1]) - centre)
    if reach <= 0.0:
        return None
    before, after = angle[angle <= centre], angle[angle >= centre]
    distance = np.linspace(max(centre - float(before[-1]), float(after[0]) - centre), reach, 101)
    places = np.concatenate([centre - distance, centre + distance])
    return np.array([np.interp(places, angle, one).mean() for one in np.eye(angle.size)])


def friction_of(forces: Forces) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Friction coefficient, positive against the sliding, and effect of each error on it."""
    normal, friction = forces.value.T
    value = forces.sense * friction / normal
    to_forces = np.stack([-value / normal, forces.sense / normal], axis=1)
    return value, {label: (to_forces * moved).sum(axis=1) for label, moved in forces.errors.items()}


def mean_friction(forces: Forces, meshing: Meshing) -> tuple[float, dict[str, np.ndarray]]:
    """Mean friction of single contact (lost over transmitted work), weighted with load and sliding, and its errors.

    The step at the pitch point is left out, since the average over turns mixes both directions of friction there.
    """
    used = forces.single & ~meshing.is_smeared(forces.roll_angle)
    slide = np.where(used, np.abs(forces.roll_angle - meshing.pitch_point), 0.0)
    if not slide.any():
        rule = f"no single contact of an instrumented tooth beyond {meshing.smeared:.3g}° from the pitch point"
        raise InputError(f"{rule} was recorded", where="recordings")
    total = float((slide * forces.value[:, 0]).sum())
    value = float((slide * forces.sense * forces.value[:, 1]).sum()) / total
    to_forces = np.stack([-value * slide, slide * forces.sense], axis=1) / total
    return value, {label: (to_forces * moved).sum() for label, moved in forces.errors.items()}


def noise_of(errors: Mapping[str, np.ndarray]) -> np.ndarray:
    """Standard deviation by noise of the recording alone."""
    return combined({label: moved for label, moved in errors.items() if label.startswith(NOISE)})
