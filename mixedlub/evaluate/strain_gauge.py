"""Normal force, friction force and friction coefficient from strains in root fillets of instrumented teeth."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
import pandas as pd
from pydantic import Field

from mixedlub.evaluate.evaluation import CaseDraft, Curve, Evaluated, Evaluation, Panel
from mixedlub.evaluate.influence import Influence, fit_influence
from mixedlub.evaluate.mesh_recording import MeshRecording, SpurGearFile, mesh_friction_case, not_negative
from mixedlub.evaluate.outlying import check_turns
from mixedlub.evaluate.result_columns import STRAIN_GAUGE
from mixedlub.evaluate.synchronous import Average, few_turns, synchronous_average
from mixedlub.evaluate.tooth_forces import (
    Forces,
    Meshing,
    Meters,
    forces_of,
    friction_of,
    mean_friction,
    noise_of,
    recentred,
)
from mixedlub.evaluate.uncertainty import combined, interval
from mixedlub.gear import GearPair
from mixedlub.gear.build import gear_pair
from mixedlub.schema.findings import collected
from mixedlub.schema.result import curve
from mixedlub.schema.section import Number, Section, Whole, key
from mixedlub.schema.table import Column, read_table
from mixedlub.schema.toml_file import named_file
from profiles.errors import InputError

SOURCE = "Rebbechi, Oswald and Townsend 1996, NASA TM-107279, equations 1 to 6"
Positive = Annotated[Number, Field(gt=0.0)]
Size = Annotated[Number, Field(ge=0.0)]
RECENTRE = {
    "none": "forces as measured; the zeros of the gauges are uncertain by meters.zero_sd_um_m",
    "mean": "friction force moved so that its mean over equal ways before and after the pitch point is zero",
}


class Gauges(Section):
    columns: Annotated[tuple[str, ...], Field(min_length=2, max_length=64)] = key(
        "columns of the gauges, which both tables have",
        example=["compressive_1_um_m", "tensile_1_um_m", "compressive_2_um_m", "tensile_2_um_m"],
    )
    wheel: Literal["pinion", "gear"] = key(
        "wheel whose teeth have the gauges; its roll angles are meant",
        "gear",
        values={"pinion": "the driving wheel, whose contact moves to larger roll angles", "gear": "the driven wheel"},
    )
    teeth: Whole = key("instrumented teeth, one behind the other; tooth 1 enters the mesh first", 2, ge=1, le=16)
    degree: Whole = key("degree of the polynomials in the roll angle", 6, ge=1, le=12)
    largest_condition: Positive = key("condition number of the influence matrix above which it is refused", 200.0)


class MeterSection(Section):
    zero_sd_um_m: Size = key("standard deviation of the zeros of the gauges in the rig", 3.0)
    calibration_force_sd: Annotated[Number, Field(ge=0.0, lt=1.0)] = key(
        "of the calibration forces, relative; one error for normal, one for friction forces", 0.005
    )
    roll_angle_sd_deg: Size = key("of the roll angle at the pulse", 0.05)


class FrictionSection(Section):
    recentre: Literal["none", "mean"] = key(
        "what is done about zeros of the gauges; recentring also removes real differences of approach and recess",
        "none",
        values=RECENTRE,
    )
    asymmetry_sd: Size = key(
        'recentre "mean": standard deviation of the half difference of friction between recess and approach', 0.002
    )
    margin_deg: Size = key("how far beyond the path of contact loaded teeth may touch", 0.3)
    samples_per_revolution: Whole = key("angles to which every revolution is interpolated", 1000, ge=10, le=1_000_000)


class StrainGaugeFile(SpurGearFile):
    """Input file of gears with strain gauges, calibration and recordings."""

    schema_: Literal["mixedlub-strain-gauge/1"] = key(
        "format of the file", example="mixedlub-strain-gauge/1", alias="schema"
    )
    title: str = key("title of the figures", "Strain gauges", example="NASA gear noise rig")
    calibration: str = key("table of the calibration, relative to this file", example="calibration.csv")
    gauges: Gauges = key("where the gauges are, and how they are calibrated")
    meters: MeterSection = key("standard deviations of the meters", MeterSection())
    friction: FrictionSection = key("how forces become friction", FrictionSection())


SMEARED_SDS = 2.0
"""Judgement. Largest offset of the friction step from the pitch point, in standard deviations of the roll angle."""
TURN = (
    "turn the sign of friction_force_N of the calibration (positive towards the tip), or of the recording's gauges; or "
    "name the other wheel in gauges.wheel"
)
LARGEST_DEVIATION = 0.1
"""Judgement. Largest deviation of normal force from torque over base radius attributable to gear dynamics."""
CALIBRATION = (
    Column("tooth", "whole", at_least=1.0, meaning="tooth that is loaded, 1 for the one that enters the mesh first"),
    Column("roll_angle_deg", at_least=0.0, at_most=90.0, meaning="roll angle of the loaded tooth"),
    Column("normal_force_N", meaning="force normal to its flank"),
    Column("friction_force_N", meaning="force along its flank, positive towards its tip"),
)
RECORDING = (
    Column("revolution", "whole", meaning="number of the revolution"),
    Column("shaft_angle_deg", at_least=0.0, at_most=360.0, meaning="angle turned since the pulse"),
)
STRAIN = Column("GAUGE", meaning="strain of a gauge, named in gauges.columns")


def _gauge_columns(file: StrainGaugeFile) -> tuple[Column, ...]:
    return tuple(Column(name, meaning="strain") for name in file.gauges.columns)


def _calibrated(file: StrainGaugeFile, folder: Path) -> Influence:
    """Influence coefficients from the calibration table."""
    path = named_file(folder, file.calibration, "calibration")
    table = read_table(path, (*CALIBRATION, *_gauge_columns(file)), key=())
    teeth = file.gauges.teeth
    for tooth in range(1, teeth + 1):
        if tooth not in table["tooth"]:
            raise InputError(f"no calibration of tooth {tooth} of {teeth}", where=f"{table.source}: tooth", value=tooth)
    return fit_influence(
        table["roll_angle_deg"],
        table["tooth"] - 1,
        np.stack([table["normal_force_N"], table["friction_force_N"]], axis=1),
        np.stack([table[name] for name in file.gauges.columns], axis=1),
        teeth=teeth,
        degree=file.gauges.degree,
        source=table.source,
    )


def _average(file: StrainGaugeFile, one: MeshRecording, folder: Path) -> Average:
    path = named_file(folder, one.file, "recordings.file")
    table = read_table(path, (*RECORDING, *_gauge_columns(file)), key=("revolution", "shaft_angle_deg"))
    strains = np.stack([table[name] for name in file.gauges.columns], axis=1)
    gauges = {name: table[name] for name in file.gauges.columns}
    check_turns(table["revolution"], table["shaft_angle_deg"], gauges, table.source)
    step = 360.0 / file.friction.samples_per_revolution
    return synchronous_average(table["revolution"], table["shaft_angle_deg"], strains, step, source=table.source)


def meshing_of(pair: GearPair, wheel: str, teeth: int, margin: float) -> Meshing:
    """Roll angles (deg) of the instrumented wheel at the start of contact, pitch point and end of contact."""
    number = 0 if wheel == "pinion" else 1
    if number and pair.ring:
        raise InputError("gauges on the teeth of a ring gear are not evaluated", where="gauges.wheel", value=wheel)
    radius = pair.base_radius[number]
    ways = [pair.path_start, pair.pitch_point, pair.path_end]
    if number:
        ways = [pair.line_of_action_length - way for way in reversed(ways)]
    low, pitch, high = (math.degrees(way / radius) for way in ways)
    return Meshing(low, pitch, high, 360.0 / pair.teeth[number], teeth, 1 if wheel == "pinion" else -1, margin)


def run(file: StrainGaugeFile, path: Path) -> Evaluated:
    """Evaluate influence matrices, synchronous averages, forces and friction of every recording."""
    with collected() as findings:
        pair = gear_pair(file.gears)
    influence = _calibrated(file, path.parent)
    meshing = meshing_of(pair, file.gauges.wheel, file.gauges.teeth, file.friction.margin_deg)
    meters = Meters(
        file.meters.zero_sd_um_m,
        file.meters.calibration_force_sd,
        file.meters.roll_angle_sd_deg,
        file.gauges.largest_condition,
    )
    parts, summary, notes = [], [], [str(one) for one in dict.fromkeys(findings)]
    for name, one in file.recordings.items():
        average = _average(file, one, path.parent)
        turned = one.roll_angle_at_pulse_deg + meshing.direction * average.angle
        smeared = average.spacing + SMEARED_SDS * meters.roll_angle
        blurred = replace(meshing, margin=max(meshing.margin, average.spacing), smeared=smeared)
        forces = forces_of(influence, blurred, turned, average, meters, name)
        notes += _doubts(name, forces, one.torque_Nm / pair.base_radius[0])
        offset = [np.nan]
        if file.friction.recentre == "mean":
            forces, offset = recentred(forces, meshing, file.friction.asymmetry_sd, name)
            notes.append(
                f"recording {name}: friction forces moved by {', '.join(f'{o:.3g}' for o in offset)} N to be centred; "
                "nothing that differs between approach and recess alone can be found in them"
            )
        parts.append(_table(name, one, forces, blurred, pair, file.gauges.wheel, few_turns(average.turns)))
        summary.append(_summary(name, one, forces, blurred, pair, average, offset))
        notes += not_negative(f"recordings.{name}", summary[-1], TURN)
    table = pd.concat(parts, ignore_index=True)
    tables = {"forces": table, "recordings": pd.DataFrame(summary), "influence": _influence_table(influence, meshing)}
    case = _case(file, path, table)
    if case is None:
        notes.append("no case folder: it needs [lubricant], [surfaces.NAME] and the surfaces of each recording")
    return Evaluated(
        file.title, tables, _figures(file, tables), tuple(_lines(tables["recordings"])), tuple(notes), case
    )


def _doubts(name: str, forces: Forces, nominal: float) -> Iterator[str]:
    """Raise an error for a negative normal force; yield a note if it deviates from torque over base radius."""
    ratio = float(forces.value[forces.single, 0].mean() / nominal) if forces.single.any() else np.nan
    if ratio <= 0.0:
        rule = "normal force of single contact over that of the torque: check gauges.wheel, roll_angle_at_pulse_deg and"
        raise InputError(f"{rule} the signs of the calibration", where=f"recordings.{name}", value=round(ratio, 4))
    if abs(ratio - 1.0) > LARGEST_DEVIATION:
        yield f"recording {name}: normal force {ratio:.3g} of torque over base radius; the source has it within 3 %"


def _table(
    name: str, one: MeshRecording, forces: Forces, meshing: Meshing, pair: GearPair, wheel: str, wider: float
) -> pd.DataFrame:
    """Table of shaft angles and instrumented teeth in contact."""
    way = np.radians(forces.roll_angle) * pair.base_radius[0 if wheel == "pinion" else 1]
    pinion = way if wheel == "pinion" else pair.line_of_action_length - way
    omega = one.speed_rpm * math.pi / 30.0
    other = (pair.line_of_action_length - pinion) / pair.teeth_ratio
    value, sd = friction_of(forces)
    found: dict[str, Any] = {
        "recording": np.full(pinion.size, name),
        "tooth": forces.tooth + 1,
        "roll_angle_deg": forces.roll_angle,
        "pinion_roll_angle_deg": np.degrees(pinion / pair.base_radius[0]),
        "single_contact": forces.single,
        "at_pitch_point": meshing.is_smeared(forces.roll_angle),
        "sliding_speed_m_s": omega * (pinion - other),
        "condition_number": forces.condition,
        **interval("normal_force_N", forces.value[:, 0], forces.sd(0), forces.sd_own(0), wider),
        **interval("friction_force_N", forces.value[:, 1], forces.sd(1), forces.sd_own(1), wider),
        **interval("friction_coefficient", value, combined(sd), noise_of(sd), wider),
        "friction_coefficient_sd_own": noise_of(sd),
    }
    return pd.DataFrame(found)


def _summary(
    name: str,
    one: MeshRecording,
    forces: Forces,
    meshing: Meshing,
    pair: GearPair,
    average: Average,
    offset: list[float],
) -> dict[str, Any]:
    """Row of a recording: friction of single contact weighted with load and sliding, normal force over torque."""
    mean, sd = mean_friction(forces, meshing)
    nominal = one.torque_Nm / pair.base_radius[0]
    found = interval("mean_friction", np.array(mean), combined(sd), noise_of(sd), few_turns(average.turns))
    return {
        "recording": name,
        "torque_Nm": one.torque_Nm,
        "speed_rpm": one.speed_rpm,
        "oil_temperature_C": one.oil_temperature_C,
        "revolutions": average.turns,
        **{k: float(v) for k, v in found.items()},
        "left_out_deg": meshing.smeared,
        "normal_force_over_nominal": float(forces.value[forces.single, 0].mean() / nominal),
        "largest_condition_number": float(forces.condition.max()),
        "removed_friction_force_N": float(np.mean(offset)),
        "strain_noise_um_m": float(average.sd.mean()),
    }


def _influence_table(influence: Influence, meshing: Meshing) -> pd.DataFrame:
    """Influence coefficients over the roll angle, by tooth and gauge."""
    angle = np.linspace(max(influence.low, meshing.low), min(influence.high, meshing.high), 41)
    rows = []
    for tooth in range(meshing.teeth):
        values = influence.at(angle, tooth)
        for gauge in range(values.shape[1]):
            rows.append(
                pd.DataFrame(
                    {
                        "tooth": tooth + 1,
                        "gauge": gauge + 1,
                        "roll_angle_deg": angle,
                        "normal_influence_um_m_per_N": values[:, gauge, 0],
                        "friction_influence_um_m_per_N": values[:, gauge, 1],
                    }
                )
            )
    return pd.concat(rows, ignore_index=True)


def _lines(recordings: pd.DataFrame) -> Iterator[str]:
    for row in recordings.to_dict("records"):
        yield (
            f"{row['recording']}: mean friction {row['mean_friction']:.4f} (sd {row['mean_friction_sd']:.2g}) in "
            f"single contact beyond {row['left_out_deg']:.2g}° from the pitch point; normal force "
            f"{row['normal_force_over_nominal']:.3f} of torque over base radius; "
            f"condition number up to {row['largest_condition_number']:.3g}"
        )


def _figures(file: StrainGaugeFile, tables: dict[str, pd.DataFrame]) -> dict[str, tuple[Panel, ...]]:
    normal: list[Curve] = []
    friction: list[Curve] = []
    coefficient: list[Curve] = []
    for group, name in enumerate(file.recordings):
        own = tables["forces"][tables["forces"]["recording"] == name]
        for tooth, rows in own.groupby("tooth"):
            label = name if tooth == 1 else ""
            for curves, quantity in ((normal, "normal_force_N"), (friction, "friction_force_N")):
                curves.append(curve(rows, "roll_angle_deg", quantity, label, group=group))
            single = rows[rows["single_contact"] & ~rows["at_pitch_point"]]
            coefficient.append(curve(single, "roll_angle_deg", "friction_coefficient", label, marker=True, group=group))
    shape = []
    first = tables["influence"][tables["influence"]["tooth"] == 1]
    for number, column in enumerate(file.gauges.columns):
        rows = first[first["gauge"] == number + 1]
        for kind, label in (("normal", f"influence on {column}"), ("friction", "")):
            shape.append(curve(rows, "roll_angle_deg", f"{kind}_influence_um_m_per_N", label, group=number))
    angle = f"roll angle of a tooth of the {file.gauges.wheel} (deg)"
    return {
        "forces": (
            Panel(angle, "normal force (N)", tuple(normal)),
            Panel(angle, "friction force (N)", tuple(friction)),
        ),
        "friction": (Panel(angle, "friction coefficient against sliding (-)", tuple(coefficient)),),
        "influence": (Panel(angle, "strain of tooth 1 per force (µm/m per N)", tuple(shape)),),
    }


def _case(file: StrainGaugeFile, path: Path, table: pd.DataFrame) -> CaseDraft | None:
    """Case of mesh friction from single contact."""
    rows = table[table["single_contact"] & ~table["at_pitch_point"]]
    # Errors of recentring have the opposite sign on either side of the pitch point.
    side = np.where(rows["sliding_speed_m_s"] < 0.0, "before", "behind")
    setup = np.char.add(np.char.add(rows["recording"].to_numpy().astype(str), ", "), side)
    includes = f'tooth friction of single contact, recentre = "{file.friction.recentre}"'
    return mesh_friction_case(file, path, rows, "pinion_roll_angle_deg", includes, setup)


EVALUATION = Evaluation(
    name="strain-gauge",
    about="strains of instrumented teeth, by calibrated influence matrices, into normal force and friction force",
    source=SOURCE,
    file=StrainGaugeFile,
    columns={"the calibration": (*CALIBRATION, STRAIN), "a recording": (*RECORDING, STRAIN)},
    run=run,
    results=STRAIN_GAUGE,
    example={
        "schema": "mixedlub-strain-gauge/1",
        "title": "NASA gear noise rig",
        "calibration": "calibration.csv",
        "gears": {"preset": "nasa"},
        "lubricant": {
            "oil": "mil_prf_23699",
            "density_15C_kg_m3": 1000.0,
            "density_change_per_K": 7e-4,
            "eyring_stress_MPa": 5.0,
            "specific_heat_J_kgK": 2000.0,
        },
        "surfaces": {"ground": {"m0_um2": 0.16, "m2": 0.0031, "m4_per_um2": 0.0021}},
        "gauges": {
            "columns": ["compressive_1_um_m", "tensile_1_um_m", "compressive_2_um_m", "tensile_2_um_m"],
            "wheel": "gear",
        },
        "friction": {"recentre": "mean", "asymmetry_sd": 0.002},
        "recordings": {
            "full_torque": {
                "file": "recording.csv",
                "torque_Nm": 71.7,
                "speed_rpm": 2000.0,
                "oil_temperature_C": 70.0,
                "roll_angle_at_pulse_deg": 31.88,
                "pinion_surface": "ground",
                "gear_surface": "ground",
            }
        },
    },
)
