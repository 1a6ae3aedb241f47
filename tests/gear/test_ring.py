"""Ring gears: geometry, curvature, sliding, loss and interference of internal pairs."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from mixedlub.gear import GearPair, LdpSharing, RigidSharing, iso_stiffness, local_loss_factor, loss_factors, mesh
from mixedlub.gear.corner_contact import corner_gap
from mixedlub.gear.geometry import involute
from mixedlub.gear.ring import tip_clearance
from mixedlub.gear.tooth import tooth
from profiles.errors import InputError

ALPHA = math.radians(20)
PLANET = GearPair((27, -72), 2e-3, ALPHA, 20e-3)
HELICAL = replace(PLANET, helix_angle=math.radians(15))
SHIFTED = GearPair((23, -67), 3e-3, ALPHA, 30e-3, profile_shift=(0.1, 0.05))


class TestLiterature:
    def test_a_printed_profile_shifted_pair(self):
        """Published worksheet: z 17 and 96, module 14, shifts 0.2 and 0.5 (out of the ring: -0.5 by ISO 21771)."""
        pair = GearPair((17, -96), 14e-3, ALPHA, 100e-3, profile_shift=(0.2, -0.5))
        assert math.degrees(pair.working_pressure_angle) == pytest.approx(21.1251, abs=5e-5)
        assert -1e3 * pair.working_centre_distance == pytest.approx(557.0887, abs=5e-5)

    def test_metric_gear_technology_s_internal_pair(self):
        """Elements of Metric Gear Technology, table 5-1: 16/24 teeth, module 3, shift 0.5: 13.1683 mm."""
        pair = GearPair((16, -24), 3e-3, ALPHA, 10e-3, profile_shift=(0.0, -0.5))
        assert -1e3 * pair.working_centre_distance == pytest.approx(13.1683, abs=5e-5)

    @pytest.mark.parametrize("pair", [PLANET, SHIFTED, replace(PLANET, profile_shift=(0.2, -0.3))])
    def test_ohlendorf_keeps_its_form_with_u_less_one(self, pair):
        u = pair.gear_ratio
        ends = pair.approach_ratio**2 + pair.recess_ratio**2
        closed = math.pi * (u - 1) / (pair.teeth[0] * u) * (1 - pair.contact_ratio + ends)
        assert pair.loss_factor == pytest.approx(closed, rel=1e-12)
        assert local_loss_factor(mesh(pair, RigidSharing()), 100.0) == pytest.approx(closed, rel=1e-4)


class TestKinematics:
    @pytest.mark.parametrize("pair", [PLANET, HELICAL, SHIFTED])
    def test_mean_sliding_is_buckingham_s_factor(self, pair):
        points = mesh(pair, RigidSharing())
        speed = np.abs(points.sliding_per_speed) / pair.base_radius[0]
        mean = np.sum(points.weight * speed) / np.sum(points.weight)
        assert mean == pytest.approx(loss_factors(pair)[2].value, rel=1e-4)

    @pytest.mark.parametrize("pair", [PLANET, SHIFTED])
    def test_sliding_is_the_difference_of_speeds_times_the_distance_from_the_pitch_point(self, pair):
        points = mesh(pair, RigidSharing())
        expected = (1 - 1 / pair.gear_ratio) * (points.position - pair.pitch_point)
        assert points.sliding_per_speed == pytest.approx(expected, abs=1e-15)

    def test_curvatures_subtract(self):
        """1/R = 1/R1 - 1/R2 with both radii measured from the base tangent points."""
        points = mesh(SHIFTED, RigidSharing())
        inner = points.position
        outer = inner + abs(SHIFTED.working_centre_distance) * math.sin(SHIFTED.working_pressure_angle)
        assert 1 / points.radius == pytest.approx(1 / inner - 1 / outer, rel=1e-12)

    def test_surface_speeds_by_vectors(self):
        """Both wheels turn the same way about their axes: speeds of the contact point along the flank."""
        pair, points = SHIFTED, mesh(SHIFTED, RigidSharing())
        alpha, centre = pair.working_pressure_angle, abs(pair.working_centre_distance)
        along, across = complex(math.sin(alpha), math.cos(alpha)), complex(math.cos(alpha), -math.sin(alpha))
        inner_axis, ring_axis = 0j, complex(-centre, 0)
        place = inner_axis + pair.base_radius[0] * across + points.position * along
        inner, ring = 1j * (place - inner_axis), 1j * (place - ring_axis) / pair.gear_ratio
        tangential = [np.real(v * np.conj(across)) for v in (inner, ring)]
        normal = [np.real(v * np.conj(along)) for v in (inner, ring)]
        assert normal[0] == pytest.approx(normal[1], rel=1e-12)
        assert points.sliding_per_speed == pytest.approx(tangential[1] - tangential[0], abs=1e-15)
        assert points.entrainment_per_speed == pytest.approx(-(tangential[0] + tangential[1]) / 2, rel=1e-12)


def _features(teeth: int) -> np.ndarray:
    """Sizes of a pair whose second wheel tends to a rack, with a rack's straight tip line."""
    pair = GearPair((27, teeth), 2e-3, ALPHA, 20e-3, dedendum=1.6)
    points = mesh(pair, RigidSharing())
    share = (points.position - pair.path_start) / (pair.path_end - pair.path_start)
    radius = np.interp(0.4, share, points.radius)
    return np.array([pair.path_start, pair.contact_ratio, pair.loss_factor, pair.end_mean_sliding, radius * 0 + 1.0])


