"""A study prepared to run: surfaces paired, gears meshed, inputs arranged by axis."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from inspect import signature
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from mixedlub import friction
from mixedlub.base_model.flattened import Flattening, of_flattened
from mixedlub.base_model.limits import law_limits
from mixedlub.chain.effect import Effect
from mixedlub.chain.model import Chain, Law, Model, Parameters
from mixedlub.chain.ranges import Limit, of_law
from mixedlub.chain.slots import ASPERITY_LOAD
from mixedlub.effects import find
from mixedlub.friction import FrictionLaw
from mixedlub.full_base.words import FULL_INPUTS
from mixedlub.gear import GearPair, Mesh
from mixedlub.laws.rough_film import THINNEST
from mixedlub.own_laws import by_id
from mixedlub.rig.build import check_bandwidth
from mixedlub.rig.lubricant import Lubricant
from mixedlub.rig.plausibility import implausible
from mixedlub.rig.rig import Rig
from mixedlub.rig.surface import Surface, mean_assumed
from mixedlub.rig.waves import wave_rows
from mixedlub.schema import system_file, toml_file
from mixedlub.schema.findings import Finding, collected, finding, report
from mixedlub.schema.table_files import escaped
from mixedlub.study.bands import Group, groups, uncertain_inputs
from mixedlub.study.chosen_effects import chosen_effects, with_traction
from mixedlub.study.costs import check_costs
from mixedlub.study.friction_options import (
    check_coefficients,
    check_friction,
    check_oil,
    check_viscosity,
)
from mixedlub.study.heat import LOSS, heat_inputs, rating_inputs
from mixedlub.study.heights import HeightTables, height_tables
from mixedlub.study.inputs import condition_inputs, surface_inputs
from mixedlub.study.options import FURTHER, RATED, at_hardness, study_chain
from mixedlub.study.origins import by_origin, losing
from mixedlub.study.schema import Options, Pairings, Safety, StudyFile
from profiles.errors import InputError, as_path, nearest, refuse_other

if TYPE_CHECKING:
    from mixedlub.full_base.emulator import Emulator

WANTED = (
    "power_loss",
    "mesh_loss",
    "rolling_loss",
    "mean_friction",
    "area_ratio",
    "film_thickness",
    "composite_roughness",
    "line_load",
    "hertz_pressure",
    "friction",
    "flash_temperature",
    "load_loss_factor",
)
BALANCED = ("asperity_pressure", "full_load_film", "film_load_share", "least_film_share")
"""Additional quantities if film and asperities share the load."""
HEAT = "nominal_loss"
"""Input of effects that read the heat of the mesh."""
MOST_CONTACT_RATIO = 2.0
"""Largest contact ratio for which Ohlendorf's loss factor is valid."""
MOST_FRICTION = 1e300
"""Largest friction coefficient accepted as finite; a diverging law exceeds it."""

BY_AREA = (
    "asperities that carry nearly all of the load get almost no friction, and the order of finishes can reverse, "
    'because the film that gives way leaves them little area and "tallian" weights friction by it; take "load_weighted"'
)
"""Problem of friction by area if film and asperities share the load."""


