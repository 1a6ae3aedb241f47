"""Measured traces for the tests, read by the plainest means, and Gaussian traces of known spectrum."""

import json
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from mixedlub.cli import main
from mixedlub.rig.rig import Rig
from mixedlub.schema.system_file import RigFile
from profiles import Profile


@pytest.fixture(scope="session")
def measured(shared: Path) -> Path:
    return shared / "data" / "profiles"


@pytest.fixture(scope="session")
def nist(measured: Path) -> Callable[[str], tuple[Profile, np.ndarray | None]]:
    """A softgauge as (profile, NIST's filtered heights in m or None)."""

    def block(text: str, tag: str) -> np.ndarray | None:
        found = re.search(rf"<{tag}>([^<]+)</{tag}>", text)
        return np.array(found.group(1).split(), float) * 1e-6 if found else None

    @cache
    def read(name: str) -> tuple[Profile, np.ndarray | None]:
        text = (measured / "reference" / f"{name}.xml").read_text()
        spacing = float(re.search(r"<SPACING>(.*?)<", text).group(1)) * 1e-6
        profile = Profile(block(text, "DATA_POINT_VALUES"), spacing, name=name)
        return profile, block(text, "SHORT_CUTOFF_PROFILE_DATA_POINT_VALUES")

    return read


@pytest.fixture(scope="session")
def mitutoyo(measured: Path) -> Callable[[str], Profile]:
    """The R profile stored in a Mitutoyo report."""

    @cache
    def read(name: str) -> Profile:
        import openpyxl

        with (measured / "reference" / f"{name}.xlsx").open("rb") as file:
            book = openpyxl.load_workbook(file, data_only=True, read_only=True)
            rows = [row[4:6] for row in book["DATA"].iter_rows(values_only=True)]
            book.close()
        table = np.array([r for r in rows if len(r) == 2 and all(isinstance(v, (int, float)) for v in r)])
        spacing = (table[-1, 0] - table[0, 0]) / (len(table) - 1)
        return Profile(table[:, 1] * 1e-6, spacing * 1e-3, name=name)

    return read


@pytest.fixture(scope="session")
def gaussian_trace() -> Callable[..., Profile]:
    """A periodic Gaussian trace: flat to the roll-off, self-affine above, smooth below ``short``."""

    def make(
        points: int = 9600, spacing: float = 0.5e-6, roll: float = 40e-6, short: float = 6e-6, seed: int = 0
    ) -> Profile:
        rng = np.random.default_rng(seed)
        f = np.fft.rfftfreq(points, spacing)
        density = (1 + (f * roll) ** 2) ** -1.3 * np.exp(-((f * short) ** 2))
        density[0] = 0.0
        noise = rng.normal(size=f.size) + 1j * rng.normal(size=f.size)
        z = np.fft.irfft(np.sqrt(density) * noise, points)
        return Profile(0.3e-6 * z / z.std(), spacing, name=f"gaussian {seed}")

    return make


@pytest.fixture(scope="session")
def plateau_trace(gaussian_trace: Callable[..., Profile]) -> Callable[..., Profile]:
    """A fine plateau of sigma 0.1 um into which valleys of another sigma cut: the lower of two surfaces."""

    def make(valley_sigma: float = 0.5e-6, lift: float = 0.4e-6, seed: int = 0, points: int = 9600) -> Profile:
        fine = gaussian_trace(points, roll=30e-6, seed=2 * seed).heights / 3
        deep = gaussian_trace(points, roll=60e-6, seed=2 * seed + 1).heights * (valley_sigma / 0.3e-6)
        return Profile(np.minimum(fine, deep + lift), 0.5e-6, name="plateau")

    return make


def rig_of(folder, **surfaces):
    return Rig(RigFile(surfaces=surfaces), folder)


@pytest.fixture
def evaluated(tmp_path):
    """The row of one file, through the command line."""

    def run(file, *options):
        assert main(["profile", str(file), "--no-figures", "--replace", "--out", str(tmp_path), *options]) == 0
        (row,) = json.loads((tmp_path / "profile.json").read_text())
        return row

    return run