class TestLimits:
    def test_an_infinite_ring_is_the_rack(self):
        """Ring and external wheel approach the rack from both sides, in even powers of 1/z2 for their mean."""
        near, far = ((_features(z) + _features(-z)) / 2 for z in (4000, 8000))
        found = (4 * far - near) / 3
        radius, base = 27e-3, 27e-3 * math.cos(ALPHA)
        pitch = math.pi * 2e-3 * math.cos(ALPHA)
        start = radius * math.sin(ALPHA) - 2e-3 / math.sin(ALPHA)
        approach = 2e-3 / math.sin(ALPHA) / pitch
        recess = (math.sqrt(29e-3**2 - base**2) - radius * math.sin(ALPHA)) / pitch
        factor = math.pi / 27 * (1 - approach - recess + approach**2 + recess**2)
        sliding = (approach + recess) * pitch / (4 * base)
        rack = np.array([start, approach + recess, factor, sliding])
        assert found[:4] == pytest.approx(rack, rel=1e-9)

    def test_the_flank_of_an_infinite_ring_is_flat(self):
        curvature = [
            1 / (x * (pair.line_of_action_length - x) / pair.line_of_action_length) - 1 / x
            for z in (9999, -9999)
            for pair in [GearPair((27, z), 2e-3, ALPHA, 20e-3)]
            for x in [pair.pitch_point]
        ]
        assert sum(curvature) / 2 * PLANET.pitch_point == pytest.approx(0.0, abs=1e-9)

    def test_either_sign_of_tips_and_centre_distance_says_the_same(self):
        given = {"tip_radius": (29e-3, 70.4e-3), "centre_distance": 45.0e-3}
        signed = {"tip_radius": (29e-3, -70.4e-3), "centre_distance": -45.0e-3}
        assert replace(PLANET, **given) == replace(PLANET, **signed)
        assert replace(PLANET, **given).contact_ratio == pytest.approx(1.70, abs=0.15)

    def test_backlash_falls_as_the_centres_part(self):
        assert [replace(PLANET, centre_distance=a).backlash > 0 for a in (44.98e-3, 45.02e-3)] == [True, False]


def _outline(pair: GearPair, wheel: int, count: int = 400) -> np.ndarray:
    """Right and left flank and tip of one tooth as complex points about its axis, tooth centre on the real axis."""
    base, tip = abs(pair.base_radius[wheel]), abs(pair.tip_radii[wheel])
    reference = abs(pair.reference_radius[wheel])
    other = reference * 0.97 if wheel == 0 else reference + 1.1 * pair.normal_module
    radius = np.linspace(max(base, other), tip, count) if wheel == 0 else np.linspace(other, tip, count)
    alpha = np.arccos(np.minimum(base / radius, 1.0))
    half = pair.half_tooth_angle(wheel) - (np.tan(alpha) - alpha)
    flank = radius * np.exp(1j * np.abs(half))
    return np.concatenate([flank, np.conj(flank)[::-1]])


