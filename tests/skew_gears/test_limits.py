"""Limits of bevel and hypoid gears: bevel without offset, helical on parallel axes, and the exact closures."""

from dataclasses import replace
from math import cos, radians, sin

import numpy as np
import pytest

from mixedlub.gear import GearPair, RigidSharing, local_loss_factor, mesh
from mixedlub.skew_gears.blank import ToothData, blank
from mixedlub.skew_gears.contact_lines import contact_lines, mean_contact
from mixedlub.skew_gears.flank import contact_at
from mixedlub.skew_gears.pitch_cones import (
    METHODS,
    Basic,
    NoPitchConesError,
    crown_ratio,
    largest_offset,
    limit_curvature,
    pitch_cones,
)
from mixedlub.skew_gears.placing import axes
from tests.skew_gears.samples import BEVEL, GLEASON, KLINGELNBERG, OERLIKON, TEETH, TWENTY

SAMPLES = (BEVEL, GLEASON, OERLIKON, KLINGELNBERG)
BY_METHOD = pytest.mark.parametrize("basic", SAMPLES, ids=lambda one: f"method_{one.method}")


@BY_METHOD
def test_axes_have_the_given_angle_and_offset(basic):
    placed = axes(pitch_cones(basic))
    assert placed.shaft_angle == pytest.approx(basic.shaft_angle, abs=1e-9)
    assert placed.offset == pytest.approx(basic.offset, abs=1e-11)


@BY_METHOD
def test_sliding_at_the_mean_point_in_both_forms(basic):
    made = blank(basic, TEETH[basic])
    placed, (b1, b2) = axes(made.cones), made.cones.spiral
    pinion, wheel = (placed.velocity(member, np.zeros(3)) for member in (0, 1))
    mean = mean_contact(made)
    closed = np.linalg.norm(pinion) * sin(b1 - b2) / cos(b2)
    assert np.linalg.norm(pinion - wheel) == pytest.approx(closed, rel=1e-12, abs=1e-15)
    assert mean.sliding_speed[0] == pytest.approx(closed, rel=1e-12, abs=1e-15)
    assert np.linalg.norm(pinion) * cos(b1) == pytest.approx(np.linalg.norm(wheel) * cos(b2), rel=1e-12)
    assert abs((mean.sliding * mean.lengthwise).sum()) == pytest.approx(closed, rel=1e-12, abs=1e-15)


@BY_METHOD
def test_the_limit_angle_is_that_of_the_vectors(basic):
    """A normal at the limit pressure angle stops the contact: n (w1 x v2 - w2 x v1) = 0."""
    cones = pitch_cones(basic)
    placed, beta, limit = axes(cones), cones.spiral[1], cones.limit_angle
    normal = np.array([-sin(beta) * cos(limit), cos(beta) * cos(limit), sin(limit)])
    v1, v2 = (placed.velocity(member, np.zeros(3)) for member in (0, 1))
    stop = np.cross(placed.turning[0], v2) - np.cross(placed.turning[1], v1)
    assert normal @ stop == pytest.approx(0.0, abs=1e-12 * np.linalg.norm(stop))


def test_method_1_fits_the_cutter():
    cones = pitch_cones(GLEASON)
    assert 1.0 / limit_curvature(cones) == pytest.approx(GLEASON.cutter_radius, rel=1e-9)


@pytest.mark.parametrize(("offset", "angles"), [(0.05e-3, (17.215, 72.785)), (15e-3, (21.288, 68.324))])
def test_small_offsets_of_method_1_have_pitch_cones(offset, angles):
    """Near the bevel pair: atan(13/42) = 17.199 degrees; 15 mm is the sample of the standard."""
    assert np.degrees(pitch_cones(replace(GLEASON, offset=offset)).angle) == pytest.approx(angles, abs=6e-4)


