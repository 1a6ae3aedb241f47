"""Elastic load distribution: equilibrium, contact conditions, convergence."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mixedlub.gear import GearPair, LdpSharing, RigidSharing, at_roll_angle, mesh, transmission_error
from mixedlub.gear.compliance import hertz_approach
from mixedlub.gear.distribution import distribute
from profiles.errors import InputError
from tests.gear.pairs import (
    EVERYTHING,
    HONG,
    STANDARD,
    TORQUES,
    loss_factor,
)


class TestEquilibrium:
    """What every solution must satisfy, with every modification switched on."""

    solved = transmission_error(HONG, EVERYTHING, TORQUES)

    def test_forces_add_up_to_the_base_tangent_force(self):
        wanted = TORQUES[:, None] / HONG.base_radius[0]
        assert np.abs(self.solved.force.sum(axis=(2, 3)) / wanted - 1).max() < 1e-10

    def test_forces_push_and_flanks_do_not_overlap(self):
        assert self.solved.force.min() == 0
        assert self.solved.separation.min() > -1e-12
        assert self.solved.separation[np.isfinite(self.solved.separation)].max() > 1e-7

    def test_force_only_where_the_gap_is_closed(self):
        loaded = self.solved.force > 0
        assert np.abs(self.solved.separation[loaded]).max() < 1e-12

    def test_gaps_closed_by_flattening_and_bending_reach_the_approach(self):
        # One slice, one pair, no modification: the two laws added up by hand.
        x = np.array([STANDARD.pitch_point])
        solved = distribute(STANDARD, LdpSharing(), np.array([20.0]), x, 1)
        line_load = solved.force[0, 0, 0, 0] / STANDARD.face_width
        stiffness = line_load / solved.approach[0, 0]
        assert 13e9 < stiffness < 18e9
        narrow = distribute(STANDARD, LdpSharing(), np.array([20.0]), x, 11)
        assert narrow.approach[0, 0] == pytest.approx(solved.approach[0, 0], rel=0.01)

    def test_shares_of_all_pairs_add_up_to_one(self):
        points = mesh(HONG, EVERYTHING)
        assert (points.weight * points.load_share(TORQUES)).sum(axis=1) == pytest.approx(1, rel=1e-10)

    def test_share_at_a_position_and_a_base_pitch_on(self):
        x = HONG.path_start + 1.3e-3
        angles = np.array([x, x + HONG.base_pitch]) / HONG.base_radius[0]
        share = at_roll_angle(HONG, EVERYTHING, angles).load_share(80.0)
        assert share.sum() == pytest.approx(1, rel=1e-9)

    @given(
        st.floats(0, 50e-6),
        st.floats(0, 50e-6),
        st.floats(0, 20e-6),
        st.floats(-60e-6, 60e-6),
        st.floats(0.5, 500),
        st.sampled_from(["linear", "parabolic"]),
    )
    @settings(max_examples=40, deadline=None)
    def test_conditions_hold_for_any_modification_and_torque(self, pinion, gear, crown, skew, torque, form):
        sharing = LdpSharing(
            tip_relief=(pinion, gear),
            relief_length=(3e-3, 5e-3),
            lead_crown=crown,
            misalignment=skew,
            relief_form=form,
        )
        solved = transmission_error(HONG, sharing, torque, phases=6)
        total = torque / HONG.base_radius[0]
        assert np.abs(solved.force.sum(axis=(2, 3)) / total - 1).max() < 1e-10
        assert solved.force.min() >= 0
        assert solved.separation.min() > -1e-12
        assert np.where(solved.force > 0, np.abs(solved.separation), 0).max() < 1e-12

    @given(
        st.tuples(st.integers(6, 90), st.integers(6, 90)),
        st.floats(14, 28),
        st.tuples(st.floats(-0.6, 1.0), st.floats(-0.6, 1.0)),
        st.floats(1, 20),
        st.floats(-2, 3),
    )
    @settings(max_examples=30, deadline=None)
    def test_any_gear_pair_is_solved_or_refused(self, teeth, angle, shift, width, load):
        module = 3e-3
        try:
            pair = GearPair(teeth, module, math.radians(angle), width * module, profile_shift=shift)
            torque = 10**load * 1e6 * pair.face_width * pair.base_radius[0] * 0.01
            solved = transmission_error(pair, EVERYTHING, torque, phases=3, slices=5)
        except InputError:
            return
        total = torque / pair.base_radius[0]
        assert np.abs(solved.force.sum(axis=(2, 3)) / total - 1).max() < 1e-10
        assert solved.force.min() >= 0
        assert solved.separation.min() > -1e-12
        assert np.where(solved.force > 0, np.abs(solved.separation), 0).max() < 1e-11


class TestConvergence:
    """Refinement changes less and less, at the order the method promises."""

    def test_slices_converge_with_second_order(self):
        sharing = LdpSharing(lead_crown=3e-6, misalignment=4e-6)
        phase = np.array([HONG.pitch_point])
        approach = [distribute(HONG, sharing, np.array([100.0]), phase, n).approach.item() for n in (3, 9, 27)]
        order = math.log((approach[1] - approach[0]) / (approach[2] - approach[1]), 3)
        assert order == pytest.approx(2, abs=0.15)

    def test_eleven_slices_are_within_a_thousandth(self):
        sharing = LdpSharing(lead_crown=3e-6, misalignment=4e-6)
        factors = [loss_factor(HONG, sharing, 100.0, slices=n) for n in (11, 33)]
        assert factors[0] == pytest.approx(factors[1], rel=1e-3)

    def test_default_points_are_within_a_ten_thousandth(self):
        sharing = LdpSharing(tip_relief=(15e-6, 15e-6), relief_length=(2e-3, 2e-3), lead_crown=3e-6)
        coarse, fine = (loss_factor(HONG, sharing, 100.0, points=n) for n in (48, 600))
        assert coarse == pytest.approx(fine, rel=1e-4)

    def test_many_torques_agree_with_one_at_a_time(self):
        points = mesh(HONG, EVERYTHING, points=12)
        torques = np.linspace(5, 300, 700).reshape(70, 10)
        share = points.load_share(torques)
        assert share.shape == (70, 10, points.position.size)
        for index in ((0, 0), (35, 4), (69, 9)):
            assert share[index] == pytest.approx(points.load_share(torques[index]), rel=1e-9, abs=1e-12)


def test_flattening_takes_part():
    """Without Hertzian flattening the teeth would be a third stiffer."""
    x = np.array([HONG.pitch_point])
    solved = distribute(HONG, LdpSharing(), np.array([100.0]), x, 1)
    line_load = solved.force.sum() / HONG.face_width
    radius = x * (HONG.line_of_action_length - x) / HONG.line_of_action_length
    flat, _ = hertz_approach(line_load, radius, HONG.reduced_modulus, (3.4e-3, 3.5e-3), (206e9,) * 2, (0.3,) * 2)
    assert 0.2 < flat[0] / solved.approach[0, 0] < 0.4


def test_rigid_and_elastic_meshes_share_their_kinematics():
    rigid, elastic = mesh(HONG, RigidSharing(), slices=11), mesh(HONG, LdpSharing())
    assert np.array_equal(rigid.position, elastic.position)
