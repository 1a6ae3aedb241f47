"""Base models of the kinds, against formulas written out here."""

from math import asinh, exp, log, log10

import numpy as np
import pytest

from mixedlub.case.folder import read_conditions
from mixedlub.case.forward import Forward
from mixedlub.schema.findings import codes
from mixedlub.schema.table import Table
from profiles.errors import InputError

from .conftest import BALL, OIL, system


def d341(celsius, t=(40.0, 100.0), nu=(67.0, 18.9)):
    """Kinematic viscosity in mm2/s between two points, written out."""
    z1, z2 = (log10(log10(v + 0.7)) for v in nu)
    slope = (z2 - z1) / (log10(t[1] + 273.15) - log10(t[0] + 273.15))
    return 10 ** (10 ** (z1 + slope * (log10(celsius + 273.15) - log10(t[0] + 273.15)))) - 0.7


def film_columns(speed=(0.1, 1.0, 2.0), temperature=40.0):
    n = len(speed)
    return {
        "load_N": [50.0] * n,
        "entrainment_speed_m_s": list(speed),
        "slide_roll_ratio": [0.0] * n,
        "oil_temperature_C": [temperature] * n,
        "film_thickness_nm": [100.0 + i for i in range(n)],
    }


def test_film_is_hamrock_dowson_with_unit_ellipticity_of_a_ball(make):
    case = make(system("film", "film_thickness_nm", contact=BALL, lubricant=OIL), film_columns())
    r, e = 9.525e-3, 2.0 / ((1 - 0.3**2) / 207e9 + (1 - 0.22**2) / 75e9)
    eta = d341(40.0) * 1e-6 * 870.0 * (1 - 7e-4 * 25.0)
    group = (eta * 1.0 / (e * r)) ** 0.67 * (20e-9 * e) ** 0.53 * (50.0 / (e * r**2)) ** -0.067
    expected = 2.69 * r * group * (1 - 0.61 * exp(-0.73 * 1.03)) * 1e9
    assert Forward(case, case.recordings).predict()[1] == pytest.approx(expected, rel=1e-9)


def test_film_of_an_unnamed_oil_is_fitted_with_broad_priors_and_says_so(make):
    case = make(system("film", "film_thickness_nm", contact=BALL), film_columns())
    forward = Forward(case, case.recordings)
    assert [c.name for c in forward.calibrations] == ["viscosity", "pressure_viscosity", "film_regime", "film_exponent"]
    assert "oil_fitted" in codes(forward.notes)


def test_film_of_a_known_oil_has_the_film_law_alone_to_calibrate(make):
    case = make(system("film", "film_thickness_nm", contact=BALL, lubricant=OIL), film_columns())
    assert [c.name for c in Forward(case, case.recordings).calibrations] == ["film_regime", "film_exponent"]


def test_film_needs_a_contact(make):
    with pytest.raises(InputError, match=r"\[contact\]"):
        make(system("film", "film_thickness_nm"), film_columns())


def test_a_reading_one_fringe_off_is_called_a_miscount(make):
    case = make(system("film", "film_thickness_nm", contact=BALL, lubricant=OIL), film_columns())
    for excess, sd, said in ((203.0, 1.0, "one"), (-400.0, 1.0, "two"), (250.0, 20.0, "one"), (310.0, 90.0, "two")):
        assert f"{said} interference order" in case.kind.instrument_fault(case.recordings, 2, excess, sd)
    assert "within the noise" in case.kind.instrument_fault(case.recordings, 2, 250.0, 20.0)
    assert "within the noise" not in case.kind.instrument_fault(case.recordings, 2, 203.0, 20.0)
    for excess, sd in ((60.0, 1.0), (-318.0, 1.0), (250.0, 5.0), (60.0, 90.0), (280.0, 90.0)):
        assert case.kind.instrument_fault(case.recordings, 2, excess, sd) is None
    below = {**case.recordings.columns, "film_thickness_nm": -case.recordings["film_thickness_nm"]}
    assert case.kind.instrument_fault(Table(below), 2, -400.0, 1.0) is None


