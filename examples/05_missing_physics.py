"""Find the physics that a simulation lacks, and predict two readings of a measured robot joint that it has not seen.

The readings (``real/tables``, every fourth stroke of an arm's fourth joint) are measured. Two are taken out before the
diagnosis: one where friction falls with speed, and the fastest backward one, beyond all speeds that remain.
"""

from pathlib import Path

import numpy as np
import pandas as pd

import mixedlub as ml

HERE = Path(__file__).parent
OUT = Path("out/missing_physics")
HELD_BACK = [17, 22]

joint = pd.read_csv(HERE / "real/tables/robot_joint_4.csv")
readings = pd.DataFrame({"speed_rpm": joint["speed_rad_s"] * 30 / np.pi, "friction_torque_Nm": joint["torque_Nm"]})
later, known = readings.iloc[HELD_BACK], readings.drop(index=HELD_BACK)

system = {"kind": "friction_map", "recording": {"quantity": "friction_torque_Nm"}}
answer = ml.diagnose(ml.case.case_of(system, known, name="robot joint"), predict=later[["speed_rpm"]])
print(answer)

print("Predicted before they were measured:")
predictions = answer.predictions.iloc[-len(later) :]
for (_, row), measured in zip(predictions.iterrows(), later["friction_torque_Nm"], strict=True):
    interval = f"{row['predicted']:.2f} N m ({row['low90']:.2f} to {row['high90']:.2f})"
    base = f"calibrated base model {row['calibrated']:.2f}"
    print(f"{row['speed_rpm']:6.2f} rpm: {interval}, {base}, measured {measured:.2f}")

picture = ml.plot(answer, over="speed_rpm", later=later["friction_torque_Nm"])
OUT.mkdir(parents=True, exist_ok=True)
picture.savefig(OUT / "missing_physics.svg", metadata={"Date": None})
print(f"Drawn: {OUT / 'missing_physics.svg'}")
