"""Cases of the typed-in tables."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

TABLES = Path(__file__).parent / "tables"
STEEL_ON_GLASS = {"youngs_modulus_GPa": [207.0, 75.0], "poisson_ratio": [0.3, 0.22]}
BALL_MM = 9.525
Found = tuple[str, dict[str, Any], dict[str, Any]]


def table(name: str) -> pd.DataFrame:
    """One of the typed-in tables."""
    return pd.read_csv(TABLES / f"{name}.csv")


def ball_on_glass() -> dict[str, Any]:
    """A steel ball on a glass disc; the size of the ball is the rig's usual one."""
    return {"geometry": "point", "radius_mm": [BALL_MM, float("inf")], **STEEL_ON_GLASS}


def film_31() -> Iterator[Found]:
    """Film against speed; the oil is unnamed, its viscosity the nominal one of the source.

    The noise is the middle of the 1 to 3 % by which the readings scatter about a smooth curve.
    """
    t = table("ehd_film_31C_50N")
    system = {
        "kind": "film",
        "description": "EHD rig, 31 degC, 50 N; oil unnamed, 67.0 and 18.9 mm2/s are the source's nominal values",
        "contact": ball_on_glass(),
        "lubricant": {
            "name": "unnamed",
            "temperature_C": [40.0, 100.0],
            "kinematic_viscosity_mm2_s": [67.0, 18.9],
        },
        "uncertainty": {"viscosity": 0.3},
        "recording": {"quantity": "film_thickness_nm", "noise": {"relative": 0.02, "absolute": 1.0}},
    }
    yield (
        "ehd_film_31C_50N",
        system,
        {
            "load_N": t["ball_load_N"].round(),
            "entrainment_speed_m_s": t["rolling_speed_mm_s"] * 1e-3,
            "slide_roll_ratio": np.zeros(len(t)),
            "oil_temperature_C": t["lube_temperature_C"],
            "film_thickness_nm": t["film_thickness_nm"],
            "fringe_order": t["fringe_order"],
        },
    )


def tribofilm_steps() -> Iterator[Found]:
    """Friction after each rubbing step, coverage of the track as a second channel that is never fitted."""
    t = table("mtm_tribofilm_growth_120C")
    system = {
        "kind": "friction_history",
        "description": "ball on disc, 24 rubbing steps of 5 min at 120 degC, 50 N, 200 mm/s, slide-roll ratio 1; "
        "oil and film unnamed; friction is the mean of the last minute of a step",
        "recording": {
            "quantity": "friction_coefficient",
            "check": "track_coverage_percent",
            "noise": {"relative": 0.01},
        },
    }
    n = len(t)
    yield (
        "mtm_tribofilm_growth_120C",
        system,
        {
            "time_s": t["rubbing_time_min"] * 60.0,
            "load_N": np.full(n, 50.0),
            "entrainment_speed_m_s": np.full(n, 0.2),
            "slide_roll_ratio": np.ones(n),
            "oil_temperature_C": np.full(n, 120.0),
            "friction_coefficient": t["friction_coefficient"],
            "track_coverage_percent": t["track_coverage_percent"],
        },
    )


def leadscrews() -> Iterator[Found]:
    """Two screw drives; torque in N m from per cent of 9.84 mN m."""
    for drive, rows in table("leadscrew_friction_map").groupby("drive"):
        unit = 9.84e-5
        system = {
            "kind": "friction_map",
            "description": f"lead screw drive {drive}, constant speeds in both directions, payload 0.096 kg",
            "recording": {
                "quantity": "friction_torque_Nm",
                "includes": "motor, screw, nut and guide, from the motor current",
            },
        }
        yield (
            f"leadscrew_drive_{drive}",
            system,
            {
                "speed_rpm": rows["speed_rpm"],
                "friction_torque_Nm": rows["motor_torque_percent"] * unit,
                "friction_torque_Nm_sd": np.hypot(rows["standard_error_percent"], 0.3) * unit,
            },
        )


