"""Effects with several literature forms: what each parameter must do at its ends."""

from __future__ import annotations

import numpy as np
import pytest

from mixedlub.effects import catalogue
from mixedlub.effects.bearing_drag import bearing_drag
from mixedlub.effects.churning import churning
from mixedlub.effects.dynamic_load import dynamic_load
from mixedlub.effects.friction_event import friction_event
from mixedlub.effects.inlet_shear_heating import inlet_shear_heating
from mixedlub.effects.presliding import presliding
from mixedlub.effects.pressure_viscosity_law import pressure_viscosity_law
from mixedlub.effects.starvation import starvation
from mixedlub.effects.stribeck import stribeck
from mixedlub.effects.viscosity_drift import viscosity_drift
from mixedlub.laws.oil import roelands_viscosity

LOW = 0.15e9
STRAIGHT = {
    "onset": LOW,
    "roelands": 0.0,
    "exponent": 0.6,
    "slope_with_temperature": 0.0,
    "slope_bow": 0.0,
    "bend_down": 0.0,
    "bend_up": 0.0,
    "down_with_temperature": 0.0,
    "up_with_temperature": 0.0,
}
BEARINGS = {"strength": 1.0, "loaded": 1.0, "load_power": 1.0, "idle": 1.0, "rolling_power": 0.0}
GEAR = {"transmitted_force": 3000.0, "pinion_radius": 0.036, "gears_fitted": 1, "oil_density": 850.0}


def exponent(pressure: float, slope: float) -> float:
    """ln of the rise of viscosity with pressure, over that of Barus' law with 14/GPa."""
    thin, barus = 0.02, np.exp(14e-9 * pressure)
    other = pressure_viscosity_law(thin * barus, thin, pressure, 313.15, slope=slope, **STRAIGHT)
    return float(np.log(other / thin) / np.log(barus))


def test_another_slope_in_the_contact_leaves_the_coefficient_of_low_pressure() -> None:
    assert exponent(1e-4 * LOW, 1.3) == pytest.approx(1.0, abs=1e-4)
    assert exponent(0.8e9, 1.3) == pytest.approx(1.3, abs=8e-3)
    assert exponent(0.8e9, 1.0) == pytest.approx(1.0, abs=1e-12)


def test_a_coefficient_of_pressure_may_bow_between_the_temperatures_at_which_it_is_known() -> None:
    """One over a line in temperature, as of a modulus equation, where the base draws a straight line."""
    known, celsius = (50.0, 110.0), np.array([50.0, 80.0, 110.0])
    modulus = 1.0 / (0.033 + 0.00033 * celsius)
    straight = np.interp(celsius, known, modulus[[0, 2]])
    z = (celsius - 40.0) / 100.0 * (313.15 / (celsius + 273.15))
    slope = np.polyfit(z, np.log(modulus / straight), 2)
    form = {**STRAIGHT, "slope": np.exp(slope[2]), "slope_bow": slope[0], "slope_with_temperature": slope[1]}
    thin, pressure = 0.02, 0.6e9
    found = pressure_viscosity_law(thin * np.exp(1e-9 * straight * pressure), thin, pressure, celsius + 273.15, **form)
    assert straight[1] / modulus[1] == pytest.approx(1.03, abs=0.003)
    assert np.log(found / thin) == pytest.approx(1e-9 * modulus * pressure, rel=2e-3)


@pytest.mark.literature("SKF (2018), Rolling Bearings, model of the frictional moment")
@pytest.mark.parametrize(("speed", "rise"), [(0.05, 1.4), (2000.0, 0.0)])
def test_bearings_rub_where_they_have_no_film_and_only_there(speed: float, rise: float) -> None:
    """SKF's 0.12 over 0.05 for the part that load adds; at rest it is nearly all of the torque."""
    motion = {"pinion_speed": speed, "gear_speed": speed, "viscosity": 0.01275}
    without, rubbing = (bearing_drag(0.0, **GEAR, **motion, **BEARINGS, rubbing=m) for m in (0.0, 1.4))
    loaded = without - bearing_drag(0.0, **GEAR, **motion, **{**BEARINGS, "loaded": 0.0}, rubbing=0.0)
    assert (rubbing - without) / loaded == pytest.approx(rise, abs=0.02)


@pytest.mark.literature(
    "SKF (2018), Rolling Bearings, constant coefficient of friction: 0.0015 for deep groove ball bearings"
)
def test_bearings_of_a_constant_coefficient_lose_that_share_of_load_at_any_speed() -> None:
    values = catalogue()["bearing_drag"].special_cases["constant coefficient"]
    motion = {"pinion_speed": np.array([5.0, 500.0]), "gear_speed": 0.0, "viscosity": np.array([0.3, 0.003])}
    torque = bearing_drag(0.0, **GEAR, **motion, **values, strength=0.0015 / 0.0024) / motion["pinion_speed"]
    journal = 1.25 * GEAR["pinion_radius"]
    assert torque == pytest.approx(0.0015 * GEAR["transmitted_force"] * journal / 2.0, rel=1e-12)


