"""Files of the logger of the fan."""

import numpy as np

from mixedlub.importers.base import Draft


def matches(text):
    return text.startswith("FANLOG")


def draft(file, answers):
    rows = np.array([[float(cell) for cell in line.split()] for line in file.text.splitlines()[1:]])
    return Draft("fan_drag", "fan_drag_mNm", {"speed_rpm": rows[:, 0], "fan_drag_mNm": rows[:, 1]})
