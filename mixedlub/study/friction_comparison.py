"""Comparison of all friction laws on a gear pair: along the path, over the slide-to-roll ratio, and for the mesh."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import pandas as pd

from mixedlub.chain.friction_law import FrictionLaw
from mixedlub.chain.model import Model
from mixedlub.friction import BASE, catalogue, find
from mixedlub.gear.mesh import Mesh, at_roll_angle
from mixedlub.schema.result import described
from mixedlub.schema.toml_file import parse
from mixedlub.study.columns import every_column
from mixedlub.study.friction_options import check_coefficients, check_oil
from mixedlub.study.inputs import condition_inputs, surface_inputs
from mixedlub.study.options import FURTHER, with_friction
from mixedlub.study.plan import Study, read_study
from mixedlub.study.results import Results, run_study
from mixedlub.study.schema import Conditions, Options, Pairings
from profiles.errors import InputError, nearest

FILM_ALONE = {"balance": "none", "film_roughness": "none"}
"""Options of laws other than the base model's: they are fitted to smooth films carrying the whole load."""
POINTS = 201
"""Number of points along the path of contact and over the slide-to-roll ratio."""
LARGEST_RATIO = 2.0
"""Slide-to-roll ratio of a contact with the slower surface at rest."""
VALID, OUTSIDE, DIVERGES = "valid", "outside range", "diverges"
Coefficients = Mapping[str, Mapping[str, float]]
COLUMNS = {
    "slide_roll_ratio": ("slide_roll_ratio", 1.0),
    "sliding_speed": ("sliding_speed_m_s", 1.0),
    "entrainment_speed": ("entrainment_speed_m_s", 1.0),
    "hertz_pressure": ("hertz_pressure_MPa", 1e-6),
    "film_rise": ("crook_film_rise_K", 1.0),
}
"""Columns of a contact point, and factor from SI."""
_LAW = "text: friction law"
_AT_A_CONTACT = {
    "slide_roll_ratio": "sliding speed over entrainment speed",
    "sliding_speed_m_s": "speed of the pinion's flank less that of the gear's",
    "entrainment_speed_m_s": "mean speed of both flanks",
    "hertz_pressure_MPa": "largest Hertz pressure",
    "crook_film_rise_K": "rise of the film's temperature after Crook",
    "friction": "friction coefficient, empty where it diverges",
    "validity": f"text: {VALID}, {OUTSIDE} or {DIVERGES}",
}
TABLES = {
    "along_path": described(law=_LAW, roll_angle_deg="roll angle of the pinion", **_AT_A_CONTACT),
    "over_slide_roll_ratio": described(law=_LAW, **_AT_A_CONTACT),
    "mesh": (*described(law=_LAW), *every_column(bands=False)),
}
"""Columns of the tables of `mixedlub friction-laws --study`."""


@dataclass(frozen=True, eq=False)
class Comparison:
    """Friction laws at one condition of a study with one pairing, and ``every`` pairing at that condition.

    ``coefficients``: values from the user, by law.
    """

    study: Study
    every: Study
    coefficients: Coefficients

    @cached_property
    def laws(self) -> tuple[FrictionLaw, ...]:
        """Laws with all coefficients given."""
        return complete(self.coefficients)

    @property
    def left_out(self) -> dict[str, list[str]]:
        """Laws with missing coefficients, and the names of these."""
        return {law.name: lacks for law in catalogue().values() if (lacks := _lacks(law, self.coefficients))}

    def along_path(self) -> pd.DataFrame:
        """Friction of every law over the pinion roll angle, including the pitch point."""
        pair = self.study.pair
        angles = np.linspace(pair.path_start, pair.path_end, POINTS) / pair.base_radius[0]
        angles = np.unique(np.append(angles, pair.pitch_point / pair.base_radius[0]))
        mesh, inputs = self._at(angles)
        place = np.argmin(np.abs(mesh.sliding_per_speed))
        inputs["sliding_speed"][..., place] = 0.0  # rounding aside
        return self._table("roll_angle_deg", np.degrees(angles), inputs)

    def over_ratio(self) -> pd.DataFrame:
        """Friction of every law over the slide-to-roll ratio, in the contact at the pitch point."""
        pair = self.study.pair
        _, inputs = self._at(np.array([pair.pitch_point / pair.base_radius[0]]))
        ratio = np.linspace(0.0, LARGEST_RATIO, POINTS)
        inputs["sliding_speed"] = ratio * inputs["entrainment_speed"]
        return self._table("slide_roll_ratio", ratio, inputs)

    def _at(self, angles: np.ndarray) -> tuple[Mesh, dict[str, Any]]:
        """Contact points at pinion roll angles (rad), and their chain inputs."""
        mesh = at_roll_angle(self.study.pair, self.study.rig.sharing, angles, slices=1)
        with np.errstate(invalid="ignore"):  # points of no quadrature have no weights for a mean
            return mesh, condition_inputs(self.study.file, self.study.pair, mesh, self.study.oil)

    def _inputs(self, inputs: Mapping[str, Any]) -> dict[str, Any]:
        surfaces = surface_inputs([(self.study.surfaces[a], self.study.surfaces[b]) for a, b in self.study.pairings])
        rows = ("height_row", "first_waves", "second_waves")
        own = {name: value for name, value in self.study.plan.inputs.items() if name in rows}
        return {**inputs, **surfaces, **own}

    def _table(self, name: str, place: np.ndarray, inputs: Mapping[str, Any]) -> pd.DataFrame:
        """Table with a row per law and place: conditions, friction, and validity of the law."""
        given, options = self._inputs(inputs), _base_options(self.study)
        chain, film_alone = map(self.study.plan.chain, (options, options.model_copy(update=FILM_ALONE)))
        parts = []
        for law in self.laws:
            own = law.with_coefficients(self.coefficients.get(law.name, {}))
            steps = chain if law.name == BASE else with_friction(film_alone, own)
            model = Model((*steps, *FURTHER), tuple(given), tuple(dict.fromkeys((*law.checked, *COLUMNS))))
            with np.errstate(all="ignore"):
                state = model(given)
                friction = np.broadcast_to(np.asarray(state["friction"], float).ravel(), place.shape)
                holds = judged(law, state, place.shape)
            columns = {c: np.broadcast_to(np.ravel(state[q]), place.shape) * f for q, (c, f) in COLUMNS.items()}
            shown = np.where(np.isfinite(friction), friction, np.nan)
            parts.append(pd.DataFrame({"law": law.name, name: place, **columns, "friction": shown, "validity": holds}))
        return pd.concat(parts, ignore_index=True)