@pytest.mark.parametrize("saturation", [-1e4, -6.0, -1e-10, 0.0, 1e-10, 0.7, 8.0, 1e4])
def test_drift_is_the_change_at_the_end_whatever_its_pace(saturation: float) -> None:
    place = np.array([0.0, 0.5, 1.0])
    found = viscosity_drift(1.0, place, place, 313.15, drift=0.2, saturation=saturation, cold_gain=0.7, heat=0.3)
    assert np.log(found[[0, 2]]) == pytest.approx([0.0, 0.2])
    assert (np.log(found[1]) - 0.1) * np.sign(saturation) > -1e-12


@pytest.mark.parametrize("constant", [0.05, 0.3, 2.0])
def test_drift_that_saturates_is_a_change_of_first_order(constant: float) -> None:
    """1 - exp(-t/T), of which the programme sees the part up to its end."""
    place = np.linspace(0.0, 1.0, 9)
    full, seen = 0.2, -0.2 * np.expm1(-1.0 / constant)
    found = viscosity_drift(1.0, place, place, 313.15, drift=seen, saturation=1.0 / constant, cold_gain=0.0, heat=0.0)
    np.testing.assert_allclose(np.log(found), -full * np.expm1(-place / constant), rtol=1e-12)


def test_drift_passes_smoothly_through_the_steady_rate() -> None:
    place = np.linspace(0.0, 1.0, 5)
    rest = {"drift": 0.2, "cold_gain": 0.0, "heat": 0.0}
    found = [viscosity_drift(1.0, place, place, 313.15, saturation=s, **rest) for s in (-2e-9, 0.0, 2e-9)]
    np.testing.assert_allclose(found[0], found[1], atol=1e-9)
    np.testing.assert_allclose(found[2], found[1], atol=1e-9)


def test_a_film_that_collapses_keeps_viscosity_times_speed() -> None:
    """Ten kelvin at 3 % each thin the oil by e^0.3: the same friction at e^0.3 times the speed."""
    law = {"excess": 0.4, "speed_share": 0.05, "exponent": 1.6, "thinning": 0.03, "load_power": 1.0}
    cold, warm = (stribeck(2.0, 2.0, v, 100.0, t, 0.0, **law) for v, t in ((4.0, -5.0), (4.0 * np.exp(0.3), 5.0)))
    assert cold == pytest.approx(warm, rel=1e-12)
    doubled = stribeck(2.0, 2.0, 8.0, 100.0, -5.0, np.log(2.0), **law)
    assert doubled == pytest.approx(cold, rel=1e-12)


@pytest.mark.literature("Boness (1989), Proc. Int. Symp. Gearing")
def test_churning_between_reynolds_numbers_2000_and_1e5_goes_as_boness_has_it() -> None:
    """C_m = 8.6e-4 Re^(1/3): loss as n^(10/3) nu^(-1/3)."""
    wheel = {"gear_radius": 0.05, "face_width": 0.02, "gear_module": 4e-3, "gear_teeth": 25.0, "gears_fitted": 1.0}
    wheel["helix_angle"] = 0.0
    law = {"strength": 1.0, "viscous": -1.0 / 3.0, "surplus": 0.7, "second_law": 0.0, "oil_density": 850.0}
    slow, fast, thick = (
        churning(0.0, gear_speed=speed, viscosity=viscosity, bath_acceleration=speed**2 * 0.016, **wheel, **law)
        for speed, viscosity in ((100.0, 0.02), (200.0, 0.02), (100.0, 0.16))
    )
    assert fast / slow == pytest.approx(2.0 ** (10.0 / 3.0), rel=1e-12)
    assert thick / slow == pytest.approx(0.5, rel=1e-12)


@pytest.mark.parametrize("exponent", [0.5, 1.0, 1.5, 2.0])
def test_presliding_keeps_to_the_stiffness_of_dahl(exponent: float) -> None:
    """dF/dx = k (1 - F/T)^i, P. R. Dahl (1968)."""
    travel = np.linspace(0.01, 1.5, 400)
    force = presliding(1.0, travel, 1.0, speed_share=1.0, exponent=exponent)
    stiffness = np.gradient(force, travel, edge_order=2)
    np.testing.assert_allclose(stiffness[1:-1], ((1.0 - force) ** exponent)[1:-1], rtol=2e-3, atol=1e-4)


