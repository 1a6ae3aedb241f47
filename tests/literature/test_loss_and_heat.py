"""Loss factors and flash temperatures against the closed forms and constants that standards and papers print."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mixedlub.laws.contact import line_hertz_half_width, line_hertz_pressure
from mixedlub.laws.heating import flash_per_friction, largest_flash_temperature
from mixedlub.study import read_study, run_study
from tests.gear.pairs import FZG_C

GEARS = """
schema = "mixedlub-study/1"
surfaces = { ground = { m0_um2 = 0.1, m2 = 0.0025, m4_per_um2 = 0.0036 } }
conditions = { torque_Nm = [100, 300], speed_rpm = [500, 2000], oil_temperature_C = [60] }
[gears]
"""
HONG = "teeth = [17, 26]\nnormal_module_mm = 4.2333333\npressure_angle_deg = 22.5\nface_width_mm = 14.0\n"
FZG = """
teeth = [16, 24]
normal_module_mm = 4.5
pressure_angle_deg = 20.0
face_width_mm = 14.0
profile_shift = [0.1817, 0.1715]
centre_distance_mm = 91.5
tip_diameter_mm = [82.46, 118.36]
"""


@pytest.mark.literature("H. Ohlendorf (1958), in the form of Niemann and Winter, Maschinenelemente II; FZG C: 0.195")
@pytest.mark.parametrize(("gears", "factor"), [(HONG, 0.1891), (FZG, 0.1950)], ids=["17/26", "FZG C"])
def test_rigid_teeth_have_the_loss_factor_of_ohlendorf(tmp_path: Path, gears: str, factor: float) -> None:
    """The integral along the path gives what the closed form has."""
    path = tmp_path / "study.toml"
    path.write_text(GEARS + gears, encoding="utf-8")
    rows = run_study(read_study(path)).to_pandas()
    assert rows["loss_factor_H_V"].to_numpy() == pytest.approx(factor, abs=5e-5)
    assert rows["loss_factor_H_VL"].to_numpy() == pytest.approx(factor, abs=5e-5)


FORCE, SPEED, FRICTION = 5000.0, 8.3, 0.05
"""Force at the pitch circle (N), pitch line speed (m/s) and friction of the contacts below."""
EFFUSIVITY = 435.0 * np.sqrt(1000.0)
"""That of the steels for which ISO/TR 13989-1 prints X_M = 50: 435 N/(mm^0.5 m^0.5 s^0.5 K), in SI."""


def by_standard(parameter: float) -> float:
    """Flash temperature (K) by the factors X_M and X_G of the standard, at a place Gamma of the line of action."""
    ratio, working = FZG_C.gear_ratio, FZG_C.working_pressure_angle
    angle = 1.22 * (np.sin(working) * np.cos(FZG_C.pressure_angle)) ** 0.25
    angle /= np.sqrt(np.cos(working) * np.cos(FZG_C.transverse_pressure_angle))
    roots = abs(np.sqrt(1.0 + parameter) - np.sqrt(1.0 - parameter / ratio))
    geometry = 0.51 * angle * np.sqrt(ratio + 1.0) * roots / ((1.0 + parameter) * (ratio - parameter)) ** 0.25
    load = FORCE / (FZG_C.face_width * 1e3)
    return float(FRICTION * 50.0 * geometry * load**0.75 * SPEED**0.5 / (FZG_C.working_centre_distance * 1e3) ** 0.25)


def contact(place: float) -> tuple[float, float, float, float]:
    """Line load, reduced radius and the two surface speeds at a place (m) of the line of action."""
    radius = FZG_C.operating_radius[0]
    speed, other = SPEED / radius, FZG_C.line_of_action_length - place
    load = FORCE * radius / FZG_C.base_radius[0] / FZG_C.face_width
    return load, place * other / FZG_C.line_of_action_length, place * speed, other * speed / FZG_C.gear_ratio


def by_law(place: float) -> float:
    """Flash temperature (K) by the laws of the package, for a body of unit density and heat capacity."""
    load, radius, first, second = contact(place)
    pressure = line_hertz_pressure(load, radius, FZG_C.reduced_modulus)
    half_width = line_hertz_half_width(load, radius, FZG_C.reduced_modulus)
    speeds = 0.5 * (first + second), abs(first - second)
    return float(
        largest_flash_temperature(flash_per_friction(pressure, half_width, *speeds, EFFUSIVITY**2, 1.0, 1.0), FRICTION)
    )


PLACES = np.linspace(FZG_C.path_start, FZG_C.path_end, 7)


@pytest.mark.literature("ISO/TR 13989-1:2000, flash temperature with X_M = 50 for steel and the geometry factor X_G")
@pytest.mark.parametrize("place", PLACES)
def test_flash_temperature_is_that_of_the_standard(place: float) -> None:
    parameter = place / FZG_C.pitch_point - 1.0
    assert by_law(place) == pytest.approx(by_standard(parameter), rel=0.01)


@pytest.mark.literature(
    "H. Blok, Proc. Gen. Disc. Lubrication, IMechE 2 (1937) 222: constant 1.11 over the root of 2 b"
)
@pytest.mark.parametrize("place", PLACES)
def test_flash_temperature_is_that_of_blok(place: float) -> None:
    load, radius, first, second = contact(place)
    half_width = line_hertz_half_width(load, radius, FZG_C.reduced_modulus)
    roots = EFFUSIVITY * (np.sqrt(first) + np.sqrt(second)) * np.sqrt(2.0 * half_width)
    blok = 1.11 * FRICTION * load * abs(first - second) / roots
    assert by_law(place) == pytest.approx(blok, rel=2e-3)
