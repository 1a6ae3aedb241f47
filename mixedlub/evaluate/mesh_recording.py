"""Recordings of running spur gears common to several evaluations, and their case of mesh friction."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import pandas as pd
from pydantic import Field, model_validator

from mixedlub.evaluate.evaluation import CaseDraft, case_draft, check_surfaces
from mixedlub.schema.section import Number, Section, key
from mixedlub.schema.system_file import Gears, RigFile
from profiles.errors import InputError

Positive = Annotated[Number, Field(gt=0.0)]
CONDITIONS = ("torque_Nm", "speed_rpm", "oil_temperature_C", "pinion_surface", "gear_surface")
"""Case columns with one value per recording."""


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


def not_negative(place: str, found: Mapping[str, Any], turn: str) -> Iterator[str]:
    """Raise an error if friction drives the sliding, yield a note if it may; ``turn`` names the sign to change."""
    mean, high = found["mean_friction"], found["mean_friction_high90"]
    if high < 0.0:
        rule = f"mean friction is below zero (90 % up to {high:.3g}), as if it drove the teeth: {turn}"
        raise InputError(rule, where=place, value=round(mean, 5))
    if mean < 0.0:
        yield f"{place}: mean friction {mean:.3g} is below zero, within its uncertainty; where it is not noise, {turn}"


def mesh_friction_case(
    file: SpurGearFile,
    path: Path,
    found: pd.DataFrame,
    roll_angle: str,
    includes: str,
    setup: np.ndarray,
) -> CaseDraft | None:
    """Case of mesh friction from the table ``found``, with roll angles in a named column; None without surfaces.

    Readings have their independent errors; errors common to several readings are errors of a set-up.
    """
    named = {s for one in file.recordings.values() for s in (one.pinion_surface, one.gear_surface)}
    if None in named or file.lubricant is None or not file.surfaces:
        return None
    check_surfaces(file.surfaces, named, f"{path}: recordings")
    names = found["recording"].to_numpy()
    every, own = (found[f"friction_coefficient_{name}"].to_numpy() for name in ("sd", "sd_own"))
    recorded = {column: np.array([getattr(file.recordings[name], column) for name in names]) for column in CONDITIONS}
    recorded |= {"roll_angle_deg": found[roll_angle].to_numpy(), "setup": setup}
    recorded |= {"friction_coefficient": found["friction_coefficient"].to_numpy(), "friction_coefficient_sd": own}
    common = float(np.median(np.sqrt(np.maximum(every**2 - own**2, 0.0))))
    recording = {"quantity": "friction_coefficient", "includes": includes, "noise": {"setup_absolute": common}}
    return case_draft(path, "mesh_friction", ("gears", "lubricant", "surfaces"), recording, recorded)
