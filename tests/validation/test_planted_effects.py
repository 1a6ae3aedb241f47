"""Every planted effect: absent at zero strength, finite, of the sign and shape that physics gives it."""

from dataclasses import replace

import numpy as np
import pytest

from mixedlub.validation.contact import calibrated, lubricate, press, shear, start, summits, thick, touch
from mixedlub.validation.planted import FORMS, MEASUREMENT, NAMED, OUTSIDE
from mixedlub.validation.planted.contact import (
    HARDNESS,
    HEIGHTS,
    _overlap_table,
    _two_process_table,
    _weibull_table,
    asperity_elastoplasticity,
    yielding_spheres,
)
from mixedlub.validation.planted.film import OF_LOCAL_CONTACTS
from mixedlub.validation.planted.load import dynamic_load_of_quality, dynamic_load_of_two_orders
from mixedlub.validation.planted.loss import (
    churning_past_transition,
    rolling_in_warm_inlets,
    rolling_resistance,
    rolling_under_load,
)
from mixedlub.validation.planted.shear import film_heating, flash, limiting_stress_in_hot_oil
from mixedlub.validation.rigs import discs, gears

from .helpers import readings, run

EVERY = {form.law.__name__: form for forms in FORMS.values() for form in forms} | OUTSIDE
ABSENT = {"gear_pair": gears.NOT_HERE, "disc": discs.NOT_HERE}
ON = [(name, kind) for name, effect in EVERY.items() for kind in ABSENT if effect.id not in ABSENT[kind]]
RAISES = {
    *("asperity_plasticity", "surface_defects", "misalignment", "rolling_resistance", "windage", "churning"),
    *("bearing_drag", "seal_drag", "elastic_hysteresis"),
}
LOWERS = {
    *("boundary_film_temperature", "micro_ehl", "film_heating", "limiting_shear_stress", "coating_insulation"),
    *("contact_creep", "heat_leak"),
}
SIGNS = dict.fromkeys(RAISES, 1) | dict.fromkeys(LOWERS, -1)
"""What an effect does to the recorded quantity, where physics says so."""
LEAVES_IN_HEAT = ("boundary_film_desorbed", "boundary_film_defect")
"""Forms by which a boundary film is lost as the surfaces warm, and friction rises."""
GEAR_IDS = {
    *("inlet_shear_heating", "starvation", "inlet_shear_thinning", "roughness_lay", "film_heating"),
    *("limiting_shear_stress", "coating_insulation", "skewed_heights", "asperity_plasticity", "micro_ehl"),
    *("running_in", "surface_defects", "boundary_film_temperature", "boundary_speed_dependence"),
    *("tribofilm_growth", "dynamic_load", "misalignment", "tip_relief", "rolling_resistance", "windage"),
    *("churning", "bearing_drag", "seal_drag", "elastic_hysteresis", "pressure_viscosity_law"),
    *("bulk_temperature", "viscosity_drift", "heat_leak", "sensor_offset", "sensor_gain", "sensor_drift"),
    *("torque_offset", "torque_gain"),
}


def _change(rigs, name, kind, **knobs):
    rig, nominal = rigs[kind]
    effect = EVERY[name]
    values = {knob.name: 0.5 * sum(knob.typical) for knob in effect.knobs} | knobs
    return readings(rig, nominal, [effect.hide(values)]) - readings(rig, nominal)


def test_every_gear_and_disc_id_has_a_law():
    assert set(NAMED) == GEAR_IDS | {"contact_creep"}


def test_at_least_six_effects_lie_outside_any_catalogue():
    assert len(OUTSIDE) >= 6
    assert not set(OUTSIDE) & set(NAMED)


def test_forms_of_one_effect_act_at_one_stage_and_are_drawn_as_often():
    for forms in FORMS.values():
        assert len({(form.hook, form.rarity) for form in forms}) == 1


