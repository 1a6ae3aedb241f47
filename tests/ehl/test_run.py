"""Many contacts in parts: those that are there are not solved again, and other contacts never take them."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mixedlub.ehl import contacts, example_oil, run
from mixedlub.ehl.line_contacts import Contacts
from mixedlub.ehl.solve import solved

COUNT = 40


def some() -> Contacts:
    speed = np.linspace(1.0, 5.0, COUNT)
    return contacts(radius=0.01, line_load=2e5, speed=speed, oil_temperature=333.15)


def solver(found: Contacts) -> dict[str, np.ndarray]:
    """A stand-in for the solver: twice the speed, and one that fails past the second part."""
    return {"twice": 2.0 * found.speed, "status": np.full(len(found.radius), "converged")}


def failing(found: Contacts) -> dict[str, np.ndarray]:
    if found.speed[0] > 4.0:
        raise KeyboardInterrupt
    return solver(found)


def never(found: Contacts) -> dict[str, np.ndarray]:
    raise AssertionError("was there already")


@pytest.fixture(autouse=True)
def _in_turn(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mixedlub.running.parallel.os.sched_getaffinity", lambda process: {0}, raising=False)


def test_a_stopped_run_goes_on_with_the_parts_that_it_has(tmp_path: Path) -> None:
    told: list[tuple[int, int]] = []
    with pytest.raises(KeyboardInterrupt):
        run.run_parts(failing, some(), keep=tmp_path)
    assert len(list(tmp_path.glob("*.npz"))) == 2
    found = run.run_parts(solver, some(), keep=tmp_path, progress=lambda done, of: told.append((done, of)))
    assert told == [(2, 3), (3, 3)]
    assert found["twice"].tolist() == (2.0 * some().speed).tolist()
    assert set(found["status"]) == {"converged"}
    again = run.run_parts(never, some(), keep=tmp_path)
    assert again["twice"].tolist() == found["twice"].tolist()


def test_a_damaged_part_is_solved_again(tmp_path: Path) -> None:
    run.run_parts(solver, some(), keep=tmp_path)
    (tmp_path / "1.npz").write_bytes(b"half")
    assert run.run_parts(solver, some(), keep=tmp_path)["twice"].tolist() == (2.0 * some().speed).tolist()


def test_parts_are_of_one_oil_and_its_contacts_alone(tmp_path: Path) -> None:
    oil, here = example_oil(), some()
    thicker = replace(oil, conductivity=oil.conductivity * 1.01)
    others = (
        run.parts_folder(tmp_path, oil, here.take(np.arange(3)), thermal=True),
        run.parts_folder(tmp_path, oil, here, thermal=False),
        run.parts_folder(tmp_path, thicker, here, thermal=True),
        run.parts_folder(tmp_path, replace(oil, stress_scale=lambda p: np.full_like(p, 6e6)), here, thermal=True),
    )
    own = run.parts_folder(tmp_path, oil, here, thermal=True)
    assert own == run.parts_folder(tmp_path, example_oil(), some(), thermal=True)
    assert len({own, *others}) == 5


def test_workers_of_a_cluster_solve_the_same(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    oil, here = example_oil(), some().take(np.arange(2))
    alone = solved(oil, here, thermal=False)
    with distributed.LocalCluster(1, threads_per_worker=1, processes=False, dashboard_address=None) as cluster:
        found = solved(oil, here, thermal=False, scheduler=cluster.scheduler_address)
    # Threads of linear algebra add in another order.
    assert found["central_film"].to_numpy() == pytest.approx(alone["central_film"].to_numpy(), rel=1e-12)