def test_viscosity_is_d341_times_density_and_barus(make):
    columns = {"temperature_C": [40.0, 70.0], "pressure_MPa": [0.0, 200.0], "viscosity_mPa_s": [50.0, 400.0]}
    case = make(system("viscosity", "viscosity_mPa_s", lubricant=OIL), columns)
    expected = d341(70.0) * 0.870 * (1 - 7e-4 * 55.0) * exp(17.5e-9 * 200e6)
    assert Forward(case, case.recordings).predict()[1] == pytest.approx(expected, rel=1e-9)


def test_viscosity_without_pressure_was_measured_at_ambient(make):
    columns = {"temperature_C": [40.0, 70.0, 90.0], "viscosity_mPa_s": [57.0, 25.0, 15.0]}
    case = make(system("viscosity", "viscosity_mPa_s", lubricant=OIL), columns)
    expected = d341(40.0) * 0.870 * (1 - 7e-4 * 25.0)
    assert Forward(case, case.recordings).predict()[0] == pytest.approx(expected, rel=3e-3)


def test_an_unnamed_sample_starts_at_the_level_of_its_readings(make):
    columns = {"temperature_C": [20.0, 40.0, 60.0], "viscosity_mPa_s": [9.0, 5.0, 3.0]}
    case = make(system("viscosity", "viscosity_mPa_s"), columns)
    forward = Forward(case, case.recordings)
    assert np.allclose(np.log(forward.predict() / columns["viscosity_mPa_s"]), 0.0, atol=1.0)
    assert {"viscosity", "viscosity_slope"} <= {c.name for c in forward.calibrations}


def test_conditions_without_readings_share_the_level_of_the_recording(make, tmp_path):
    columns = {"temperature_C": [20.0, 40.0, 60.0], "viscosity_mPa_s": [9.0, 5.0, 3.0]}
    case = make(system("viscosity", "viscosity_mPa_s"), columns)
    (tmp_path / "at.csv").write_text("run,temperature_C\n1,40\n", encoding="utf-8")
    wanted = read_conditions(case, tmp_path / "at.csv")
    assert Forward(case, wanted).predict()[0] == Forward(case, case.recordings).predict()[1]


def map_columns(**more):
    speed = [-200.0, -50.0, 0.0, 50.0, 200.0]
    return {"speed_rpm": speed, "friction_torque_Nm": [-3.0, -2.0, 0.5, 2.5, 3.5], **more}


def test_friction_map_is_coulomb_viscous_and_payload(make):
    case = make(system("friction_map", "friction_torque_Nm"), map_columns())
    values = {"coulomb_torque": 2.0, "viscous_torque": 1.0, "payload_torque": 0.25}
    found = Forward(case, case.recordings).predict(values)
    assert found.tolist() == pytest.approx([-2.75, -2.0, 0.25, 2.5, 3.25], rel=1e-12)


def test_friction_map_without_gears_keeps_a_share_of_friction_and_all_of_the_payload(make):
    case = make(system("friction_map", "friction_torque_Nm"), map_columns(rig=["geared"] * 4 + ["no_gears"]))
    values = {"coulomb_torque": 2.0, "viscous_torque": 1.0, "payload_torque": 0.25, "bare_share": 0.5}
    assert Forward(case, case.recordings).predict(values)[4] == pytest.approx(1.75, rel=1e-12)


def test_friction_map_speed_scale_is_that_of_the_recording(make, tmp_path):
    case = make(system("friction_map", "friction_torque_Nm"), map_columns())
    (tmp_path / "at.csv").write_text("run,speed_rpm\n1,50\n2,100\n", encoding="utf-8")
    wanted = read_conditions(case, tmp_path / "at.csv")
    values = {"coulomb_torque": 2.0, "viscous_torque": 1.0, "payload_torque": 0.25}
    assert Forward(case, wanted).predict(values).tolist() == pytest.approx([2.5, 2.75], rel=1e-12)


def test_friction_map_takes_one_kind_of_speed(make):
    case = make(system("friction_map", "friction_torque_Nm"), map_columns(sliding_speed_m_s=[0.1] * 5))
    with pytest.raises(InputError, match="speed_rpm"):
        Forward(case, case.recordings)


def history_columns(**more):
    return {"time_s": [60.0, 120.0, 180.0], "friction_coefficient": [0.05, 0.06, 0.055], **more}


