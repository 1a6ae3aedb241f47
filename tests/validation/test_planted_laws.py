"""Planted laws against what their sources say, and where and how they are dealt."""

from collections import Counter

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from mixedlub.validation.battery import plan
from mixedlub.validation.planted import MEASUREMENT
from mixedlub.validation.planted import viscosity_temperature as cooling
from mixedlub.validation.planted.drives import (
    SHOWN_BELOW,
    TRANSITION,
    ball_bearing,
    bristles,
    free_disc,
    hysteretic,
    partial_slip,
    rotor_in_gap,
    torque_share,
)
from mixedlub.validation.planted.histories import hump
from mixedlub.validation.planted.measurement import crept, diffused
from mixedlub.validation.rigs import KINDS, OTHERS, drives, films, histories, tooth_contacts, viscosities
from mixedlub.validation.sample_rig import progress

from .helpers import change, drawn, forms_of

pytestmark = pytest.mark.long

KELVIN = 273.15
WHERE = {
    "presliding": {"friction_map"},
    "fluid_drag": {"friction_map"},
    "force_offset": {"friction_map", "friction_history"},
    "force_drift": {"friction_map", "friction_history"},
    "viscosity_temperature_law": {"viscosity", "film", "friction_history", "mesh_friction"},
}


WATER = (20.0, 80.0), (1.0016, 0.3540)


@pytest.mark.literature("IAPWS (2008), viscosity of water; Viswanath and Natarajan; Thorpe and Rodger")
def test_vogel_and_slotte_between_two_viscosities_of_water_give_the_others():
    """IAPWS 2008 at 25 and 50 C: 0.890 and 0.5465 mPa s; constants of Viswanath and Natarajan, Thorpe and Rodger."""
    celsius, measured = np.array([25.0, 50.0]), [0.8900, 0.5465]
    assert cooling.vogel(celsius, *WATER, divergence=137.546) == pytest.approx(measured, rel=5e-3)
    assert cooling.slotte(celsius, *WATER, above=43.252) == pytest.approx(measured, rel=5e-3)
    steps = np.log(cooling.slotte(np.array([20.0, 21.0]), *WATER, above=43.252))
    assert -np.diff(steps)[0] / np.log(64.252 / 63.252) == pytest.approx(1.5423, rel=0.015)


def test_andrade_between_two_viscosities_of_mercury_gives_the_others():
    """A liquid metal, which he wrote the law for: 1.402 and 1.312 mPa s at 50 and 75 C."""
    found = cooling.andrade(np.array([50.0, 75.0]), (25.0, 100.0), (1.526, 1.245))
    assert found == pytest.approx([1.402, 1.312], rel=0.01)


@pytest.mark.literature("Williams, Landel and Ferry (1955), J. Am. Chem. Soc. 77, 3701, doi:10.1021/ja01619a008")
def test_vogel_is_the_law_of_williams_landel_and_ferry():
    """Their constants for all glasses: log10 of the shift is -17.44 (T - Tg)/(51.6 + T - Tg)."""
    glass, celsius = -70.0, np.linspace(-20.0, 150.0, 12)
    shifted = 1e12 * 10 ** (-17.44 * (celsius - glass) / (51.6 + celsius - glass))
    known = (celsius[3], celsius[9]), (shifted[3], shifted[9])
    divergence = glass - 51.6 + KELVIN
    assert cooling.vogel(celsius, *known, divergence) == pytest.approx(shifted, rel=1e-9)


def test_reynolds_halves_at_even_steps_of_temperature():
    celsius = np.array([20.0, 40.0, 60.0, 80.0])
    assert cooling.reynolds(celsius, (20.0, 40.0), (8.0, 4.0)) == pytest.approx([8.0, 4.0, 2.0, 1.0])


@pytest.mark.parametrize(("room", "law"), [(viscosities.draw, "misstated"), (films.draw, "cooled_as_misstated")])
def test_only_an_oil_with_a_data_sheet_can_be_mistold(room, law):
    rng = np.random.default_rng(2)
    told = set()
    for rig in (room(rng) for _ in range(40)):
        names = {form.law.__name__ for form in forms_of(rig, "viscosity_temperature_law")}
        if names:
            told.add(("lubricant" in rig.settings, law in names))
    assert told <= {(True, True), (False, False)}
    assert (True, True) in told


