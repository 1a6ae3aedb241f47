"""Fixtures shared by all tests."""

import os
from pathlib import Path

import pytest


def pytest_configure() -> None:
    """Each worker of a parallel run keeps to one processor: forks of a diagnosis in it would only copy its memory."""
    worker = os.environ.get("PYTEST_XDIST_WORKER", "")
    if worker and hasattr(os, "sched_setaffinity"):
        free = sorted(os.sched_getaffinity(0))
        os.sched_setaffinity(0, {free[int(worker.removeprefix("gw")) % len(free)]})


def pytest_make_parametrize_id(val: object, argname: str) -> str | None:
    """A file's bytes name no test: some hold the time they were made, which differs between workers."""
    return argname if isinstance(val, bytes) and len(val) > 40 else None


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of measured data beside the project; tests that need it skip where it is absent."""
    folder = Path(__file__).resolve().parents[2] / "shared"
    if not (folder / "data").is_dir():
        pytest.skip("measured data not present beside the project")
    return folder
