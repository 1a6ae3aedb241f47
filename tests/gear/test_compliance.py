"""Elastic laws of a tooth: published stiffnesses, exact plates, and the contact problem."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mixedlub.gear import GearPair
from mixedlub.gear.compliance import (
    bending_compliance,
    foundation_compliance,
    hertz_approach,
    iso_single_stiffness,
    sainsot_foundation,
    weber_foundation,
)
from mixedlub.gear.contact_solver import descend, share_out
from mixedlub.gear.plate import tapered_plate
from mixedlub.gear.tooth import Tooth, tooth
from profiles.errors import InputError
from tests.gear.pairs import HONG, NASA, STANDARD

PAIRS = [
    STANDARD,
    HONG,
    NASA,
    GearPair((40, 60), 2e-3, math.radians(20), 40e-3, profile_shift=(0.3, -0.1)),
]
STEEL = 206e9, 0.3


def foundation(pair, wheel, kind):
    if kind == "weber":
        return weber_foundation(0.3)
    body = tooth(pair, wheel)
    return sainsot_foundation(1.4, math.atan(body.root_chord / 2 / body.height[0]))


def pair_stiffness(pair, kind, line_load=3e5):
    """Single-pair stiffness at the pitch point, N/m per m."""
    x = np.array(pair.pitch_point)
    distances = x, pair.line_of_action_length - x
    bodies = [tooth(pair, wheel) for wheel in (0, 1)]
    give = sum(
        bending_compliance(body, distance, *STEEL)
        + foundation_compliance(body, distance, STEEL[0], foundation(pair, wheel, kind))
        for wheel, (body, distance) in enumerate(zip(bodies, distances))
    )
    radius = distances[0] * distances[1] / pair.line_of_action_length
    depths = tuple(body.depth(distance) for body, distance in zip(bodies, distances))
    flat, _ = hertz_approach(line_load, radius, pair.reduced_modulus, depths, (STEEL[0],) * 2, (STEEL[1],) * 2)
    return 1 / (give + flat / line_load)


class TestLiterature:
    """Published stiffnesses and exact solutions, at the tolerance they support."""

    @pytest.mark.literature("ISO 6336-1, method B")
    def test_iso_stiffness_of_the_standard_pair(self):
        assert iso_single_stiffness(STANDARD) / 1e9 == pytest.approx(16.032, abs=5e-4)

    @pytest.mark.parametrize("kind", ["weber", "sainsot"])
    def test_single_pair_stiffness_of_the_standard_pair(self, kind):
        assert 13 < pair_stiffness(STANDARD, kind) / 1e9 < 18

    def test_half_plane_foundation_agrees_with_finite_elements(self):
        # A plane-strain finite element model of this pair gives 17.06 N/(mm um).
        assert pair_stiffness(STANDARD, "weber") / 1e9 == pytest.approx(17.06, rel=0.05)

    @pytest.mark.literature("Sainsot, Velex and Duverger (2004), J. Mech. Des. 126, 748, doi:10.1115/1.1758252")
    def test_ring_foundation_is_15_to_20_percent_softer(self):
        ratio = pair_stiffness(STANDARD, "sainsot") / pair_stiffness(STANDARD, "weber")
        assert 0.80 < ratio < 0.85

    @pytest.mark.literature("ISO 6336-1, method B")
    @pytest.mark.parametrize("pair", PAIRS)
    def test_stiffness_is_near_the_iso_standard(self, pair):
        assert pair_stiffness(pair, "weber") == pytest.approx(iso_single_stiffness(pair), rel=0.15)

    @pytest.mark.literature("Weber and Banaschek (1953)")
    def test_weber_foundation_constants(self):
        assert weber_foundation(0.3)[1:] == pytest.approx((1.04, 1.534 * 0.91, 0.3205), abs=1e-4)

    @pytest.mark.literature("Palmgren's roller, 3.84e-5 F^0.9 / l^0.8")
    @pytest.mark.parametrize("force", [300.0, 1e3, 1e4])
    def test_hertz_approach_agrees_with_palmgrens_roller(self, force):
        # Empirical: 3.84e-5 F^0.9 / l^0.8 (mm, N); roller of 10 mm on a raceway 20 mm deep.
        length = 10.0
        measured = 3.84e-5 * force**0.9 / length**0.8 * 1e-3
        line = force / (length * 1e-3)
        computed, _ = hertz_approach(line, 5e-3, 206e9 / 0.91, (5e-3, 20e-3), (206e9, 206e9), (0.3, 0.3))
        assert computed == pytest.approx(measured, rel=0.03)

    @pytest.mark.literature("Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells")
    def test_point_load_on_the_free_edge_of_a_long_cantilever_plate(self):
        # Timoshenko and Woinowsky-Krieger: 0.168 P a^2/D; exact by transform in the next test.
        assert self.edge_deflection() == pytest.approx(0.168, rel=0.02)

    def test_point_load_on_the_free_edge_against_the_fourier_transform(self):
        k = np.linspace(1e-6, 40, 40001)
        s, c = np.sinh(k), np.cosh(k)
        nu = 0.3
        moment = -s - k * c - nu * (s - k * c), 2 * c + k * s - nu * k * s
        shear = -2 * c - k * s + (2 - nu) * k * s, 3 * s + k * c - (2 - nu) * (s + k * c)
        first = -1 / k**3 / (shear[0] - shear[1] * moment[0] / moment[1])
        edge = first * (s - k * c) - first * moment[0] / moment[1] * k * s
        exact = np.trapezoid(edge, k) / math.pi
        assert self.edge_deflection() == pytest.approx(exact, rel=0.01)

    @staticmethod
    def edge_deflection():
        """Deflection under the load over P a^2/D of a thin plate clamped along its root."""
        thickness, slices = 0.02, 81
        height = np.linspace(0, 1, 50)
        plate = tapered_plate(
            Tooth(1.0, 0.1, 0.0, height, np.full(50, thickness / 2)), 4.0, slices, 1.0, 0.3, (1e-6, 0.0, 1e-6, 0.0)
        )
        middle = plate.compliance(np.full((1, slices), 1.0))[0, slices // 2, slices // 2]
        return middle * thickness**3 / (12 * (1 - 0.3**2))


class TestLaws:
    """Limits and exact relations."""

    def test_hertz_slope_is_the_derivative(self):
        load = np.array([1e2, 1e5, 5e6])
        args = (8e-3, 206e9 / 0.91, (4e-3, 5e-3), (206e9, 100e9), (0.3, 0.2))
        _, slope = hertz_approach(load, *args)
        step = 1e-4 * load
        numeric = (hertz_approach(load + step, *args)[0] - hertz_approach(load - step, *args)[0]) / (2 * step)
        assert slope == pytest.approx(numeric, rel=1e-7)

    def test_hertz_logarithm_far_from_the_surface(self):
        load, radius, modulus = 1e3, 8e-3, 206e9 / 0.91
        width = math.sqrt(8 * load * radius / (math.pi * modulus))
        weber = 2 * load * 0.91 / (math.pi * 206e9) * (math.log(2 * 5e-3 / width) - 0.3 / 1.4)
        computed, _ = hertz_approach(load, radius, modulus, (5e-3, 5e-3), (206e9, 206e9), (0.3, 0.3))
        assert computed == pytest.approx(2 * weber, rel=1e-5)

    def test_bending_of_a_straight_cantilever(self):
        height = np.linspace(1.0, 2.0, 2001)
        beam = Tooth(2.0, 0.0, 1.0, height, np.full(2001, 0.05))
        tip = bending_compliance(beam, np.array(0.0), *STEEL)
        bending, shear = 12 * 0.91 / 0.1**3 / 3, 2.4 * 1.3 / 0.1
        assert tip == pytest.approx((bending + shear) / 206e9, rel=1e-6)

    def test_load_at_the_root_section_bends_nothing(self):
        body = tooth(STANDARD, 0)
        short = Tooth(body.base_radius, body.half_angle, 0.0, body.height + 2e-3, body.half_thickness)
        assert bending_compliance(short, np.array(STANDARD.pitch_point), *STEEL) == 0

    @pytest.mark.parametrize("pair", PAIRS)
    @pytest.mark.parametrize("wheel", [0, 1])
    def test_tooth_is_continuous_and_thickest_at_the_root(self, pair, wheel):
        body = tooth(pair, wheel)
        assert body.half_thickness.argmax() == 0
        assert np.abs(np.diff(body.half_thickness)).max() < 0.8 * np.diff(body.height)[0]
        tip = math.hypot(body.height[-1], body.half_thickness[-1])
        assert tip == pytest.approx(pair.tip_radii[wheel], rel=1e-9)

    @pytest.mark.parametrize("pair", PAIRS)
    @pytest.mark.parametrize("wheel", [0, 1])
    def test_thickness_at_the_reference_circle(self, pair, wheel):
        radius = pair.reference_radius[wheel]
        arc = pair.normal_module * (math.pi / 2 + 2 * pair.profile_shift[wheel] * math.tan(pair.pressure_angle))
        half = arc / 2 / radius
        body = tooth(pair, wheel)
        assert np.interp(radius * math.cos(half), body.height, body.half_thickness) == pytest.approx(
            radius * math.sin(half), rel=1e-5
        )

    def test_tooth_without_a_rack_is_refused(self):
        shifted = GearPair((60, 60), 2e-3, math.radians(20), 10e-3, profile_shift=(1.24, -0.6))
        with pytest.raises(InputError, match=r"^profile_shift: "):
            tooth(shifted, 0)

    def test_flank_and_fillet_meet_without_a_step_or_a_corner(self):
        for wheel in (0, 1):
            body = tooth(HONG, wheel, 4000)
            slope = np.diff(body.half_thickness) / np.diff(body.height)
            assert np.abs(np.diff(slope)).max() < 0.01


class TestPlate:
    """The tooth as a plate: what coupling across the face must obey."""

    @pytest.mark.parametrize("pair", PAIRS)
    @pytest.mark.parametrize("wheel", [0, 1])
    def test_uniform_load_deflects_by_the_beam_and_foundation_laws(self, pair, wheel):
        body = tooth(pair, wheel)
        x = np.linspace(pair.path_start, pair.path_end, 9)
        distance = x if wheel == 0 else pair.line_of_action_length - x
        upright = np.cos(body.load_angle(distance)) ** 2
        coefficients = (*weber_foundation(0.3)[:3], 0.0)
        # The plate knows no force along the tooth: leave its part out of the beam laws too.
        reach = body.load_height(distance)
        fine = np.linspace(body.height[0], reach, 400)
        inverse = 0.5 / np.interp(fine, body.height, body.half_thickness)
        along = 0.91 * np.tan(body.load_angle(distance)) ** 2 / 206e9 * np.trapezoid(inverse, fine, axis=0)
        beam = bending_compliance(body, distance, *STEEL) / upright - along
        beam += foundation_compliance(body, distance, 206e9, coefficients) / upright
        plate = tapered_plate(body, pair.face_width, 11, *STEEL, coefficients)
        mean = plate.compliance(np.repeat(reach[:, None], 11, axis=1)).sum(axis=(1, 2)) * pair.face_width / 11**2
        assert mean == pytest.approx(beam, rel=0.03)

    @pytest.mark.parametrize("wheel", [0, 1])
    def test_maxwell_reciprocity(self, wheel):
        body = tooth(HONG, wheel)
        plate = tapered_plate(body, HONG.face_width, 11, *STEEL, weber_foundation(0.3))
        height = np.linspace(body.height[0], body.height[-1], 7)[:, None]
        oblique = np.clip(height + np.linspace(-2e-3, 2e-3, 11), body.height[0], body.height[-1])
        matrix = plate.compliance(np.concatenate([np.repeat(height, 11, axis=1), oblique]))
        asymmetry = np.abs(matrix - matrix.transpose(0, 2, 1)).max()
        assert 0 <= asymmetry < 1e-11 * np.abs(matrix).max()

    def test_influence_is_positive_definite_and_falls_with_distance(self):
        body = tooth(HONG, 0)
        plate = tapered_plate(body, HONG.face_width, 11, *STEEL, weber_foundation(0.3))
        matrix = plate.compliance(np.full(11, body.height[-1]))
        assert np.linalg.eigvalsh(matrix).min() > 0
        assert np.all(np.diff(matrix[0]) < 0)
        assert matrix.min() > 0

    def test_mirrored_face_gives_the_mirrored_influence(self):
        body = tooth(HONG, 1)
        plate = tapered_plate(body, HONG.face_width, 8, *STEEL, weber_foundation(0.3))
        matrix = plate.compliance(np.full(8, body.height[200]))
        assert matrix[::-1, ::-1] == pytest.approx(matrix, rel=1e-10)


def random_problem(seed, size):
    """A dense positive definite problem, far from the friendly matrices of teeth."""
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(size, size))
    return root @ root.T + 1e-3 * np.eye(size), rng.normal(size=size) * 3, 10 ** rng.uniform(-2, 2)


def assert_optimal(compliance, gap, total, possible, force, approach):
    separation = compliance @ force + gap - approach
    scale = np.abs(compliance).max() * total + np.abs(gap).max()
    assert force.sum() == pytest.approx(total, rel=1e-10)
    assert np.all(force >= 0)
    assert not force[~possible].any()
    assert np.all(separation[possible] >= -1e-10 * scale)
    assert np.abs(force * separation).max() <= 1e-10 * scale * total


class TestComplementarity:
    """Forces where points touch, gaps where they do not, whatever the matrix."""

    @given(st.integers(0, 10_000), st.integers(1, 25))
    @settings(max_examples=50, deadline=None)
    def test_any_positive_definite_problem_is_solved(self, seed, size):
        compliance, gap, total = random_problem(seed, size)
        possible = np.random.default_rng(seed).random(size) < 0.8
        possible[0] = True
        force, approach, _ = share_out(
            compliance[None], gap[None], np.array([total]), possible[None], np.ones((1, size), bool)
        )
        assert_optimal(compliance, gap, total, possible, force[0], approach[0])

    @given(st.integers(0, 10_000), st.integers(2, 25))
    @settings(max_examples=40, deadline=None)
    def test_descent_alone_reaches_the_same_answer(self, seed, size):
        compliance, gap, total = random_problem(seed, size)
        possible = np.ones(size, bool)
        force, approach, touching = descend(
            compliance, gap, total, possible, np.ones(size), np.trace(compliance) / size
        )
        assert_optimal(compliance, gap, total, possible, force, approach)
        assert np.array_equal(touching, force > 0)

    def test_a_start_without_contact_is_mended(self):
        force, approach, touching = share_out(
            np.eye(2)[None], np.array([[1.0, 0.0]]), np.array([0.5]), np.ones((1, 2), bool), np.zeros((1, 2), bool)
        )
        assert force.tolist() == [[0.0, 0.5]]
        assert approach == pytest.approx([0.5])
        assert touching.tolist() == [[False, True]]