def test_bristles_are_the_mean_of_their_own_deflection():
    solved = solve_ivp(lambda x, y: [1 - y[0], y[0]], (0, 5), [0.0, 0.0], rtol=1e-10, atol=1e-12, dense_output=True)
    travel = np.array([0.1, 1.0, 5.0])
    assert bristles(travel) == pytest.approx(solved.sol(travel)[1] / travel, rel=1e-6)


@pytest.mark.parametrize("exponent", [1.4, 2.0])
def test_ball_bearings_follow_their_equation(exponent):
    solved = solve_ivp(lambda x, f: (1 - f) ** exponent, (0, 8), [0.0], rtol=1e-10, atol=1e-12, dense_output=True)
    travel = np.array([0.1, 1.0, 8.0])
    assert ball_bearing(travel, exponent) == pytest.approx(solved.sol(travel)[0], rel=1e-6)


def test_ball_bearings_of_exponent_one_give_way_exponentially():
    travel = np.array([0.2, 1.0, 3.0])
    assert ball_bearing(travel, 1 + 1e-7) == pytest.approx(-np.expm1(-travel), rel=1e-5)


def test_partial_slip_has_the_compliance_of_mindlin():
    """Travel goes with 1 - (1 - F)^(2/3), and sliding begins at 3/2 of the travel of a ball that sticks."""
    force = np.array([0.1, 0.5, 0.9])
    assert partial_slip(1.5 * (1 - (1 - force) ** (2 / 3))) == pytest.approx(force)
    assert partial_slip(np.array([1.5, 4.0])) == pytest.approx([1.0, 1.0])
    assert partial_slip(np.array([1e-4])) == pytest.approx([1e-4], rel=1e-3)


def test_smooth_hysteresis_follows_its_equation():
    solved = solve_ivp(lambda x, f: 1 - f**2, (0, 4), [0.0], rtol=1e-10, atol=1e-12, dense_output=True)
    travel = np.array([0.1, 1.0, 4.0])
    assert hysteretic(travel) == pytest.approx(solved.sol(travel)[0], rel=1e-6)


@pytest.mark.parametrize(("law", "knob", "bent"), [("bending", "bend", 1), ("sticking", "pull", -1)])
def test_losses_under_load_bend_either_way_and_are_gone_without_load(law, knob, bent):
    rig = drawn(drives.draw, lambda b: len(np.unique(b.columns.get("load_N", [1.0]))) == 4)
    (form,) = (f for f in forms_of(rig, "load_dependent_friction") if f.law.__name__ == law)
    load = rig.columns["load_N"] / rig.columns["load_N"].max()
    more = np.abs(change(rig, form, {"strength": 1.0, knob: 0.2}))
    full = more[load == 1.0][0]
    assert more[load == 1.0] == pytest.approx(np.full(np.sum(load == 1.0), full))
    assert (bent * (load * full - more)[(load > 0.1) & (load < 1.0)] > 0).all()
    assert more[load < 0.01].max() < 0.05 * full


def test_a_stribeck_curve_over_hersey_is_left_later_under_more_load():
    rig = drawn(drives.draw, lambda b: "load_N" in b.columns)
    (form,) = (f for f in forms_of(rig, "stribeck") if f.law.__name__ == "hersey")
    load, name = rig.columns["load_N"], "speed_rpm" if "speed_rpm" in rig.columns else "sliding_speed_m_s"
    share = rig.columns[name] / np.abs(rig.columns[name]).max()
    more = np.abs(change(rig, form, {"strength": 1.0, "width": 0.1, "power": 1.0}))
    rest = more * (1 + (share * load.max() / (0.1 * load)) ** 2)
    assert rest == pytest.approx(np.full(len(rest), rest[0]))