def complete(coefficients: Coefficients) -> tuple[FrictionLaw, ...]:
    """Laws with all coefficients given, with the resulting ranges."""
    found = (law for law in catalogue().values() if not _lacks(law, coefficients))
    return tuple(law.bounded(coefficients.get(law.name, {})) for law in found)


def _lacks(law: FrictionLaw, coefficients: Coefficients) -> list[str]:
    given = coefficients.get(law.name, {})
    return [c.name for c in law.coefficients if c.default is None and c.name not in given]


def judged(law: FrictionLaw, state: Mapping[str, Any], shape: tuple[int, ...]) -> np.ndarray:
    """Whether a law holds at each place."""
    outside = np.broadcast_to(law.outside(state).ravel(), shape)
    divergent = np.broadcast_to(law.divergent(state).ravel(), shape)
    return np.where(divergent, DIVERGES, np.where(outside, OUTSIDE, VALID))


def _base_options(study: Study) -> Options:
    """Options of a study with the friction of the base model."""
    return study.file.options.model_copy(update={"friction": BASE, "friction_coefficients": {}})


def compared(
    study: Study,
    coefficients: Coefficients,
    *,
    pairing: str | None = None,
    **conditions: float | None,
) -> Comparison:
    """Comparison at one condition; defaults: the last level of each condition, and the first pairing."""
    levels = study.file.conditions
    chosen = {
        name: [given[-1] if (wanted := conditions.get(name)) is None else wanted]
        for name, given in levels.model_dump().items()
    }
    names = {f"{a} / {b}": (a, b) for a, b in study.pairings}
    if pairing is not None and pairing not in names:
        raise InputError(f"no such pairing; {nearest(pairing, names)}", where="--pairing", value=pairing)
    a, b = study.pairings[0] if pairing is None else names[pairing]
    here = study.file.model_copy(update={"conditions": parse(Conditions, chosen, "condition to compare at")})
    one = here.model_copy(update={"pairings": Pairings(pinion=(a,), gear=(b,))})
    given = checked(coefficients)
    for name, own in given.items():
        check_oil(find(name), own, study.oil, f"--coefficients: {name}")
    given |= _own(study, coefficients)
    return Comparison(_altered(study, one), _altered(study, here), given)


def _altered(study: Study, file: Any) -> Study:
    path = study.rig.folder / f"{study.name}.toml"
    return read_study(path, file)


def _own(study: Study, coefficients: Coefficients) -> dict[str, Mapping[str, float]]:
    """Coefficients of the friction law in the study itself."""
    options = study.file.options
    given = options.friction_coefficients
    return {options.friction: given} if given and options.friction not in coefficients else {}


def checked(coefficients: Coefficients) -> dict[str, Mapping[str, float]]:
    """Coefficients by law; raises an error for an unknown law or coefficient."""
    found: dict[str, Mapping[str, float]] = {}
    for name, given in coefficients.items():
        find(name, "--coefficients")
        where = f"--coefficients: {name}"
        options = parse(Options, {"friction": name, "friction_coefficients": given}, where)
        check_coefficients(options, where)
        found[name] = options.friction_coefficients
    return found


def of_mesh(study: Study, coefficients: Coefficients) -> Iterator[tuple[FrictionLaw, Results]]:
    """Results of a study with each law that has its coefficients, without effects."""
    values = {name: getattr(study.file.options, name) for name in type(study.file.options).model_fields}
    for law in complete(coefficients):
        own = {"friction": law.name, "friction_coefficients": dict(coefficients.get(law.name, {}))}
        own |= {} if law.name == BASE else FILM_ALONE
        # Of the options none counts as given, so that a law may ignore those that another one reads.
        options = Options.model_construct({"friction", "friction_coefficients"}, **values | own)
        altered = _altered(study, study.file.model_copy(update={"options": options, "effects": {}}))
        yield law, run_study(altered)


def mesh_table(study: Study, coefficients: Coefficients) -> pd.DataFrame:
    """Mean friction and mesh loss of every law at every condition of a study."""
    parts = []
    for law, results in of_mesh(study, coefficients):
        rows = results.to_pandas()
        kept = ["pinion_surface", "gear_surface", "torque_Nm", "speed_rpm", "oil_temperature_C"]
        rows = rows[[*kept, "mean_friction", "mesh_loss_W", "validity"]]
        rows.insert(0, "law", law.name)
        parts.append(rows)
    return pd.concat(parts, ignore_index=True)
