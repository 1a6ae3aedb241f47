"""Effects find what was planted by formulas written here, and lose against them when another was planted."""

import numpy as np
import pytest

from mixedlub.case.forward import Forward
from mixedlub.diagnosis.assessment.power_law import power_law
from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.diagnosis.explanation import NOTHING, Explanation
from mixedlub.effects import catalogue
from mixedlub.schema.table import Table

from .conftest import BALL, OIL, TIME, drive, least_squares, noisy, system

SPEED = np.concatenate([-np.geomspace(2.0, 200.0, 14)[::-1], np.geomspace(2.0, 200.0, 14)])


def coulomb(speed=SPEED):
    return 2.0 * np.sign(speed) + 0.8 * speed / 200.0 + 0.3


def planted_stribeck():
    """Gaussian form: the catalogue carries the exponential one."""
    return drive(coulomb() + 0.7 * np.exp(-((SPEED / 30.0) ** 2)) * np.sign(SPEED), speed_rpm=SPEED)


def planted_presliding():
    """Hyperbolic tangent: the catalogue carries Dahl's exponential."""
    speed = np.concatenate([-np.geomspace(0.02, 200.0, 24)[::-1], np.geomspace(0.02, 200.0, 24)])
    return drive((coulomb(speed) - 0.3) * np.tanh(np.abs(speed) / 0.6) + 0.3, speed_rpm=speed)


def planted_modifier():
    """Coverage that saturates exponentially: the catalogue carries Langmuir's isotherm."""
    speed, content = np.tile(SPEED, 5), np.repeat([0.0, 0.5, 1.0, 3.0, 10.0], SPEED.size)
    dry = 2.0 * (1.0 - 0.4 * (1.0 - np.exp(-content / 1.2)))
    return drive(dry * np.sign(speed) + 0.8 * speed / 200.0 + 0.3, speed_rpm=speed, additive_percent=content)


def planted_direction():
    friction = np.where(SPEED > 0, 2.6 + 1.6 * SPEED / 200.0, -1.7 + 0.9 * SPEED / 200.0)
    return drive(friction, speed_rpm=SPEED)


def planted_torque_constant():
    speed = np.tile([30.0, 60.0, 120.0, 0.0], 10)
    torque = np.repeat(np.linspace(0.5, 8.0, 5), 8) * np.tile([1.0] * 4 + [-1.0] * 4, 5)
    bare = speed == 0.0
    friction = np.where(bare, 0.0, 0.5 + 0.2 * speed / 120.0)
    wrong = torque - torque / (1.0 + 0.02 * np.abs(torque))
    rig = np.where(bare, "no_gears", "geared")
    sections, columns = drive(friction + wrong + 0.05, speed_rpm=speed, torque_Nm=torque, rig=rig)
    return sections, columns


def planted_load():
    speed, load = np.tile(SPEED, 3), np.repeat([10.0, 40.0, 90.0], SPEED.size)
    friction = (0.8 + 0.02 * load) * np.sign(speed) + 0.5 * speed / 200.0
    return drive(friction, speed_rpm=speed, load_N=load)


def planted_grease():
    """Walther's form, 100 mm2/s at 40 and 11 at 100 degC: the catalogue carries Vogel's."""
    speed, celsius = np.tile(SPEED, 3), np.repeat([10.0, 40.0, 70.0], SPEED.size)
    place = np.log((celsius + 273.15) / 313.15) / np.log(373.15 / 313.15)
    ordinate = np.log(np.log(100.7)) + place * np.log(np.log(11.7) / np.log(100.7))
    drag = 3.0 * (np.exp(np.exp(ordinate)) - 0.7) / 100.0
    return drive(2.0 * np.sign(speed) + drag * speed / 200.0, speed_rpm=speed, oil_temperature_C=celsius)


def planted_grease_thinning():
    friction = np.sign(SPEED) * (1.0 + 2.0 * (np.abs(SPEED) / 200.0) ** 0.5)
    return drive(friction, speed_rpm=SPEED)


def planted_drag():
    """A disc in air, laminar below half of the largest speed and turbulent above: the catalogue has one power."""
    share = np.abs(SPEED) / 200.0
    disc = np.where(share < 0.5, 0.5**1.8 * (share / 0.5) ** 1.5, share**1.8)
    return drive(np.sign(SPEED) * (1.0 + 3.0 * disc), speed_rpm=SPEED)


