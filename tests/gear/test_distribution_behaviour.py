"""How the elastic load distribution answers to what an engineer changes."""

from dataclasses import replace

import numpy as np
import pytest

from mixedlub.gear import LdpSharing, at_roll_angle, mesh, transmission_error
from tests.gear.pairs import EVERYTHING, HIGH_SPEED_B, HONG, NASA, TORQUES, loss_factor


class TestBehaviour:
    """How the distribution answers to what an engineer changes."""

    def test_elastic_sharing_loses_a_little_less_than_rigid_sharing(self):
        elastic = loss_factor(HONG, LdpSharing(), 100.0)
        assert 0.95 * HONG.loss_factor < elastic < HONG.loss_factor

    def test_equal_wheels_share_symmetrically(self):
        angles = np.array([NASA.path_start, NASA.path_end]) / NASA.base_radius[0]
        share = at_roll_angle(NASA, LdpSharing(), angles).load_share(60.0).reshape(2, -1)
        assert share[0] == pytest.approx(share[1], rel=1e-6)

    def test_tip_relief_unloads_the_tip(self):
        end = HONG.path_end / HONG.base_radius[0]
        shares = [
            at_roll_angle(HONG, LdpSharing(tip_relief=(depth, 0.0), relief_length=(3e-3, 0.0)), end)
            .load_share(100.0)
            .sum()
            for depth in (0.0, 5e-6, 10e-6, 40e-6)
        ]
        assert np.all(np.diff(shares) < 0)
        assert shares[-1] == 0

    @pytest.mark.parametrize("wheel", [0, 1])
    def test_root_relief_acts_like_the_mates_tip_relief(self, wheel):
        depth, length = (12e-6, 0.0), (3e-3, 0.0)
        if wheel == 1:
            depth, length = depth[::-1], length[::-1]
        tip = LdpSharing(tip_relief=depth[::-1], relief_length=length[::-1])
        root = LdpSharing(root_relief=depth, root_relief_length=length)
        assert np.array_equal(mesh(HONG, tip).load_share(90.0), mesh(HONG, root).load_share(90.0))

    def test_parabolic_relief_stands_back_less(self):
        linear = LdpSharing(tip_relief=(10e-6, 10e-6), relief_length=(4e-3, 4e-3))
        curved = replace(linear, relief_form="parabolic")
        x = np.linspace(HONG.path_start, HONG.path_end, 50)
        gap = [s.gap(HONG, x, np.zeros_like(x)) for s in (linear, curved)]
        assert np.all(gap[1] <= gap[0])
        assert gap[1][[0, -1]] == pytest.approx(gap[0][[0, -1]], rel=1e-12)

    def test_crown_loads_the_middle_and_misalignment_an_edge(self):
        pitch = HONG.pitch_point / HONG.base_radius[0]
        crown = at_roll_angle(HONG, LdpSharing(lead_crown=8e-6), pitch).load_share(60.0)
        skew = at_roll_angle(HONG, LdpSharing(misalignment=15e-6), pitch).load_share(60.0)
        assert crown.argmax() == 5
        assert skew.argmax() == 0
        assert np.all(np.diff(skew) <= 0)

    def test_misalignment_of_the_other_sign_mirrors_the_slices(self):
        one, other = (
            mesh(HONG, LdpSharing(misalignment=f, lead_crown=3e-6)).load_share(70.0).reshape(-1, 11)
            for f in (18e-6, -18e-6)
        )
        assert one == pytest.approx(other[:, ::-1], rel=1e-7, abs=1e-12)

    def test_load_closes_gaps(self):
        sharing = LdpSharing(misalignment=30e-6)
        solved = transmission_error(HONG, sharing, [5.0, 50.0, 500.0], phases=4)
        touching = (solved.force > 0).sum(axis=(1, 2, 3))
        assert touching[0] < touching[1] < touching[2]

    def test_light_load_on_relieved_teeth_passes_single_pairs_only(self):
        sharing = LdpSharing(tip_relief=(50e-6, 50e-6), relief_length=(3e-3, 3e-3))
        solved = transmission_error(HONG, sharing, 0.5)
        assert ((solved.force.sum(axis=3) > 0).sum(axis=2) == 1).mean() > 0.8

    def test_transmission_error_grows_with_torque(self):
        solved = transmission_error(HONG, LdpSharing(), TORQUES)
        assert np.all(np.diff(solved.peak_to_peak) > 0)
        assert np.all(np.diff(solved.approach, axis=0) > 0)

    def test_some_relief_smooths_the_transmission_error(self):
        plain = transmission_error(HONG, LdpSharing(), 150.0).peak_to_peak
        length = HONG.lowest_single_contact - HONG.path_start
        eased = LdpSharing(tip_relief=(8e-6, 8e-6), relief_length=(length, length))
        assert transmission_error(HONG, eased, 150.0).peak_to_peak < 0.6 * plain

    def test_softer_foundation_shares_more_evenly(self):
        start = HONG.path_start / HONG.base_radius[0]
        weber = at_roll_angle(HONG, LdpSharing(), start).load_share(150.0).sum()
        ring = LdpSharing(foundation="sainsot", bore_radius=(15e-3, 25e-3))
        sainsot = at_roll_angle(HONG, ring, start).load_share(150.0).sum()
        assert weber < sainsot < 0.5

    def test_other_units_give_the_same_answer(self):
        length, modulus = 3.7, 0.21
        pair = replace(
            HONG,
            normal_module=length * HONG.normal_module,
            face_width=length * HONG.face_width,
            youngs_modulus=(206e9 * modulus, 206e9 * modulus),
        )
        scaled = replace(
            EVERYTHING,
            **{
                name: tuple(length * value for value in getattr(EVERYTHING, name))
                for name in ("tip_relief", "relief_length", "root_relief", "root_relief_length")
            },
            lead_crown=length * EVERYTHING.lead_crown,
            misalignment=length * EVERYTHING.misalignment,
        )
        here = transmission_error(HONG, EVERYTHING, TORQUES)
        there = transmission_error(pair, scaled, TORQUES * modulus * length**3)
        assert there.approach == pytest.approx(length * here.approach, rel=1e-9)
        assert there.force == pytest.approx(modulus * length**2 * here.force, rel=1e-7, abs=1e-6)

    def test_linear_in_load_but_for_the_flattening(self):
        double = transmission_error(HONG, LdpSharing(), [50.0, 100.0]).approach
        assert np.all((double[1] / double[0] > 1.9) & (double[1] / double[0] < 2.0))

    def test_contact_ratio_above_two_shares_between_three(self):
        solved = transmission_error(HIGH_SPEED_B, LdpSharing(), 500.0)
        assert solved.force.shape[2] == 3
        assert ((solved.force.sum(axis=3) > 0).sum(axis=2) == 3).any()
