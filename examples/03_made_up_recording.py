"""Make the recording of ``case``: the model's own answer with one effect on and 1 % noise, for commands to run on."""

import csv
import itertools
from pathlib import Path

import numpy as np

from mixedlub.case.folder import read_case, read_conditions
from mixedlub.case.forward import Forward
from mixedlub.effects import find

CASE = Path(__file__).with_name("case")
CONDITIONS = ("torque_Nm", "speed_rpm", "oil_temperature_C", "pinion_surface", "gear_surface")
TORQUES, SPEEDS, OILS = (50, 100, 150), (500, 1000, 2000, 4000), (40, 70)
PAIRINGS = (("polished", "polished"), ("polished", "ground"), ("ground", "ground"))

rows = [(*place, *pairing) for place in itertools.product(TORQUES, SPEEDS, OILS) for pairing in PAIRINGS]
with (CASE / "conditions.csv").open("w", newline="") as file:
    table = csv.writer(file, lineterminator="\n")
    table.writerow(("run", *CONDITIONS))
    table.writerows((run, *row) for run, row in enumerate(rows, start=1))

case = read_case(CASE, need_recordings=False)
(effect,) = find(["inlet_shear_heating"])
forward = Forward(case, read_conditions(case, CASE / "conditions.csv"))
true = forward.predict(parameters={effect.id: effect.prior_medians})
noise = np.random.default_rng(20221).normal(size=true.size) * np.hypot(0.01 * true, 0.2)

with (CASE / "recordings.csv").open("w", newline="") as file:
    table = csv.writer(file, lineterminator="\n")
    table.writerow(("run", *CONDITIONS, "power_loss_W"))
    table.writerows((run, *row, f"{y:.2f}") for run, (row, y) in enumerate(zip(rows, true + noise), start=1))
(CASE / "conditions.csv").write_text("run," + ",".join(CONDITIONS) + "\n101,100,3000,55,polished,ground\n")
print(f"{len(rows)} readings in {CASE.name}/recordings.csv, largest loss {true.max():.0f} W")