def planted_ripple(order=9.0):
    angle = np.linspace(0.0, 360.0, 80, endpoint=False)
    friction = 2.0 + 0.4 * np.sin(np.radians(order * angle) + 0.6)
    return drive(friction, speed_rpm=np.where(angle < 180.0, 50.0, 60.0), position_deg=angle)


def history(friction, **columns):
    n = np.size(friction)
    time = np.asarray(columns.pop("time_s", np.linspace(60.0, 7200.0, n)))
    return system("friction_history", "friction_coefficient"), {
        "time_s": time,
        "friction_coefficient": noisy(friction),
        **columns,
    }


def planted_tribofilm():
    """Logistic coverage: the catalogue carries first order after an induction time."""
    return history(0.06 + 0.06 / (1.0 + np.exp(-(TIME - 1700.0) / 450.0)))


def planted_run_in():
    """Hyperbolic: the catalogue carries an exponential."""
    return history(0.08 + 0.04 / (1.0 + TIME / 500.0))


def planted_event():
    """A ramp over two readings: the catalogue carries a sudden step."""
    return history(0.08 * (1.0 + 0.18 * np.clip((TIME - 3900.0) / 240.0, 0.0, 1.0)))


def planted_two_scales():
    return history(0.1 + 0.04 * (np.exp(-TIME / 900.0) - np.exp(-TIME / 300.0)) - 0.03 * TIME / 7200.0)


def planted_swings():
    return history(0.06 + 0.006 * np.sin(2 * np.pi * TIME / 2900.0) + 0.004 * np.sin(2 * np.pi * TIME / 1900.0 + 1.0))


def planted_creep():
    """Hyperbolic tangent: the catalogue carries a power of the slip that is left."""
    slip = np.tile(np.geomspace(0.0008, 0.2, 15), 4)
    return history(0.055 * np.tanh(slip / 0.008), slide_roll_ratio=slip, entrainment_speed_m_s=np.full(60, 0.025))


def film(thickness, speed, **columns):
    n = speed.size
    sections = system("film", "film_thickness_nm", contact=BALL, lubricant=OIL, uncertainty={"viscosity": 0.2})
    return sections, {
        "load_N": np.full(n, 50.0),
        "entrainment_speed_m_s": speed,
        "slide_roll_ratio": np.zeros(n),
        "oil_temperature_C": np.full(n, 40.0),
        "film_thickness_nm": noisy(thickness),
        **columns,
    }


ROLL = np.geomspace(0.003, 1.5, 28)
SMOOTH = 380.0 * ROLL**0.67


def planted_boundary_film():
    """Sum of cubes: the catalogue carries the root of squares."""
    return film(np.cbrt(SMOOTH**3 + 22.0**3), ROLL)


def planted_fringe():
    return film(SMOOTH + np.where(SMOOTH > 240.0, 200.0, 0.0), ROLL)


def planted_fringe_step():
    """Steps that differ from order to order: the catalogue carries one step."""
    order = np.digitize(SMOOTH, [60.0, 170.0, 330.0])
    shift = np.array([0.0, 22.0, 50.0, 68.0])[order]
    return film(SMOOTH + shift, ROLL, fringe_order=3.0 + order)


def planted_zero_drift():
    order = np.random.default_rng(0).permutation(28)
    speed, place = ROLL[order], np.arange(28) / 27.0
    return film(380.0 * speed**0.67 + 15.0 * place, speed, sequence=place)


def by_d341(celsius):
    """Viscosity (mPa s) of an oil of 67 mm2/s at 40 degC."""
    z = np.log10(np.log10(67.7)) - 3.1 * (np.log10(celsius + 273.15) - np.log10(313.15))
    return (10.0 ** (10.0**z) - 0.7) * 0.87


def planted_pressure_law():
    """Free-volume form of Doolittle: the catalogue carries a double exponential."""
    celsius, mpa = np.repeat([20.0, 60.0, 100.0], 12), np.tile(np.linspace(0.1, 700.0, 12), 3)
    room = 1.0 / (1.0 + 0.9 * mpa / 700.0 * 0.18) - 0.66 + 6e-4 * (celsius - 20.0)
    still = 1.0 - 0.66 + 6e-4 * (celsius - 20.0)
    grown = np.exp(4.5 * (0.66 / room - 0.66 / still))
    return system("viscosity", "viscosity_mPa_s"), {
        "temperature_C": celsius,
        "pressure_MPa": mpa,
        "viscosity_mPa_s": noisy(by_d341(celsius) * grown),
    }