def test_a_drive_at_a_creep_has_its_drag_alone_and_at_full_speed_all_friction():
    rig = drawn(drives.draw, lambda b: "presliding" in b.ids)
    name = "speed_rpm" if "speed_rpm" in rig.columns else "sliding_speed_m_s"
    speed = rig.columns[name]
    share = speed / np.abs(speed).max()
    z = np.zeros(3)
    base = rig.model(z, ())
    constant = np.mean([base[share == side].mean() for side in (-1, 1)])
    at_once = (base[share == 1].mean() - base[share == -1].mean()) / 2
    slow = np.abs(share).min()
    drag = (at_once - np.abs(base - constant)[np.abs(share) == slow].mean()) / (1 - slow)
    for form in forms_of(rig, "presliding"):
        later = rig.model(z, [form.hide({k.name: 12.0 if k.name == "strength" else 1.5 for k in form.knobs})])
        crawling = np.abs(share) < 0.002
        assert (np.abs(later - constant)[crawling] < np.abs(base - constant)[crawling]).all()
        stiff = rig.model(z, [form.hide({k.name: 1e6 if k.name == "strength" else 1.5 for k in form.knobs})])
        assert stiff - constant == pytest.approx(drag * share, abs=1e-3 * at_once)
        weak = rig.model(z, [form.hide({k.name: 1e-6 if k.name == "strength" else 1.5 for k in form.knobs})])
        assert weak == pytest.approx(base, abs=1e-3 * at_once)


def test_only_drives_that_creep_show_what_comes_before_sliding():
    rng = np.random.default_rng(3)
    for rig in (drives.draw(rng) for _ in range(60)):
        speed = rig.columns.get("speed_rpm", rig.columns.get("sliding_speed_m_s"))
        assert ("presliding" in rig.ids) == bool(
            np.abs(speed).min() <= SHOWN_BELOW * np.abs(speed).max() and "position_deg" not in rig.columns
        )


@pytest.mark.literature("Rogers and Lance (1960); Dorfman (1963)")
def test_a_free_disc_drags_by_its_exact_flow_and_by_the_logarithmic_law():
    """Slope at the disc 0.6159 (Rogers and Lance 1960), of both sides; Dorfman 1963: 0.491 (lg Re)^-2.58 a side."""
    assert free_disc(np.array([1e4, 2e5])) == pytest.approx(2 * np.pi * 0.6159 * np.array([1e4, 2e5]) ** -0.5, rel=1e-3)
    reynolds = np.array([1e6, 3e6, 1e7])
    assert free_disc(reynolds) == pytest.approx(2 * 0.491 * np.log10(reynolds) ** -2.58, rel=0.11)
    assert free_disc(np.array([TRANSITION]))[0] == pytest.approx(free_disc(np.array([0.999999 * TRANSITION]))[0])


@pytest.mark.literature("Donnelly and Simon (1960)")
def test_a_rotor_in_a_gap_drags_linearly_and_then_as_the_measured_powers():
    """Donnelly and Simon 1960: about the 1.36th power from the first vortices on, the 1.51th well beyond."""

    def power(low, high):
        torque = torque_share(np.array([low, high]) / high, high, rotor_in_gap)
        return np.log(torque[1] / torque[0]) / np.log(high / low)

    assert power(5.0, 50.0) == pytest.approx(1.0)
    assert power(60.0, 600.0) == pytest.approx(1.36, abs=0.05)
    assert power(1000.0, 9000.0) == pytest.approx(1.51, abs=0.02)


def test_drag_of_every_fluid_is_odd_and_its_share_of_dry_friction_at_full_speed():
    rig = drawn(drives.draw, lambda b: "fluid_drag" in b.ids and "speed_rpm" in b.columns)
    share = rig.columns["speed_rpm"] / np.abs(rig.columns["speed_rpm"]).max()
    for form in forms_of(rig, "fluid_drag"):
        more = change(rig, form, {"strength": 1.0})
        full = more[np.abs(share) == 1]
        assert np.abs(full) == pytest.approx(np.full(len(full), np.abs(more).max()))
        assert (np.sign(more) == np.sign(share)).all()
        assert (np.abs(more) <= 1.000001 * np.abs(share) * np.abs(full[0])).all()
        if form.law.__name__ == "fan":
            assert more == pytest.approx(full[0] / share[np.abs(share) == 1][0] * share * np.abs(share))


def test_no_tribometer_has_a_fan_but_its_readings_may_be_taken_for_one():
    rng = np.random.default_rng(6)
    for rig in (drives.draw(rng) for _ in range(60)):
        torque = rig.settings["recording"]["quantity"] == "friction_torque_Nm"
        assert all(form.rarity == float(torque) for form in forms_of(rig, "fluid_drag"))


