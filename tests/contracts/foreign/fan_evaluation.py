"""An evaluation: drag of a fan from its power."""

import numpy as np
import pandas as pd

from mixedlub.evaluate.evaluation import Curve, Evaluated, Evaluation, Panel
from mixedlub.schema.section import Number, Section, key


class FanFile(Section):
    power_W: Number = key("power of the fan", example=30.0, gt=0.0)
    speed_rpm: Number = key("speed of the fan", example=1000.0, gt=0.0)


def run(file, path):
    torque = file.power_W / (file.speed_rpm * np.pi / 30.0)
    line = Curve(np.array([0.0, file.speed_rpm]), np.array([0.0, torque]))
    figures = {"drag": (Panel("speed (rpm)", "torque (N m)", (line,)),)}
    return Evaluated("Fan", {"drag": pd.DataFrame({"torque_Nm": [torque]})}, figures, (f"torque {torque:.4f} N m",))


EVALUATION = Evaluation(
    name="fan",
    about="power of a fan into its drag",
    source="the conservation of energy",
    file=FanFile,
    columns={},
    run=run,
    example={"power_W": 30.0, "speed_rpm": 1000.0},
)
