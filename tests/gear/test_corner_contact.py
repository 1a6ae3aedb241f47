"""Edge contact beyond the path, pitch deviations and twist of the bodies."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from mixedlub.gear import LdpSharing, transmission_error
from mixedlub.gear.corner_contact import corner_gap
from mixedlub.gear.distribution import distribute
from mixedlub.gear.influence import body_torsion
from profiles.errors import InputError
from tests.gear.pairs import FZG_C, HELICAL, HONG


def rigid_gap(pair, lacking):
    """Turn of the pinion, as an arc of its base circle, from the path until its flank meets the gear's tip edge.

    Independent of the law: involutes in polar angles from the line of centres; the turn is found by root finding.
    """
    base, other = pair.base_radius
    centre, angle = pair.working_centre_distance, pair.working_pressure_angle
    tip = pair.tip_radii[1]

    def polar(wheel_base, radius):
        return math.tan(math.acos(wheel_base / radius)) - math.acos(wheel_base / radius)

    # Angles from the line of centres where each wheel's flank passes the pitch point.
    start = pair.path_start - lacking
    turned_gear = (pair.pitch_point - start) / other
    edge_angle = polar(other, tip) - polar(other, pair.operating_radius[1]) - turned_gear
    x, y = centre - tip * math.cos(edge_angle), tip * math.sin(edge_angle)
    radius, seen = math.hypot(x, y), math.atan2(y, x)

    def ahead(turn):
        flank = polar(base, pair.operating_radius[0]) - polar(base, radius)
        return flank - (pair.pitch_point - start) / base + turn - seen

    assert angle > 0
    return brentq(ahead, -0.5, 0.5, xtol=1e-14) * base


class TestEdgeContact:
    @pytest.mark.parametrize("pair", [HONG, FZG_C], ids=["17/26", "FZG C"])
    @pytest.mark.parametrize("lacking", [1e-5, 3e-4, 1e-3, 2e-3])
    def test_gap_is_that_of_the_involutes(self, pair, lacking):
        gap = corner_gap(pair, np.array(pair.path_start - lacking))
        assert gap == pytest.approx(abs(rigid_gap(pair, lacking)), rel=1e-6, abs=1e-12)

    def test_gap_closes_at_both_ends_and_grows_faster_than_in_proportion(self):
        beyond = np.array([0.0, 1e-3, 2e-3])
        for position in (HONG.path_start - beyond, HONG.path_end + beyond):
            gap = corner_gap(HONG, position)
            assert gap[0] == pytest.approx(0, abs=1e-15)
            assert gap[2] > 3 * gap[1] > 0
        assert np.all(corner_gap(HONG, np.linspace(HONG.path_start, HONG.path_end, 9)) == 0)

    def test_equal_wheels_have_equal_gaps_at_both_ends(self):
        from tests.gear.pairs import NASA

        gaps = corner_gap(NASA, np.array([NASA.path_start - 1e-3, NASA.path_end + 1e-3]))
        assert gaps[0] == pytest.approx(gaps[1], rel=1e-9)

    def test_load_brings_tips_into_contact_beyond_the_path_and_smooths_the_error(self):
        within = transmission_error(HONG, LdpSharing(), [1.0, 150.0])
        beyond = transmission_error(HONG, LdpSharing(), [1.0, 150.0], edge_contact=True)
        outside = (beyond.position < HONG.path_start) | (beyond.position > HONG.path_end)
        carried = np.where(outside, beyond.force, 0).sum(axis=(1, 2, 3)) / beyond.force.sum(axis=(1, 2, 3))
        assert carried[0] < 0.01 < carried[1] < 0.2
        assert beyond.peak_to_peak[1] < within.peak_to_peak[1]
        assert np.abs(beyond.force.sum(axis=(2, 3)) * HONG.base_radius[0] / beyond.force.shape[1:2]).all()

    def test_enough_tip_relief_leaves_nothing_beyond_the_path(self):
        sharing = LdpSharing(tip_relief=(40e-6, 40e-6), relief_length=(3e-3, 3e-3))
        solved = transmission_error(HONG, sharing, 100.0, edge_contact=True)
        outside = (solved.position < HONG.path_start) | (solved.position > HONG.path_end)
        assert np.where(outside, solved.force, 0).sum() == 0

    def test_forces_balance(self):
        solved = transmission_error(HELICAL, LdpSharing(), 5000.0, phases=8, edge_contact=True)
        assert solved.force.sum(axis=(2, 3)) == pytest.approx(5000.0 / HELICAL.base_radius[0], rel=1e-10)


class TestPitchDeviations:
    def test_equal_deviations_only_move_the_error(self):
        plain = transmission_error(HONG, LdpSharing(), 100.0)
        moved = transmission_error(HONG, LdpSharing(), 100.0, pitch_deviation=[5e-6])
        assert moved.approach == pytest.approx(plain.approach + 5e-6, rel=1e-9)
        assert moved.force == pytest.approx(plain.force, rel=1e-6, abs=1e-3)

    def test_the_error_repeats_after_as_many_base_pitches_as_there_are_deviations(self):
        solved = transmission_error(HONG, LdpSharing(), 100.0, phases=10, pitch_deviation=[0.0, 8e-6, 0.0])
        assert solved.approach.shape == (1, 30)
        assert solved.peak_to_peak > transmission_error(HONG, LdpSharing(), 100.0, phases=10).peak_to_peak
        share = solved.force.sum(axis=3)[0]
        # The rearmost pair of a base pitch is the leading one of the next, whose neighbour has entered behind it.
        reached = solved.position[..., 0]
        assert reached[0, 0] + HONG.base_pitch == pytest.approx(reached[10, 1])
        assert share.sum(axis=1) == pytest.approx(100.0 / HONG.base_radius[0], rel=1e-10)

    def test_a_pair_that_stands_back_carries_less(self):
        start = np.array([HONG.path_start + 0.5e-3])
        even = distribute(HONG, LdpSharing(), np.array([100.0]), start, 11).force.sum(axis=3)[0, 0]
        late = distribute(HONG, LdpSharing(), np.array([100.0]), start, 11, stand_back=np.array([[4e-6, 0.0]]))
        assert late.force.sum(axis=3)[0, 0, 0] < 0.8 * even[0]

    def test_deviations_are_finite(self):
        with pytest.raises(InputError, match=r"^pitch_deviation_um: "):
            transmission_error(HONG, LdpSharing(), 100.0, pitch_deviation=[math.nan])


class TestTwist:
    def test_uniform_load_twists_by_half_the_torque_over_the_face(self):
        """Saint-Venant: torque that falls evenly to zero over b turns the end by T b/(2 G I)."""
        slices, radius = 200, 30e-3
        face = (np.arange(slices) + 0.5) * HONG.face_width / slices
        matrix = body_torsion(HONG, ("front", "none"), (radius, radius), face, 1)
        force = np.full(slices, 150.0 / HONG.base_radius[0] / slices)
        shear = 206e9 / 2.6
        wanted = HONG.base_radius[0] * 150.0 * HONG.face_width / (2 * shear * math.pi * radius**4 / 2)
        assert (matrix @ force)[-1] == pytest.approx(wanted, rel=1e-4)

    def test_torque_loads_the_end_where_it_enters(self):
        for end, heavier in (("front", 0), ("back", -1)):
            solved = transmission_error(HELICAL, LdpSharing(torque_end=(end, "none")), 9000.0)
            over_face = solved.force.sum(axis=(0, 1, 2))
            assert over_face[heavier] > 1.02 * over_face[-1 - heavier]


class TestLead:
    """Deviations over the face that are the same in other words."""

    def test_a_straight_trace_is_a_misalignment(self):
        one = transmission_error(HONG, LdpSharing(misalignment=12e-6), 80.0)
        other = transmission_error(HONG, LdpSharing(lead_deviation=(0.0, 6e-6, 12e-6)), 80.0)
        assert other.force == pytest.approx(one.force, rel=1e-9, abs=1e-9)

    def test_end_relief_unloads_its_end(self):
        sharing = LdpSharing(end_relief=(15e-6, 0.0), end_relief_length=(4e-3, 0.0))
        over_face = transmission_error(HONG, sharing, 80.0).force.sum(axis=(0, 1, 2))
        assert over_face[0] < 0.5 * over_face[-1]
        assert np.argmin(over_face) == 0

    def test_profile_slope_unloads_the_tip_that_it_takes_from(self):
        plain = transmission_error(HONG, LdpSharing(), 80.0).force.sum(axis=3)
        sloped = transmission_error(HONG, LdpSharing(profile_slope_deviation=(10e-6, 0.0)), 80.0).force.sum(axis=3)
        # Early in the base pitch both pairs touch: the one that is further on is nearer to the pinion's tip.
        assert sloped[0, 2, 1] < plain[0, 2, 1]

    def test_equal_slopes_of_opposite_sign_cancel(self):
        both = transmission_error(HONG, LdpSharing(profile_slope_deviation=(6e-6, 6e-6)), 80.0)
        plain = transmission_error(HONG, LdpSharing(), 80.0)
        assert both.approach == pytest.approx(plain.approach + 6e-6, rel=1e-9)

    def test_end_relief_longer_than_the_face_is_refused(self):
        with pytest.raises(InputError, match=r"^end_relief_length_mm: 20\.0: .*longer than the face"):
            transmission_error(HONG, LdpSharing(end_relief=(1e-6, 0), end_relief_length=(20e-3, 0)), 80.0)