def test_yielding_summits_have_the_area_of_the_law_whatever_the_quadrature(rigs):
    """Against a sum over a hundred times as many heights."""
    rig, nominal = rigs["disc"]
    contact = touch(lubricate(press(start(rig, nominal))))
    s = summits(contact)
    t = (contact.film - s.offset) / s.spread
    first = (0.6 * np.pi * HARDNESS / 2.0 / rig.solid.reduced) ** 2 * s.radius / s.spread
    height = np.linspace(-8.0, 8.0, 200_001)
    density = np.exp(-0.5 * height**2) / np.sqrt(2 * np.pi)
    place = int(np.argmin(contact.film[:, 0]))
    pressed = height - t[place]
    x = np.clip((pressed / first[place] - 1) / 53, 0.0, 1.0)
    more = np.trapezoid(pressed * (3 * x**2 - 2 * x**3) * density, height)
    expected = contact.area[place] + np.pi * s.density[place] * s.radius[place] * s.spread[place] * more
    assert asperity_elastoplasticity(contact, 2.0).area[place] == pytest.approx(expected, rel=2e-4)


@pytest.mark.parametrize(("name", "kind"), ON)
def test_zero_strength_is_the_base_model(rigs, name, kind):
    rig, nominal = rigs[kind]
    change = _change(rigs, name, kind, strength=0.0)
    np.testing.assert_allclose(change / readings(rig, nominal), 0.0, atol=1e-9)


@pytest.mark.parametrize(("name", "kind"), ON)
def test_usual_strength_changes_some_reading_and_stays_finite(rigs, name, kind):
    rig, nominal = rigs[kind]
    change = _change(rigs, name, kind) / readings(rig, nominal)
    assert np.all(np.isfinite(change))
    assert np.max(np.abs(change)) > 1e-3


@pytest.mark.parametrize(("name", "kind"), [pair for pair in ON if EVERY[pair[0]].id in SIGNS])
def test_sign_where_physics_gives_one(rigs, name, kind):
    rig, nominal = rigs[kind]
    change = _change(rigs, name, kind) * (1 if name in LEAVES_IN_HEAT else SIGNS[EVERY[name].id])
    assert np.min(change / readings(rig, nominal)) > -1e-6
    assert np.sum(change) > 0


@pytest.mark.parametrize(
    "name",
    [form.law.__name__ for form in OF_LOCAL_CONTACTS],
)
@pytest.mark.parametrize("kind", ["gear_pair", "disc"])
def test_thinner_films_raise_the_loss_of_mixed_contacts(rigs, name, kind):
    assert np.sum(_change(rigs, name, kind)) > 0


def test_transverse_lay_lowers_and_longitudinal_lay_raises_the_loss(rigs):
    assert np.all(_change(rigs, "roughness_lay", "gear_pair", strength=1.0) < 0)
    assert np.all(_change(rigs, "roughness_lay", "gear_pair", strength=-0.7) > 0)


def _power(rigs, name, column):
    """Least-squares exponent of an extra loss in one condition, the others taken as they come."""
    rig, _ = rigs["gear_pair"]
    extra = np.log(np.abs(_change(rigs, name, "gear_pair")))
    names = ("torque_Nm", "speed_rpm", "oil_temperature_C")
    table = [np.log(rig.conditions[n].astype(float)) for n in names]
    slopes = np.linalg.lstsq(np.column_stack([*table, np.ones(len(extra))]), extra, rcond=None)[0]
    return slopes[names.index(column)]


