"""What a rig can be set to is stated in [rig], and wrong statements are refused in one sentence."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from mixedlub.case.folder import Case, case_of
from mixedlub.schema.table import Table
from profiles.errors import InputError

OIL = {"temperature_C": [40.0, 100.0], "kinematic_viscosity_mm2_s": [30.0, 6.2]}
SURFACE = {"m0_um2": 0.137, "m2": 0.0031, "m4_per_um2": 0.0021}
DISCS: dict[str, Any] = {
    "kind": "disc",
    "contact": {"radius_mm": [20.0, 25.4], "width_mm": 6.0},
    "lubricant": {**OIL, "base": "mineral"},
    "surfaces": {"rough": SURFACE, "smooth": SURFACE},
    "recording": {"quantity": "friction_coefficient"},
}
ROWS = {
    "load_N": [100.0, 200.0, 300.0],
    "entrainment_speed_m_s": [1.0, 2.0, 3.0],
    "slide_roll_ratio": 0.1,
    "oil_temperature_C": 60.0,
    "surface_1": "rough",
    "surface_2": "smooth",
    "friction_coefficient": [0.05, 0.04, 0.03],
}


def discs(**rig: Any) -> Case:
    return case_of({**DISCS, "rig": rig}, ROWS)


def test_a_rig_does_what_it_states() -> None:
    reach = discs(load_N=[50, 400], oil_temperature_C={"steps": [40, 60, 80]}, pairings=[["rough", "smooth"]]).reach
    assert [reach.allows("load_N", x) for x in (49.0, 50.0, 400.0, 401.0)] == [False, True, True, False]
    assert [reach.allows("oil_temperature_C", x) for x in (40.0, 50.0)] == [True, False]
    assert reach.allows("slide_roll_ratio", 1.9)
    names = {"surface_1": np.array(["rough", "smooth"]), "surface_2": np.array(["smooth", "rough"])}
    table = Table({"run": np.array([1, 2]), "load_N": np.array([500.0, 100.0]), **names})
    beyond = list(reach.beyond(table, ("surface_1", "surface_2")))
    assert beyond == [(1, "load_N 500"), (2, "smooth on rough")]


@pytest.mark.parametrize(
    ("rig", "said"),
    [
        ({"load_N": [400, 50]}, "rig.load_N: [400, 50]: low must be below high"),
        ({"load_kN": [0.1, 0.4]}, "rig.load_kN: is no condition of kind 'disc'; nearest known: 'load_N'"),
        ({"load_N": {"steps": [3, 2]}}, "rig.load_N: steps must rise"),
        ({"load_N": {"levels": [1, 2]}}, "rig.load_N: must be a range [low, high] or { steps = [...] }"),
        ({"load_N": [-1, 5]}, "rig.load_N: -1.0: load_N must be above 0"),
        ({"oil_temperature_C": [293, 353]}, "oil_temperature_C must lie between -60 and 300"),
        ({"pairings": [["rough", "smoth"]]}, "rig.pairings: 'smoth': no such surface; nearest known: 'smooth'"),
        ({"pairings": [1, 2]}, 'rig.pairings: [1.0, 2.0]: must be pairs of surfaces: [["a", "b"], ...]'),
        ({"load_N": [["rough", "smooth"]]}, "rig.load_N: [['rough', 'smooth']]: must be numbers"),
        ({"load_N": "any"}, "rig.load_N: 'any': must be a range [low, high]"),
    ],
)
def test_wrong_statements_are_refused(rig: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError) as refusal:
        discs(**rig)
    assert said in str(refusal.value)