def planted_other_cooling():
    """Slotte's power of a temperature through the two known points: the catalogue carries Vogel's exponential."""
    celsius = np.tile([-10.0, 0.0, 10.0, 25.0, 40.0, 55.0, 70.0, 85.0, 100.0, 120.0], 3)
    known = np.array(OIL["kinematic_viscosity_mm2_s"]) * (0.87 - 7e-4 * (np.array([40.0, 100.0]) - 15.0))
    power = np.log(known[0] / known[1]) / np.log((100.0 + 50.0) / (40.0 + 50.0))
    cooled = known[0] * ((40.0 + 50.0) / (celsius + 50.0)) ** power
    return system("viscosity", "viscosity_mPa_s"), {"temperature_C": celsius, "viscosity_mPa_s": noisy(cooled)}


def planted_sample_drift():
    """Linear growth of viscosity: the catalogue carries an exponential."""
    celsius = np.concatenate([np.linspace(25.0, 70.0, 20), np.linspace(70.0, 10.0, 25)])
    place = np.linspace(0.0, 1.0, 45)
    return system("viscosity", "viscosity_mPa_s"), {
        "temperature_C": celsius,
        "time_s": 20000.0 * place,
        "viscosity_mPa_s": noisy(by_d341(celsius) * (1.0 + 0.3 * place)),
    }


CASES = {
    "stribeck": (planted_stribeck, ("grease_shear_thinning", "direction_dependence", "fluid_drag")),
    "presliding": (planted_presliding, ("stribeck", "grease_shear_thinning", "direction_dependence")),
    "friction_modifier_film": (planted_modifier, ("stribeck", "direction_dependence", "grease_shear_thinning")),
    "direction_dependence": (planted_direction, ("stribeck", "grease_shear_thinning", "fluid_drag")),
    "torque_constant": (planted_torque_constant, ("stribeck", "load_dependent_friction", "direction_dependence")),
    "load_dependent_friction": (planted_load, ("stribeck", "direction_dependence")),
    "grease_temperature": (planted_grease, ("stribeck", "grease_shear_thinning", "direction_dependence")),
    "grease_shear_thinning": (planted_grease_thinning, ("direction_dependence", "fluid_drag")),
    "fluid_drag": (planted_drag, ("direction_dependence", "presliding")),
    "friction_event": (planted_event, ("tribofilm_growth", "friction_run_in", "sensor_drift")),
    "tribofilm_growth": (planted_tribofilm, ("friction_run_in", "sensor_drift")),
    "friction_run_in": (planted_run_in, ("sensor_drift",)),
    "two_time_scales": (planted_two_scales, ("friction_run_in", "tribofilm_growth", "sensor_drift")),
    "wandering_surface_state": (planted_swings, ("friction_run_in", "tribofilm_growth", "two_time_scales")),
    "contact_creep": (planted_creep, ("tribofilm_growth", "friction_run_in", "two_time_scales")),
    "boundary_film": (planted_boundary_film, ("inlet_shear_heating", "fringe_order")),
    "fringe_order": (planted_fringe, ("inlet_shear_heating", "boundary_film")),
    "fringe_step": (planted_fringe_step, ("fringe_order", "inlet_shear_heating", "boundary_film")),
    "zero_drift": (planted_zero_drift, ("inlet_shear_heating", "boundary_film")),
    "pressure_viscosity_law": (planted_pressure_law, ()),
    "viscosity_temperature_law": (planted_other_cooling, ("sensor_gain", "sensor_offset")),
    "viscosity_drift": (planted_sample_drift, ()),
}


@pytest.mark.parametrize("name", CASES)
def test_planted_effect_leaves_no_more_than_form_and_noise_and_beats_its_rivals(make, name):
    plant, rivals = CASES[name]
    case = make(*plant())
    y = case.recordings[case.quantity]
    sd = np.hypot(0.01 * np.abs(y), 0.01 * np.median(np.abs(y)))
    base, _, _ = least_squares(case, (), sd)
    found, _, prediction = least_squares(case, (name,), sd)
    left = float(np.sum(((y - prediction) / sd) ** 2))
    assert left < 4.0 * y.size
    assert base > 3.0 * found
    for rival in rivals:
        other, _, _ = least_squares(case, (rival,), sd)
        assert other > found + 9.0, rival


