"""Preparation of the stages from a file of `mixedlub efficiency`."""

from __future__ import annotations

from pathlib import Path

from mixedlub.chain.effect import Effect
from mixedlub.chain.slots import SLIDING_POWER
from mixedlub.efficiency.file import EfficiencyFile, Stage
from mixedlub.efficiency.gearbox import Gearbox, StageModel
from mixedlub.efficiency.parts import bearing_findings, check_name, oil_state, parts_of
from mixedlub.efficiency.shafts import bearing_loads
from mixedlub.laws.oil import ZERO_CELSIUS
from mixedlub.schema.findings import Finding
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
    studies: dict[str, Study] = {}
    for name, section in file.stages.items():
        where = f"stages.{name}"
        check_name(name, f"{path}: {where}")
        studies[name] = _study(path, where, section)
        _check_effects(studies[name].effects, where)
    loads, notes = bearing_loads(file.stages, {name: one.pair for name, one in studies.items()})
    torques = (*file.conditions.torque_Nm, *(file.duty.torque_Nm if file.duty else ()))
    stages: list[StageModel] = []
    for name, study in studies.items():
        section, own = file.stages[name], {part: load for (stage, part), load in loads.items() if stage == name}
        oil = oil_state(study.oil, section.oil_temperature_C + ZERO_CELSIUS)
        parts = tuple(parts_of(section, study.pair, own, f"{path}: stages.{name}"))
        stages.append(StageModel(name, section.driving, study, oil, parts))
        notes += study.notes
        for part in parts:
            notes += bearing_findings(part, study.pair, oil, f"stages.{name}", idles=0.0 in torques)
    return Gearbox(file, tuple(stages)), tuple(notes)


def _study(path: Path, where: str, stage: Stage) -> Study:
    """Mesh of a stage as a study of one pairing and one condition."""
    for option in UNREAD:
        if option in stage.options.model_fields_set and getattr(stage.options, option) != _default(option):
            raise InputError(
                "has no meaning for a stage; leave it out",
                where=f"{path}: {where}.options.{option}",
                value=getattr(stage.options, option),
            )
    condition = {"torque_Nm": [1.0], "speed_rpm": [100.0], "oil_temperature_C": [stage.oil_temperature_C]}
    given = {
        "schema": "mixedlub-study/1",
        **{name: getattr(stage, name) for name in SHARED if name in stage.model_fields_set},
        "surfaces": {"pinion": stage.surfaces.pinion, "gear": stage.surfaces.gear},
        "pairings": Pairings(pinion=("pinion",), gear=("gear",)),
        "conditions": condition,
    }
    file = parse(StudyFile, given, f"{path}: {where}")
    try:
        return read_study(path, file)
    except InputError as error:
        place = error.where.removeprefix(f"{path}: ").removeprefix(str(path))
        inside = f"{where}.{place}" if place else where
        raise InputError(error.rule, where=f"{path}: {inside}", value=error.value) from None


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