@dataclass(frozen=True, eq=False)
class Plan:
    """All inputs of the computation, in a form that can be sent to other machines.

    ``inputs``: SI arrays of up to five axes (pairing, oil temperature, torque, speed, mesh), of length one on axes they
    do not depend on. ``shape``: number of levels of the first four axes. ``points``: length of the mesh axis.
    ``bands``: inputs of the surfaces for the bands of the results. ``heights``: contact integrals of non-normal
    heights. ``laws``: laws of the user by id.
    """

    inputs: Mapping[str, Any]
    options: Options
    parameters: Parameters
    shape: tuple[int, int, int, int]
    points: int
    bands: tuple[Group, ...] = ()
    heights: HeightTables | None = None
    safety: Safety | None = None
    laws: Mapping[str, Effect] = field(default_factory=dict)
    full: Emulator | None = None
    flattening: Flattening | None = None

    @property
    def effects(self) -> tuple[Effect, ...]:
        """The active effects."""
        return find(sorted(self.parameters), laws=self.laws) if self.parameters else ()

    def model(self, also: Iterable[str] = ()) -> Model:
        """Chain of the chosen options with the active effects and their losses; ``also``: additional outputs."""
        return by_origin(self._model((*also, *(limit.quantity for limit in self.limits))))

    def _model(self, checked: Iterable[str]) -> Model:
        of_balance = BALANCED if self.balanced else ()
        rated = RATED if self.rates_films else ()
        of_films = tuple(name for name, _ in rated[-1:])
        wanted = dict.fromkeys((*WANTED, *of_balance, *self.asperities_read, *checked, *of_films))
        chain = (*self.chain(self.options), *FURTHER, *rated)
        return Model(chain, tuple(self.inputs), tuple(wanted), self.effects)

    @property
    def rates_films(self) -> bool:
        """Whether films are compared with the limit of micropitting."""
        return self.safety is not None and self.safety.permissible_film_ratio is not None

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """Ranges of all active effects and chosen laws at points of the path."""
        found = law_limits(self._model(()).steps, self.effects, self.parameters)
        if self.options.film_roughness != "none":
            found += of_law("rough_film", {"film_over_roughness": (THINNEST, np.inf)})
        if self.friction is not None:
            found += of_law(self.friction.name, {**self.friction.valid, "friction": (0.0, MOST_FRICTION)})
        return found

    @property
    def _of_heights(self) -> Mapping[str, Law]:
        """Laws of asperities with non-normal heights, by output quantity."""
        return {} if self.heights is None else self.heights.laws()

    def chain(self, options: Options) -> Chain:
        """Chain of options with the heights of this study, and with full solutions if they are the base."""
        return study_chain(options, self._of_heights, self.full, self.flattening)

    @property
    def friction(self) -> FrictionLaw | None:
        """Friction law that replaces the base model's."""
        if self.options.friction == friction.BASE:
            return None
        return friction.find(self.options.friction).bounded(self.options.friction_coefficients)

    @property
    def spur(self) -> bool:
        """Whether the teeth are straight."""
        return float(self.inputs["base_helix_angle"]) == 0.0

    @property
    def losing(self) -> tuple[str, ...]:
        """Active effects that add a loss outside the mesh."""
        return losing(self.effects)

    @property
    def reads_mean_roughness(self) -> bool:
        """Whether a law reads the arithmetic mean roughness."""
        return any("mean_roughness" in step.outputs for step in self.model().steps)

    @property
    def balanced(self) -> bool:
        """Whether film and asperities share the load."""
        return self.options.balance != "none"

    @property
    def asperities(self) -> Law:
        """Law of the pressure of the asperities; with yielding if plasticity is on."""
        return self._asperities if self.flattening is None else of_flattened(self._asperities)

    @property
    def _asperities(self) -> Law:
        plastic = self.parameters.get("asperity_plasticity")
        if self.heights is not None:
            return self._of_heights[ASPERITY_LOAD.quantity]
        return at_hardness(**plastic) if plastic else ASPERITY_LOAD.choices[self.options.asperities].law

    @cached_property
    def asperities_read(self) -> tuple[str, ...]:
        """Quantities read by the law `asperities`."""
        return tuple(signature(self.asperities).parameters)


@dataclass(frozen=True, eq=False)
class Study:
    """A study file, read and resolved; ``notes``: assumptions made."""

    name: str
    file: StudyFile
    rig: Rig
    pair: GearPair
    mesh: Mesh
    oil: Lubricant
    surfaces: Mapping[str, Surface]
    pairings: tuple[tuple[str, str], ...]
    effects: tuple[Effect, ...]
    plan: Plan
    notes: tuple[Finding, ...] = ()
    stated: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    """Parameters in the file, by effect."""

    @property
    def needs_quotes(self) -> bool:
        """Whether a surface name needs quotes in a CSV file or would be taken as a formula."""
        names = {name for both in self.pairings for name in both}
        return any(escaped(name) != name or any(mark in name for mark in ',;"\n\r') for name in names)

    @property
    def conditions(self) -> int:
        """Number of rows of the result."""
        return int(np.prod(self.plan.shape))