def planted_roelands():
    """Roelands' own writing: centipoise, kgf/cm2, decimal logarithms, one exponent at all temperatures."""
    celsius, mpa = np.repeat([20.0, 60.0, 100.0], 12), np.tile(np.linspace(0.1, 700.0, 12), 3)
    pressed = (np.log10(by_d341(celsius)) + 1.2) * (1.0 + mpa / 0.0980665 / 2000.0) ** 0.6 - 1.2
    return system("viscosity", "viscosity_mPa_s"), {
        "temperature_C": celsius,
        "pressure_MPa": mpa,
        "viscosity_mPa_s": noisy(10.0**pressed),
    }


@pytest.mark.parametrize(("plant", "holds"), [(planted_roelands, True), (planted_pressure_law, False)])
def test_the_answer_says_whether_roelands_law_would_do(make, plant, holds):
    found = diagnose_case(make(*plant()).folder)
    assert found.posterior.verdict == Explanation.of("pressure_viscosity_law")
    (roelands,) = found.contained
    assert roelands.law == "Roelands"
    assert (roelands.log_odds > -2.3) == holds
    assert ("fits as well with fewer parameters" in roelands.text) == holds
    assert ("rejected" in roelands.text) != holds


@pytest.mark.parametrize("order", [3.0, *(pytest.param(one, marks=pytest.mark.long) for one in (9.0, 17.0)), 31.0])
def test_ripple_is_found_whatever_its_order(make, order):
    found = diagnose_case(make(*planted_ripple(order)).folder)
    assert found.posterior.verdict == Explanation.of("periodic_mesh")
    problem, z = found.search.problem, found.search.fits[Explanation.of("periodic_mesh")].z
    values = problem.parameters(Explanation.of("periodic_mesh"), z)["periodic_mesh"]
    assert values["order"] == pytest.approx(order, rel=0.01)
    torque = problem.calibration(z)["coulomb_torque"]
    assert np.hypot(values["cosine"], values["sine"]) * torque == pytest.approx(0.4, rel=0.05)


def test_films_wanted_without_an_order_are_predicted_as_the_lowest_order_reads(make):
    case = make(*planted_fringe_step())
    forward = Forward(case, case.recordings)
    bare = Table({k: v for k, v in case.recordings.columns.items() if k != "fringe_order"})
    step = {"fringe_step": {"step": 2e-8}}
    assert np.allclose(Forward(case, bare).predict(None, step), forward.predict())
    top = forward.predict(None, step) - forward.predict()
    assert top[0] == pytest.approx(0.0)
    assert top[-1] == pytest.approx(60.0)


def test_a_payload_as_large_as_friction_is_no_physics(make):
    """Turning down a vertical axis hardly reads a torque."""
    speed = np.concatenate([np.tile(SPEED[:14], 3), np.tile(SPEED[14:], 2)])
    sections = system("friction_map", "friction_torque_Nm")
    sections["recording"]["noise"] = {"relative": 0.01, "absolute": 0.004}
    clean = 1.467 * np.sign(speed) + 0.16 * speed / 200.0 + 1.543
    scatter = np.random.default_rng(3).standard_normal(speed.size) * np.hypot(0.01 * clean, 0.004)
    found = diagnose_case(make(sections, {"friction_torque_Nm": clean + scatter, "speed_rpm": speed}).folder)
    assert found.posterior.verdict == NOTHING


def test_planted_size_of_stribeck_friction_is_found(make):
    friction = coulomb() + 0.7 * np.exp(-np.abs(SPEED) / 30.0) * np.sign(SPEED)
    case = make(*drive(friction, speed_rpm=SPEED))
    y = case.recordings[case.quantity]
    _, values, _ = least_squares(case, ("stribeck",), 0.01 * np.abs(y))
    assert values["stribeck"]["excess"] == pytest.approx(0.35, rel=0.2)


def test_a_power_law_turns_its_sign_with_the_direction(make):
    speed = np.concatenate([np.linspace(-200.0, -10.0, 20), np.linspace(10.0, 200.0, 20)])
    friction = np.sign(speed) * (1.0 + 2.0 * (speed / 200.0) ** 2)
    law = power_law(diagnose_case(make(*drive(friction, speed_rpm=speed)).folder, exclude=tuple(catalogue())).search)
    assert law is not None
    assert dict(law.factors) == {"speed_rpm": 2}
    assert law.coefficient == pytest.approx(2.0 * (law.middles[0] / 200.0) ** 2, rel=0.1)
    assert law.text.endswith("in the direction of motion")