@pytest.mark.parametrize(
    ("name", "torque", "speed"),
    [
        ("windage", (0.0, 0.0), (2.7, 3.0)),
        ("windage_in_mist", (0.0, 0.0), (2.8, 2.8)),
        ("churning", (0.0, 0.0), (1.3, 2.1)),
        ("churning_of_rim_and_faces", (0.0, 0.0), (2.0, 2.86)),
        ("churning_past_transition", (0.0, 0.0), (2.5, 2.8)),
        ("churning_of_splash", (0.0, 0.0), (1.59, 1.59)),
        ("churning_past_splash", (0.0, 0.0), (1.1, 1.8)),
        ("churning_of_standard", (0.0, 0.0), (3.0, 3.0)),
        ("windage_of_teeth", (0.0, 0.0), (2.75, 2.75)),
        ("rolling_resistance", (-0.05, 0.1), (1.5, 1.8)),
        ("rolling_free_of_load", (-0.05, 0.05), (1.7, 1.8)),
        ("rolling_under_load", (0.2, 0.3), (1.6, 1.7)),
        ("rolling_as_bearings_are_tested", (0.25, 0.35), (0.9, 1.66)),
        ("rolling_in_warm_inlets", (-0.3, 0.05), (0.9, 1.66)),
        ("elastic_hysteresis", (1.4, 1.6), (0.95, 1.05)),
        ("elastic_damping", (1.65, 2.0), (0.95, 1.05)),
        ("bearing_drag", (0.3, 1.3), (0.8, 1.7)),
        ("bearing_drag_of_rollers", (0.2, 0.8), (0.8, 1.7)),
        ("bearing_drag_of_palmgren", (0.1, 0.8), (1.1, 1.7)),
        ("seal_drag_of_standard", (0.0, 0.0), (1.0, 1.0)),
        ("torque_offset", (0.0, 0.0), (1.0, 1.0)),
        ("torque_gain", (1.0, 1.0), (1.0, 1.0)),
        ("seal_drag", (0.0, 0.0), (1.0, 1.0)),
    ],
)
def test_exponents_of_extra_losses(rigs, name, torque, speed):
    assert torque[0] - 1e-6 <= _power(rigs, name, "torque_Nm") <= torque[1] + 1e-6
    assert speed[0] - 1e-6 <= _power(rigs, name, "speed_rpm") <= speed[1] + 1e-6


def test_starvation_sets_in_at_speed_and_leaves_slow_readings_alone(rigs):
    rig, nominal = rigs["gear_pair"]
    change = _change(rigs, "starvation", "gear_pair") / readings(rig, nominal)
    speed = rig.conditions["speed_rpm"]
    assert change[speed == speed.max()].mean() > 10 * change[speed == speed.min()].mean()


def test_heated_film_is_in_balance_with_its_own_heat(rigs):
    rig, nominal = rigs["disc"]
    cold = shear(touch(lubricate(press(start(rig, nominal)))))
    hot = film_heating(cold, 1.0)
    friction = hot.fluid_friction * (1 - hot.area) + hot.boundary_friction * hot.area
    rise = flash(hot, friction) + hot.stress * hot.sliding * hot.film / (12 * rig.oil.conductivity)
    eyring = hot.eyring_stress
    expected = eyring * np.arcsinh(thick(hot, rise) * hot.sliding / (hot.film * eyring))
    np.testing.assert_allclose(hot.stress, expected, rtol=1e-9)


def _warmer(rig, nominal, form):
    """The contact of teeth warmer than their oil, and by how much at each reading."""
    contact = run(rig, nominal, [form.hide({"strength": 1.0})])
    return contact, contact.temperature[:, 0] - rig.temperature


@pytest.mark.parametrize("form", FORMS["bulk_temperature"], ids=lambda form: form.law.__name__)
def test_teeth_are_as_warm_as_their_own_loss_makes_them(rigs, gear_case, form):
    rig, nominal = rigs["gear_pair"]
    contact, rise = _warmer(rig, nominal, form)
    table, speed = gear_case.settings["gears"], rig.conditions["speed_rpm"] * np.pi / 30
    loss = contact.recorded
    if form.source == "ISO/TR 15144-1":
        pair = gears.gears_of(gear_case.settings)
        spread = np.cos(pair.pressure_angle) / np.cos(gears.operating_angle(pair))
        centre = 0.5 * table["normal_module_mm"] * sum(pair.teeth) * spread
        expected = 7400 * (loss / 1000 / (centre * table["face_width_mm"])) ** 0.72 / 1.2
    else:
        size = 1e-3 * table["normal_module_mm"] * np.array(table["teeth"])
        area = np.pi * sum(size) * 1e-3 * table["face_width_mm"] + np.pi / 2 * sum(size**2)
        expected = loss / (700 * area * np.sqrt(speed * size[0] / 2 / 10))
    np.testing.assert_allclose(rise, expected, atol=0.02)


