import os
import socket
import subprocess
import sys
import threading
import time
import urllib.request

import pytest

pytest.importorskip("fastapi")


@pytest.fixture(scope="module")
def served(tmp_path_factory):
    """A running page: its address, the folder of its work, and its process."""
    work = tmp_path_factory.mktemp("work")
    command = [sys.executable, "-m", "mixedlub", "app", "--port", "0", "--no-browser", "--out", str(work)]
    environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment)
    address = process.stdout.readline().split()[0].rstrip("/")
    for _ in range(100):
        try:
            with urllib.request.urlopen(address, timeout=5):
                break
        except OSError:
            time.sleep(0.1)
    yield address, work, process
    process.terminate()
    process.wait(20)
    process.stdout.close()


@pytest.fixture(scope="module")
def in_process(tmp_path_factory):
    """A page in this process: its address, and the parts that its requests use."""
    import uvicorn

    from mixedlub.app.server import application, desk

    listening = socket.create_server(("127.0.0.1", 0))
    host = f"127.0.0.1:{listening.getsockname()[1]}"
    parts = desk(tmp_path_factory.mktemp("work"))
    config = uvicorn.Config(application(parts, [host]), log_level="critical", access_log=False)
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run, args=([listening],))
    thread.start()
    while not server.started:
        time.sleep(0.05)
    yield f"http://{host}", parts
    server.should_exit = True
    thread.join(20)
