"""Preparation of the stages from a file of `mixedlub efficiency`."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import groupby, product
from pathlib import Path

from mixedlub.chain.effect import Effect
from mixedlub.chain.slots import SLIDING_POWER
from mixedlub.efficiency.file import EfficiencyFile, Stage
from mixedlub.efficiency.gearbox import Gearbox
from mixedlub.efficiency.parts import bearing_findings, check_name, oil_state, part_of, parts_of, rating_findings
from mixedlub.efficiency.planetary import PlanetaryModel
from mixedlub.efficiency.planetary_file import PlanetaryStage, PlanetMesh
from mixedlub.efficiency.planets import PlanetSet
from mixedlub.efficiency.shafts import bearing_loads
from mixedlub.efficiency.stage import StageModel
from mixedlub.efficiency.train import Coupling, PlanetaryTrain
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.schema.findings import Finding, finding
from mixedlub.schema.surface_file import SurfaceSection
from mixedlub.schema.toml_file import parse, read_toml
from mixedlub.study import Study, read_study
from mixedlub.study.origins import losing
from mixedlub.study.schema import Options, Pairings, StudyFile
from profiles.errors import InputError

UNREAD = ("base", "bands", "conditions_of", "averaging")
"""Study options without use in a stage, which takes the formulas as base."""
SHARED = ("boundary_friction", "gears", "lubricant", "options", "effects")
"""Tables common to a stage and a study."""


def read_gearbox(path: Path, file: EfficiencyFile | None = None) -> tuple[Gearbox, tuple[Finding, ...]]:
    """Gearbox from a file, checked, and findings for its user; ``file`` replaces the content of the file."""
    file = parse(EfficiencyFile, read_toml(path), str(path)) if file is None else file
    torques = (*file.conditions.torque_Nm, *(file.duty.torque_Nm if file.duty else ()))
    box, notes = _built(path, file, idles=0.0 in torques)
    at_oil = {at: _built(path, file.at_oil(at))[0] for at in file.conditions.oil_temperature_C or ()}
    return replace(box, at_oil=at_oil), tuple(notes)


def _built(path: Path, file: EfficiencyFile, *, idles: bool = False) -> tuple[Gearbox, list[Finding]]:
    """Gearbox at the oil temperatures of its stages, with its reverse if there is coast, and findings."""
    notes: list[Finding] = []
    box = Gearbox(file, _all_stages(path, file, notes, idles=idles))
    if file.coasts:
        reverse = _all_stages(path, file, [], coast=True)[::-1]
        box = replace(box, coasting=Gearbox(file, reverse))
    return box, notes


def _all_stages(
    path: Path, file: EfficiencyFile, notes: list[Finding], *, coast: bool = False, idles: bool = False
) -> tuple[StageModel | PlanetaryModel, ...]:
    """Stages in the order of the file; in coast each is driven at its output."""
    built: dict[str, StageModel | PlanetaryModel] = {}
    for run in _runs(file):
        if run[0] in file.planetary:
            for name in run:
                section = file.planetary[name]
                turned = {"input": section.output, "output": section.input} if coast else {}
                built[name] = _planetary(path, name, section.model_copy(update=turned), notes)
        else:
            sections = {name: file.stages[name] for name in run}
            built |= _stages(path, sections, notes, idles=idles, coast=coast)
    return tuple(built.values())


def _runs(file: EfficiencyFile) -> list[list[str]]:
    """Names of stages in the order of the power, in runs of one kind."""
    return [list(names) for _, names in groupby(file.in_order, key=lambda name: name in file.planetary)]


def _stages(
    path: Path, sections: dict[str, Stage], notes: list[Finding], *, idles: bool, coast: bool
) -> dict[str, StageModel | PlanetaryModel]:
    """Stages of one gear pair that follow each other; findings go to ``notes``."""
    studies: dict[str, Study] = {}
    for name, section in sections.items():
        where = f"stages.{name}"
        check_name(name, f"{path}: {where}")
        surfaces = section.surfaces.pinion, section.surfaces.gear
        studies[name] = _study(path, where, section, surfaces, section.oil_temperature_C)
    loads, found = bearing_loads(sections, {name: one.pair for name, one in studies.items()}, coast=coast)
    notes += found
    stages: dict[str, StageModel | PlanetaryModel] = {}
    for name, study in studies.items():
        section, own = sections[name], {part: load for (stage, part), load in loads.items() if stage == name}
        oil = oil_state(study.oil, section.oil_temperature_C + ZERO_CELSIUS)
        parts = tuple(parts_of(section, study.pair, own, f"{path}: stages.{name}"))
        stage = StageModel(name, section.driving, study, oil, parts)
        stages[name] = replace(stage, driving=stage.driven) if coast else stage
        notes += study.notes
        for part in parts:
            notes += bearing_findings(part, study.pair, oil, f"stages.{name}", idles=idles)
    return stages


def _planetary(path: Path, name: str, section: PlanetaryStage, notes: list[Finding]) -> PlanetaryModel:
    """A planetary stage, its train and planets checked."""
    where = f"planetary.{name}"
    check_name(name, f"{path}: {where}")
    meshes: list[StageModel] = []
    finished: dict[str, dict[tuple[str, str], StageModel]] = {}
    for mesh, own in section.meshes.items():
        place = f"{where}.meshes.{mesh}"
        check_name(mesh, f"{path}: {place}")
        surfaces = own.surfaces.pinion, own.surfaces.gear
        study = _study(path, place, own, surfaces, section.oil_temperature_C, section)
        if study.pair.ring and own.wheels[1] in section.planets:
            raise InputError("a ring is no planet", where=f"{path}: {place}.wheels", value=own.wheels[1])
        oil = oil_state(study.oil, section.oil_temperature_C + ZERO_CELSIUS)
        meshes.append(StageModel(f"{name}.{mesh}", "pinion", study, oil, ()))
        notes += study.notes
        tried = [section.pairings.get(wheel, ("",)) for wheel in own.wheels] if section.pairings else []
        finished[mesh] = {}
        for names in product(*tried) if tried else ():
            chosen = [section.finishes.get(finish, known) for finish, known in zip(names, surfaces, strict=True)]
            other = _study(path, place, own, (chosen[0], chosen[1]), section.oil_temperature_C, section)
            finished[mesh][names[0], names[1]] = replace(meshes[-1], study=other)
    couplings = tuple(
        Coupling(mesh, own.wheels, one.pair.teeth)
        for (mesh, own), one in zip(section.meshes.items(), meshes, strict=True)
    )
    train = PlanetaryTrain(couplings, tuple(section.planets), section.input, section.output, section.fixed)
    pairs = {one.name: mesh.pair for one, mesh in zip(couplings, meshes, strict=True)}
    planets = PlanetSet(train, pairs, section.planet_count)
    try:
        train.check()
        planets.check(section.least_clearance_mm * 1e-3)
    except InputError as error:
        raise InputError(error.rule, where=f"{path}: {where}.{error.where}", value=error.value) from None
    parts = [
        part_of(table, part, one, f"{path}: {where}.{table}.{part}")
        for table in ("bearings", "seals", "others")
        for part, one in getattr(section, table).items()
    ]
    carried = {
        planet: tuple(
            part_of("bearings", f"{planet}.{part}", one, f"{path}: {where}.planets.{planet}.bearings.{part}")
            for part, one in own.bearings.items()
        )
        for planet, own in section.planets.items()
    }
    model = PlanetaryModel(name, section, train, planets, tuple(meshes), meshes[0].oil, tuple(parts), carried, finished)
    notes += _planetary_findings(model, where)
    return model


def _planetary_findings(model: PlanetaryModel, where: str) -> Iterator[Finding]:
    """Findings on planets without bearings, on what helical planets lack, and on static ratings."""
    bare = [planet for planet, parts in model.planet_parts.items() if not parts]
    if bare:
        text = f"no bearings in the planets {', '.join(bare)}: their losses are left out"
        yield finding("shaft_without_bearings", text, where)
    if any(mesh.pair.helix_angle for mesh in model.meshes) and len(bare) < len(model.planet_parts):
        text = (
            "axial forces on helical planets and their tilting moment are left out of the bearings of the planets: "
            "give radial_load_N and axial_load_N"
        )
        yield finding("planet_tilting_left_out", text, where)
    for part in model.parts:
        yield from rating_findings(part, f"{where}.bearings.{part.name}")
    for planet, parts in model.planet_parts.items():
        for part in parts:
            name = part.name.removeprefix(f"{planet}.")
            yield from rating_findings(part, f"{where}.planets.{planet}.bearings.{name}")


def _study(
    path: Path,
    where: str,
    mesh: Stage | PlanetMesh,
    surfaces: tuple[SurfaceSection, SurfaceSection],
    oil_temperature: float,
    outer: PlanetaryStage | None = None,
) -> Study:
    """Mesh as a study of one pairing and one condition; ``outer``: planetary stage whose oil it takes."""
    for option in UNREAD:
        if option in mesh.options.model_fields_set and getattr(mesh.options, option) != _default(option):
            raise InputError(
                "has no meaning for a stage; leave it out",
                where=f"{path}: {where}.options.{option}",
                value=getattr(mesh.options, option),
            )
    condition = {"torque_Nm": [1.0], "speed_rpm": [100.0], "oil_temperature_C": [oil_temperature]}
    sections = (mesh,) if outer is None else (outer, mesh)
    given = {
        "schema": "mixedlub-study/1",
        **{name: getattr(one, name) for one in sections for name in SHARED if name in one.model_fields_set},
        "surfaces": dict(zip(("pinion", "gear"), surfaces, strict=True)),
        "pairings": Pairings(pinion=("pinion",), gear=("gear",)),
        "conditions": condition,
    }
    file = parse(StudyFile, given, f"{path}: {where}")
    try:
        study = read_study(path, file)
    except InputError as error:
        place = error.where.removeprefix(f"{path}: ").removeprefix(str(path))
        of_outer = outer is not None and place.startswith("lubricant")
        inside = ".".join(filter(None, (where.partition(".meshes")[0] if of_outer else where, place)))
        raise InputError(error.rule, where=f"{path}: {inside}", value=error.value) from None
    _check_effects(study.effects, where)
    return study


def _default(option: str) -> object:
    return SLIDING_POWER.default if option == SLIDING_POWER.option else Options.model_fields[option].default


def _check_effects(effects: tuple[Effect, ...], where: str) -> None:
    """Raise an error for effects that are losses outside the mesh, given by the tables of parts instead."""
    for name in losing(effects):
        raise InputError(
            "is a loss outside the mesh; give the part itself: bearings, seals, windage, churning, pocketing, jets or "
            "others of the stage",
            where=f"{where}.effects.{name}",
        )
