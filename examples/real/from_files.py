"""Cases of the larger files, read from a folder of recordings."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pandas as pd
from typed_in import Found, ball_on_glass

ZERO_NM = 1.5


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


FROM_FILES: tuple[Callable[[Path], Iterator[Found]], ...] = (
    film_two_oils,
    traction_cycles,
    pin_on_disc,
    rheometer,
    geared_motors,
)
