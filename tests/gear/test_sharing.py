"""The mesh and the two plain ways to share the load: rigid teeth and a table."""

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mixedlub.gear import GearPair, RigidSharing, TableSharing, at_roll_angle, mesh
from mixedlub.schema.findings import Severity, codes, collected
from profiles.errors import InputError
from tests.gear.pairs import FZG_C, HONG, NASA, TIPPED


def loss_factor(points, torque):
    """Loss over power in for a friction coefficient of 1."""
    return (points.weight * points.load_share(torque) * np.abs(points.sliding_per_speed)).sum() / (
        points.pair.base_radius[0]
    )


def table(torques=(50.0, 150.0), rows=61, pair=TIPPED):
    """A trapezoidal share with steps at B and D, sampled like the output of a gear program."""
    x = np.linspace(pair.path_start, pair.path_end, rows)
    b, d = pair.lowest_single_contact, pair.highest_single_contact
    rising = 0.2 + 0.6 * (x - x[0]) / (b - x[0])
    falling = 0.2 + 0.6 * (x[-1] - x) / (x[-1] - d)
    share = np.where(x < b, rising, np.where(x > d, falling, 1.0))
    angle = x / pair.base_radius[0]
    return TableSharing(np.repeat(torques, rows), np.tile(angle, len(torques)), np.tile(share, len(torques)))


class TestMesh:
    """Kinematics and quadrature of the contact points."""

    def test_sliding_is_negative_before_and_positive_after_the_pitch_point(self):
        points = mesh(HONG, RigidSharing())
        assert np.all(np.sign(points.sliding_per_speed) == np.sign(points.position - HONG.pitch_point))

    def test_entrainment_is_constant_for_equal_teeth(self):
        points = mesh(NASA, RigidSharing())
        assert points.entrainment_per_speed == pytest.approx(NASA.pitch_point, rel=1e-13)

    @pytest.mark.parametrize(
        ("point", "radius", "entrainment", "sliding"),
        [
            ("pitch_point", 8.3262e-3, 2.1630, 0),
            ("highest_single_contact", 8.6914e-3, 2.2417, 0.7518),
            ("path_end", 7.9264e-3, 2.4039, 2.3021),
        ],
    )
    def test_local_check_values_at_1500_rpm(self, point, radius, entrainment, sliding):
        points = at_roll_angle(HONG, RigidSharing(), getattr(HONG, point) / HONG.base_radius[0])
        omega = 1500 * math.pi / 30
        assert points.radius[0] == pytest.approx(radius, rel=1e-5)
        assert points.entrainment_per_speed[0] * omega == pytest.approx(entrainment, rel=3e-5)
        assert points.sliding_per_speed[0] * omega == pytest.approx(sliding, rel=1e-4, abs=1e-12)

    def test_weights_add_up_to_the_contact_ratio(self):
        for pair in (HONG, FZG_C, NASA):
            assert mesh(pair, RigidSharing()).weight.sum() == pytest.approx(pair.contact_ratio, rel=1e-13)

    @pytest.mark.parametrize("kind", ["rigid", "table"])
    def test_no_panel_holds_a_kink(self, kind):
        sharing = RigidSharing() if kind == "rigid" else table()
        coarse = loss_factor(mesh(TIPPED, sharing, points=9), 50.0)
        fine = loss_factor(mesh(TIPPED, sharing, points=900), 50.0)
        assert coarse == pytest.approx(fine, rel=1e-12)

    def test_arrays_are_read_only(self):
        with pytest.raises(ValueError, match="read-only"):
            mesh(HONG, RigidSharing()).position[0] = 0.0

    def test_mesh_can_be_sent_to_another_process(self):
        points = mesh(TIPPED, table())
        sent = pickle.loads(pickle.dumps(points))
        assert np.array_equal(sent.load_share(50.0), points.load_share(50.0))

    @pytest.mark.parametrize("torque", [0.0, -5.0, math.nan, math.inf, "much", None, [50.0, 0.0]])
    def test_torque_must_be_above_zero(self, torque):
        with pytest.raises(InputError, match="torque_Nm"):
            mesh(HONG, RigidSharing()).load_share(torque)

    @pytest.mark.parametrize("keyword", ["points", "slices"])
    @pytest.mark.parametrize("value", [0, -3, 2.5, True])
    def test_counts_are_whole_numbers(self, keyword, value):
        with pytest.raises(InputError, match=keyword):
            mesh(HONG, RigidSharing(), **{keyword: value})


