"""Friction force and friction coefficient of a mesh from the shaft displacement off the line of action."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
import pandas as pd
from pydantic import Field, model_validator

from mixedlub.evaluate.evaluation import CaseDraft, Curve, Evaluated, Evaluation, Panel
from mixedlub.evaluate.frequency_response import Response, division
from mixedlub.evaluate.mesh_force import Found, Meters, cycle_pattern, friction_of_cycle
from mixedlub.evaluate.mesh_recording import MeshRecording, SpurGearFile, mesh_friction_case, not_negative
from mixedlub.evaluate.outlying import check_turns
from mixedlub.evaluate.result_columns import OFF_LINE
from mixedlub.evaluate.synchronous import Average, cycle_average, few_turns
from mixedlub.evaluate.uncertainty import interval
from mixedlub.gear.build import gear_pair, sharing
from mixedlub.schema.findings import collected
from mixedlub.schema.result import curve
from mixedlub.schema.section import Number, Section, Whole, key
from mixedlub.schema.table import Column, Table, read_table
from mixedlub.schema.toml_file import named_file
from profiles.errors import InputError

SOURCE = "Vaishya and Houser 1999, AGMA 99FTMS1, sections 6 to 8"
Positive = Annotated[Number, Field(gt=0.0)]
Share = Annotated[Number, Field(ge=0.0, lt=1.0)]
TURN = (
    "turn the sign of off_line_displacement_um (positive where friction of recess moves the shaft), in the static test "
    "too, or of the response"
)
LEAK = 0.02
"""Largest ratio of displacement off and along the line of action with negligible coupling in the source."""


class Shaft(Section):
    response: str | None = key("table of the frequency response, relative to this file", None, example="response.csv")
    stiffness_N_um: Positive | None = key(
        "stiffness of the bearings, for gears so slow that it is all of the response",
        None,
        example=90.0,
        alternative=True,
    )
    static: str | None = key(
        "table of the static test in both directions, from which the coupling with the line of action follows",
        None,
        example="static.csv",
    )

    @model_validator(mode="after")
    def _one_response(self) -> Shaft:
        if (self.response is None) == (self.stiffness_N_um is None):
            raise ValueError("needs either response or stiffness_N_um")
        return self


class MeterSection(Section):
    response_sd: Share = key("of the response or stiffness, relative; one error for all frequencies", 0.03)
    response_noise: Share = key("of the response, relative; from frequency to frequency", 0.02)
    zero_sd_um: Annotated[Number, Field(ge=0.0)] = key("of the zero of the probe", 0.1)
    roll_angle_sd_deg: Annotated[Number, Field(ge=0.0)] = key("of the roll angle at the pulse", 0.05)
    normal_force_sd: Share = key("of the normal force that torque and load sharing mean, relative", 0.02)


class Filter(Section):
    low_pass_Hz: Positive = key("highest frequency that is used, below the first resonance", example=750.0)
    regularisation: Share = key("added to the response in quadrature, over the static response", 0.01)
    least_response: Share = key("response over the static one below which it is refused", 0.05)
    recentre: Literal["none", "mean"] = key(
        "what is done about the zero of the probe",
        "none",
        values={
            "none": "force as measured",
            "mean": "the mean over a mesh cycle is left out, of displacement and force",
        },
    )
    local_points: Whole = key("points of the path between which friction is linear; 1: constant", 5, ge=1, le=50)


class OffLineFile(SpurGearFile):
    """Input file of gears with a shaft that moves off the line of action, and its response."""

    schema_: Literal["mixedlub-off-line/1"] = key("format of the file", example="mixedlub-off-line/1", alias="schema")
    title: str = key("title of the figures", "Off-line force", example="Variable centre distance rig")
    shaft: Shaft = key("how the shaft of the pinion answers to forces off the line of action")
    meters: MeterSection = key("standard deviations of the meters", MeterSection())
    filter: Filter = key("which frequencies are used, and how")


DISPLACEMENT = Column("off_line_displacement_um", meaning="of the shaft, positive where friction of recess moves it")
RECORDING = (
    Column("revolution", "whole", meaning="number of the revolution of the pinion, one after the other"),
    Column("shaft_angle_deg", at_least=0.0, at_most=360.0, meaning="angle turned since the pulse"),
    DISPLACEMENT,
)
RESPONSE = (
    Column("frequency_Hz", at_least=0.0, meaning="frequency, rising, from 0"),
    Column("real_um_N", meaning="displacement off the line of action per force there, real part"),
    Column("imaginary_um_N", meaning="the same, imaginary part"),
)
STATIC = (
    Column("direction", "name", names=("driving", "driven"), meaning="driving or driven: what the pinion is"),
    Column("line_force_N", above=0.0, meaning="force along the line of action, torque over base radius"),
    DISPLACEMENT,
)


def _response(file: OffLineFile, folder: Path) -> Response:
    shaft = file.shaft
    if shaft.response is None:
        assert shaft.stiffness_N_um is not None
        return Response(np.array([0.0, np.inf]), np.full(2, 1.0 / shaft.stiffness_N_um + 0j), "shaft.stiffness_N_um")
    table = read_table(named_file(folder, shaft.response, "shaft.response"), RESPONSE, key=("frequency_Hz",))
    frequency = table["frequency_Hz"]
    if np.any(np.diff(frequency) <= 0.0):
        place = f"{table.source}: frequency_Hz"
        raise InputError("frequencies must rise", where=place, value=float(frequency[1:][np.diff(frequency) <= 0.0][0]))
    return Response(frequency, table["real_um_N"] + 1j * table["imaginary_um_N"], table.source)


def coupling_of(direction: np.ndarray, force: np.ndarray, displacement: np.ndarray, source: str) -> tuple[float, float]:
    """Displacement off the line of action per force along it (um/N) and standard deviation, from both directions.

    Friction changes sign with the direction and cancels in the mean of the two slopes.
    Source: Vaishya and Houser 1999, AGMA 99FTMS1, section 8, figure 10.

    >>> both = np.repeat(["driving", "driven"], 3)
    >>> load = np.tile([1.0, 2.0, 3.0], 2)
    >>> print(round(coupling_of(both, load, np.array([0.3, 0.6, 0.9, -0.1, -0.2, -0.3]), "x")[0], 3))
    0.1
    """
    slopes, variance = [], 0.0
    for name in ("driving", "driven"):
        rows = direction == name
        if np.unique(force[rows]).size < 3:
            rule = f"needs three forces or more with the pinion {name}"
            raise InputError(rule, where=f"{source}: line_force_N", value=int(rows.sum()))
        design = np.stack([force[rows], np.ones(rows.sum())], axis=1)
        found = np.linalg.lstsq(design, displacement[rows], rcond=None)[0]
        misfit = displacement[rows] - design @ found
        spread = float(misfit @ misfit) / max(int(rows.sum()) - 2, 1)
        variance += spread * float(np.linalg.inv(design.T @ design)[0, 0]) / 4.0
        slopes.append(found[0])
    return float(np.mean(slopes)), math.sqrt(variance)


def _static(file: OffLineFile, folder: Path) -> Table | None:
    if file.shaft.static is None:
        return None
    return read_table(named_file(folder, file.shaft.static, "shaft.static"), STATIC, key=())


def _coupling(static: Table | None) -> tuple[float, float]:
    if static is None:
        return 0.0, 0.0
    direction, force, displacement = (static[c.name] for c in STATIC)
    return coupling_of(direction, force, displacement, static.source)


def _average(one: MeshRecording, teeth: int, samples: int, folder: Path) -> Average:
    path = named_file(folder, one.file, "recordings.file")
    table = read_table(path, RECORDING, key=("revolution", "shaft_angle_deg"))
    turn, angle, displacement = (table[c.name] for c in RECORDING)
    check_turns(turn, angle, {DISPLACEMENT.name: displacement}, table.source)
    return cycle_average(turn, angle, displacement, teeth, samples, source=table.source)


SAMPLES = 512
"""Interpolation points of the displacement per mesh cycle."""


def run(file: OffLineFile, path: Path) -> Evaluated:
    """Average each recording over mesh cycles, divide by the response, and fit friction."""
    with collected() as findings:
        pair, shared = gear_pair(file.gears), sharing(file.gears.load_sharing, path.parent)
    response, static = _response(file, path.parent), _static(file, path.parent)
    coupling, coupling_sd = _coupling(static)
    notes = [str(one) for one in dict.fromkeys(findings)]
    leak = abs(coupling / abs(response.value[0]))
    if leak > LEAK:
        notes.append(
            f"{100 * leak:.2g} % of a force along the line of action acts off it, above the 2 % that the source "
            "neglects; only the mean of it is taken off"
        )
    if file.shaft.static is None and file.filter.recentre == "none":
        notes.append("no static test: forces along the line of action are taken not to move the shaft off it")
    forces, local, summary = [], [], []
    for name, one in file.recordings.items():
        average = _average(one, pair.teeth[0], SAMPLES, path.parent)
        divided = division(
            response,
            pair.teeth[0] * one.speed_rpm / 60.0,
            file.filter.low_pass_Hz,
            file.filter.regularisation,
            file.filter.least_response,
        )
        line = one.torque_Nm / pair.base_radius[0]
        meters = Meters(
            file.meters.response_sd,
            file.meters.response_noise if file.shaft.response else 0.0,
            math.hypot(file.meters.zero_sd_um, coupling_sd * line),
            file.meters.normal_force_sd,
            file.filter.recentre == "mean",
        )
        first, points = one.roll_angle_at_pulse_deg, file.filter.local_points
        pattern, turned = (
            cycle_pattern(pair, shared, one.torque_Nm, angle, points, SAMPLES)
            for angle in (first, first + file.meters.roll_angle_sd_deg)
        )
        found = friction_of_cycle(average, divided, pattern, turned, coupling * line, meters, name)
        forces.append(_force_table(name, one, found, average))
        wider = few_turns(average.turns)
        local.append(_local_table(name, one, found, pattern.roll_angle, wider))
        harmonics = divided.inverse.size - 1
        summary.append(_summary(name, one, found, harmonics, wider) | {"coupling_percent": 100.0 * leak})
        notes += not_negative(f"recordings.{name}", summary[-1], TURN)
    tables = {
        "friction_force": pd.concat(forces, ignore_index=True),
        "friction": pd.concat(local, ignore_index=True),
        "recordings": pd.DataFrame(summary),
    }
    case = _case(file, path, tables["friction"])
    if case is None:
        notes.append("no case folder: it needs local_points above 1, [lubricant], and surfaces of each recording")
    return Evaluated(
        file.title, tables, _figures(file, tables, static), tuple(_lines(tables["recordings"])), tuple(notes), case
    )


def _force_table(name: str, one: MeshRecording, found: Found, average: Average) -> pd.DataFrame:
    columns: dict[str, Any] = {
        "recording": name,
        "shaft_angle_deg": average.angle,
        "roll_angle_deg": one.roll_angle_at_pulse_deg + average.angle,
        "off_line_displacement_um": average.mean[:, 0],
        **interval("friction_force_N", found.force, found.force_sd, found.force_sd_own, few_turns(average.turns)),
        "fitted_friction_force_N": found.fitted,
    }
    return pd.DataFrame(columns)[:: max(1, average.angle.size // 128)]


def _local_table(name: str, one: MeshRecording, found: Found, roll_angle: np.ndarray, wider: float) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "recording": name,
            "torque_Nm": one.torque_Nm,
            "speed_rpm": one.speed_rpm,
            "roll_angle_deg": roll_angle,
            **interval("friction_coefficient", found.friction, found.friction_sd, found.friction_sd_own, wider),
            "friction_coefficient_sd_own": found.friction_sd_own,
        }
    )


def _summary(name: str, one: MeshRecording, found: Found, harmonics: int, wider: float) -> dict[str, Any]:
    own = np.array(found.mean_sd_own)
    mean = interval("mean_friction", np.array(found.mean), np.array(found.mean_sd), own, wider)
    return {
        "recording": name,
        "torque_Nm": one.torque_Nm,
        "speed_rpm": one.speed_rpm,
        "oil_temperature_C": one.oil_temperature_C,
        "harmonics": harmonics,
        **{k: float(v) for k, v in mean.items()},
        "misfit_N": found.misfit,
    }


def _lines(recordings: pd.DataFrame) -> Iterator[str]:
    for row in recordings.to_dict("records"):
        yield (
            f"{row['recording']}: mean friction {row['mean_friction']:.4f} (sd {row['mean_friction_sd']:.2g}) over the "
            f"path, weighted with load and sliding, from {row['harmonics']} harmonics of the mesh, misfit "
            f"{row['misfit_N']:.2g} N"
        )


def _figures(file: OffLineFile, tables: dict[str, pd.DataFrame], static: Table | None) -> dict[str, tuple[Panel, ...]]:
    """Displacement and force over the mesh cycle, local friction, and the static test if given."""
    force, friction, moved = [], [], []
    for group, name in enumerate(file.recordings):
        own, local = (tables[t][tables[t]["recording"] == name] for t in ("friction_force", "friction"))
        moved.append(curve(own, "roll_angle_deg", "off_line_displacement_um", name, group=group))
        force.append(curve(own, "roll_angle_deg", "friction_force_N", name, group=group))
        friction.append(curve(local, "roll_angle_deg", "friction_coefficient", name, marker=True, group=group))
    angle = "roll angle of a pinion tooth (deg)"
    drawn = {
        "friction_force": (
            Panel(angle, "displacement off the line of action (µm)", tuple(moved)),
            Panel(angle, "friction force of the mesh (N)", tuple(force)),
        ),
        "friction": (Panel(angle, "friction coefficient (-)", tuple(friction)),),
    }
    if static is None:
        return drawn
    test = []
    for group, name in enumerate(("driving", "driven")):
        rows = static["direction"] == name
        x, y = (static[column][rows] for column in ("line_force_N", "off_line_displacement_um"))
        test.append(Curve(x, y, f"pinion {name}", marker=True, group=group))
    words = "force along the line of action (N)", "displacement off the line of action (µm)"
    return {**drawn, "static": (Panel(*words, tuple(test)),)}


def _case(file: OffLineFile, path: Path, table: pd.DataFrame) -> CaseDraft | None:
    """Case of mesh friction from local friction."""
    if file.filter.local_points == 1:
        return None
    includes = "friction force off the line of action"
    return mesh_friction_case(file, path, table, "roll_angle_deg", includes, table["recording"].to_numpy())


EVALUATION = Evaluation(
    name="off-line",
    about="displacement of a shaft off the line of action, over its frequency response, into friction force",
    source=SOURCE,
    file=OffLineFile,
    columns={"a recording": RECORDING, "the response": RESPONSE, "the static test": STATIC},
    run=run,
    results=OFF_LINE,
    example={
        "schema": "mixedlub-off-line/1",
        "title": "Variable centre distance rig",
        "gears": {"preset": "nasa"},
        "lubricant": {"oil": "agma_7ep"},
        "surfaces": {"ground": {"m0_um2": 0.25, "m2": 0.0031, "m4_per_um2": 0.0021}},
        "shaft": {"response": "response.csv", "static": "static.csv"},
        "filter": {"low_pass_Hz": 750.0},
        "recordings": {
            "slow": {
                "file": "recording.csv",
                "torque_Nm": 135.6,
                "speed_rpm": 200.0,
                "oil_temperature_C": 40.0,
                "roll_angle_at_pulse_deg": 10.324,
                "pinion_surface": "ground",
                "gear_surface": "ground",
            }
        },
    },
)
