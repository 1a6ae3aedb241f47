"""Losses beside the mesh against published numbers, and against integrals of the physics they shorten."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import integrate

from mixedlub.effects import catalogue
from mixedlub.effects.elastic_hysteresis import elastic_hysteresis
from mixedlub.effects.rolling_resistance import rolling_resistance
from mixedlub.effects.torque_offset import torque_offset
from mixedlub.laws import drag, loss


def goksem(radius: float, modulus: float, viscosity: float, speed: float, alpha: float) -> float:
    """Force per length of Goksem and Hargreaves, 4.318 (G U)^0.658 W^0.0126 R/alpha, at W = 1.14e-4."""
    return 4.318 * (alpha * viscosity * speed / radius) ** 0.658 * 1.14e-4**0.0126 * radius / alpha


@pytest.mark.literature("Diab, Ville, Velex and Changenet (2004), J. Mech. Des. 126, 903")
@pytest.mark.parametrize(
    ("diameter", "width", "teeth", "rpm", "watts"),
    [(0.1, 0.02, 25, 10_000, 114), (0.2794, 0.0284, 44, 10_000, 5390), (0.288, 0.03, 72, 6685, 1710),
     (1.16, 0.19, 72, 1000, 6980)],
)  # fmt: skip
def test_windage_of_diab(diameter: float, width: float, teeth: int, rpm: float, watts: float) -> None:
    found = drag.windage_diab(diameter / 2, rpm * np.pi / 30, width, float(teeth))
    assert found == pytest.approx(watts, rel=0.05)


@pytest.mark.parametrize("largest", [5.0, 100.0, 5000.0])
def test_torque_offset_is_that_of_a_meter_as_large_as_the_test(largest: float) -> None:
    """Meters keep their zero to 0.05 % of their range."""
    typical = catalogue()["torque_offset"].parameters[0].prior.value(np.arcsinh(1.0))
    assert torque_offset(0.0, 1.0, largest, offset=typical) == pytest.approx(5e-4 * largest, rel=1e-9)


def test_windage_is_above_a_smooth_disc_in_air() -> None:
    """Two faces of a turbulent disc, 0.073 Re^-0.2 rho omega^3 R^5, bound it from below."""
    omega, radius = 1000.0, 0.14
    reynolds = drag.AIR_DENSITY * omega * radius**2 / drag.AIR_VISCOSITY
    disc = 0.073 * reynolds**-0.2 * drag.AIR_DENSITY * omega**3 * radius**5
    assert drag.windage_diab(radius, omega, 0.028, 44.0) > disc


@pytest.mark.literature("Changenet and Velex (2007), J. Mech. Des. 129, 128")
@pytest.mark.parametrize(("rpm", "watts"), [(1000, 5.8), (2000, 17), (3000, 33), (5000, 74)])
def test_churning_of_changenet_and_velex(rpm: float, watts: float) -> None:
    found = drag.churning_changenet_velex(0.05, rpm * np.pi / 30, 0.02, 4e-3, 25.0, 50e-6 * 850, 850.0)
    assert found == pytest.approx(watts, rel=0.03)


@pytest.mark.literature("Palmgren (1964), Grundlagen der Waelzlagertechnik; ISO/TR 14179-2")
@pytest.mark.parametrize(("motion", "within"), [(1.0, 0.01), (1999.0, 0.01), (2000.0, 1e-9), (2500.0, 1e-9)])
def test_palmgren_has_two_ranges(motion: float, within: float) -> None:
    """160e-7 f0 d^3 below nu n of 2000 mm^2/s rpm, 1e-7 f0 (nu n)^(2/3) d^3 above."""
    printed = (160.0 if motion < 2000.0 else motion ** (2 / 3)) * 1e-7 * 2 * 45**3 * 1e-3
    for speed in (np.pi / 30, -np.pi / 30):
        torque = drag.palmgren_idle_torque(motion * 1e-6 * 850, 850.0, speed, 0.045)
        assert torque == pytest.approx(printed, rel=within)


@pytest.mark.literature("Goksem and Hargreaves (1978), J. Lubr. Technol. 100, 346, doi:10.1115/1.3453183")
@pytest.mark.parametrize("speed", [1.0, 2.2, 5.0])
def test_rolling_near_goksem_and_hargreaves(speed: float) -> None:
    """4.318 (G U)^0.658 W^0.0126 R/alpha; the two laws meet within 40 % at gear conditions."""
    contact = (8.3262e-3, 226.374e9, 0.01489, speed, 14.81e-9)
    found = rolling_resistance(0.0, *contact, strength=1.0, exponent=0.75)
    assert found == pytest.approx(goksem(*contact), rel=0.4)


@pytest.mark.literature("Goksem and Hargreaves (1978), J. Lubr. Technol. 100, 346, doi:10.1115/1.3453183")
@pytest.mark.parametrize("speed", [1.0, 2.2, 5.0])
@pytest.mark.parametrize("alpha", [8e-9, 14.81e-9, 25e-9])
def test_rolling_with_their_power_of_speed_is_that_of_goksem_and_hargreaves(speed: float, alpha: float) -> None:
    contact = (8.3262e-3, 226.374e9, 0.01489, speed, alpha)
    found = rolling_resistance(0.0, *contact, strength=1.0, exponent=0.658)
    assert found == pytest.approx(goksem(*contact), rel=0.03)


@pytest.mark.literature(
    "Biboulet and Houpert (2010), Proc. IMechE J 224, 765, doi:10.1243/13506501JET790; "
    "Goksem and Hargreaves (1978), J. Lubr. Technol. 100, 346, doi:10.1115/1.3453183; "
    "Zhou and Hoeprich (1991), J. Tribol. 113, 590, doi:10.1115/1.2920664; "
    "Pan and Hamrock (1989), J. Tribol. 111, 246, doi:10.1115/1.3261900"
)
@pytest.mark.parametrize(("power", "published"), [(0.75, 0.0), (0.658, -0.342), (0.648, -0.352), (0.638, -0.358)])
def test_rolling_falls_with_the_published_powers_of_alpha(power: float, published: float) -> None:
    """Biboulet and Houpert; Goksem and Hargreaves; Zhou and Hoeprich; Pan and Hamrock."""
    stiff, soft = (
        rolling_resistance(0.0, 0.01, 226e9, 0.015, 2.0, alpha, strength=1.0, exponent=power)
        for alpha in (20e-9, 10e-9)
    )
    assert np.log2(stiff / soft) == pytest.approx(published, abs=0.03)


def test_hysteresis_loses_its_share_of_the_work_of_the_front_half() -> None:
    """Surfaces a distance x before the middle of a Hertz line contact close at the speed x u/R."""
    load, width, radius, speed = 200e3, 0.15e-3, 8.3e-3, 3.0
    peak = 2.0 * load / (np.pi * width)

    def work(x: float) -> float:
        return peak * np.sqrt(1.0 - (x / width) ** 2) * x * speed / radius

    force = elastic_hysteresis(0.0, load, width, radius, loss_fraction=0.01)
    lost = loss.rolling_loss(np.full(1, force), np.full(1, speed), 1.0, np.ones(1))
    assert float(lost[0]) == pytest.approx(0.01 * integrate.quad(work, 0.0, width)[0], rel=1e-9)
