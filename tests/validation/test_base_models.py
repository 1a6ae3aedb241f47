"""The validation's own base models against numbers from outside them."""

import json

import numpy as np
import pytest

from mixedlub.validation.case_folder import read_case
from mixedlub.validation.contact import (
    Calibration,
    lubricate,
    mix,
    oil_of,
    overlap,
    shear,
    summits,
    touch,
)
from mixedlub.validation.rig import Case
from mixedlub.validation.rigs import discs, films, gears, tooth_contacts, viscosities
from mixedlub.validation.rigs.drives import Drive, gaussian
from mixedlub.validation.rigs.gears import Gears, path_of_contact, share_at

from .helpers import readings, reference_points

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
    np.testing.assert_allclose(readings(inputs_of(case)), expected, rtol=5e-4)


@pytest.mark.parametrize("name", CASES)
def test_literature_base_values_at_the_calibration_that_was_drawn(shared, name):
    case = read_case(shared / "cases" / name)
    truth, told = _told(shared, name)
    theta = {key.removesuffix("_scale"): value for key, value in truth["theta"].items()}
    expected = [told["base"][run] for run in case.columns["run"]]
    np.testing.assert_allclose(readings(inputs_of(case), Calibration(**theta)), expected, rtol=5e-4)


def inputs_of(case):
    return (gears if case.kind == "gear_pair" else discs).inputs_of(case)


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
    contact = mix(shear(touch(lubricate(reference_points()))))
    found = contact.rig.radius if quantity == "radius" else getattr(contact, quantity)
    np.testing.assert_allclose(found[0], expected, rtol=5e-3)


def test_literature_summits_of_the_reference_surface():
    """Density 4.4106e10 per m2, radius 7.8332 um, spread 0.48970 um, offset 0.13298 um."""
    s = summits(reference_points())
    found = [s.density[0, 0], s.radius[0, 0], s.spread[0, 0], s.offset[0, 0]]
    np.testing.assert_allclose(found, [4.4106e10, 7.8332e-6, 0.48970e-6, 0.13298e-6], rtol=1e-4)


def test_overlap_is_the_integral_it_stands_for():
    s = np.linspace(0.7, 12, 200001)
    integral = np.trapezoid((s - 0.7) * np.exp(-0.5 * s**2) / np.sqrt(2 * np.pi), s)
    assert overlap(np.array(0.7)) == pytest.approx(integral, rel=1e-8)


@pytest.mark.literature("Rebbechi, Oswald and Townsend (1996), NASA TM-107279")
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


@pytest.mark.literature("Hamrock and Dowson (1977), J. Lubr. Technol. 99, 264")
def test_film_of_a_steel_ball_on_glass_is_hamrock_and_dowson():
    """2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 e^(-0.73 k)) by hand, at the first reading."""
    rig = films.draw(np.random.default_rng(4))
    table, columns = rig.settings, rig.columns
    oil, celsius = oil_of(table), columns["oil_temperature_C"][0]
    bodies = zip(table["contact"]["poisson_ratio"], table["contact"]["youngs_modulus_GPa"])
    modulus = 2e9 / sum((1 - v**2) / e for v, e in bodies)
    radius = 1e-3 * table["contact"]["radius_mm"][0]
    speed = oil.viscosity_at(celsius) * columns["entrainment_speed_m_s"][0] / (modulus * radius)
    load = columns["load_N"][0] / (modulus * radius**2)
    film_m = 2.69 * radius * speed**0.67 * (oil.pressure_viscosity_at(celsius) * modulus) ** 0.53 * load**-0.067
    expected = 1e9 * film_m * (1 - 0.61 * np.exp(-0.73 * 1.03))
    assert rig.model(np.zeros(len(rig.names)), ())[0] == pytest.approx(expected)


def test_unnamed_sample_keeps_to_astm_d341_and_barus():
    """log10 log10(nu + 0.7) is straight in log10 T but for the bow, and ln eta straight in pressure."""
    rng = np.random.default_rng(1)
    riges = [viscosities.draw(rng) for _ in range(30)]
    rig = next(b for b in riges if len(b.names) == 5 and len(np.unique(b.columns["temperature_C"])) > 2)
    eta = rig.model(np.array([1.0, -1.5, 0.0, 1.0, 2.0]), ())
    celsius, pressure = rig.columns["temperature_C"], rig.columns["pressure_MPa"]
    doubled, slopes = [], []
    for level in np.unique(celsius):
        slope, start = np.polyfit(pressure[celsius == level], np.log(eta[celsius == level]), 1)
        left = np.log(eta[celsius == level]) - start - slope * pressure[celsius == level]
        assert np.abs(left).max() < 1e-9
        slopes.append(slope)
        doubled.append(np.exp(start))
    levels = np.unique(celsius)
    assert np.abs(np.diff(np.diff(slopes) / np.diff(levels))).max() < 1e-9
    fitted = []
    for density in (832.0, 865.0, 950.0):
        fall = 8e-4 if density == 950.0 else 7e-4
        nu = 1e3 * np.array(doubled) / (density * (1 - fall * (levels - 15)))
        line = np.log10(np.log10(nu + 0.7))
        fitted.append(np.abs(np.diff(np.diff(line) / np.diff(np.log10(levels + 273.15)))).max())
    assert min(fitted) < 1e-9


def test_tooth_contacts_are_those_of_the_path_of_contact():
    """At the pitch point nothing slides, and the speeds part on either side of it."""
    rig = tooth_contacts.draw(np.random.default_rng(6))
    case = Case(settings=rig.settings, columns=rig.columns, share=rig.share)
    path = gears.path_of_contact(gears.gears_of(rig.settings))
    pitch = np.full(len(rig.columns["run"]), np.degrees(path.pitch / path.base_radius[0]))
    at_pitch, later = tooth_contacts.at_angles(case, pitch), tooth_contacts.at_angles(case, pitch + 2.0)
    assert at_pitch.speed_1 == pytest.approx(at_pitch.speed_2)
    assert (later.speed_1 > later.speed_2).all()


def test_stribeck_rise_is_the_static_excess_at_rest_and_gone_at_speed():
    speed = np.array([-1.0, -1e-6, 1e-6, 1.0])
    flat = np.ones(4)
    state = Drive(flat, flat, flat, np.sign(speed), speed, 2.0, 0.0 * flat, flat)
    assert gaussian(state, 1.0, 0.1).running == pytest.approx([0.0, -0.6, 0.6, 0.0], abs=1e-9)