def read_study(path: str | PathLike[str], file: StudyFile | None = None) -> Study:
    """Read a study file and prepare it; traces are read relative to its folder.

    ``file`` replaces the content of the file: a study altered in Python.
    """
    path = as_path(path, "study.read_study")
    if file is not None:
        refuse_other(file, StudyFile, "the file of another study, altered", "study.read_study: file")
    if path.is_dir():
        raise InputError("is a folder; a study is one TOML file", where=str(path))
    if file is None:
        file = toml_file.parse(StudyFile, toml_file.read_toml(path), str(path))
    try:
        with collected() as notes, np.errstate(all="ignore"):
            study = _resolve(path.stem, file, Rig(file, path.parent.resolve()))
        _check_finite(study)
        doubtful = tuple(implausible(study.rig, study.surfaces))
    except InputError as error:
        placed = system_file.in_file(error, str(path))
        if str(path) in str(placed):
            raise placed from None
        raise InputError(str(error), where=str(path)) from None
    return replace(study, notes=(*notes, *doubtful))


def _check_finite(study: Study) -> None:
    """Raise an error for an input that is not finite, naming its level."""
    levels = study.file.conditions
    columns = ("", "oil_temperature_C", "torque_Nm", "speed_rpm")
    for name, value in study.plan.inputs.items():
        if not np.all(np.isfinite(value)):
            axes = zip(columns, np.argwhere(~np.isfinite(value))[0], np.shape(value))
            place = ", ".join(f"{c} {getattr(levels, c)[i]:g}" for c, i, n in axes if c and n > 1) or "all of them"
            rule = f"the study's numbers give no finite {name.replace('_', ' ')}; look for one far out of range"
            raise InputError(rule, where=f"conditions: {place}")


def counted(count: int, thing: str) -> str:
    """A count with its noun.

    >>> counted(1, "speed"), counted(6, "speed")
    ('1 speed', '6 speeds')
    """
    return f"{count} {thing}{'' if count == 1 else 's'}"


def factors(study: Study) -> tuple[str, ...]:
    """Factors of a study with their number of levels."""
    refuse_other(study, Study, "ml.study.read_study(...)", "study.factors: study")
    things = ("pairing", "oil temperature", "torque", "speed")
    pairings, oil, torque, speed = map(counted, study.plan.shape, things)
    return (pairings, torque, speed, oil)


def pairings_of(section: Pairings | None, known: Mapping[str, object]) -> tuple[tuple[str, str], ...]:
    """Pinion and gear surface of each pairing; by default every unordered pair.

    >>> pairings_of(None, {"a": 0, "b": 0})
    (('a', 'a'), ('a', 'b'), ('b', 'b'))
    """
    section = section or Pairings(every=tuple(known))
    for place in ("every", "pinion", "gear"):
        for name in getattr(section, place) or ():
            if name not in known:
                raise InputError(f"no such surface; {nearest(name, known)}", where=f"pairings.{place}", value=name)
    if section.every is not None:
        return tuple(itertools.combinations_with_replacement(section.every, 2))
    return tuple(itertools.product(section.pinion or (), section.gear or ()))


