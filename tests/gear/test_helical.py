"""Helical pairs: the same contact problem along oblique lines."""

import math
import time
from dataclasses import replace

import numpy as np
import pytest

from mixedlub.gear import GearPair, LdpSharing, RigidSharing, at_roll_angle, mesh, transmission_error
from mixedlub.gear.contact_lines import contact_line_length
from mixedlub.gear.distribution import distribute
from profiles.errors import InputError
from tests.gear.pairs import EVERYTHING, HELICAL, HIGH_SPEED_A, HONG, TORQUES, loss_factor


class TestBalance:
    """Forces and moments of all slices against the torque, in space."""

    solved = transmission_error(HELICAL, EVERYTHING, [100.0, 3000.0], phases=16, slices=21)

    def test_slices_add_up_to_the_base_tangent_force(self):
        wanted = np.array([100.0, 3000.0])[:, None] / HELICAL.base_radius[0]
        assert np.abs(self.solved.force.sum(axis=(2, 3)) / wanted - 1).max() < 1e-10

    @pytest.mark.parametrize("wheel", [0, 1])
    def test_normal_forces_turn_pinion_and_gear_by_their_torques(self, wheel):
        """Force on each slice along the normal of the involute helicoid, from its parametric surface."""
        base, sign = HELICAL.base_radius[wheel], 1 - 2 * wheel
        roll = self.solved.position if wheel == 0 else HELICAL.line_of_action_length - self.solved.position
        lead = sign * math.tan(HELICAL.base_helix_angle) / base

        def surface(turn, along):
            """Points of a flank turned to the line of action at a roll angle, and at a face position further on."""
            angle = turn - roll / base - lead * along
            point = np.array([np.sin(angle) - turn * np.cos(angle), np.cos(angle) + turn * np.sin(angle)]) * base
            return np.array([-point[0], point[1], np.broadcast_to(along, turn.shape)])

        turn, step = roll / base, 1e-6
        tangents = (
            (surface(turn + step, 0.0) - surface(turn - step, 0.0)) / (2 * step),
            (surface(turn, step * base) - surface(turn, -step * base)) / (2 * step * base),
        )
        normal = np.cross(*tangents, axis=0)
        normal /= np.linalg.norm(normal, axis=0)
        assert np.abs(normal[2]) == pytest.approx(math.sin(HELICAL.base_helix_angle), rel=1e-6)
        # The transverse component is the slice's force; it acts at the point of the flank.
        across = self.solved.force / np.hypot(*normal[:2])
        point = surface(turn, 0.0)
        moment = (across * (point[0] * normal[1] - point[1] * normal[0])).sum(axis=(2, 3))
        wanted = np.array([100.0, 3000.0]) * (1, HELICAL.gear_ratio)[wheel]
        assert np.abs(np.abs(moment) / wanted[:, None] - 1).max() < 1e-9
        thrust = np.abs((across * normal[2]).sum(axis=(2, 3)))
        assert thrust == pytest.approx(np.abs(moment) / base * math.tan(HELICAL.base_helix_angle), rel=1e-6)

    def test_conditions_of_contact(self):
        assert self.solved.force.min() == 0
        assert self.solved.separation.min() > -1e-12
        assert np.abs(self.solved.separation[self.solved.force > 0]).max() < 1e-12

    def test_stiffness_is_the_slope_of_the_force(self):
        low, mid, high = (transmission_error(HELICAL, EVERYTHING, t, phases=3) for t in (2999.0, 3000.0, 3001.0))
        slope = 2.0 / HELICAL.base_radius[0] / (high.approach - low.approach)
        assert mid.stiffness == pytest.approx(slope, rel=1e-4)