def test_friction_history_is_one_coefficient(make):
    case = make(system("friction_history", "friction_coefficient"), history_columns())
    forward = Forward(case, case.recordings)
    assert forward.predict({"boundary_friction": 0.07}).tolist() == [0.07] * 3
    assert [c.name for c in forward.calibrations] == ["boundary_friction"]


GROUND = {"m0_um2": 0.02, "m2": 0.004, "m4_per_um2": 0.003}
RESOLVED = {
    "load_N": [20.0] * 3,
    "entrainment_speed_m_s": [0.5] * 3,
    "slide_roll_ratio": [0.5] * 3,
    "oil_temperature_C": [40.0] * 3,
    "surface_1": ["ground"] * 3,
    "surface_2": ["ground"] * 3,
}
SECTIONS = {"contact": BALL, "lubricant": OIL, "surfaces": {"ground": GROUND}}


def test_friction_history_is_the_mixture_where_contact_oil_and_surfaces_are_given(make):
    history = make(system("friction_history", "friction_coefficient", **SECTIONS), history_columns(**RESOLVED))
    found = Forward(history, history.recordings).predict()
    readings = {"friction_coefficient": [0.05, 0.06, 0.055]}
    disc = make(system("disc", "friction_coefficient", **SECTIONS), {**RESOLVED, **readings})
    assert found.tolist() == Forward(disc, disc.recordings).predict().tolist()
    assert 0.0 < found[0] < 0.1


def test_friction_history_with_sections_but_without_conditions_says_what_it_does(make):
    case = make(system("friction_history", "friction_coefficient", **SECTIONS), history_columns())
    forward = Forward(case, case.recordings)
    assert "film_not_computed" in codes(forward.notes)
    assert np.ptp(forward.predict()) == 0.0


def test_point_contact_friction_takes_the_hertz_point_pressure(make):
    columns = {**RESOLVED, "friction_coefficient": [0.05, 0.06, 0.055]}
    smooth = {"m0_um2": 1e-8, "m2": 1e-9, "m4_per_um2": 1e-9}
    case = make(system("disc", "friction_coefficient", **{**SECTIONS, "surfaces": {"ground": smooth}}), columns)
    r, e = 9.525e-3, 2.0 / ((1 - 0.3**2) / 207e9 + (1 - 0.22**2) / 75e9)
    p0 = (6 * 20.0 * (e / 2) ** 2 / (np.pi**3 * r**2)) ** (1 / 3)
    eta = d341(40.0) * 1e-6 * 870.0 * (1 - 7e-4 * 25.0)
    group = (eta * 0.5 / (e * r)) ** 0.67 * (20e-9 * e) ** 0.53 * (20.0 / (e * r**2)) ** -0.067
    h = 2.69 * r * group * (1 - 0.61 * exp(-0.73 * 1.03))
    lead = log(eta) + 9.67
    thick = eta * exp(lead * ((1 + p0 / 1.96e8) ** (20e-9 * 1.96e8 / lead) - 1))
    expected = 5e6 * asinh(thick * 0.25 / (h * 5e6)) / p0
    assert Forward(case, case.recordings).predict()[0] == pytest.approx(expected, rel=1e-6)


ONE_WAY = np.geomspace(3.0, 3000.0, 12)
BOTH_WAYS = np.concatenate([-ONE_WAY[::-1], ONE_WAY])


@pytest.mark.parametrize("name", ["torque_Nm", "motor_torque_Nm"])
@pytest.mark.parametrize("size", [0.0, 2.0])
def test_a_torque_of_zeros_is_no_torque_of_the_motor(make, name, size):
    friction = np.sign(BOTH_WAYS) * (1.0 + 0.3 * np.abs(BOTH_WAYS) / 3000.0)
    columns = {"speed_rpm": BOTH_WAYS, name: np.full(BOTH_WAYS.size, size), "friction_torque_Nm": friction}
    case = make(system("friction_map", "friction_torque_Nm"), columns)
    forward = Forward(case, case.recordings)
    offered = {effect.id: effect for effect in forward.effects()}
    assert ("torque_constant" in offered) == (size > 0.0)
    for effect in offered.values():
        assert np.isfinite(forward.predict(None, {effect.id: effect.prior_medians})).all(), effect.id