@pytest.mark.parametrize(("basic", "offset"), [(OERLIKON, 1e-7), (KLINGELNBERG, 1e-13)], ids=["method_2", "method_3"])
def test_vanishing_offset_gives_the_bevel_pair(basic, offset):
    general = METHODS[basic.method](replace(basic, offset=offset))
    bevel = pitch_cones(replace(basic, offset=0.0))
    error = max(1e-9, 20.0 * offset)
    assert (*general.angle, *general.spiral) == pytest.approx((*bevel.angle, *bevel.spiral), abs=error)
    assert general.radius == pytest.approx(bevel.radius, rel=error)


@BY_METHOD
def test_without_offset_every_method_is_the_bevel_pair(basic):
    cones = pitch_cones(replace(basic, offset=0.0))
    assert np.tan(cones.angle[0]) == pytest.approx(sin(basic.shaft_angle) / (basic.ratio + cos(basic.shaft_angle)))
    assert sum(cones.angle) == pytest.approx(basic.shaft_angle, abs=1e-12)
    assert cones.limit_angle == pytest.approx(0.0, abs=1e-12)
    assert mean_contact(blank(replace(basic, offset=0.0), TEETH[basic])).sliding_speed[0] == pytest.approx(
        0.0, abs=1e-15
    )


def helical():
    """A helical pair, as bevel gears without shaft angle and in the room of gears."""
    beta, teeth, module = radians(20.0), (23, 67), 2e-3
    basic = Basic(0, teeth, 0.0, 0.0, module * teeth[1] / cos(beta), 26e-3, beta, 0.1)
    return blank(basic, ToothData(TWENTY)), GearPair(teeth, module, TWENTY[0], 26e-3, beta)


def test_without_shaft_angle_the_flanks_are_helical():
    made, pair = helical()
    placed = axes(made.cones)
    found = contact_at(made, placed, np.linspace(-13e-3, 13e-3, 5)[:, None], np.linspace(-1.8e-3, 1.8e-3, 7))
    out = found.place - placed.point[0]
    along = out @ placed.direction[0]
    place = np.sqrt((out**2).sum(axis=-1) - along**2 - pair.base_radius[0] ** 2)
    other = pair.line_of_action_length - place
    radius = place * other / pair.line_of_action_length / cos(pair.base_helix_angle)
    assert placed.offset == pytest.approx(pair.working_centre_distance, rel=1e-9)
    assert found.radius == pytest.approx(radius, rel=1e-9)
    assert found.entrainment == pytest.approx((place + other / pair.gear_ratio) / 2, rel=1e-9)
    assert found.sliding_speed == pytest.approx(np.abs(place - other / pair.gear_ratio), rel=1e-9, abs=1e-14)


def test_without_shaft_angle_lines_and_loss_are_helical():
    made, pair = helical()
    lines = contact_lines(made, crowning="none", face_share=1.0, positions=32, points=121)
    power = lines.over_positions(lines.weight * lines.contact.sliding_speed)
    factor = float((power / lines.over_positions(lines.weight * lines.drive_speed)).mean())
    assert lines.contact_ratio == pytest.approx(pair.contact_ratio + pair.overlap_ratio, rel=1e-3)
    mean_length = pair.face_width * pair.contact_ratio / cos(pair.base_helix_angle)
    assert lines.over_positions(lines.length).mean() == pytest.approx(mean_length, rel=1e-3)
    assert factor == pytest.approx(float(local_loss_factor(mesh(pair, RigidSharing()), 100.0)), rel=1e-3)


@BY_METHOD
@pytest.mark.parametrize("drive", [True, False])
def test_contact_holds_the_equation_of_meshing(basic, drive):
    made = blank(basic, TEETH[basic])
    along, height = np.linspace(-0.01, 0.01, 5)[:, None], np.linspace(-made.addendum[1], made.addendum[0], 4)
    found = contact_at(made, axes(made.cones), along, height, drive=drive)
    normal_speed = np.einsum("...i,...i->...", found.normal, found.sliding)
    assert np.abs(normal_speed).max() < 1e-14
    assert (found.curvature > 0.0).all()