class TestLimits:
    """Where helical pairs must agree with what is known."""

    @pytest.mark.parametrize("angle", [1e-6, 1e-9])
    def test_helical_becomes_spur(self, angle):
        spur = transmission_error(HONG, EVERYTHING, TORQUES)
        helical = distribute(replace(HONG, helix_angle=angle), EVERYTHING, TORQUES, spur.phase, 11)
        assert helical.approach == pytest.approx(spur.approach, rel=2 * angle)
        assert np.abs(helical.force - spur.force).max() < 5 * angle * spur.force.max()

    def test_loss_factor_of_a_study_becomes_that_of_spur_gears(self):
        factors = [loss_factor(pair, EVERYTHING, 100.0) for pair in (HONG, replace(HONG, helix_angle=1e-7))]
        assert factors[1] == pytest.approx(factors[0], rel=1e-4)

    def test_either_hand_of_the_helix_carries_the_same(self):
        left = replace(HELICAL, helix_angle=-HELICAL.helix_angle)
        approach = [transmission_error(pair, EVERYTHING, 500.0, phases=5).approach for pair in (HELICAL, left)]
        np.testing.assert_allclose(*approach, rtol=1e-9)

    def test_shares_over_the_path_add_up_to_one(self):
        points = mesh(HELICAL, EVERYTHING)
        total = (points.weight * points.load_share([100.0, 3000.0])).sum(axis=1) * math.cos(HELICAL.base_helix_angle)
        assert total == pytest.approx(1, rel=1e-12)

    def test_a_study_reads_the_share_that_the_contact_problem_gives(self):
        along = np.linspace(HELICAL.path_start, HELICAL.path_end, 9) / HELICAL.base_radius[0]
        points = at_roll_angle(HELICAL, LdpSharing(), along)
        front = points.position - points.face_position * math.tan(HELICAL.base_helix_angle)
        share = points.load_share(1000.0)
        place = int(np.argmax(share))
        start = HELICAL.path_start - HELICAL.face_width * math.tan(HELICAL.base_helix_angle)
        past = math.floor((front[place] - start) / HELICAL.base_pitch)
        phase = front[place : place + 1] - past * HELICAL.base_pitch
        solved = distribute(HELICAL, LdpSharing(), np.array([1000.0]), phase, points.slices)
        exact = solved.force[0, 0, past, place % points.slices] * HELICAL.base_radius[0] / 1000.0
        assert share[place] == pytest.approx(exact, rel=5e-3)

    def test_more_slices_change_little(self):
        means = [transmission_error(HELICAL, LdpSharing(), 3000.0, slices=n).approach.mean() for n in (17, 68)]
        assert means[0] == pytest.approx(means[1], rel=3e-3)

    def test_a_wide_face_shares_almost_evenly_along_the_lines(self):
        """Rigid teeth load every length alike; elastic ones do so within the change of their stiffness along a line."""
        rigid, elastic = (loss_factor(HELICAL, sharing, 3000.0) for sharing in (RigidSharing(), LdpSharing()))
        assert 0.85 * rigid < elastic < rigid

    def test_total_contact_ratio_above_one_is_enough(self):
        narrow = GearPair(
            (38, 57), 1.75e-3, math.radians(20), 21.2418e-3, math.radians(15), (1.6915, 2.0003), (38.115e-3, 55.867e-3)
        )
        assert narrow.contact_ratio < 1 < narrow.contact_ratio + narrow.overlap_ratio
        assert contact_line_length(narrow, np.linspace(narrow.path_start, narrow.path_end, 50)).min() > 0
        assert np.isfinite(loss_factor(narrow, RigidSharing(), 200.0))
        with pytest.raises(InputError, match="contact ratio"):
            replace(narrow, face_width=1e-3)


def test_sixty_four_positions_of_fifty_slices_take_less_than_a_second():
    start = time.process_time()
    transmission_error(replace(HELICAL, face_width=99e-3), LdpSharing(), 9000.0, phases=64, slices=50)
    assert time.process_time() - start < 1.0


def test_high_speed_gears_of_five_degrees_lose_like_their_spur_equivalents():
    helical = GearPair(
        (35, 49), 4.825e-3, math.radians(22.5), 20e-3, math.radians(5), (0.2, -0.2195), (91.965e-3, 123.845e-3)
    )
    spur, oblique = (loss_factor(pair, LdpSharing(), 1000.0) for pair in (HIGH_SPEED_A, helical))
    assert oblique == pytest.approx(spur, rel=0.02)


def test_blocks_of_contact_problems_change_nothing(monkeypatch):
    torques = np.array([100.0, 3000.0, 5000.0])
    whole = transmission_error(HELICAL, EVERYTHING, torques, phases=12, slices=9)
    monkeypatch.setattr("mixedlub.gear.distribution.MOST_ENTRIES", 5 * 27**2)
    parts = transmission_error(HELICAL, EVERYTHING, torques, phases=12, slices=9)
    assert parts.position == pytest.approx(whole.position)
    for name in ("force", "approach", "stiffness"):
        assert getattr(parts, name) == pytest.approx(getattr(whole, name), rel=1e-9, abs=1e-6)
