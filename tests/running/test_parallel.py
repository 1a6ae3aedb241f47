"""Work shared between processors gives the same as in turn."""

import multiprocessing
import os
from concurrent.futures.process import BrokenProcessPool

import pytest

from mixedlub.running import parallel
from mixedlub.running.parallel import shared_out


def test_results_keep_the_order_of_the_items(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parallel.os, "sched_getaffinity", lambda process: {0, 1, 2}, raising=False)
    offset = 10
    found = shared_out(lambda item: (item + offset, os.getpid()), range(20))
    assert [value for value, _ in found] == list(range(10, 30))
    if "fork" in multiprocessing.get_all_start_methods():
        assert os.getpid() not in {process for _, process in found}


def test_an_error_of_one_item_is_raised(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parallel.os, "sched_getaffinity", lambda process: {0, 1}, raising=False)
    with pytest.raises(ZeroDivisionError):
        shared_out(lambda item: 1 // item, [1, 0, 2])


def test_a_process_that_is_one_of_several_works_in_turn(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parallel.multiprocessing, "parent_process", lambda: "the first process")
    assert set(shared_out(lambda item: os.getpid(), range(4))) == {os.getpid()}


def test_a_process_that_dies_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parallel.os, "sched_getaffinity", lambda process: {0, 1}, raising=False)
    with pytest.raises(BrokenProcessPool):
        shared_out(lambda item: os._exit(1), range(4))