@pytest.mark.parametrize("form", FORMS["bulk_temperature"], ids=lambda form: form.law.__name__)
def test_usual_teeth_are_some_kelvin_warmer_and_their_oil_with_them(form):
    for seed in range(6):
        case = gears.draw_case(np.random.default_rng(seed), coated=False)
        rig, nominal = gears.inputs_of(case, 24), calibrated(case.settings, np.zeros(5))
        contact, rise = _warmer(rig, nominal, form)
        assert rise.min() > 0
        assert 4 < rise.max() < 25
        hot = start(replace(rig, temperature=rig.temperature + rise), nominal)
        np.testing.assert_allclose(contact.viscosity, hot.viscosity)
        np.testing.assert_allclose(contact.pressure_viscosity, hot.pressure_viscosity)


@pytest.mark.parametrize("name", ["churning", "windage_in_mist", "bearing_drag", "seal_drag", "heat_leak"])
def test_warm_teeth_leave_the_bath_and_the_housing_as_warm_as_recorded(rigs, name):
    rig, nominal = rigs["gear_pair"]
    teeth = NAMED["bulk_temperature"].hide({"strength": 1.0})
    values = {knob.name: 0.5 * sum(knob.typical) for knob in EVERY[name].knobs}
    mesh = readings(rig, nominal, [teeth])
    found = readings(rig, nominal, [teeth, EVERY[name].hide(values)]) - mesh
    told = replace(start(rig, nominal), recorded=mesh)
    np.testing.assert_allclose(found, EVERY[name].law(told, **values).recorded - mesh)


@pytest.mark.literature("ISO/TR 13989-1")
def test_literature_flash_rise_against_the_standard(rigs):
    """ISO/TR 13989-1 writes the maximum with 0.62 w^0.75 (E/R)^0.25; the mean is 0.542/0.786 of it."""
    rig, nominal = rigs["disc"]
    contact = press(start(rig, nominal))
    solid = rig.solid
    effusivity = np.sqrt(solid.conductivity * solid.density * solid.specific_heat)
    standard = 0.62 * 0.05 * contact.line_load**0.75 * (solid.reduced / rig.radius) ** 0.25
    standard = standard * contact.sliding / (effusivity * (np.sqrt(rig.speed_1) + np.sqrt(rig.speed_2)))
    np.testing.assert_allclose(flash(contact, 0.05), 0.542 / 0.786 * standard, rtol=0.01)


@pytest.mark.parametrize("name", ["limiting_shear_stress", "limiting_stress_cut"])
def test_limiting_stress_is_never_passed(rigs, name):
    rig, nominal = rigs["disc"]
    contact = run(rig, nominal, [EVERY[name].hide({"strength": 2.0})])
    assert np.all(contact.stress <= 0.0225 * 0.25 * np.pi * contact.pressure)


def test_limit_falls_as_oil_warms_and_holds_at_40_degrees(rigs):
    rig, nominal = rigs["disc"]
    stiff = replace(shear(touch(lubricate(press(start(rig, nominal))))), stress=np.full_like(rig.radius, 1e12))
    per_pressure = limiting_stress_in_hot_oil(stiff, 1.0, 0.005).stress / (0.25 * np.pi * stiff.pressure)
    expected = 0.045 * (1 - 0.005 * (stiff.temperature - 40.0))
    np.testing.assert_allclose(per_pressure, np.broadcast_to(expected, per_pressure.shape))


def test_churning_turns_weakly_viscous_past_the_transition(gear_case):
    """Fully laminar layers go with nu^0.5 at fixed speed, turbulent ones with nu^0.2; both meet at the transition."""
    rig, nominal = gears.inputs_of(gear_case, 6), calibrated(gear_case.settings, np.zeros(5))
    speed = rig.conditions["speed_rpm"].astype(float) / 1500
    contact = start(rig, nominal)
    nu = 1e6 * (contact.viscosity / rig.oil.density_at(contact.temperature))[:, 0] / 15
    heavy = rig.oil.density_at(contact.temperature)[:, 0] / rig.oil.density_15
    still = replace(contact, recorded=np.zeros(len(speed)))
    thick_layer = churning_past_transition(still, 1.0, 1e9).recorded / (12 * heavy)
    thin_layer = churning_past_transition(still, 1.0, 1e-9).recorded / (12 * heavy)
    np.testing.assert_allclose(thick_layer, speed**2.5 * nu**0.5)
    np.testing.assert_allclose(thin_layer / thin_layer[0], (speed / speed[0]) ** 2.8 * (nu / nu[0]) ** 0.2)
    just = speed[0] / nu[0]
    below, above = (churning_past_transition(still, 1.0, just * f).recorded[0] for f in (1 + 1e-9, 1 - 1e-9))
    assert below == pytest.approx(above)


