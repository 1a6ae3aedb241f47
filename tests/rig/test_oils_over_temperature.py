"""Friction of the shipped oils over temperature, and maps of oils."""

import numpy as np
import pytest

from mixedlub.base_model.chains import LINE
from mixedlub.chain.model import Model
from mixedlub.ehl.oil.lubricant import from_lubricant
from mixedlub.report.oil_maps import film_friction, known_range, oil_maps
from mixedlub.rig.build import lubricant
from mixedlub.schema.findings import collected
from mixedlub.schema.lubricant_section import Lubricant
from mixedlub.schema.oil_file import oil_names
from mixedlub.schema.toml_file import parse

KELVIN = np.linspace(20.0, 200.0, 19) + 273.15
PRESSURE, RADIUS, MODULUS = 1e9, 0.012, 226.4e9
SMOOTH = {"m0": 1e-18, "m2": 1e-6, "m4": 1e7}


def oil(name):
    with collected():
        return lubricant(parse(Lubricant, {"oil": name}, "rig.toml"))


@pytest.mark.parametrize("name", oil_names())
def test_friction_falls_with_temperature_at_1_GPa(name):
    """Traction of lubricating oils falls as they warm; one coefficient for all temperatures made it rise."""
    inputs = {
        **oil(name).inputs(KELVIN),
        **SMOOTH,
        "radius": RADIUS,
        "reduced_modulus": MODULUS,
        "line_load": PRESSURE**2 * 2.0 * np.pi * RADIUS / MODULUS,
        "entrainment_speed": 5.0,
        "sliding_speed": 1.0,
        "oil_temperature": KELVIN,
        "boundary_friction": 0.1,
        "solid_conductivity": 46.0,
        "solid_density": 7850.0,
        "solid_heat_capacity": 470.0,
    }
    found = Model(LINE, tuple(inputs), ("fluid_friction", "hertz_pressure"))(inputs)
    assert found["hertz_pressure"] == pytest.approx(PRESSURE)
    assert np.all(np.diff(found["fluid_friction"]) < 0.0)


@pytest.mark.parametrize("name", oil_names())
def test_viscosity_of_the_solver_falls_with_temperature_to_2_GPa(name):
    pressure, kelvin = np.meshgrid(np.linspace(0.0, 2e9, 11), KELVIN, indexing="ij")
    log, _, fall = from_lubricant(oil(name)).log_viscosity(pressure, kelvin)
    inside = kelvin <= 100.0 + 30.0 + 273.15
    assert np.all(fall[inside] < 0.0)
    assert np.all(np.isfinite(log))


def test_maps_hatch_what_no_source_knows():
    of = oil("mil_prf_23699")
    assert known_range(of) == (pytest.approx((10.0, 130.0)), (0.0, 1e9))
    figure = oil_maps(["mil_prf_23699", "pao4"])
    assert len(figure.axes) == 4
    assert len(figure.axes[0].patches) == 2  # above 130 degC and above 1 GPa
    # tau0 asinh(eta rate/tau0)/p with an independent Roelands at 14.2 1/GPa, 54 degC
    nu = 10**10 ** np.interp(np.log10(327.15), *np.log10([[313.15, 373.15], np.log10([23.7, 5.6])])) - 0.7
    eta = nu * 1e-6 * of.density_15 * (1.0 - of.density_change * 39.0)
    power = 14.2e-9 * 1.96e8 / (np.log(eta) + 9.67)
    thick = np.exp((np.log(eta) + 9.67) * (1.0 + 1e9 / 1.96e8) ** power - 9.67)
    stress = of.eyring_stress * np.arcsinh(thick * 1e6 / of.eyring_stress)
    assert film_friction(of, 1e6, np.array(1e9), np.array(327.15)) == pytest.approx(stress / 1e9, rel=1e-6)
