"""Laws of worm drives: printed numbers, forces on the thread, limits."""

import math

import numpy as np
import pytest

from mixedlub.worm_gears import laws

LEADS, FRICTIONS, PRESSURE = (0.05, 0.2, 0.5, 0.8), (0.01, 0.04, 0.1), math.radians(20)
PLACES = [(lead, mu) for lead in LEADS for mu in FRICTIONS]


def forces(lead, mu, worm_drives):
    """Circumferential forces on worm and wheel of a unit normal force, by vectors on the thread.

    Along the worm's rim, along its axis (the rim of the wheel), outwards; friction holds back what slides.
    """
    normal = np.array([math.cos(PRESSURE) * math.sin(lead), math.cos(PRESSURE) * math.cos(lead), math.sin(PRESSURE)])
    along = np.array([math.cos(lead), -math.sin(lead), 0.0])
    assert normal @ along == pytest.approx(0.0, abs=1e-15)
    return normal + (mu if worm_drives else -mu) * along


@pytest.mark.parametrize(("lead", "mu"), PLACES)
def test_both_efficiencies_are_those_of_the_forces_on_the_thread(lead, mu):
    """The worm moves by 1 along its rim while the wheel's rim moves by tan(lead)."""
    angle = laws.friction_angle(mu, PRESSURE)
    on_worm, on_wheel, _ = forces(lead, mu, worm_drives=True)
    assert laws.driving_efficiency(lead, angle) == pytest.approx(on_wheel * math.tan(lead) / on_worm, rel=1e-12)
    on_worm, on_wheel, _ = forces(lead, mu, worm_drives=False)
    assert laws.driven_efficiency(lead, angle) == pytest.approx(on_worm / (on_wheel * math.tan(lead)), rel=1e-9)


def test_the_wheel_drives_up_to_the_friction_of_the_lead():
    lead = math.radians(6.0)
    limit = laws.friction_angle(math.tan(lead) * math.cos(PRESSURE), PRESSURE)
    assert laws.driven_efficiency(lead, limit) == pytest.approx(0.0, abs=1e-12)
    assert laws.driving_efficiency(lead, limit) == pytest.approx((1 - math.tan(lead) ** 2) / 2, rel=1e-12)
    assert laws.driving_efficiency(lead, 0.0) == laws.driven_efficiency(lead, 0.0) == 1.0


def test_sliding_is_the_difference_of_both_rim_speeds():
    """Worm and wheel move at right angles at the pitch point: 72.5 mm/s and the wheel's share of it."""
    lead = laws.lead_angle(2, 4.0, 36.0)
    worm, wheel = 20.0 * 18e-3, 20.0 * 2 / 41 * 82e-3
    assert laws.sliding_speed(20.0, 36e-3, lead) == pytest.approx(math.hypot(worm, wheel), rel=1e-12)


def test_the_film_is_dowson_and_higginson_s_with_the_sizes_of_the_drive():
    """h ~ R^0.43 alpha^0.6 (eta u)^0.7 E^0.03/w^0.13; R = a, u = n a, w = T/a^2: one factor for all drives."""
    rng = np.random.default_rng(5)
    torque, speed, eta, alpha = (np.exp(rng.normal(size=8)) for _ in range(4))
    factors = []
    for a, modulus in ((0.05, 150e9), (0.1, 150e9), (0.3, 90e9)):
        found = laws.mean_film(
            torque, speed, eta, alpha, parameter=0.07, coefficient=20.0, centre_distance=a, modulus=modulus
        )
        line = a**0.43 * alpha**0.6 * (eta * speed * a) ** 0.7 * modulus**0.03 / (torque / a**2) ** 0.13
        factors += list(found / line)
    assert factors == pytest.approx([factors[0]] * len(factors), rel=1e-12)


def test_the_film_by_hand_in_the_units_of_the_standard():
    """k h* = 1.4, alpha 1.7e-8, eta 0.1, 1000 rpm, 100 mm, 150,000 N/mm2, 500 N m: 0.83 um by logarithms."""
    logarithm = math.log10(1.4) + 0.6 * math.log10(1.7e-8) + 0.7 * 2 + 1.39 * 2
    logarithm += 0.03 * math.log10(150_000) - 0.13 * math.log10(500)
    film = laws.mean_film(
        500.0,
        1000 * math.pi / 30,
        0.1,
        1.7e-8,
        parameter=0.07,
        coefficient=20.0,
        centre_distance=0.1,
        modulus=150e9,
    )
    assert 1e6 * film == pytest.approx(10**logarithm, rel=1e-12)


def test_both_branches_of_agma_s_friction_nearly_meet():
    meet = 10 * laws.FOOT_PER_MINUTE
    below, above = laws.agma_6034(np.array([meet * (1 - 1e-9), meet * (1 + 1e-9)]))
    assert (below, above) == pytest.approx((0.08943, 0.08754), abs=1e-5)
