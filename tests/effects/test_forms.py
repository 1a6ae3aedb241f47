"""Effects with several literature forms: what each parameter must do at its ends."""

from __future__ import annotations

import numpy as np
import pytest

from mixedlub.effects.bearing_drag import bearing_drag
from mixedlub.effects.pressure_viscosity_law import LOW, pressure_viscosity_law

STRAIGHT = {
    "roelands": 0.0,
    "exponent": 0.6,
    "bend_down": 0.0,
    "bend_up": 0.0,
    "down_with_temperature": 0.0,
    "up_with_temperature": 0.0,
}
BEARINGS = {"strength": 1.0, "loaded": 1.0, "load_power": 1.0, "rolling_power": 0.0}
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


@pytest.mark.parametrize(("speed", "rise"), [(0.05, 1.4), (2000.0, 0.0)])
def test_bearings_rub_where_they_have_no_film_and_only_there(speed: float, rise: float) -> None:
    """SKF's 0.12 over 0.05 for the part that load adds; at rest it is nearly all of the torque."""
    motion = {"pinion_speed": speed, "gear_speed": speed, "viscosity": 0.01275}
    without, rubbing = (bearing_drag(0.0, **GEAR, **motion, **BEARINGS, rubbing=m) for m in (0.0, 1.4))
    loaded = without - bearing_drag(0.0, **GEAR, **motion, **{**BEARINGS, "loaded": 0.0}, rubbing=0.0)
    assert (rubbing - without) / loaded == pytest.approx(rise, abs=0.02)