def test_a_power_law_of_what_keeps_its_sign_is_found_in_both_directions(make):
    """A payload that grows with the load, as of a vertical axis."""
    speed, load = np.tile(SPEED, 4), np.repeat([1.0, 2.0, 4.0, 8.0], SPEED.size)
    payload = np.sign(speed) + 0.3 * speed / 200.0 + 0.3 * load
    found = diagnose_case(make(*drive(payload, speed_rpm=speed, load_N=load)).folder, exclude=tuple(catalogue()))
    law = power_law(found.search)
    assert law is not None
    assert dict(law.factors) == {"load_N": 1}
    assert not law.odd


def test_planted_growth_of_friction_is_found(make):
    case = make(*planted_tribofilm())
    y = case.recordings[case.quantity]
    _, values, _ = least_squares(case, ("tribofilm_growth",), 0.01 * np.abs(y))
    assert values["tribofilm_growth"]["change"] == pytest.approx(1.0, rel=0.25)


def test_a_motor_torque_that_contains_the_friction_is_no_condition(make) -> None:
    """Friction is motor torque less shaft torque: as a condition of a smooth form it would explain itself."""
    torque = np.tile(np.linspace(0.5, 8.0, 12), 4)
    speed = np.repeat([30.0, 60.0, 90.0, 120.0], 12)
    sections, columns = drive(0.5 + 0.2 * speed / 120.0 + torque - torque / (1.0 + 0.02 * torque), speed_rpm=speed)
    columns |= {"torque_Nm": torque, "motor_torque_Nm": torque + columns["friction_torque_Nm"]}
    d = diagnose_case(make(sections, columns).folder)
    assert "motor_torque_Nm" not in [axis.name for axis in d.search.space.axes]
    assert "torque_constant" in d.posterior.verdict.effects


@pytest.mark.parametrize(
    ("effect_id", "drifts"), [("force_offset", False), pytest.param("force_drift", True, marks=pytest.mark.long)]
)
def test_zero_error_of_the_force_weighs_as_one_over_the_load(make, effect_id: str, drifts: bool) -> None:
    """0.1 of a load of 5 to 60 N, and a force that reads 0.05 N too much, or comes to."""
    load = np.tile([5.0, 10.0, 20.0, 60.0], 15)
    force = 0.05 * (TIME / 7200.0 if drifts else 1.0)
    columns = {"time_s": TIME, "load_N": load, "friction_coefficient": noisy(0.1 + force / load, 0.003)}
    found = diagnose_case(make(system("friction_history", "friction_coefficient"), columns).folder)
    assert found.posterior.verdict == Explanation.of(effect_id)


def test_a_force_at_one_load_has_no_zero_error_of_its_own(make) -> None:
    steady = {"time_s": TIME, "load_N": np.full(60, 20.0), "friction_coefficient": noisy(np.full(60, 0.1))}
    case = make(system("friction_history", "friction_coefficient"), steady)
    assert not {"force_offset", "force_drift"} & {e.id for e in Forward(case, case.recordings).effects()}


def test_grease_that_cools_after_walther_needs_no_other_effect(make):
    assert diagnose_case(make(*planted_grease()).folder).posterior.verdict == Explanation.of("grease_temperature")


def test_an_unnamed_oil_that_cools_after_vogel_is_no_offset_of_the_viscometer(make):
    """Divergence at -120 degC, as fits of engine oils have it; through 67 and 9.5 mm2/s at 40 and 100 degC."""
    celsius = np.repeat(np.linspace(0.0, 100.0, 11), 2)
    steep = np.log(67.0 / 9.5) / (1.0 / 160.0 - 1.0 / 220.0)
    viscosity = 57.0 * np.exp(steep / (celsius + 120.0) - steep / 160.0)
    columns = {"temperature_C": celsius, "viscosity_mPa_s": noisy(viscosity, 0.007)}
    sections = system("viscosity", "viscosity_mPa_s")
    sections["recording"]["noise"] = {"relative": 0.007}
    found = diagnose_case(make(sections, columns).folder)
    assert list(found.posterior.verdict.ids) == ["none"]
    offset = {**columns, "viscosity_mPa_s": columns["viscosity_mPa_s"] + 3.0}
    found = diagnose_case(make(sections, offset).folder)
    assert list(found.posterior.verdict.ids) == ["sensor_offset"]