@pytest.fixture(scope="module")
def equal_sharing(gear_case):
    """The gear rig with equal sharing between the pairs in contact, on a fine path."""
    return gears.inputs_of(replace(gear_case, share=None), 480), calibrated(gear_case.settings, np.zeros(5))


@pytest.mark.parametrize(("second", "speed"), [(0.0, 1.0), (0.5, 0.5), (0.5, 1.0)])
def test_mesh_orders_resonate_where_their_frequency_is_that_of_the_gears(equal_sharing, second, speed):
    """At r = 1 with 7 % damping the answer is 1/0.14 as large as the error, and the mean force stays."""
    rig, _ = equal_sharing
    held = replace(rig, conditions={**rig.conditions, "speed_rpm": np.full(len(rig.sequence), 2000.0 * speed)})
    contact = start(held, equal_sharing[1])
    factor = dynamic_load_of_two_orders(contact, 0.1, 2000.0, second).force / contact.force - 1
    turn = np.exp(-2j * np.pi * rig.phase)
    orders = [2 * np.abs(np.mean((factor * turn**n)[:, np.ravel(rig.phase) < 1.0], axis=1)) for n in (1, 2)]
    gain = {1.0: (1 / 0.14, 4 / np.hypot(3, 0.28)), 0.5: (0.25 / np.hypot(0.75, 0.07), 1 / 0.14)}[speed]
    for found, size, per_error in zip(orders, (1.0, second), gain):
        np.testing.assert_allclose(found, 0.015 * size * per_error, atol=2e-3)


def test_tip_relief_keeps_the_sum_of_both_pairs(equal_sharing):
    rig, nominal = equal_sharing
    contact = run(rig, nominal, [NAMED["tip_relief"].hide({"strength": 0.8})])
    np.testing.assert_allclose(contact.force.sum(axis=1), rig.share_force.sum(axis=1), rtol=2e-3)


def test_tip_relief_of_equal_sharing_lowers_the_loss(equal_sharing):
    rig, nominal = equal_sharing
    change = readings(rig, nominal, [NAMED["tip_relief"].hide({"strength": 0.5})]) - readings(rig, nominal)
    assert np.all(change < 0)


def _density(table):
    """Heights and the density behind an overlap, by differencing it twice."""
    step = HEIGHTS[1] - HEIGHTS[0]
    return HEIGHTS[1:-1], np.diff(table, 2) / step


@pytest.mark.parametrize("table", [_overlap_table, _weibull_table])
def test_skewed_heights_have_the_skewness_asked_for(table):
    height, density = _density(table(-0.7))
    assert np.sum(density) == pytest.approx(1.0, abs=1e-4)
    assert np.sum(height * density) == pytest.approx(0.0, abs=1e-4)
    assert np.sum(height**2 * density) == pytest.approx(1.0, abs=1e-3)
    assert np.sum(height**3 * density) == pytest.approx(-0.7, abs=2e-3)


def test_a_plateau_on_a_rough_cut_keeps_mean_and_spread_and_leans_down():
    height, density = _density(_two_process_table(0.7))
    assert np.sum(density) == pytest.approx(1.0, abs=2e-3)
    assert np.sum(height * density) == pytest.approx(0.0, abs=5e-3)
    assert np.sum(height**2 * density) == pytest.approx(1.0, abs=0.03)
    assert np.sum(height**3 * density) < -0.6


