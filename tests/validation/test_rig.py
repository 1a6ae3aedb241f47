"""The proof's own base model against numbers from outside it."""

import json
from dataclasses import replace

import numpy as np
import pytest

from mixedlub.validation.build import read_case, rig_of, share_at
from mixedlub.validation.involute import Gears, path_of_contact
from mixedlub.validation.rig import (
    Calibration,
    Contact,
    Oil,
    Rig,
    Solid,
    lubricate,
    mix,
    overlap,
    press,
    readings,
    shear,
    start,
    summits,
    touch,
)

CASES = [f"case_{number:03d}" for number in range(8)]


def _told(shared, name):
    truth = json.loads((shared / "cases" / name / "truth.json").read_text())
    rows = truth["rows"]
    return truth, {column: dict(zip(rows["run"], rows[column])) for column in ("nominal", "base")}


@pytest.mark.parametrize("table", ["recordings.csv", "conditions.csv"])
@pytest.mark.parametrize("name", CASES)
def test_literature_nominal_values_of_the_practice_cases(shared, name, table):
    case = read_case(shared / "cases" / name, table)
    _, told = _told(shared, name)
    expected = [told["nominal"][run] for run in case.columns["run"]]
    np.testing.assert_allclose(readings(rig_of(case), case.nominal), expected, rtol=5e-4)


@pytest.mark.parametrize("name", CASES)
def test_literature_base_values_at_the_calibration_that_was_drawn(shared, name):
    case = read_case(shared / "cases" / name)
    truth, told = _told(shared, name)
    theta = {key.removesuffix("_scale"): value for key, value in truth["theta"].items()}
    expected = [told["base"][run] for run in case.columns["run"]]
    np.testing.assert_allclose(readings(rig_of(case), Calibration(**theta)), expected, rtol=5e-4)


def _reference_points() -> Contact:
    """The 17/26 pair at 100 Nm and 1500 rpm, at the pitch point, HPSTC and the end of the path."""
    module = 25.4e-3 / 6
    tips = (0.5 * module * 19, 0.5 * module * 28)
    path = path_of_contact(Gears((17, 26), module, np.radians(22.5), tips, 14e-3))
    x = np.array([path.pitch, path.high_single, path.end])
    pinion = 1500 * np.pi / 30
    rig = Rig(
        kind="gear_pair",
        oil=Oil((40.0, 100.0), (30e-6, 6e-6), (18e-9, 13e-9)),
        solid=Solid(),
        radius=(x * (path.tangent_length - x) / path.tangent_length)[None, :],
        speed_1=(pinion * x)[None, :],
        speed_2=(pinion * 17 / 26 * (path.tangent_length - x))[None, :],
        share_force=np.array([[1.0, 1.0, 0.5]]) * 100 / path.base_radius[0],
        width=14e-3,
        step=1.0,
        temperature=np.array([60.0]),
        moments=np.array([[(0.321**2 + 0.374**2) * 1e-12, 0.005, 7.2e9]]),
        sequence=np.zeros(1),
        conditions={},
    )
    oil = {"viscosity": np.array([[0.01489]]), "pressure_viscosity": np.array([[14.81e-9]])}
    return press(replace(start(rig, Calibration()), **oil))


@pytest.mark.parametrize(
    ("quantity", "expected"),
    [
        ("radius", [8.3262e-3, 8.6914e-3, 7.9264e-3]),
        ("entrainment", [2.1630, 2.2417, 2.4039]),
        ("pressure", [0.9642e9, 0.9437e9, 0.6988e9]),
        ("film", [0.2214e-6, 0.2310e-6, 0.2502e-6]),
        ("area", [0.16749, 0.16309, 0.15449]),
        ("friction", [0.01675, 0.03633, 0.03889]),
    ],
)
def test_literature_local_reference_values(quantity, expected):
    """Values computed by another program, stated to hold within 0.5 %."""
    contact = mix(shear(touch(lubricate(_reference_points()))))
    found = contact.rig.radius if quantity == "radius" else getattr(contact, quantity)
    np.testing.assert_allclose(found[0], expected, rtol=5e-3)


def test_literature_summits_of_the_reference_surface():
    """Density 4.4106e10 per m2, radius 7.8332 um, spread 0.48970 um, offset 0.13298 um."""
    s = summits(_reference_points())
    found = [s.density[0, 0], s.radius[0, 0], s.spread[0, 0], s.offset[0, 0]]
    np.testing.assert_allclose(found, [4.4106e10, 7.8332e-6, 0.48970e-6, 0.13298e-6], rtol=1e-4)


def test_overlap_is_the_integral_it_stands_for():
    s = np.linspace(0.7, 12, 200001)
    integral = np.trapezoid((s - 0.7) * np.exp(-0.5 * s**2) / np.sqrt(2 * np.pi), s)
    assert overlap(np.array(0.7)) == pytest.approx(integral, rel=1e-8)


def test_contact_ratio_of_the_nasa_pair():
    """28/28 teeth of module 3.175 mm and 20 degrees: contact ratio 1.64 (NASA TM-107279)."""
    path = path_of_contact(Gears((28, 28), 3.175e-3, np.radians(20.0), (47.625e-3, 47.625e-3), 6.35e-3))
    assert path.contact_ratio == pytest.approx(1.64, abs=0.005)


def test_equal_sharing_carries_the_whole_force_everywhere():
    path = path_of_contact(Gears((28, 28), 3.175e-3, np.radians(20.0), (47.625e-3, 47.625e-3), 6.35e-3))
    phase = np.linspace(0.01, 0.99, 41)
    total = np.zeros_like(phase)
    for pair in range(2):
        x = path.start + (phase + pair) * path.base_pitch
        inside = x < path.end
        total += np.where(inside, share_at(path, None, np.ones(1), x)[0], 0.0)
    np.testing.assert_allclose(total, 1.0)


def test_nearest_torque_of_a_load_share_table():
    path = path_of_contact(Gears((28, 28), 3.175e-3, np.radians(20.0), (47.625e-3, 47.625e-3), 6.35e-3))
    rows = np.array([[50.0, 0.0, 0.2], [50.0, 90.0, 0.2], [100.0, 0.0, 0.8], [100.0, 90.0, 0.8]])
    share = share_at(path, rows, np.array([60.0, 120.0]), np.array([path.pitch]))
    np.testing.assert_allclose(share[:, 0], [0.2, 0.8])
