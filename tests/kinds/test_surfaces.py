"""Surfaces of a case from the traces that come with the package."""

from pathlib import Path

import numpy as np
import pytest

from mixedlub.rig import build
from mixedlub.schema import system_file
from profiles import shipped
from profiles.errors import InputError
from roughness import evaluation_profile, moments


def flank(name: str) -> system_file.SurfaceSection:
    return system_file.SurfaceSection(profile=name, cutoff_mm=0.8, short_cutoff_um=2.5)


def test_a_shipped_trace_needs_no_file(tmp_path: Path) -> None:
    found = build.surface("ground", flank("shipped:0302"), tmp_path)
    own = moments(evaluation_profile(shipped("0302"), form="line", cutoff=0.8e-3, short_cutoff=2.5e-6))
    assert np.array([found.m0, found.m2, found.m4]) == pytest.approx(np.array([own.m0, own.m2, own.m4]), rel=1e-12)


def test_an_unknown_shipped_trace_is_told_the_nearest(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"surfaces\.ground\.profile.*no such shipped trace.*0302"):
        build.surface("ground", flank("shipped:0303"), tmp_path)
