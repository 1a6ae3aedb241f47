"""What a table tells of loads and temperatures decides which effects are offered, and against what they are told."""

from dataclasses import replace
from itertools import product

import numpy as np

from mixedlub.case import reference_rigs
from mixedlub.case.forward import Forward
from mixedlub.schema.table import Table

from .conftest import BALL, OIL, drive, system


def teeth(torques: tuple[float, ...], angles: tuple[float, ...]) -> Forward:
    """The standard rig of tooth friction at torques and roll angles."""
    rig = reference_rigs.forward("mesh_friction")
    rows = np.array(list(product(torques, angles)))
    held = {name: np.repeat(values[:1], len(rows)) for name, values in rig.table.columns.items()}
    own = {"run": np.arange(len(rows)), "torque_Nm": rows[:, 0], "roll_angle_deg": rows[:, 1]}
    table = Table({**held, **own})
    return Forward(replace(rig.case, recordings=table), table)


def test_a_force_at_one_tooth_load_has_no_zero_error_of_its_own() -> None:
    assert "inverse_load" not in teeth((100.0,), (21.6, 21.8, 22.0)).inputs


def test_a_zero_error_of_the_tooth_force_is_told_at_the_least_load_recorded() -> None:
    several = teeth((50.0, 100.0), (16.0, 22.0, 28.0))
    inverse = several.inputs["inverse_load"]
    assert inverse.max() == 1.0
    heavy = several.table["torque_Nm"] > 50.0
    asked = Forward(several.case, several.table.take(heavy))
    np.testing.assert_allclose(asked.inputs["inverse_load"], inverse[heavy], rtol=1e-12)


def test_an_idle_run_leaves_the_loads_of_the_others(make) -> None:
    speed, load = np.tile([30.0, 90.0, 150.0], 4), np.repeat([2.0, 4.0, 6.0, 0.0], 3)
    case = make(*drive(0.2 + speed / 300.0, speed_rpm=speed, load_N=load))
    told = Forward(case, case.recordings).inputs["log_load"][:, 0]
    assert np.allclose(told[:9] - told[0], np.log(load[:9] / 2.0))
    assert np.allclose(told[9:], told[:3], rtol=1e-12)
    asked = Table({k: v[3:] for k, v in case.recordings.columns.items()}, "conditions.csv")
    np.testing.assert_allclose(Forward(case, asked).inputs["log_load"][:, 0], told[3:], rtol=1e-12)


def test_a_law_over_temperature_is_not_offered_at_one_temperature(make) -> None:
    """There it is no more than another viscosity, which is calibration."""
    speed = np.geomspace(0.1, 3.0, 12)
    columns = {"load_N": np.full(12, 20.0), "entrainment_speed_m_s": speed, "slide_roll_ratio": np.zeros(12)}
    for span in (1.5, 40.0):
        columns["oil_temperature_C"] = np.linspace(60.0, 60.0 + span, 12)
        columns["film_thickness_nm"] = 100.0 * speed**0.67
        case = make(system("film", "film_thickness_nm", contact=BALL, lubricant=OIL), columns)
        offered = {e.id for e in Forward(case, case.recordings).effects()}
        assert ("viscosity_temperature_law" in offered) == (span > 6.0)
