"""Laws of machine parts against numbers that papers print and against public programs."""

from __future__ import annotations

import numpy as np
import pytest

from mixedlub.chain.part_law import PartLaw
from mixedlub.parts import find, series_coefficients

RPM = np.pi / 30


def given(law: PartLaw, series: str | None = None, **own: float) -> dict[str, float]:
    """The coefficients of a law: those of a series, then the user's, then defaults."""
    known = {} if series is None else series_coefficients(law, series, "series")
    return law.values({**known, **own})


@pytest.mark.literature("Gear-Calculation (FEUP), its bearings NJ 406 and QJ 308, without their drag")
@pytest.mark.parametrize(
    ("name", "series", "size", "load", "own", "torque"),
    [
        ("skf_cylindrical", "NJ4", (0.030, 0.090), (3000.0, 0.0), {"film_friction": 0.02}, 95.831e-3),
        ("skf_angular_contact", "QJ3", (0.040, 0.090), (0.0, 2000.0), {"film_friction": 0.05}, 114.377e-3),
    ],
)
def test_skf_bearings_are_those_of_a_public_program(
    name: str,
    series: str,
    size: tuple[float, float],
    load: tuple[float, float],
    own: dict[str, float],
    torque: float,
) -> None:
    """1000 rpm, oil of 20 mm^2/s; numbers of the program's formulas, evaluated apart from this package."""
    law = find("bearing", name)
    found = law.law(1000 * RPM, 20e-6 * 850.0, 850.0, *load, *size, **given(law, series, **own))
    assert float(found) == pytest.approx(torque, rel=1e-4)


@pytest.mark.literature("a public MATLAB program for gearboxes of electric cars: SKF series 160 with grease factors")
def test_a_deep_groove_bearing_under_both_loads_is_that_of_a_public_program() -> None:
    """1500 N and 600 N at 3000 rpm, oil of 9.12 mm^2/s, bearing 60 x 95 with C0 of 14 kN."""
    law = find("bearing", "skf_deep_groove")
    own = given(law, "160", replenishment=6e-8, film_friction=0.04)
    found = law.law(3000 * RPM, 9.12e-6 * 820.0, 820.0, 1500.0, 600.0, 0.060, 0.095, 14e3, **own)
    assert float(found) == pytest.approx(125.737e-3, rel=1e-4)


@pytest.mark.literature("ISO/TR 14179-2, P = 7.69e-6 d^2 n in W, mm, rpm, as two public programs have it")
def test_seals_lose_what_the_report_says() -> None:
    law = find("seal", "iso_tr_14179_2")
    torque = law.law(0.01, 850.0, 0.040, **given(law))
    assert float(torque) * 3000 * RPM == pytest.approx(7.69e-6 * 40.0**2 * 3000.0, rel=1e-3)


@pytest.mark.literature("P. Luke, A. V. Olver (1999), Proc. IMechE G 213, 337, doi:10.1243/0954410991533061, abstract")
def test_a_dipping_gear_differs_by_the_factor_that_luke_and_olver_print() -> None:
    """72 teeth, 3 mm, 4500 rpm, 54 mm deep in 20W50: 75 N m by Boness, below 5 N m by another method.

    Not printed: face width, taken as 15 to 34 mm, viscosity of 160 mm^2/s, 10 l of oil.
    """
    oil, speed = (160e-6 * 850.0, 850.0), 4500 * RPM
    narrow, wide = (float(find("churning", "boness").law(0.108, speed, b, *oil, 0.054)) / speed for b in (0.015, 0.034))
    assert narrow < 75.0 < wide
    other = find("churning", "changenet_velex").law(0.108, speed, 0.034, 3e-3, 72.0, 0.0, *oil, 0.054, 0.010)
    assert float(other) / speed < 5.0


def disc(radius: float, speed: float) -> float:
    """Power (W) of a smooth disc in air, both sides, turbulent."""
    reynolds = 1.2 * speed * radius**2 / 1.8e-5
    return 0.073 * reynolds**-0.2 * 1.2 * speed**3 * radius**5


@pytest.mark.literature("T. von Karman (1921): moment of a turbulent disc, both sides, 0.073 Re^-0.2 rho omega^2 R^5")
@pytest.mark.parametrize("name", ["anderson_loewenthal", "dawson", "diab"])
@pytest.mark.parametrize(
    ("diameter", "width", "module", "teeth", "rpm"),
    [(0.2794, 0.0284, 6.35e-3, 44.0, 10_000.0), (1.160, 0.190, 16e-3, 72.0, 1000.0)],
)
def test_a_gear_in_air_loses_more_than_a_smooth_disc(
    name: str, diameter: float, width: float, module: float, teeth: float, rpm: float
) -> None:
    law, radius = find("windage", name), 0.5 * diameter
    state = {
        "wheel_radius": radius,
        "root_diameter": diameter - 2.5 * module,
        "shaft_speed": rpm * RPM,
        "face_width": width,
        "gear_module": module,
        "wheel_teeth": teeth,
        "viscosity": 0.010,
    }
    found = float(law.law(*(state[quantity] for quantity in law.reads), **given(law)))
    assert 5.0 * disc(radius, rpm * RPM) < found < 30.0 * disc(radius, rpm * RPM)