def _resolve(name: str, given: StudyFile, rig: Rig) -> Study:
    stated, laws = by_id(given.effects, rig.folder)
    file = given.model_copy(update={"effects": with_traction(given, stated)})
    chosen = pairings_of(file.pairings, file.surfaces)
    used = dict.fromkeys(s for both in chosen for s in both)
    idle = [s for s in file.surfaces if s not in used]
    if idle:
        report(finding("surfaces_unused", f"in no pairing: {', '.join(idle)}", "surfaces"))
    pair, options = rig.gears, file.options
    if pair.helix_angle == 0.0 and pair.contact_ratio > MOST_CONTACT_RATIO:
        text = f"holds for contact ratios up to {MOST_CONTACT_RATIO:g}, not {pair.contact_ratio:.4g}; left out"
        report(finding("loss_factor_left_out", text, "loss_factor_H_V"))
    check_coefficients(options)
    check_costs(file.costs, used)
    uncertain = uncertain_inputs(file)
    points = rig.mesh(options.path_points, options.face_slices)
    oil = rig.oil()
    check_oil(friction.find(options.friction), options.friction_coefficients, oil)
    check_viscosity(options, oil)
    surfaces = {s: rig.surface(s) for s in used}
    for s, one in surfaces.items():
        check_bandwidth(one, file.surfaces[s])
    waves = wave_rows(options.flattening, options.short_cutoff_over_half_width, file.effects, "options.")

    def of_surfaces(pairs: list[tuple[Surface, Surface]]) -> dict[str, np.ndarray]:
        return surface_inputs(pairs, waves)

    inputs = {
        **condition_inputs(file, pair, points, oil),
        **of_surfaces([(surfaces[a], surfaces[b]) for a, b in chosen]),
    }
    _check_film_roughness(file, surfaces)
    levels = file.conditions
    shape = (len(chosen), len(levels.oil_temperature_C), len(levels.torque_Nm), len(levels.speed_rpm))
    heights = height_tables(options.heights, rig, surfaces, chosen)
    if heights is not None:
        inputs["height_row"] = heights.rows.reshape(-1, 1, 1, 1, 1)
    full = None if options.base == "formulas" else _full_base(file, rig, oil, inputs)
    if full is not None:
        inputs |= {**FULL_INPUTS, "entering_stress": inputs["eyring_stress"]}
    # Bands add rows of waves: the tables of waves come after them.
    moved = groups(options.bands, rig, surfaces, chosen, of_surfaces, uncertain, inputs)
    flat = None if waves is None else waves.tables(options.flattening, options.short_cutoff_over_half_width)
    if any(HEAT in e.reads for e in find(sorted(file.effects), "effects", laws)):
        chain = study_chain(options, {} if heights is None else heights.laws(), full, flat)
        inputs |= heat_inputs(Model(chain, tuple(inputs), (LOSS,)), inputs, shape, points.position.size)
    active, parameters = chosen_effects(file, inputs, laws)
    inputs |= rating_inputs(inputs, parameters)
    plan = Plan(inputs, options, parameters, shape, points.position.size, moved, heights, file.safety, laws, full, flat)
    check_friction(file, plan.model())
    if plan.reads_mean_roughness:
        for found in mean_assumed(surfaces.values()):
            report(found)
    if plan.balanced and options.mixture == "tallian":
        report(finding("balance_by_area", BY_AREA, "options.mixture"))
    return Study(name, given, rig, pair, points, oil, surfaces, chosen, active, plan, stated=stated)


def _full_base(file: StudyFile, rig: Rig, oil: Lubricant, inputs: Mapping[str, Any]) -> Emulator:
    """Emulator of full solutions for the contacts of a study."""
    from mixedlub.full_base.box import CONDITIONS, needed
    from mixedlub.full_base.chain import matter_of, noted, refuse_contained, refuse_oil
    from mixedlub.full_base.store import emulator

    refuse_contained(file.effects)
    refuse_oil(file.lubricant, rig.oil, np.unique(inputs["oil_temperature"]).tolist())
    want = [name for name in (*CONDITIONS, "line_load") if name not in inputs]
    state = Model(study_chain(Options()), tuple(inputs), want)(inputs)
    found, built = emulator(matter_of(oil, inputs), needed({**inputs, **state}))
    noted(found, built)
    return found


def _check_film_roughness(file: StudyFile, surfaces: Mapping[str, Surface]) -> None:
    """Raise an error for a lay in the film if a surface's lay is unknown or another law includes it."""
    chosen, where = file.options.film_roughness, "options.film_roughness"
    if chosen == "none":
        return
    unknown = [name for name, one in surfaces.items() if one.lay is None]
    if unknown:
        rule = f"needs the lay of every surface; unknown is that of {', '.join(unknown)}"
        raise InputError(rule, where=where, value=chosen)
    if "roughness_lay" in file.effects:
        raise InputError(
            "is the lay's effect on the film; leave it or film_roughness out", where="effects.roughness_lay"
        )
    if file.options.friction != friction.BASE:
        rule = f"goes with the base model's friction; friction = {file.options.friction!r} is fitted to smooth films"
        raise InputError(rule, where=where, value=chosen)
