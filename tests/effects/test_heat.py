"""Heat in the film and on the flanks against the integrals and equations behind it."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import integrate

from mixedlub.effects.film_heating import film_heating
from mixedlub.laws import heating


def test_flash_temperature_integrates_a_moving_source() -> None:
    """Mean over the contact of a semi-elliptic flux that one fast body carries off alone, halved between two."""
    width, speed, steel = 0.2e-3, 4.0, (46.0, 7800.0, 470.0)
    effusivity = np.sqrt(np.prod(steel))

    def rise(x: float) -> float:
        def source(s: float) -> float:
            return 2.0 * np.sqrt(max(width**2 - (x - s**2) ** 2, 0.0)) / width

        return integrate.quad(source, 0.0, np.sqrt(x + width))[0] / (effusivity * np.sqrt(np.pi * speed))

    mean = integrate.quad(rise, -width, width)[0] / (2.0 * width)
    per_flux = mean / (np.pi / 4.0) / 2.0
    assert heating.flash_temperature(1.0, width, speed, 0.0, *steel) == pytest.approx(per_flux, rel=5e-3)


@pytest.mark.parametrize("given", [0.0, 1.5])
def test_softened_stress_meets_its_own_equation(given: float) -> None:
    stress = np.linspace(0.1, 90.0, 40)[:, None] * 1e6
    per_stress = np.geomspace(1e-10, 3e-6, 30)
    found = heating.softened_stress(stress, 5e6, given, per_stress)
    again = 5e6 * np.arcsinh(np.sinh(stress / 5e6) * np.exp(-given - per_stress * found))
    np.testing.assert_allclose(found, again, rtol=2e-3)


def test_film_rise_is_that_of_a_sheared_sheet() -> None:
    """Uniform shear between walls at one temperature warms the film by tau v_s h / (12 k) on average."""
    tau, eyring, slip, film, conductivity = 20e6, 5e6, 3.0, 0.4e-6, 0.14
    oil = {"viscosity": 0.0149, "contact_viscosity": 70.0, "temperature_viscosity": 0.026}
    contact = {"flash_per_friction": 700.0, "hertz_pressure": 1e9, "boundary_friction": 0.1, "area_ratio": 0.0}
    found = film_heating(
        tau, eyring, slip, film, oil_conductivity=conductivity, **oil, **contact,
        strength=0.5, flash=0.0, pressure=1.0,
    )  # fmt: skip
    softening = heating.contact_softening(
        **{k: oil[k] for k in ("temperature_viscosity", "viscosity", "contact_viscosity")}
    )
    rise = -np.log(np.sinh(found / eyring) / np.sinh(tau / eyring)) / softening
    assert rise == pytest.approx(found * slip * film / (12.0 * conductivity), rel=1e-3)
