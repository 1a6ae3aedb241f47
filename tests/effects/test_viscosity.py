"""Laws of viscosity over temperature, each met by the effect that contains it."""

from __future__ import annotations

import numpy as np
import pytest

from mixedlub.effects.viscosity_temperature_law import viscosity_temperature_law
from mixedlub.rig.lubricant import Lubricant


@pytest.mark.parametrize("divergence", [155.0, 178.15, 195.0])
@pytest.mark.parametrize("known", [(313.15, 373.15), (353.15, 293.15)])
def test_liquid_of_vogel_is_met_from_two_of_its_viscosities(divergence: float, known: tuple[float, float]) -> None:
    """0.065 mPa s exp(900 K/(T - T_c)): 51 mPa s at 40 degC where T_c is 178 K."""

    def vogel(kelvin: np.ndarray) -> np.ndarray:
        return 6.5e-5 * np.exp(900.0 / (kelvin - divergence))

    kinematic = vogel(np.array(known)) / (850.0 * (1.0 - 6.5e-4 * (np.array(known) - 288.15)))
    oil = Lubricant("", known, tuple(kinematic.tolist()), (2e-8, 1e-8), 850.0, 6.5e-4, 5e6, 0.14, 2e3)
    kelvin = np.linspace(263.15, 423.15, 9)
    inputs = oil.inputs(kelvin)
    words = ("first_known_temperature", "second_known_temperature", "known_fall", "fall_from_first")
    law = {"share": 1.0, "convexity": 313.15 / (313.15 - divergence), "fall": 1.0}
    found = viscosity_temperature_law(inputs["viscosity"], kelvin, *(inputs[w] for w in words), **law)
    np.testing.assert_allclose(found, vogel(kelvin), rtol=1e-10)
    departure = np.abs(np.log(inputs["viscosity"] / found))
    assert departure[(kelvin > 313.0) & (kelvin < 373.0)].max() < 0.06


@pytest.mark.parametrize("spot", [120.0, 178.15, 200.0])
def test_liquid_of_slotte_is_met_within_3_percent_from_10_to_120_degC(spot: float) -> None:
    """(T - T_s)**-n, K. F. Slotte, Wied. Ann. 14 (1881) 13: a power of the temperature above one of no flow."""
    known = np.array([313.15, 373.15])
    kelvin = np.linspace(283.15, 393.15, 12)

    def fall(at: np.ndarray) -> np.ndarray:
        return np.log(10.0) * np.log((at - spot) / (known[0] - spot)) / np.log((known[1] - spot) / (known[0] - spot))

    convexity = 313.15 / (2.0 * (313.15 - spot))
    oil = np.exp(-fall(kelvin))
    found = viscosity_temperature_law(
        oil, kelvin, *known, np.log(10.0), fall(kelvin), share=1.0, convexity=convexity, fall=1.0
    )
    assert np.abs(np.log(found / oil)).max() < 0.03


def test_exponential_of_reynolds_is_met_exactly() -> None:
    kelvin = np.linspace(253.15, 423.15, 9)
    fall = 0.0384 * (kelvin - 313.15)
    found = viscosity_temperature_law(
        0.1 * np.exp(-0.9 * fall),
        kelvin,
        313.15,
        373.15,
        0.0384 * 60.0,
        0.9 * fall,
        share=1.0,
        convexity=0.0,
        fall=1.0,
    )
    np.testing.assert_allclose(found, 0.1 * np.exp(-fall), rtol=1e-12)


def test_law_of_vogel_leaves_the_two_given_viscosities() -> None:
    oil = Lubricant("", (313.15, 373.15), (1e-4, 1.1e-5), (2e-8, 1e-8), 880.0, 6.5e-4, 5e6, 0.14, 2e3)
    kelvin = np.array(oil.temperature)
    inputs = oil.inputs(kelvin)
    words = ("first_known_temperature", "second_known_temperature", "known_fall", "fall_from_first")
    found = viscosity_temperature_law(
        inputs["viscosity"], kelvin, *(inputs[w] for w in words), share=1.3, convexity=2.5, fall=1.0
    )
    np.testing.assert_allclose(found, inputs["viscosity"], rtol=1e-13)
