"""Recordings of three published kinds of rig turned into friction, beside the friction that made them.

The rigs are synthetic, with the gears, loads and procedures that the papers state: the calorimetric rig of high-speed
gears B, the strain gauges of NASA TM-107279, and the slow gears and two discs of AGMA 99FTMS1. What a paper does not
print (stiffness, heat capacity, noise) is assumed.
"""

from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import mixedlub as ml
from mixedlub.commands.new import evaluation_files
from mixedlub.validation.benches import calorimetric, off_line, strain_gauges, two_discs
from mixedlub.validation.benches.tables import as_csv


def evaluated(folder, method, tables):
    """The tables of an evaluation of the template's rig with other recordings."""
    for name, text in {**evaluation_files(method), **{name: as_csv(one) for name, one in tables.items()}}.items():
        (Path(folder) / name).write_text(text, encoding="utf-8")
    return ml.evaluate_recording(method, Path(folder) / f"{method}.toml")


def say(what, truth, row, name="mean_friction"):
    print(f"{what:58}{truth:9.4f}{row[name]:9.4f}{row[f'{name}_low90']:9.4f} to {row[f'{name}_high90']:.4f}")


with TemporaryDirectory() as folder:
    print(f"{'':58}{'planted':>9}{'found':>9}{'90 % interval':>18}")

    gear = calorimetric.Gear()
    rig = replace(calorimetric.Bench(), sliding=calorimetric.sliding_of_mesh(gear))
    columns, truth = calorimetric.recorded(rig, gear, 1)
    series = evaluated(folder, "calorimetric", {"readings.csv": columns})["series"]
    for surface, speed in (("ground", 20.0), ("ground", 95.0), ("superfinished", 95.0)):
        row = series[series["series"].str.contains(surface) & (series["pitch_line_velocity_m_s"].round() == speed)]
        rows = zip(truth, columns["pinion_surface"], columns["torque_Nm"], strict=True)
        own = [(t["friction"], load) for t, s, load in rows if s == surface and t["speed"] == speed]
        friction, load = np.transpose(own)
        say(f"heat of the oil, {surface}, {speed:g} m/s", np.average(friction, weights=load), row.iloc[0])

    tooth = strain_gauges.Tooth()
    calibration, recording, real = strain_gauges.recorded(strain_gauges.Bench(), tooth, 1)
    tables = evaluated(folder, "strain-gauge", {"calibration.csv": calibration, "recording.csv": recording})
    single = tables["forces"][tables["forces"]["single_contact"]]
    slide = np.abs(single["roll_angle_deg"] - tooth.path[1])
    planted = np.average([real[round(angle, 2)][1] for angle in single["roll_angle_deg"]], weights=slide)
    say("strain gauges, single contact", planted, tables["recordings"].iloc[0])

    slow = off_line.Bench()
    found = evaluated(folder, "off-line", off_line.recorded(slow, 1)[0])["friction"]
    for _, row in found.iterrows():
        angle = row["roll_angle_deg"]
        say(
            f"off the line of action, roll angle {angle:.1f}°",
            off_line.local_friction(slow, angle),
            row,
            "friction_coefficient",
        )

    columns, truth = two_discs.recorded(two_discs.Bench(), 1)
    found = evaluated(folder, "two-disc", {"readings.csv": columns})["traction"]
    for number in (0, 3, 12):
        row = found.iloc[number]
        where = f"two discs, {row['load_N']:.0f} N, slide-to-roll ratio {row['slide_roll_ratio']:.2f}"
        say(where, truth[number], row, "friction_coefficient")