def test_the_second_harmonic_meets_the_resonance_at_half_the_speed() -> None:
    at = {"amplitude": 0.02, "resonance": 1.0 / (2.0 * np.pi), "damping": 0.05, "power": 1.0, "fade": 0.0}
    teeth = {"transmitted_force": 3000.0, "pinion_teeth": 1.0, "mesh_phase": 0.5}
    ratio = np.linspace(0.3, 1.4, 1101)
    found = dynamic_load(1.0, pinion_speed=ratio, **teeth, **at, phase=0.0, second=0.5, in_phase=1.0, everywhere=1.0)
    peaks = ratio[1:-1][(found[1:-1] > found[:-2]) & (found[1:-1] > found[2:])]
    np.testing.assert_allclose(peaks, [0.5, 1.0], atol=0.01)


def test_a_change_that_is_undone_leaves_the_friction_of_before() -> None:
    place = np.linspace(0.0, 1.0, 11)
    event = {"change": 0.3, "place": 0.3, "width": 0.02, "later": -1.0, "delay": 0.1, "abruptness": 3.0}
    found = friction_event(0.1, place, **event)
    assert found[[0, 1, 2]] == pytest.approx(0.1, rel=1e-3)
    assert found[4] > 0.105
    assert found[-4:] == pytest.approx(0.1, rel=1e-3)


@pytest.mark.literature("Hsu and Lee (1994), J. Tribol. 116, 762")
def test_thermal_loading_and_pressure_have_the_powers_that_are_asked_for() -> None:
    """Hsu and Lee: loss as L^0.527 and, of a line contact, load^0.447, which is pressure^0.894."""
    law = {"strength": 1e-6, "sliding": 0.0, "loading_power": 0.527, "pressure_power": 0.894}

    def lost(loading: float, pressure: float) -> float:
        rest = inlet_shear_heating(1.0, 1.0, loading, 1.0, 1.0, 0.0, pressure, 1.0, **law)
        rolling = 13.2e-6 * pressure * loading**0.42
        return float(1.0 / (rest * np.exp(rolling)) - 1.0)

    assert lost(8.0, 0.004) / lost(1.0, 0.004) == pytest.approx(8.0**0.527, rel=1e-6)
    assert lost(1.0, 0.008) / lost(1.0, 0.004) == pytest.approx(2.0**0.894, rel=1e-6)


@pytest.mark.parametrize("steepness", [0.5, 2.5, 400.0])
@pytest.mark.parametrize("width_power", [-1.0, 0.0, 3.0])
def test_starved_film_is_finite_however_sharp_and_far_the_onset(steepness: float, width_power: float) -> None:
    """Chevalier's form where it can be written out, and its limit (c/(eta u))^s where it overflows."""
    law = {"strength": 0.5, "onset": 1e-2, "steepness": steepness, "width_power": width_power}
    speed, pressure = np.array([1e-3, 0.2, 30.0]), 1.4e9
    ratio = 0.1 * speed / (0.01 * 1.4**width_power)
    found = starvation(1e-7, 0.1, speed, pressure, **law)
    with np.errstate(over="ignore"):
        raised = ratio**steepness
    plain = np.where(np.isfinite(raised), (1.0 + np.where(np.isfinite(raised), raised, 0.0)) ** (-0.5 / steepness), 0.0)
    expected = 1e-7 * np.where(np.isfinite(raised), plain, ratio**-0.5)
    np.testing.assert_allclose(found, expected, rtol=1e-12)
    assert starvation(1e-7, 0.1, 1e9, pressure, **{**law, "strength": 30.0}) > 0.0


def test_law_of_roelands_stays_a_number_for_a_liquid_that_is_none() -> None:
    assert np.isfinite(roelands_viscosity(1e9, 600e-9, 3e9))


def test_a_helical_wheel_churns_with_flanks_longer_by_its_angle() -> None:
    """Only the flanks grow: by 1/cos(beta), as in the area of Changenet and Velex."""
    wheel = {"gear_radius": 0.05, "face_width": 0.02, "gear_teeth": 25.0, "gears_fitted": 1.0}
    law = {"strength": 1.0, "viscous": 0.21, "surplus": 0.38, "viscosity": 0.017, "oil_density": 850.0}
    law |= {"second_law": 1.0, "bath_acceleration": 160.0}
    bare, spur, helical = (
        churning(0.0, gear_speed=100.0, gear_module=module, helix_angle=angle, **wheel, **law)
        for module, angle in ((0.0, 0.0), (4e-3, 0.0), (4e-3, np.radians(30.0)))
    )
    assert (helical - bare) / (spur - bare) == pytest.approx(1.0 / np.cos(np.radians(30.0)), rel=1e-12)
