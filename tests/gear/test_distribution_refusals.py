"""What the elastic load distribution cannot compute is refused by its key."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mixedlub.gear import GearPair, LdpSharing, mesh, transmission_error
from profiles.errors import InputError
from tests.gear.pairs import HONG, NASA

REFUSED = [
    ("tip_relief_um", {"tip_relief": (-1e-6, 0.0)}),
    ("tip_relief_um", {"tip_relief": "none"}),
    ("tip_relief_um", {"tip_relief": (math.nan, 0.0)}),
    ("relief_length_mm", {"tip_relief": (1e-6, 0.0)}),
    ("root_relief_length_mm", {"root_relief": (1e-6, 0.0)}),
    ("relief_form", {"relief_form": "round"}),
    ("lead_crown_um", {"lead_crown": -1e-6}),
    ("misalignment_um", {"misalignment": math.inf}),
    ("end_relief_length_mm", {"end_relief": (1e-6, 0.0)}),
    ("profile_slope_deviation_um", {"profile_slope_deviation": (math.nan, 0.0)}),
    ("lead_deviation_um", {"lead_deviation": (1e-6,)}),
    ("lead_deviation_um", {"lead_deviation": "flat"}),
    ("torque_end", {"torque_end": ("left", "none")}),
    ("body_diameter_mm", {"body_radius": (0.02, 0.03)}),
    ("body_diameter_mm", {"body_radius": (0.0, 0.03), "torque_end": ("front", "front")}),
    ("foundation", {"foundation": "weberr"}),
    ("bore_diameter_mm", {"foundation": "sainsot"}),
    ("bore_diameter_mm", {"foundation": "sainsot", "bore_radius": (0.0, 1.0)}),
]


class TestRefusals:
    """What cannot be computed is refused by its key."""

    @pytest.mark.parametrize(("key", "change"), REFUSED)
    def test_message_names_the_key(self, key, change):
        with pytest.raises(InputError, match=f"^{key}: "):
            LdpSharing(**change)

    def test_misspelt_foundation_gets_the_nearest_name(self):
        with pytest.raises(InputError, match="nearest known: 'weber'"):
            LdpSharing(foundation="webber")

    def test_relief_longer_than_the_path_is_refused(self):
        with pytest.raises(InputError, match=r"^relief_length_mm: 50\.0: .*longer than the path"):
            mesh(HONG, LdpSharing(tip_relief=(1e-6, 0.0), relief_length=(50e-3, 0.0)))

    def test_bore_outside_the_ring_law_is_refused(self):
        with pytest.raises(InputError, match=r"^bore_diameter_mm: .*1\.4 to 7"):
            mesh(HONG, LdpSharing(foundation="sainsot", bore_radius=(28e-3, 25e-3)))

    def test_contact_on_undercut_flanks_is_refused(self):
        # 12 teeth without profile shift at 20 degrees; 17 are the least that a standard rack does not undercut.
        pair = GearPair((12, 40), 3e-3, math.radians(20), 20e-3, tip_radius=(21e-3, 62.3e-3))
        with pytest.raises(InputError, match=r"^profile_shift: 0\.0: undercut: the involute of the pinion begins"):
            mesh(pair, LdpSharing())

    @pytest.mark.parametrize("torque", [0.0, -1.0, math.nan, "x"])
    def test_torque_must_be_above_zero(self, torque):
        with pytest.raises(InputError, match=r"^torque_Nm: "):
            transmission_error(HONG, LdpSharing(), torque)

    @given(
        st.dictionaries(
            st.sampled_from(
                [
                    "tip_relief",
                    "relief_length",
                    "root_relief",
                    "root_relief_length",
                    "relief_form",
                    "lead_crown",
                    "misalignment",
                    "foundation",
                    "bore_radius",
                ]
            ),
            st.one_of(
                st.none(),
                st.text(max_size=4),
                st.floats(),
                st.floats(0, 1e-3),
                st.tuples(st.floats(), st.floats()),
                st.tuples(st.floats(0, 1e-2), st.floats(0, 1e-2)),
                st.lists(st.text(max_size=2), max_size=3),
            ),
            min_size=1,
            max_size=4,
        )
    )
    @settings(max_examples=60, deadline=None)
    def test_garbage_never_gives_anything_but_an_input_error(self, changes):
        try:
            share = mesh(HONG, LdpSharing(**changes), points=1, slices=2).load_share(50.0)
        except InputError:
            return
        assert np.all(np.isfinite(share))
        assert np.all(share >= 0)


def test_the_ring_foundation_is_told_beyond_its_root_angles():
    """Half a root angle of 0.133 rad on 17 teeth, where the fit ends at 0.12; 28 teeth have 0.079."""
    beyond = mesh(HONG, LdpSharing(foundation="sainsot", bore_radius=(18e-3, 25e-3))).notes
    assert [(one.code, one.place) for one in beyond] == [("law_extrapolated", "pinion")]
    assert mesh(NASA, LdpSharing(foundation="sainsot", bore_radius=(18e-3, 18e-3))).notes == ()