@pytest.mark.literature("Kogut and Etsion, J. Appl. Mech. 69 (2002) 657")
def test_literature_yielding_spheres_spread_to_twice_the_elastic_area(rigs):
    """Past 110 times the approach at first yield the area is 2 pi R w; a soft surface has most summits there."""
    rig, nominal = rigs["disc"]
    contact = touch(lubricate(press(start(rig, nominal))))
    thin = replace(contact, area=0.0 * contact.area)
    added = yielding_spheres(thin, 400.0).area / contact.area
    rough = contact.area > 0.02
    np.testing.assert_allclose(added[rough], 1.0, atol=0.03)


@pytest.mark.literature("R. S. Zhou, M. R. Hoeprich, J. Tribol. 113 (1991) 590, table 1")
@pytest.mark.parametrize(("load", "speed", "moment"), [(2.0, 10.0, 0.3172), (2.0, 100.0, 1.1290), (3.0, 35.0, 0.6933)])
def test_literature_rolling_force_of_the_fit_against_its_own_solutions(rigs, load, speed, moment):
    """Twice the force times R over the load of a solution, in units that cancel; the fit is good to some 15 %."""
    material = 3745.0
    fit = 29.2 / material * (material * speed * 1e-11) ** 0.648 * (load * 1e-4) ** 0.246
    reference = 29.2 / material * (material * 3.5e-10) ** 0.648 * 2e-4**0.246
    assert fit / reference == pytest.approx(moment / 0.6600, rel=0.16)
    rig, nominal = rigs["disc"]
    c = start(rig, nominal)
    group = c.pressure_viscosity * c.viscosity * c.entrainment / rig.radius
    force = 29.2 * group**0.648 * (c.line_load / (rig.solid.reduced * rig.radius)) ** 0.246 * rig.radius
    told = rolling_under_load(replace(c, recorded=np.zeros(len(rig.sequence))), 1.0).recorded
    np.testing.assert_allclose(told, (force / c.pressure_viscosity / c.line_load)[:, 0])


@pytest.mark.literature("S. Aihara, J. Tribol. 109 (1987) 471, equations 19 to 21")
def test_literature_heat_of_the_inlet_takes_the_same_share_of_rolling_in_both_of_its_forms(rigs):
    """Within a tenth, as the source shortens the one into the other for thermal loads up to some tens."""
    rig, nominal = rigs["disc"]
    c = replace(start(rig, nominal), recorded=np.zeros(len(rig.sequence)))
    loading = rig.oil.thinning_at(c.temperature) * c.viscosity * c.entrainment**2 / rig.oil.conductivity
    left = rolling_in_warm_inlets(c, 1.0).recorded / rolling_resistance(c, 1.0).recorded
    np.testing.assert_allclose(left, (1 / (1 + 0.29 * loading**0.78))[:, 0], rtol=0.15)


@pytest.mark.literature("AGMA 2001-D04, dynamic factor")
def test_literature_dynamic_factor_of_a_quality_number(rigs):
    """Q = 7: B = 0.731, A = 65.06; at 10 m/s K_v = ((65.06 + 44.72)/65.06)^0.731 = 1.466."""
    rig, nominal = rigs["gear_pair"]
    speed = np.full(len(rig.sequence), 10.0 * 60 / (np.pi * rig.extras["pitch_diameter"]))
    held = start(replace(rig, conditions={**rig.conditions, "speed_rpm": speed}), nominal)
    np.testing.assert_allclose(dynamic_load_of_quality(held, 1.0, 7.0).force / held.force, 1.466, rtol=1e-3)


@pytest.mark.parametrize("name", [name for name, form in EVERY.items() if form.id in MEASUREMENT])
def test_faults_act_on_the_record_alone(rigs, name):
    rig, nominal = rigs["gear_pair"]
    effect = EVERY[name]
    values = {knob.name: knob.typical[1] for knob in effect.knobs}
    faulty, sound = run(rig, nominal, [effect.hide(values)]), run(rig, nominal)
    np.testing.assert_array_equal(faulty.friction, sound.friction)
    assert not np.allclose(faulty.recorded, sound.recorded)
