"""A recorded hypoid axle, as a case of the kind table with the losses that `mixedlub bevel` computes."""

import tomllib

import numpy as np
import pandas as pd
import pytest

from mixedlub.cli import main
from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.skew_gears import EXAMPLE

CONDITIONS = """[conditions]
torque_Nm = [50, 150, 300]
speed_rpm = [500, 1000, 2000, 3000]
oil_temperature_C = [60, 90]
"""
SYSTEM = """schema = "mixedlub-case/1"
kind = "table"
[recording]
quantity = "power_loss_W"
noise = { relative = 0.01, absolute = 0.5 }
[uncertainty]
boundary_friction = 0.012
"""
SET = ["torque_Nm", "speed_rpm", "oil_temperature_C"]


def simulated(folder, boundary):
    """Losses of the sample axle at a boundary friction."""
    text = EXAMPLE.read_text(encoding="utf-8")
    start, end = text.index("[conditions]"), text.index("[lubricant]")
    text = text[:start] + CONDITIONS + text[end : text.index("[vary]")]
    text = text.replace("boundary_friction = 0.1", f"boundary_friction = {boundary}").replace(
        "xu_kahraman", "tallian_mixture"
    )
    assert tomllib.loads(text)["boundary_friction"] == boundary
    (folder / "axle.toml").write_text(text, encoding="utf-8")
    out = folder / f"axle_{boundary}"
    assert main(["bevel", str(folder / "axle.toml"), "--no-figures", "--out", str(out)]) == 0
    return pd.read_csv(out / "map.csv")


@pytest.fixture(scope="module")
def maps(tmp_path_factory):
    folder = tmp_path_factory.mktemp("axle")
    return simulated(folder, 0.1), simulated(folder, 0.112)


@pytest.mark.long
@pytest.mark.parametrize(("offset", "verdict"), [(0.0, ("none",)), (0.35, ("torque_offset",))])
def test_an_offset_of_the_torque_meter_is_told_from_the_tooth_loss(maps, tmp_path, offset, verdict):
    """Boundary friction half a standard deviation above the stated one, and a torque meter off by 0.35 N m."""
    base, up = (one["power_loss_W"].to_numpy() for one in maps)
    truth = base + 0.5 * (up - base) + offset * maps[0]["speed_rpm"].to_numpy() * np.pi / 30
    noise = np.hypot(0.01 * truth, 0.5) * np.random.default_rng(4).standard_normal(truth.size)
    columns = {"run": np.arange(1, truth.size + 1), **{name: maps[0][name] for name in SET}}
    frame = pd.DataFrame(columns).assign(power_loss_W=truth + noise, simulated=base, simulated_boundary_friction=up)
    frame.to_csv(tmp_path / "recordings.csv", index=False)
    (tmp_path / "system.toml").write_text(SYSTEM, encoding="utf-8")
    answer = diagnose_case(tmp_path)
    assert answer.posterior.tied[0].ids == verdict
