"""A cluster that fails is one sentence, at once, and the work done is kept."""

import http.server
import os
import signal
import socket
import subprocess
import sys
import threading
import time

import pytest

from mixedlub.cli import main
from mixedlub.running.cluster import on_cluster
from mixedlub.study import batch, read_study, run_study
from profiles.errors import InputError, RunError

distributed = pytest.importorskip("distributed")


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


def start(module, *words):
    return subprocess.Popen(
        [sys.executable, "-m", f"distributed.cli.{module}", *words],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )


def until(condition, seconds=60.0):
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, "it did not come about in time"
        time.sleep(0.05)


def answers(port):
    with socket.socket() as there:
        return there.connect_ex(("127.0.0.1", port)) == 0


@pytest.fixture
def cluster():
    """A scheduler in a process of its own, and a function that starts a worker for it."""
    port = free_port()
    address = f"tcp://127.0.0.1:{port}"
    processes = [start("dask_scheduler", "--port", str(port), "--no-dashboard")]
    until(lambda: answers(port))

    def worker():
        words = (address, "--nthreads", "1", "--no-nanny", "--no-dashboard")
        processes.append(start("dask_worker", *words))
        with distributed.Client(address, set_as_default=False) as client:
            client.wait_for_workers(1, timeout=60)
        return processes[-1]

    yield address, processes[0], worker
    for process in processes:
        process.kill()
        process.wait()


@pytest.mark.parametrize(
    ("address", "said"),
    [
        (f"tcp://127.0.0.1:{free_port()}", "no Dask scheduler answers there (Connection refused)"),
        ("localhost", "an address is tcp://HOST:PORT"),
        ("tcp://localhost:http", "no Dask scheduler answers there"),
    ],
    ids=["nobody there", "no port", "no number"],
)
def test_a_wrong_address_is_bad_input_at_once(address, said, write_study, tmp_path, capfd):
    command = ["study", str(write_study()), "--no-figures", "--out", str(tmp_path / "o"), "--scheduler", address]
    assert main(command) == 2
    err = capfd.readouterr().err
    assert said in err
    assert "Traceback" not in err


def test_another_service_is_not_taken_for_a_scheduler():
    server = http.server.HTTPServer(("127.0.0.1", 0), http.server.BaseHTTPRequestHandler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        with pytest.raises(InputError, match="no Dask scheduler answers there"):
            list(on_cluster(max, 1, [2], f"tcp://127.0.0.1:{server.server_port}"))
    finally:
        server.shutdown()
        server.server_close()


def test_a_scheduler_without_workers_says_how_to_start_one(cluster):
    address, _, _ = cluster
    with pytest.raises(RunError, match=f"no worker: start one with `dask worker {address}`"):
        list(on_cluster(max, 1, [2], address))


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs kill -9")
@pytest.mark.parametrize("victim", ["worker", pytest.param("scheduler", marks=pytest.mark.long)])
def test_a_killed_process_is_one_sentence_and_the_rerun_goes_on(
    victim, cluster, write_study, tmp_path, monkeypatch, capfd
):
    address, scheduler, worker = cluster
    process = {"worker": worker(), "scheduler": scheduler}[victim]
    monkeypatch.setattr(batch, "BLOCK_POINTS", 150)
    path, out = write_study(), tmp_path / "o"
    keep, kept = "mixedlub.study.checkpoint.keep", []
    from mixedlub.study import checkpoint

    original = checkpoint.keep

    def keep_then_kill(folder, block, found):
        original(folder, block, found)
        kept.append(block)
        if len(kept) == 2:
            os.kill(process.pid, signal.SIGKILL)
            process.wait()

    monkeypatch.setattr(keep, keep_then_kill)
    monkeypatch.setattr("mixedlub.study.batch.compute", _slowly)
    assert main(["study", str(path), "--no-figures", "--out", str(out), "--scheduler", address]) == 1
    err = capfd.readouterr().err
    assert (
        f"the last worker of the scheduler at {address}" in err
        or f"the connection to the scheduler at {address}" in err
    )
    assert f"what was done is kept in {out}, and the same command goes on from there" in err
    assert "Traceback" not in err
    assert not list(out.glob("*.log"))
    monkeypatch.undo()
    whole = run_study(read_study(path))
    monkeypatch.setattr(batch, "BLOCK_POINTS", 150)
    assert main(["study", str(path), "--no-figures", "--out", str(out)]) == 0
    assert "blocks kept from an earlier start" in capfd.readouterr().out
    assert (out / "results.csv").read_bytes() == _csv(whole, tmp_path)


def _slowly(plan, block):
    """As `compute`, but no worker is done before the test has killed it."""
    import time

    from mixedlub.study.batch import compute

    time.sleep(0.1)
    return compute(plan, block)


def _csv(results, folder):
    results.write(folder / "whole.csv", folder / "whole.parquet")
    return (folder / "whole.csv").read_bytes()
