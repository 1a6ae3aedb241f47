"""Effects on the film against published numbers and limits."""

from __future__ import annotations

import numpy as np
import pytest

from mixedlub.effects.inlet_shear_heating import inlet_shear_heating
from mixedlub.effects.inlet_shear_thinning import inlet_shear_thinning
from mixedlub.effects.micro_ehl import micro_ehl
from mixedlub.effects.roughness_lay import roughness_lay
from mixedlub.laws.flattening import amplitude_left, reduction_rate


@pytest.mark.literature(
    "Venner, Couhier, Lubrecht and Greenwood (1997), Tribology Series 32, 103, doi:10.1016/S0167-8922(08)70440-1"
)
@pytest.mark.parametrize(("wavelength", "left"), [(1.0, 0.183), (0.5, 0.394), (0.25, 0.660), (0.125, 0.839)])
def test_amplitude_of_waves_in_a_line_contact(wavelength: float, left: float) -> None:
    """Solutions at M 100 and L 11, for a tenth of the film."""
    assert amplitude_left(wavelength * reduction_rate(100.0, 11.0)) == pytest.approx(left, rel=0.05)


def test_each_surface_is_flattened_by_its_own_waves() -> None:
    """The long waves of the first surface go, the short ones of the second stay."""
    here = {"hertz_half_width": 0.18e-3, "hertz_pressure": 1e9, "radius": 8e-3, "reduced_modulus": 226e9}
    oil = {"viscosity": 0.015, "entrainment_speed": 1.0, "pressure_viscosity": 15e-9}
    shares = {"height_share": 0.5, "slope_share": 1e-4, "curvature_share": 1e-8}
    form = {"relative_wavelength": 1.0, "viscous": 1.0, "spread": 0.0}
    m0, m2, m4 = micro_ehl(1e-14, 1e-2, 1e9, **shares, **here, **oil, **form)
    assert m0 / 1e-14 == pytest.approx(0.5, abs=0.05)
    assert m2 / 1e-2 == pytest.approx(1.0, abs=0.1)
    assert m4 / 1e9 == pytest.approx(1.0, abs=0.1)


@pytest.mark.parametrize("spread", [0.3, 1.0])
def test_waves_of_a_spectrum_are_flattened_one_by_one(spread: float) -> None:
    """Against the spectrum itself, lognormal in the wave number q, with the amplitude of each wave."""
    m0, m2, m4, width = 1e-14, 1e-3, 1e9, 0.18e-3
    here = {"hertz_half_width": width, "hertz_pressure": 1e9, "radius": 8e-3, "reduced_modulus": 226e9}
    oil = {"viscosity": 0.015, "entrainment_speed": 1.0, "pressure_viscosity": 15e-9}
    shares = {"height_share": 1.0 - 1e-12, "slope_share": 1.0 - 1e-12, "curvature_share": 1.0 - 1e-12}
    form = {"relative_wavelength": 1.0, "viscous": 1.0, "spread": spread}
    found = np.array(micro_ehl(m0, m2, m4, **shares, **here, **oil, **form)) / (m0, m2, m4)
    variance = 0.25 * spread * np.log(m0 * m4 / m2**2)
    q = np.sqrt(m2 / m0) * np.exp(np.linspace(-8.0, 8.0, 4001))
    density = np.exp(-((np.log(q) - np.log(m2 / m0) / 2.0 + variance) ** 2) / (2.0 * variance))
    speed = 2.0 * 0.015 / (226e9 * 8e-3)
    rate = reduction_rate(2.0 * np.pi * (1.0 / 226.0) ** 2 * speed**-0.5, 15.0 * 226.0 * speed**0.25)
    kept = amplitude_left(2.0 * np.pi / q / width * rate)
    expected = [np.sum(density * q**k * kept**2) / np.sum(density * q**k) for k in (0, 2, 4)]
    assert found == pytest.approx(expected, abs=0.02)
    assert found[0] < found[1] < found[2]


@pytest.mark.literature(
    "Gupta, Cheng, Zhu, Forster and Schrand (1992), Tribol. Trans. 35, 269, doi:10.1080/10402009208982117"
)
@pytest.mark.parametrize(
    ("loading", "sliding", "factor"),
    [
        (0.1, 0.0, 0.930),
        (1.0, 0.0, 0.770),
        (10.0, 0.0, 0.428),
        (0.1, 0.5, 0.878),
        (1.0, 0.5, 0.631),
        (10.0, 0.5, 0.267),
    ],
)
def test_inlet_heating_of_gupta(loading: float, sliding: float, factor: float) -> None:
    gupta = {"strength": 1.0, "sliding": 1.0, "loading_power": 0.64, "pressure_power": 0.0}
    found = inlet_shear_heating(1.0, 1.0, loading, 1.0, 1.0, sliding, 0.005, 1.0, **gupta)
    assert found == pytest.approx(factor, rel=0.03)


@pytest.mark.literature(
    "Patir and Cheng (1978), J. Lubr. Technol. 100, 12, doi:10.1115/1.3453103; "
    "Tripp (1983), J. Lubr. Technol. 105, 458, doi:10.1115/1.3254641"
)
def test_lay_of_a_film_below_the_range_of_flow_factors_stays_what_it_was_there() -> None:
    """Patir and Cheng give them for h/sigma above 0.5; a = 0.5, k = 2 is Tripp's 1 + 3/H^2 to first order."""
    ridges = {"lay": 0.5, "onset": 6.0**0.5, "decay": 2.0, "saturation": 0.5}
    gone, thick = (roughness_lay(h, 1.0, **ridges) / h for h in (1e-9, 20.0))
    assert gone == pytest.approx((1.0 + 6.0 / 0.25) ** 0.5, rel=1e-6)
    assert thick == pytest.approx(1.0 + 3.0 / 20.0**2, rel=1e-4)


def test_thinning_grows_with_stress_and_stops_for_a_newtonian_oil() -> None:
    oil = {"critical_stress": 5e3, "plateau": 0.0, "stress_rule": 1.0, "onset": 1.0, "sliding": 1.0}
    films = [inlet_shear_thinning(2e-7, 0.015, 2.0, 0.0, index=n, **oil) for n in (1.0, 0.9, 0.7)]
    assert films[0] == 2e-7
    assert films[0] > films[1] > films[2] > 0.2 * films[0]


@pytest.mark.parametrize(("onset", "times"), [(1.0, 2.0), (2.0, 4.0)])
def test_loss_of_film_sets_in_with_that_power_of_stress(onset: float, times: float) -> None:
    """Far below the critical stress Carreau's and Eyring's viscosities fall with its square."""
    oil = {"index": 0.7, "plateau": 0.0, "stress_rule": 1.0, "onset": onset, "sliding": 0.0}
    lost = [1.0 - inlet_shear_thinning(2e-7, 0.015, 2.0, 0.0, critical_stress=g, **oil) / 2e-7 for g in (4e8, 2e8)]
    assert lost[1] / lost[0] == pytest.approx(times, rel=2e-3)


def test_sliding_thins_the_inlet_as_far_as_it_has_part_in_its_shear() -> None:
    oil = {"index": 0.75, "critical_stress": 5e3, "plateau": 0.0, "stress_rule": 1.0, "onset": 1.0}
    rolling, apart, taking_part = (
        inlet_shear_thinning(2e-7, 0.015, 2.0, slip, **oil, sliding=part)
        for slip, part in ((0.0, 1.0), (1.0, 0.0), (1.0, 1.0))
    )
    assert rolling == apart > taking_part