@BY_METHOD
def test_relative_curvature_is_that_of_both_flanks(basic):
    """Both flanks, each turned back to one position, touch along a line and part from it by the curvature."""
    made = blank(basic, TEETH[basic])
    placed, step = axes(made.cones), 2e-5
    steps = step * np.arange(-2, 3)
    near = contact_at(made, placed, steps[:, None], steps)
    mean = mean_contact(made)
    turned = near.wheel_angle
    wheel = about(placed, 1, near.place, -turned)
    pinion = about(placed, 0, near.place, turned * made.cones.ratio)
    normal = mean.normal[0]
    first, second = mean.across[0], np.cross(mean.across[0], normal)
    bends = []
    for place in (pinion, wheel):
        x, y, z = (place.reshape(-1, 3) @ one for one in (first, second, normal))
        terms = np.stack([np.ones(x.size), x, y, x * x, x * y, y * y, x**3, x * x * y, x * y * y, y**3], axis=1)
        bends.append(np.linalg.lstsq(terms * 1.0, z, rcond=None)[0][3:6])
    across, mixed, along = bends[1] - bends[0]
    assert abs(2 * across) == pytest.approx(float(mean.curvature[0]), rel=2e-3)
    assert abs(mixed) < 5e-3 * abs(across)
    assert abs(along) < 5e-3 * abs(across)


def about(placed, member, place, angle):
    """Places turned about an axis."""
    axis, point = placed.direction[member], placed.point[member]
    out = place - point
    along = (out @ axis)[..., None] * axis
    cosine, sine = np.cos(angle)[..., None], np.sin(angle)[..., None]
    return point + along + cosine * (out - along) + sine * np.cross(axis, out)


def test_the_trace_of_face_milling_is_the_circle_of_the_cutter():
    made = blank(GLEASON, TEETH[GLEASON])
    along = np.linspace(-0.014, 0.014, 7)
    radius, turn = made.trace.distance + along, made.trace.polar_angle(along)
    x, y = radius * np.cos(turn), radius * np.sin(turn)
    beta = made.cones.spiral[1]
    centre = made.trace.distance - GLEASON.cutter_radius * sin(beta), GLEASON.cutter_radius * cos(beta)
    assert np.hypot(x - centre[0], y - centre[1]) == pytest.approx(GLEASON.cutter_radius, rel=1e-12)
    assert 1 / made.trace.curvature(along) == pytest.approx(GLEASON.cutter_radius, rel=1e-12)


@pytest.mark.parametrize("basic", [OERLIKON, KLINGELNBERG], ids=["method_2", "method_3"])
def test_the_trace_of_face_hobbing_has_its_spiral_angle_and_curvature(basic):
    trace, step = blank(basic, TEETH[basic]).trace, 1e-6
    along = np.linspace(-0.012, 0.012, 5)
    slope = (trace.polar_angle(along + step) - trace.polar_angle(along - step)) / (2 * step)
    beta = trace.spiral_angle(along)
    heading = trace.polar_angle(along + step) + trace.spiral_angle(along + step)
    heading -= trace.polar_angle(along - step) + trace.spiral_angle(along - step)
    assert slope * (trace.distance + along) == pytest.approx(np.tan(beta), rel=1e-7)
    assert heading / (2 * step) * np.cos(beta) == pytest.approx(trace.curvature(along), rel=1e-7)
    assert crown_ratio(basic, blank(basic, TEETH[basic]).cones) < 1.0


def test_the_largest_offset_has_pitch_cones_and_no_larger_one():
    far = replace(GLEASON, offset=90e-3)
    with pytest.raises(NoPitchConesError):
        pitch_cones(far)
    most = largest_offset(far)
    assert pitch_cones(replace(far, offset=most)).angle[0] > 0.0
    with pytest.raises(NoPitchConesError):
        pitch_cones(replace(far, offset=most + 2e-3 * far.wheel_diameter))
