"""Case folders of real recordings: typed-in tables, and larger files from a folder of recordings.

python examples/real/build.py --out out/real
python examples/real/build.py --data ../shared/data/recordings --out out/real
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from mixedlub.importers import write_case

TABLES = Path(__file__).parent / "tables"
STEEL_ON_GLASS = {"youngs_modulus_GPa": [207.0, 75.0], "poisson_ratio": [0.3, 0.22]}
BALL_MM = 9.525
ZERO_NM = 1.5
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


def film_two_oils(data: Path) -> Iterator[Found]:
    """Film of two unnamed oils; oil a at two temperatures.

    Films read back at rest after the sweeps were -0.4 to 2.3 nm: each sweep has a zero of its own.
    """
    for oil in ("oil_a_40C_100C", "oil_b_100C"):
        t = pd.read_csv(data / "ehd_film_two_oils_40C_100C" / f"{oil}.csv")
        absolute, relative = (1.0, 0.05) if oil.startswith("oil_a") else (0.8, 0.02)
        system = {
            "kind": "film",
            "description": "EHD rig, about 20 N, oil unnamed, ball of 19.05 mm assumed",
            "contact": ball_on_glass(),
            "recording": {
                "quantity": "film_thickness_nm",
                "noise": {"relative": relative, "absolute": absolute, "setup_absolute": ZERO_NM},
            },
        }
        yield (
            f"ehd_film_{oil}",
            system,
            {
                "setup": t["step"].map("sweep {}".format),
                "load_N": t["ball_load_N"].round(),
                "entrainment_speed_m_s": t["rolling_speed_mm_s"] * 1e-3,
                "slide_roll_ratio": np.zeros(len(t)),
                "oil_temperature_C": t["lube_temp_degC"],
                "film_thickness_nm": t["film_thickness_nm"],
                "fringe_order": t["fringe_order"],
            },
        )


def traction_cycles(data: Path) -> Iterator[Found]:
    """Every tenth of 500 traction sweeps, readings averaged by slide-roll ratio.

    The sd is the scatter of a bin over the sweeps once the level of each sweep is taken out: at low slip it
    holds the wander of the slip itself. Its floor 0.001 is the change from sweep to sweep.
    """
    t = pd.read_csv(data / "etm_traction_500_cycles" / "traction_points.csv")
    t["srr"] = t["slide_roll_ratio_percent"].abs()
    t = t[(t["srr"] < 22) & ((t["cycle"] % 10 == 1) | (t["cycle"] < 8))]
    edges = [0.0, 0.5, 1.0, 1.75, 2.5, 3.5, 6.0, 12.0, 22.0]
    t["bin"] = pd.cut(t["srr"], edges, include_lowest=True)
    started = pd.to_datetime(t["cycle_start"], dayfirst=True)
    t["time"] = (started - started.min()).dt.total_seconds() + t["step_time_s"]
    mean = t.groupby(["cycle", "bin"], observed=True).mean(numeric_only=True).reset_index()
    level = mean[mean["srr"] > 12.0].groupby("cycle")["friction_coefficient"].mean()
    relative = mean["friction_coefficient"] / mean["cycle"].map(level)
    scatter = relative.groupby(mean["bin"], observed=True).agg(lambda x: 1.4826 * (x - x.median()).abs().median())
    sd = np.hypot(mean["bin"].map(scatter).astype(float) * mean["friction_coefficient"].mean(), 0.001)
    system = {
        "kind": "friction_history",
        "description": "ball on disc, 3.6 GPa if steel on steel with a 19.05 mm ball, 25 mm/s, 500 sweeps of "
        "slide-roll ratio; oil unnamed",
        "recording": {"quantity": "friction_coefficient"},
    }
    yield (
        "etm_traction_500_cycles",
        system,
        {
            "time_s": mean["time"],
            "load_N": mean["ball_load_N"].round(-1),
            "entrainment_speed_m_s": mean["rolling_speed_mm_s"] * 1e-3,
            "slide_roll_ratio": mean["srr"] / 100.0,
            "oil_temperature_C": mean["lube_probe_temp_degC"],
            "friction_coefficient": mean["friction_coefficient"],
            "friction_coefficient_sd": sd,
        },
    )


def pin_on_disc(data: Path) -> Iterator[Found]:
    """Friction and contact resistance of a pin on a disc, means of 100 s with the sd inside them."""
    t = pd.read_csv(data / "mtm_pin_on_disc_ecr_25C" / "friction_ecr_1Hz.csv")
    block = (t["step_time_s"] - 1) // 100
    mean, sd = t.groupby(block).mean(numeric_only=True), t.groupby(block)["friction_coefficient"].std()
    system = {
        "kind": "friction_history",
        "description": "pin on disc, 11.74 N, 200 mm/s, about 25 degC; pin, materials and oil unnamed",
        "recording": {"quantity": "friction_coefficient", "check": "contact_resistance_percent"},
    }
    yield (
        "mtm_pin_on_disc_ecr_25C",
        system,
        {
            "time_s": mean["step_time_s"],
            "oil_temperature_C": mean["pot_temp_degC"],
            "friction_coefficient": mean["friction_coefficient"],
            "friction_coefficient_sd": sd,
            "contact_resistance_percent": mean["ecr_percent"],
        },
    )


def rheometer(data: Path) -> Iterator[Found]:
    """Viscosity through a cycle of temperature, every 25th reading.

    The rheometer scatters by 0.04 %; the noise is what a straight line of the D341 chart leaves of a sample that
    does not change, about 1 %.
    """
    t = pd.read_csv(data / "oil_viscosity_temperature_cycle" / "viscosity_temperature.csv")
    length = t.groupby("segment")["segment_time_s"].max().cumsum().shift(fill_value=0.0)
    t["time"] = t["segment_time_s"] + t["segment"].map(length)
    t = t.iloc[1:].iloc[::25]
    system = {
        "kind": "viscosity",
        "description": "rheometer at 200 1/s, 25 to 70 to 5 to 25 degC, fluid unnamed; the start-up reading left out",
        "recording": {"quantity": "viscosity_mPa_s", "noise": {"relative": 0.01}},
    }
    yield (
        "oil_viscosity_temperature_cycle",
        system,
        {
            "temperature_C": t["temperature_degC"],
            "time_s": t["time"],
            "viscosity_mPa_s": t["viscosity_Pa_s"] * 1e3,
        },
    )


def geared_motors(data: Path) -> Iterator[Found]:
    """Friction of both geared motors, referred to the motor shaft: computed torque less torque at the sensor.

    A motor that drives gives the sensor less than it computes; one that is driven brakes with less than the
    sensor shows. Stalled and moving runs without gears are the rig ``no_gears``.
    """
    t = pd.read_csv(data / "geared_actuator_back_to_back" / "steady_steps.csv").dropna(subset=["gear_ratio"])
    i = t["gear_ratio"]
    stalled = t["kind"] == "nogear_stalled"
    speed = np.where(stalled, 0.0, t["output_speed_rad_s"] * i * 30.0 / np.pi)
    drive, load, sensor = t["ideal_drive_torque_Nm"] / i, t["ideal_load_torque_Nm"] / i, t["torque_sensor_Nm"] / i
    rig = np.where(t["kind"] == "gear6", "geared", "no_gears")
    unit = np.where(t["driving_actuator"] == 1, "actuator_1", "actuator_2")
    other = np.where(t["driving_actuator"] == 1, "actuator_2", "actuator_1")
    system = {
        "kind": "friction_map",
        "description": "two 6:1 geared motors face to face through a torque sensor, all referred to the motor shaft; "
        "motor torque is current times the constant that the controller assumes; the noise is what the two units "
        "and the stalled positions differ by, far above the scatter of one step",
        "recording": {
            "quantity": "friction_torque_Nm",
            "includes": "computed motor torque less shaft torque: gears, bearings and any error of the motor constant",
            "noise": {"relative": 0.05, "absolute": 0.012},
        },
    }
    yield (
        "geared_actuator_back_to_back",
        system,
        {
            "rig": np.concatenate([rig, rig]),
            "setup": np.concatenate([unit, other]),
            "speed_rpm": np.concatenate([speed, speed]),
            "torque_Nm": np.concatenate([drive, -load]),
            "friction_torque_Nm": np.concatenate([drive - sensor, sensor - load]),
        },
    )


TYPED_IN: tuple[Callable[[], Iterator[Found]], ...] = (
    film_31,
    tribofilm_steps,
    leadscrews,
    viscosity_pressure,
    friction_modifiers,
    coast_down,
    robot_joints,
)
FROM_FILES: tuple[Callable[[Path], Iterator[Found]], ...] = (
    film_two_oils,
    traction_cycles,
    pin_on_disc,
    rheometer,
    geared_motors,
)


def build(out: Path, data: Path | None = None) -> list[Path]:
    """Write every case; those made from larger files only where ``data`` holds them."""
    made = [write_case(out / name, system, columns) for make in TYPED_IN for name, system, columns in make()]
    for make in FROM_FILES if data is not None else ():
        made += [write_case(out / name, system, columns) for name, system, columns in make(data)]
    return made


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--data", type=Path, help="folder of the recordings, for the larger files")
    parser.add_argument("--out", type=Path, default=Path("out/real"), help="where the case folders go")
    arguments = parser.parse_args()
    for folder in build(arguments.out, arguments.data):
        print(folder)
