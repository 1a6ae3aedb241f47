"""Surfaces of a case from the traces that come with the package."""

from pathlib import Path

import numpy as np
import pytest

from mixedlub.rig.rig import Rig
from mixedlub.schema import surface_file, system_file
from mixedlub.schema.findings import codes, collected
from profiles import shipped
from profiles.errors import InputError
from roughness import evaluation_profile, moments


def rig(folder: Path, name: str) -> Rig:
    flank = surface_file.SurfaceSection(profile=name, cutoff_mm=0.8, short_cutoff_um=2.5)
    return Rig(system_file.RigFile(surfaces={"ground": flank}), folder)


def test_a_shipped_trace_needs_no_file(tmp_path: Path) -> None:
    with collected() as told:
        found = rig(tmp_path, "shipped:0302").surface("ground")
    assert codes(told) == ["trace_synthetic"]
    own = moments(evaluation_profile(shipped("0302"), form="line", cutoff=0.8e-3, short_cutoff=2.5e-6))
    assert np.array([found.m0, found.m2, found.m4]) == pytest.approx(np.array([own.m0, own.m2, own.m4]), rel=1e-12)


def test_an_unknown_shipped_trace_is_told_the_nearest(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"surfaces\.ground\.profile.*no such shipped trace.*0302"):
        rig(tmp_path, "shipped:0303").surface("ground")
