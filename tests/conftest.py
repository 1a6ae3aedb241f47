"""Fixtures shared by all tests."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from mixedlub.report.figures import Drawn


def pytest_configure() -> None:
    """Each worker of a parallel run keeps to one processor: forks of a diagnosis in it would only copy its memory."""
    worker = os.environ.get("PYTEST_XDIST_WORKER", "")
    if worker and hasattr(os, "sched_setaffinity"):
        free = sorted(os.sched_getaffinity(0))
        os.sched_setaffinity(0, {free[int(worker.removeprefix("gw")) % len(free)]})


def pytest_make_parametrize_id(val: object, argname: str) -> str | None:
    """A file's bytes name no test: some hold the time they were made, which differs between workers."""
    return argname if isinstance(val, bytes) and len(val) > 40 else None


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pages of studies without drawing: the files of figures are empty."""

    def saved(drawn: Drawn, folder: Path, formats: Sequence[str]) -> str:
        for form in formats:
            (folder / f"{drawn.name}.{form}").touch()
        return ""

    monkeypatch.setattr("mixedlub.report.html._saved", saved)


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of measured data beside the project; tests that need it skip where it is absent."""
    folder = Path(__file__).resolve().parents[2] / "shared"
    if not (folder / "data").is_dir():
        pytest.skip("measured data not present beside the project")
    return folder
