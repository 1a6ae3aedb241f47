"""The standard gear against an independent prototype of it."""

from __future__ import annotations

import numpy as np
import pytest

from mixedlub.case import reference_rigs
from mixedlub.effects import catalogue
from mixedlub.kinds.standard import ROUGHNESS_UM
from mixedlub.report.effect_pages import shown

PROTOTYPE = {
    "roughness_lay": {"lay": 1.0, "onset": 0.15, "decay": 1.0, "saturation": 0.0},
    "micro_ehl": {"viscous": 1.0, "spread": 0.0},
    "bearing_drag": {"strength": 1.0, "load_power": 1.0, "idle": 1.0, "rolling_power": 0.0, "rubbing": 0.0},
    "boundary_film_temperature": {"flash": 0.0},
}
"""Parameters of the prototype where they are not the middle of the priors: h + 0.15 sigma, all moments
alike, Palmgren's bearings, a film as warm as the oil."""


@pytest.mark.parametrize(
    ("effect_id", "torque", "speed"),
    [
        ("inlet_shear_heating", 0.8, 2.4),
        ("film_heating", 1.5, 1.7),
        ("coating_insulation", 1.35, 1.8),
        ("rolling_resistance", 0.0, 1.75),
        ("windage", 0.0, 2.75),
        ("bearing_drag", 0.6, 1.3),
        ("elastic_hysteresis", 1.5, 1.0),
        ("micro_ehl", 1.1, 0.75),
        ("asperity_plasticity", 1.0, 0.5),
        ("roughness_lay", 0.8, 0.9),
        ("boundary_film_temperature", 1.1, 0.4),
        ("surface_defects", 0.9, 1.0),
        ("tip_relief", 0.67, 0.96),
        ("torque_offset", 0.0, 1.0),
        ("torque_gain", 1.0, 1.0),
        ("sensor_gain", 1.17, 0.93),
    ],
)
def test_powers_of_torque_and_speed_on_the_standard_gear(effect_id: str, torque: float, speed: float) -> None:
    """Exponents of the change of loss that an independent prototype of this gear gave; they are good to 0.3."""
    forward = reference_rigs.forward("gear_pair")
    values = shown(catalogue()[effect_id]) | PROTOTYPE.get(effect_id, {})
    change = np.abs(forward.predict(None, {effect_id: values}) - forward.predict())
    rows = change > 1e-9 * change.max()
    table = forward.table
    columns = [np.ones(rows.sum()), np.log(table["torque_Nm"][rows]), np.log(table["speed_rpm"][rows])]
    temperature = table["oil_temperature_C"][rows] / 10.0
    rough = [table["pinion_surface"][rows] == s for s in ROUGHNESS_UM]
    design = np.array([*columns[1:], temperature, *rough], dtype=float).T
    powers, *_ = np.linalg.lstsq(design, np.log(change[rows]), rcond=None)
    assert powers[0] == pytest.approx(torque, abs=0.3)
    assert powers[1] == pytest.approx(speed, abs=0.3)