def viscosity_pressure() -> Iterator[Found]:
    """Viscosity to 757 MPa; dynamic viscosity with an assumed constant density, which only shifts the level."""
    t = table("lubricant_viscosity_vs_pressure")
    system = {
        "kind": "viscosity",
        "description": "kinematic viscosity under pressure, fluid unnamed; made dynamic with 960 kg/m3 at all "
        "pressures, so the density's own rise is missing from the slope against pressure; the noise is the scatter "
        "about a smooth curve of one temperature, mostly from the pressure gauge (repeats at 1 atm differ by 0.7 %)",
        "recording": {"quantity": "viscosity_mPa_s", "noise": {"relative": 0.04}},
    }
    yield (
        "lubricant_viscosity_vs_pressure",
        system,
        {
            "temperature_C": t["temperature_C"],
            "pressure_MPa": t["pressure_atm"] * 0.101325,
            "viscosity_mPa_s": np.exp(t["ln_kinematic_viscosity"]) * 0.96,
        },
    )


def friction_modifiers() -> Iterator[Found]:
    """The oils together by their content, and each grease: few readings, wide scatter between tests."""
    t = table("friction_modifier_concentration")
    relative = (t["friction_sd"] / t["friction_mean"]).groupby(t["sample"]).transform("max")
    t["friction_sd"] = t["friction_sd"].fillna(relative * t["friction_mean"])
    t["content"] = pd.to_numeric(t["sample"].str.extract(r"^OA-(\d+)$")[0])
    oils = t["content"].notna()
    for sample, rows in (("oils", t[oils]), *t[~oils].groupby("sample")):
        content = {"additive_percent": rows["content"]} if sample == "oils" else {}
        system = {
            "kind": "friction_map",
            "description": f"reciprocating friction, {sample}; sd is that between tests, where none is given the "
            "largest relative one of the sample; oleic acid by the names of the oils, unit not stated",
            "recording": {"quantity": "friction_coefficient"},
        }
        yield (
            f"friction_modifier_{sample}",
            system,
            {
                "sliding_speed_m_s": rows["sliding_speed_mm_s"] * 1e-3,
                "load_N": rows["load_N"],
                **content,
                "friction_coefficient": rows["friction_mean"],
                "friction_coefficient_sd": rows["friction_sd"],
            },
        )


def coast_down() -> Iterator[Found]:
    """Every second stretch of 20 revolutions below 170 rpm, where the tested wheel has long been lifted off.

    The torque is the inertia that the source takes times the deceleration. The noise is the scatter about a smooth
    curve of each direction.
    """
    t = table("drum_coast_down")
    system = {
        "kind": "friction_map",
        "description": "a drum alone coasts down in both directions, no motor and nothing in contact with it; torque "
        "is 6.7575 kg m2 times the deceleration",
        "recording": {
            "quantity": "friction_torque_Nm",
            "includes": "bearings of the drum and the air that it moves",
            "noise": {"relative": 0.003},
        },
    }
    columns = {"speed_rpm": t["speed_rpm"], "friction_torque_Nm": 6.7575 * t["deceleration_rad_s2"]}
    yield "drum_coast_down", system, columns


def robot_joints() -> Iterator[Found]:
    """Two joints of robots; neither source states a noise, which is left to be estimated."""
    for name, torque, description in (
        (
            "kinova_joint",
            "friction_torque_Nm",
            "seventh joint of a Kinova Gen3 arm at ten commanded speeds in one direction, each run in four parts, the "
            "first third left out; friction by the source's observer",
        ),
        (
            "robot_joint_4",
            "torque_Nm",
            "fourth joint of a six-axis arm, every fourth of 72 strokes in each direction, gear 121; the torque may "
            "hold a constant of gravity",
        ),
    ):
        t = table(name)
        recording = {"quantity": "friction_torque_Nm", "includes": "motor and gear of the joint"}
        system = {"kind": "friction_map", "description": description, "recording": recording}
        yield name, system, {"speed_rpm": t["speed_rad_s"] * 30.0 / np.pi, "friction_torque_Nm": t[torque]}


TYPED_IN: tuple[Callable[[], Iterator[Found]], ...] = (
    film_31,
    tribofilm_steps,
    leadscrews,
    viscosity_pressure,
    friction_modifiers,
    coast_down,
    robot_joints,
)