def test_only_drives_whose_motor_torque_is_recorded_can_have_a_wrong_constant():
    rng = np.random.default_rng(4)
    for rig in (drives.draw(rng) for _ in range(60)):
        assert ("torque_constant" in rig.ids) == ("motor_torque_Nm" in rig.columns)


@pytest.mark.parametrize("draw", [histories.draw_loads, histories.draw_stribeck, drives.draw])
def test_a_force_that_is_off_weighs_with_one_over_the_load(draw):
    rig = drawn(draw, lambda b: "force_offset" in b.ids)
    load = rig.columns["load_N"]
    (offset,) = forms_of(rig, "force_offset")
    force = change(rig, offset, {"strength": 1.0}) * load
    assert force == pytest.approx(np.full(len(load), force[0]))
    typical = np.median(np.abs(rig.model(np.zeros(len(rig.names)), ())))
    assert force[0] == pytest.approx(0.005 * typical * load.max())


def test_a_force_that_drifts_is_right_at_the_start_and_off_the_same_at_the_end():
    rig = drawn(histories.draw_loads, lambda b: True)
    time = (rig.columns["time_s"] - rig.columns["time_s"][0]) / np.ptp(rig.columns["time_s"])
    for form in forms_of(rig, "force_drift"):
        force = change(rig, form, {"strength": 1.0}) * rig.columns["load_N"]
        assert force[0] == pytest.approx(0.0, abs=1e-12)
        assert (np.diff(force) > 0).all()
        if form.law.__name__ == "creeping":
            assert force / force[-1] == pytest.approx(time, abs=1e-4)
        else:
            assert force[len(force) // 2] > 0.5 * force[-1]


def test_logarithmic_creep_slows_as_what_can_still_creep_is_used_up():
    """de/dq = exp(-e)/onset of the strain over its own scale."""
    onset, time = 0.02, np.linspace(0.0, 1.0, 21)
    strain = solve_ivp(lambda q, e: np.exp(-e) / onset, (0.0, 1.0), [0.0], t_eval=time, rtol=1e-10, atol=1e-12).y[0]
    assert crept(time, onset) == pytest.approx(strain / strain[-1], abs=1e-8)


def test_a_plate_takes_up_moisture_with_the_root_of_time_until_half_full():
    """Series of the uptake by a plate whose half thickness is 1: half of it is in at Dt = 0.196."""
    time, odd = np.linspace(0.0, 1.0, 21), np.arange(1, 4001, 2)[:, None]
    uptake = 1 - 8 / np.pi**2 * np.sum(np.exp(-0.196 * time * (odd * np.pi / 2) ** 2) / odd**2, axis=0)
    assert uptake[-1] == pytest.approx(0.5, abs=2e-3)
    assert diffused(time) == pytest.approx(uptake / uptake[-1], abs=3e-3)


@pytest.mark.parametrize("draw", [films.draw, histories.draw_loads, viscosities.draw])
def test_a_drifting_sensor_is_right_at_the_start_and_off_by_its_strength_at_the_end(draw):
    rig = drawn(draw, lambda rig: "sensor_drift" in rig.ids)
    base = rig.model(np.zeros(len(rig.names)), ())
    time = rig.columns.get("sequence", progress(len(base)))
    for form in forms_of(rig, "sensor_drift"):
        error = change(rig, form, {"strength": 1.0}) / base
        assert error[[np.argmin(time), np.argmax(time)]] == pytest.approx([0.0, 0.1], abs=1e-9)


def test_events_come_gradually_or_pass_again():
    """Consecutive reactions by their differential equations: what is there of the second substance, over its most."""
    solved = solve_ivp(
        lambda t, y: [-y[0] / 0.02, y[0] / 0.02 - y[1] / 0.1],
        (0, 0.8),
        [1.0, 0.0],
        rtol=1e-10,
        atol=1e-13,
        dense_output=True,
    )
    time = np.linspace(0.0, 0.8, 2001)
    there = solved.sol(time)[1]
    assert hump(time, 0.02, 0.1) == pytest.approx(there / there.max(), abs=1e-4)
    rig = drawn(histories.draw_steady, lambda b: len(b.columns["run"]) == 200)
    shapes = {}
    for form in forms_of(rig, "friction_event"):
        if form.law.__name__ in ("mixed_in", "passing"):
            more = change(rig, form, {"strength": 1.0, "when": 0.5})
            assert (more[:100] == 0.0).all()
            shapes[form.law.__name__] = more / more.max()
    assert (np.diff(shapes["mixed_in"]) >= 0).all()
    assert shapes["passing"][-1] < 0.05


def test_no_force_is_off_where_all_loads_are_one_or_the_reading_is_no_coefficient():
    rng = np.random.default_rng(5)
    for draw in (histories.draw_steady, histories.draw_traction, tooth_contacts.draw):
        assert not {"force_offset", "force_drift"} & draw(rng).ids
    for rig in (drives.draw(rng) for _ in range(60)):
        coefficient = rig.settings["recording"]["quantity"] == "friction_coefficient"
        assert ("force_offset" in rig.ids) == (coefficient and "load_N" in rig.columns)


@pytest.mark.parametrize("named", [True, False])
def test_an_oil_keeps_its_two_known_viscosities_whatever_its_law(named):
    rig = drawn(
        viscosities.draw,
        lambda b: ("lubricant" in b.settings) == named and {0.0, 40.0, 100.0} <= set(b.columns["temperature_C"]),
    )
    celsius = rig.columns["temperature_C"]
    base = rig.model(np.zeros(len(rig.names)), ())
    for form in forms_of(rig, "viscosity_temperature_law"):
        off = change(rig, form, {"strength": 1.0}) / base
        if form.law.__name__ == "misstated":
            assert off[celsius == 40.0] == pytest.approx(0.0, abs=1e-9)
            assert off[celsius == 100.0] == pytest.approx(0.05)
            continue
        assert off[np.isin(celsius, [40.0, 100.0])] == pytest.approx(0.0, abs=1e-9)
        assert np.abs(off[celsius == 0.0]).min() > 0.005
        if form.law.__name__ == "andrade":
            assert (off[celsius == 0.0] < -0.2).all()


def test_films_follow_the_viscosity_of_another_law():
    """Hamrock and Dowson: with its power 0.67, nothing at 40 and 100 C."""
    rig = drawn(films.draw, lambda b: 140.0 in b.columns["oil_temperature_C"])
    celsius = rig.columns["oil_temperature_C"]
    base = rig.model(np.zeros(len(rig.names)), ())
    table = rig.settings["lubricant"]
    density = table["density_15C_kg_m3"] * (1 - table["density_change_per_K"] * (celsius - 15.0))
    oil = np.array(table["kinematic_viscosity_mm2_s"])
    walther = np.log10(np.log10(oil + 0.7))
    slope = np.diff(walther)[0] / np.diff(np.log10([313.15, 373.15]))[0]
    at = 10**10 ** (walther[0] + slope * (np.log10(celsius + 273.15) - np.log10(313.15))) - 0.7
    known = oil * table["density_15C_kg_m3"] * (1 - table["density_change_per_K"] * (np.array([25.0, 85.0])))
    other = cooling.andrade(celsius, (40.0, 100.0), (known[0], known[1])) / (at * density)
    (form,) = (f for f in forms_of(rig, "viscosity_temperature_law") if f.law.__name__ == "cooled_by_andrade")
    assert change(rig, form, {"strength": 1.0}) / base + 1 == pytest.approx(other**0.67, rel=1e-6)


@pytest.mark.parametrize("name", WHERE)
def test_each_is_dealt_in_its_kinds_alone_and_in_a_pair(name):
    orders = [order for seed in range(6) for order in plan(seed, 200, OTHERS) if name in order.effects]
    assert {order.kind for order in orders} == WHERE[name]
    labels = Counter(order.label for order in orders)
    alone = "measurement" if name in MEASUREMENT else "single"
    assert set(labels) == {alone, "pair"}
    assert labels[alone] >= 6


def test_every_pair_of_these_kinds_is_dealt_sooner_or_later():
    orders = [order for seed in range(12) for order in plan(seed, 200, OTHERS) if order.label == "pair"]
    dealt = {(order.kind, order.effects) for order in orders}
    assert dealt == {(kind, (first, other)) for kind in OTHERS for first, (other,), _ in KINDS[kind].pairs}
