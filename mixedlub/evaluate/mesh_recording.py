"""Recordings of running spur gears, as files of several evaluations describe them, and their case of mesh friction."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import Field, model_validator

from mixedlub.evaluate.evaluation import CaseDraft, case_draft, check_surfaces
from mixedlub.schema.section import Number, Section, key
from mixedlub.schema.system_file import Gears, RigFile

Positive = Annotated[Number, Field(gt=0.0)]
CONDITIONS = ("torque_Nm", "speed_rpm", "oil_temperature_C", "pinion_surface", "gear_surface")
"""Columns of a case that a recording has one value of."""


class MeshRecording(Section):
    file: str = key("its table, relative to this file", example="recording.csv")
    torque_Nm: Positive = key("torque on the pinion", example=71.7)
    speed_rpm: Positive = key("speed of the pinion", example=2000.0)
    oil_temperature_C: Number = key("temperature of the oil", example=70.0, ge=-60.0, le=300.0)
    roll_angle_at_pulse_deg: Number = key("that of tooth 1 at shaft angle 0", example=31.88)
    pinion_surface: str | None = key("a surface of the file, for the case", None, example="ground")
    gear_surface: str | None = key("a surface of the file, for the case", None, example="ground")


class SpurGearFile(RigFile):
    """Spur gears and their recordings."""

    gears: Gears = key("the spur gear pair and its load sharing")
    recordings: Annotated[dict[str, MeshRecording], Field(min_length=1)] = key("one table a recording")

    @model_validator(mode="after")
    def _spur(self) -> SpurGearFile:
        if self.gears.helix_angle_deg != 0.0:
            angle = self.gears.helix_angle_deg
            raise ValueError(f"gears.helix_angle_deg = {angle:g}: one roll angle a tooth holds for spur gears")
        return self


def mesh_friction_case(
    file: SpurGearFile,
    path: Path,
    names: np.ndarray,
    columns: Mapping[str, np.ndarray],
    includes: str,
    noise: Mapping[str, Any],
) -> CaseDraft | None:
    """Friction over the roll angle as a case, rows by the names of their recordings; None where it has no surfaces."""
    named = {s for one in file.recordings.values() for s in (one.pinion_surface, one.gear_surface)}
    if None in named or file.lubricant is None or not file.surfaces:
        return None
    check_surfaces(file.surfaces, named, f"{path}: recordings")
    recorded = {column: np.array([getattr(file.recordings[name], column) for name in names]) for column in CONDITIONS}
    recording = {"quantity": "friction_coefficient", "includes": includes} | ({"noise": noise} if noise else {})
    return case_draft(path, "mesh_friction", ("gears", "lubricant", "surfaces"), recording, {**recorded, **columns})
