"""The line load of a mesh: that of the study and of statics, however the face is sliced."""

import numpy as np
import pytest

import mixedlub as ml
from mixedlub.gear import GearPair, LdpSharing, RigidSharing, mesh
from mixedlub.laws.load import gear_line_load
from profiles.errors import InputError

PAIR = GearPair((16, 24), 4.5e-3, np.radians(20), 14e-3, profile_shift=(0.182, 0.172), centre_distance=91.5e-3)
TORQUE = 302.0
SHARINGS = pytest.mark.parametrize("sharing", [RigidSharing(), LdpSharing()], ids=["rigid", "ldp"])


@SHARINGS
def test_it_carries_the_torque(sharing) -> None:
    """Where one pair is in contact, line load times width, summed over the slices, is the base-tangent force."""
    points = mesh(PAIR, sharing)
    force = (points.line_load(TORQUE) * points.contact_width).reshape(-1, points.slices).sum(axis=1)
    at_pitch = np.argmin(np.abs(points.position.reshape(-1, points.slices)[:, 0] - PAIR.pitch_point))
    assert force[at_pitch] == pytest.approx(TORQUE / PAIR.base_radius[0], rel=1e-6)


@SHARINGS
def test_it_does_not_shrink_with_the_slices(sharing) -> None:
    whole = mesh(PAIR, sharing, slices=1).line_load(TORQUE)
    sliced = mesh(PAIR, sharing, slices=7).line_load(TORQUE).reshape(-1, 7)
    assert sliced.mean(axis=1) == pytest.approx(whole, rel=0.02)


def test_the_face_width_in_place_of_the_slice_is_what_it_avoids() -> None:
    points = mesh(PAIR, LdpSharing())
    force = TORQUE / PAIR.base_radius[0]
    of_face = gear_line_load(points.load_share(TORQUE), force, PAIR.face_width)
    assert points.line_load(TORQUE) == pytest.approx(of_face * points.slices, rel=1e-12)
    assert points.slices > 1


def test_it_is_that_of_the_path() -> None:
    keys = {"teeth": (16, 24), "normal_module_mm": 4.5, "profile_shift": (0.182, 0.172), "centre_distance_mm": 91.5}
    pair = ml.gear_pair(**keys, face_width_mm=14.0, load_sharing={"model": "ldp"})
    surface = ml.surface(m0_um2=4e-4, m2=2e-4, m4_per_um2=4e-4)
    path = ml.along_path(pair, ml.oil("mineral"), surface, torque_Nm=TORQUE, speed_rpm=3000, oil_temperature_C=40)
    points = mesh(PAIR, LdpSharing())
    found = points.line_load(TORQUE).reshape(-1, points.slices) * 1e-3
    np.testing.assert_allclose(path["line_load_N_mm"].values, found, rtol=1e-12)


def test_torques_lead_its_shape_and_are_checked() -> None:
    points = mesh(PAIR, RigidSharing())
    assert points.line_load([[100.0, 200.0, 300.0]]).shape == (1, 3, points.position.size)
    with pytest.raises(InputError, match="torque_Nm"):
        points.line_load(0.0)
