"""Power loss from Python: the numbers of the same study from a file."""

import numpy as np
import pytest

import mixedlub as ml
from profiles.errors import InputError

PAIR = ml.gear_pair(
    teeth=(17, 26),
    normal_module_mm=25.4 / 6,
    pressure_angle_deg=22.5,
    tip_diameter_mm=(80.5, 118.4),
    face_width_mm=14.0,
)
ELASTIC = ml.gear_pair(**PAIR.model_dump() | {"load_sharing": {"model": "ldp"}})
GROUND = ml.surface(m0_um2=0.137, m2=0.0031, m4_per_um2=0.0021)
POLISHED = ml.surface("shipped:0258", cutoff_mm=0.8)
OIL = ml.oil("mineral")
CONDITION = {"torque_Nm": 100.0, "speed_rpm": 1500.0, "oil_temperature_C": 60.0}
FILE = """
schema = "mixedlub-study/1"
[gears]
teeth = [17, 26]
normal_module_mm = 4.233333333333333
pressure_angle_deg = 22.5
tip_diameter_mm = [80.5, 118.4]
face_width_mm = 14.0
[lubricant]
base = "mineral"
[surfaces.ground]
m0_um2 = 0.137
m2 = 0.0031
m4_per_um2 = 0.0021
[surfaces.polished]
profile = "shipped:0258"
cutoff_mm = 0.8
[pairings]
pinion = ["ground"]
gear = ["polished"]
[conditions]
torque_Nm = [50, 100]
speed_rpm = [1500]
oil_temperature_C = [60, 90]
"""


def test_it_is_the_study_of_the_same_file(tmp_path) -> None:
    (tmp_path / "own.toml").write_text(FILE, encoding="utf-8")
    study = ml.study.run(tmp_path / "own.toml").to_xarray()["power_loss_W"].isel(pairing=0, speed_rpm=0)
    loss = ml.power_loss(PAIR, OIL, (GROUND, POLISHED), torque_Nm=[50, 100], speed_rpm=1500, oil_temperature_C=[60, 90])
    assert loss["power_loss_W"].dims == ("oil_temperature_C", "torque_Nm")
    np.testing.assert_array_equal(loss["power_loss_W"].values, study.values)


@pytest.mark.parametrize("pair", [PAIR, ELASTIC], ids=["rigid", "ldp"])
def test_the_path_adds_up_to_the_loss(pair) -> None:
    """Friction times load times sliding speed, integrated over the path by base pitch: the sliced face as a whole."""
    path = ml.along_path(pair, OIL, GROUND, **CONDITION)
    loss = ml.power_loss(pair, OIL, GROUND, **CONDITION)
    force = CONDITION["torque_Nm"] / (1e-3 * PAIR.normal_module_mm * PAIR.teeth[0] / 2 * np.cos(np.radians(22.5)))
    power = path["friction"] * path["load_share"] * path["sliding_speed_m_s"] * force
    mean = float((power * path["path_weight"]).sum())
    assert mean == pytest.approx(float(loss["power_loss_W"]), rel=1e-9)


def test_wrong_keys_name_the_nearest() -> None:
    with pytest.raises(InputError, match="normal_module_mm"):
        ml.gear_pair(teeth=(17, 26), normal_modul_mm=4.0, face_width_mm=14.0)
    with pytest.raises(InputError, match="starvation"):
        ml.power_loss(PAIR, OIL, GROUND, **CONDITION, effects={"starvatio": {}})


def test_a_trace_that_is_not_there_is_named() -> None:
    with pytest.raises(InputError, match=r"nowhere\.csv"):
        ml.power_loss(PAIR, OIL, ml.surface("nowhere.csv"), **CONDITION)