class TestRigid:
    """Equal sharing between the pairs in contact."""

    @pytest.mark.parametrize(("pair", "expected"), [(HONG, 0.1891), (FZG_C, 0.1950), (NASA, 0.1579)])
    def test_mean_sliding_is_the_loss_factor(self, pair, expected):
        assert loss_factor(mesh(pair, RigidSharing()), 100.0) == pytest.approx(pair.loss_factor, rel=1e-12)
        assert pair.loss_factor == pytest.approx(expected, abs=6e-5)

    def test_one_pair_between_b_and_d_two_outside(self):
        points = mesh(HONG, RigidSharing())
        single = (points.position > HONG.lowest_single_contact) & (points.position < HONG.highest_single_contact)
        assert np.array_equal(points.load_share(1.0), np.where(single, 1.0, 0.5))

    def test_contact_ratio_above_two_shares_between_three(self):
        deep = GearPair((40, 50), 3e-3, math.radians(20), 20e-3, tip_radius=(64.2e-3, 79.2e-3))
        assert deep.contact_ratio > 2
        points = mesh(deep, RigidSharing())
        share = points.load_share(1.0)
        assert set(np.round(share, 12)) == {0.5, round(1 / 3, 12)}
        assert (points.weight * share).sum() == pytest.approx(1, rel=1e-12)

    def test_torque_axes_come_first(self):
        points = mesh(HONG, RigidSharing(), slices=3)
        share = points.load_share(np.array([[50.0, 100.0]]))
        assert share.shape == (1, 2, points.position.size)

    def test_helical_force_balance(self):
        helical = replace(HONG, helix_angle=math.radians(20))
        points = mesh(helical, RigidSharing(), points=200, slices=40)
        carried = (points.weight * points.load_share(1.0)).sum() * math.cos(helical.base_helix_angle)
        assert carried == pytest.approx(1, rel=1e-4)

    def test_helical_limit_is_the_spur_gear(self):
        nearly = replace(HONG, helix_angle=1e-7)
        spur = loss_factor(mesh(HONG, RigidSharing()), 1.0)
        assert loss_factor(mesh(nearly, RigidSharing(), slices=4), 1.0) == pytest.approx(spur, rel=1e-5)

    def test_wide_helical_gear_carries_a_steady_line_load(self):
        pair = replace(HONG, helix_angle=math.radians(20))
        pitch = math.pi * pair.normal_module / math.sin(pair.helix_angle)
        wide = replace(pair, face_width=2 * pitch)
        points = mesh(wide, RigidSharing())
        line_load = points.load_share(1.0) / points.face_fraction / wide.face_width
        mean_length = wide.face_width * wide.contact_ratio
        assert line_load == pytest.approx(1 / mean_length, rel=1e-9)

    def test_wide_helical_gear_loses_by_the_plain_mean_of_the_sliding_speed(self):
        # Buckingham: pi (1/z1 + 1/z2) (eps1^2 + eps2^2) / eps_alpha, and 1/cos(beta_b) for the normal force.
        pair = replace(HONG, helix_angle=math.radians(20))
        wide = replace(pair, face_width=2 * math.pi * pair.normal_module / math.sin(pair.helix_angle))
        mean = (wide.approach_ratio**2 + wide.recess_ratio**2) / wide.contact_ratio
        closed = math.pi * (1 / 17 + 1 / 26) * mean / math.cos(wide.base_helix_angle)
        assert loss_factor(mesh(wide, RigidSharing()), 1.0) == pytest.approx(closed, rel=1e-9)