class TestInterference:
    def test_the_clearance_of_the_tips_is_that_of_drawn_teeth(self):
        """The corner of the inner tip follows its trochoid until it passes the tip circle of the ring."""
        pair = GearPair((30, -40), 3e-3, ALPHA, 20e-3)
        centre, ratio = abs(pair.working_centre_distance), pair.gear_ratio
        inner, outer = (abs(tip) for tip in pair.tip_radii)
        half_inner = pair.half_tooth_angle(0) - involute(math.acos(pair.base_radius[0] / inner))
        half_ring = abs(pair.half_tooth_angle(1) - involute(math.acos(pair.base_radius[1] / pair.tip_radii[1])))
        # A tooth of the inner wheel and a space of the ring stand on the line of centres, without backlash.
        turn = np.linspace(0.0, 1.5, 400_001)
        corner = centre + inner * np.exp(1j * (turn + half_inner))
        leaves = int(np.argmax(np.abs(corner) < outer))
        angle = math.pi / 40 - half_ring - (np.angle(corner[leaves]) - turn[leaves] / ratio)
        assert outer * angle == pytest.approx(tip_clearance(pair), abs=2e-7)

    @pytest.mark.parametrize(
        ("change", "rule"),
        [
            ({"teeth": (40, -45)}, "tips of the ring .* overlap by .* mm"),
            ({"teeth": (40, -41)}, "tips of the ring .* overlap by .* mm"),
            ({"tip_radius": (29e-3, 69.8e-3)}, r"undercut: contact starts .* at least 140\.\d+ mm"),
            ({"tip_radius": (29e-3, 67.0e-3)}, "base circle"),
            ({"profile_shift": (0.0, 1.0)}, "too positive"),
            ({"centre_distance": 42.0e-3}, "difference of the base radii, 42.2862 mm"),
            ({"centre_distance": 45.5e-3}, "overlap"),
        ],
    )
    def test_what_does_not_fit_is_refused_with_its_number(self, change, rule):
        with pytest.raises(InputError, match=rule):
            replace(PLANET, **change)

    def test_the_diameter_named_in_the_message_is_accepted(self):
        with pytest.raises(InputError) as refused:
            replace(PLANET, tip_radius=(29e-3, 69.8e-3))
        named = float(refused.value.rule.split("at least ")[1].split(" mm")[0])
        assert replace(PLANET, tip_radius=(29e-3, named / 2e3)).path_start > 0


class TestElasticTeeth:
    def test_the_load_adds_up(self):
        points = mesh(HELICAL, LdpSharing())
        carried = points.load_share(100.0) @ points.weight
        assert carried * math.cos(HELICAL.base_helix_angle) == pytest.approx(1.0, rel=1e-9)

    def test_a_ring_is_stiffer_than_the_external_pair(self):
        """ISO 6336-1 takes an infinite number of teeth: c' rises by less than a fifth over 72 external teeth."""
        ratio = iso_stiffness(PLANET).single / iso_stiffness(GearPair((27, 72), 2e-3, ALPHA, 20e-3)).single
        assert 1.0 < ratio < 1.2

    def test_the_tooth_is_thick_at_the_root(self):
        """The flank of the ring's tooth: pi/2 modules on the reference circle, and the printed tip thickness."""
        body = tooth(PLANET, 1)
        radius = np.hypot(body.height, body.half_thickness)
        angle = np.arctan2(body.half_thickness, -body.height)
        at_reference = np.interp(72e-3, radius[::-1], (2 * angle * radius)[::-1])
        assert at_reference == pytest.approx(math.pi / 2 * 2e-3, rel=1e-4)
        assert 2 * angle[-1] * radius[-1] == pytest.approx(PLANET.tip_thickness[1], rel=1e-6)
        assert np.all(np.diff(body.half_thickness) < 0)

    def test_edges_beyond_the_path_stand_off(self):
        pair, far = PLANET, 0.2 * PLANET.base_pitch
        ends = np.array([pair.path_start - far, pair.path_start, pair.path_end, pair.path_end + far])
        gap = corner_gap(pair, ends)
        assert gap[1:3] == pytest.approx(0.0, abs=1e-12)
        assert min(gap[0], gap[3]) > 0

    @pytest.mark.parametrize(
        "wrong", [{"torque_end": ("none", "front")}, {"foundation": "sainsot", "bore_radius": (5e-3, 5e-3)}]
    )
    def test_bodies_without_a_ring_are_refused(self, wrong):
        with pytest.raises(InputError, match="neither bore nor solid body"):
            mesh(PLANET, LdpSharing(**wrong))