class TestTable:
    """A tabulated share, used as it stands."""

    def test_rows_come_back(self):
        sharing = table()
        points = at_roll_angle(TIPPED, sharing, sharing.roll_angle[:61])
        assert points.load_share(50.0) == pytest.approx(sharing.share[:61], rel=1e-14)

    def test_order_of_the_rows_does_not_matter(self):
        sharing = table()
        shuffled = np.random.default_rng(1).permutation(sharing.torque.size)
        other = TableSharing(sharing.torque[shuffled], sharing.roll_angle[shuffled], sharing.share[shuffled])
        assert np.array_equal(other.share, sharing.share)

    def test_missing_torque_takes_the_nearest_and_warns(self):
        points = mesh(TIPPED, table())
        with collected() as found:
            share = points.load_share(120.0)
        assert codes(found) == ["torque_not_tabulated"]
        assert np.array_equal(share, points.load_share(150.0))

    def test_slices_share_evenly(self):
        one, four = (mesh(TIPPED, table(), slices=n) for n in (1, 4))
        summed = four.load_share(50.0).reshape(-1, 4).sum(axis=1)
        assert summed == pytest.approx(one.load_share(50.0), rel=1e-14)

    def test_short_table_is_noted_and_zero_outside(self):
        full = table((50.0,))
        short = TableSharing(full.torque[8:], full.roll_angle[8:], full.share[8:])
        points = mesh(TIPPED, short)
        assert "load_share_short" in codes(points.notes)
        assert points.load_share(50.0)[0] == 0

    def test_shares_that_do_not_add_up_are_noted(self):
        full = table((50.0,))
        half = TableSharing(full.torque, full.roll_angle, 0.5 * full.share)
        (note,) = mesh(TIPPED, half).notes
        assert (note.code, note.severity) == ("load_share_sum", Severity.DOUBT)
        assert "at 50 N m" in note.text
        assert "0.48 to 0.53 of the load, 0.500 on average" in note.text
        assert mesh(TIPPED, full).notes == ()

    @pytest.mark.parametrize("part", [slice(0, 3), slice(0, 30), slice(40, 61)])
    def test_rows_that_leave_a_part_of_the_path_to_no_pair_are_refused(self, part):
        full = table((50.0,))
        rows = TableSharing(full.torque[part], full.roll_angle[part], full.share[part], source="share.csv")
        with pytest.raises(InputError, match=r"^share\.csv: roll_angle_deg: the rows at 50 N m \(.*% of a base pitch$"):
            mesh(TIPPED, rows)

    def test_one_torque_stands_for_the_others(self):
        full = table((50.0, 100.0, 150.0))
        half = TableSharing(full.torque, full.roll_angle, 0.5 * full.share)
        (note,) = mesh(TIPPED, half).notes
        assert note.text.endswith("(so at 2 more torques)")

    def test_steps_between_the_rows_of_rigid_teeth_are_not_noted(self):
        x = np.linspace(TIPPED.path_start, TIPPED.path_end, 31)
        share = at_roll_angle(TIPPED, RigidSharing(), x / TIPPED.base_radius[0]).load_share(50.0)
        assert mesh(TIPPED, TableSharing(np.full(31, 50.0), x / TIPPED.base_radius[0], share)).notes == ()

    def test_shares_off_by_a_few_percent_are_noted(self):
        full = table((50.0,))
        assert mesh(TIPPED, TableSharing(full.torque, full.roll_angle, 1.02 * full.share)).notes == ()
        (note,) = mesh(TIPPED, TableSharing(full.torque, full.roll_angle, 1.05 * full.share)).notes
        assert (note.code, note.severity) == ("load_share_sum", Severity.CAUTION)
        assert "1.050 on average" in note.text

    def test_the_rounding_of_the_ends_is_not_noted(self):
        full = table((50.0,))
        angle = np.radians(np.round(np.degrees(full.roll_angle), 1))
        assert mesh(TIPPED, TableSharing(full.torque, angle, full.share)).notes == ()

    def test_messages_name_the_file(self):
        with pytest.raises(InputError, match=r"^share\.csv: load_share: 50"):
            TableSharing([50, 50], [0.2, 0.3], [0.5, 50], source="share.csv")

    def test_the_share_of_a_helical_pair_spreads_over_its_contact_line(self):
        """An even share over the whole passage of a pair gives every slice in contact the same."""
        pair = replace(HONG, helix_angle=0.2)
        half = pair.face_width * math.tan(pair.base_helix_angle) / 2
        angle = np.linspace(pair.path_start - half, pair.path_end + half, 41) / pair.base_radius[0]
        even = pair.base_pitch / (pair.path_end - pair.path_start + 2 * half)
        sharing = TableSharing(np.full(41, 50.0), angle, np.full(41, even))
        points = mesh(pair, sharing, points=200, slices=40)
        total = (points.weight * points.load_share(50.0)).sum() * math.cos(pair.base_helix_angle)
        assert total == pytest.approx(1, rel=1e-2)
        front = points.position - points.face_position * math.tan(pair.base_helix_angle)
        whole = (front > pair.path_start) & (front + 2 * half < pair.path_end)
        assert points.load_share(50.0)[whole] == pytest.approx(even / 40, rel=1e-9)

    def test_a_table_of_a_part_of_a_helical_passage_is_refused(self):
        pair = replace(HONG, helix_angle=0.2)
        angle = pair.pitch_point / pair.base_radius[0] + np.array([0.0, 0.02])
        with pytest.raises(InputError, match=r"roll_angle_deg: .*leave out a part"):
            mesh(pair, TableSharing([50, 50], angle, [0.5, 0.5]))

    def test_table_of_another_gear_is_refused(self):
        far = TableSharing([50, 50], [1.0, 1.2], [0.5, 0.5])
        with pytest.raises(InputError, match=r"roll_angle_deg: .*path of contact"):
            mesh(HONG, far)

    @pytest.mark.parametrize(
        ("torque", "angle", "share", "where"),
        [
            ([50, 50], [0.2, 0.3], [0.5, 50], "load_share"),
            ([50, 50], [0.2, 0.3], [0.5, math.nan], "load_share"),
            ([50, 0], [0.2, 0.3], [0.5, 0.5], "torque_Nm"),
            ([50, 60], [0.2, 0.3], [0.5, 0.5], "torque_Nm"),
            ([50, 50], [0.2, 0.2], [0.5, 0.6], "roll_angle_deg"),
            ([50, 50], ["a", 0.2], [0.5, 0.6], "roll_angle_deg"),
            ([50, 50, 50], [0.2, 0.3], [0.5, 0.6], "load_share"),
            ([], [], [], "torque_Nm"),
        ],
    )
    def test_bad_rows_are_refused_by_column(self, torque, angle, share, where):
        with pytest.raises(InputError, match=f"^{where}: "):
            TableSharing(torque, angle, share)

    @given(st.lists(st.tuples(st.floats(), st.floats(), st.floats()), max_size=5))
    @settings(deadline=None)
    def test_garbage_never_gives_anything_but_an_input_error(self, rows):
        columns = list(zip(*rows)) if rows else [[], [], []]
        try:
            mesh(HONG, TableSharing(*columns))
        except InputError:
            return

    def test_practice_cases_agree_with_the_trapezoid_over_their_rows(self, shared):
        rows = np.loadtxt(shared / "cases/case_000/load_share.csv", delimiter=",", skiprows=1)
        pair = replace(TIPPED, normal_module=4.2333333e-3)
        points = mesh(pair, TableSharing(rows[:, 0], np.radians(rows[:, 1]), rows[:, 2]))

        def loss(sliding, share):
            return (0.02 + 0.02 * np.arcsinh(300 * np.abs(sliding))) * share * np.abs(sliding)

        for torque in (50.0, 100.0, 150.0):
            ours = (points.weight * loss(points.sliding_per_speed, points.load_share(torque))).sum()
            _, angle, share = rows[rows[:, 0] == torque].T
            x = np.radians(angle) * pair.base_radius[0]
            sliding = x - (pair.line_of_action_length - x) / pair.gear_ratio
            assert ours == pytest.approx(np.trapezoid(loss(sliding, share), x) / pair.base_pitch, rel=5e-4)


class TestRollAngles:
    """Points at the roll angles of a recording."""

    def test_order_is_kept_and_weights_are_zero(self):
        angles = np.radians([30.0, 20.0, 25.0])
        points = at_roll_angle(HONG, RigidSharing(), angles)
        assert points.roll_angle == pytest.approx(angles, rel=1e-14)
        assert not points.weight.any()

    def test_rounded_ends_are_accepted(self):
        end = math.degrees(HONG.path_end / HONG.base_radius[0])
        points = at_roll_angle(HONG, RigidSharing(), math.radians(round(end, 1)))
        assert points.position[0] <= HONG.path_end

    @pytest.mark.parametrize("degrees", [2.0, 45.0])
    def test_outside_the_path_is_refused(self, degrees):
        with pytest.raises(InputError, match=r"roll_angle_deg: .*path of contact runs from"):
            at_roll_angle(HONG, RigidSharing(), math.radians(degrees))

    @pytest.mark.parametrize("angles", [math.nan, "x", [[0.3, 0.4]], []])
    def test_angles_are_a_column_of_numbers(self, angles):
        with pytest.raises(InputError, match=r"^roll_angle_deg: "):
            at_roll_angle(HONG, RigidSharing(), angles)
