"""Runs on Windows and macOS, as far as Linux can show: quoting, processes that start anew, processes that are alive."""

import os
import subprocess
import sys
from types import SimpleNamespace

import pytest

from mixedlub.running import atomic, parallel, shell


@pytest.mark.parametrize("word", ["plain", "columns.load_N=Force (N)", 'label="two words"', "a b\\", "50 %"])
def test_a_quoted_word_is_one_argument(word, monkeypatch):
    command = f"{sys.executable} -c 'import sys; print(sys.argv[1:])' {shell.quoted(word)}"
    assert subprocess.run(command, shell=True, capture_output=True, text=True).stdout == f"{[word]}\n"
    monkeypatch.setattr(shell.sys, "platform", "win32")
    assert shell.quoted(word) == subprocess.list2cmdline([word])
    assert "'" not in shell.quoted(word).replace(word, "")


def test_liveness_on_windows_sends_no_signal(monkeypatch):
    monkeypatch.setattr(atomic.sys, "platform", "win32")
    monkeypatch.setattr(atomic.os, "kill", lambda *_: pytest.fail("a signal ends a process on Windows"))
    monkeypatch.setitem(sys.modules, "psutil", SimpleNamespace(pid_exists=lambda number: number == os.getpid()))
    assert atomic.is_alive(str(os.getpid()))
    assert not atomic.is_alive("1")
    assert not atomic.is_alive("no number")


@pytest.mark.parametrize("number", ["", "x", "-1", "99999999999999999999"])
def test_a_number_of_no_process_is_not_alive(number):
    assert not atomic.is_alive(number)


SCRIPT = """
import os
from types import SimpleNamespace
from mixedlub.running import parallel
parallel.sys = SimpleNamespace(platform="darwin")
parallel.processors = lambda: 2
offset = 10
found = parallel.shared_out(lambda item: (item + offset, os.getpid(), os.environ.get(parallel._WORKER)), range(6))
print([value for value, _, _ in found], os.getpid() in [process for _, process, _ in found], [w for *_, w in found])
"""


def test_an_unguarded_script_shares_work_without_fork(tmp_path):
    pytest.importorskip("loky")
    (tmp_path / "script.py").write_text(SCRIPT)
    run = subprocess.run([sys.executable, "script.py"], cwd=tmp_path, capture_output=True, text=True, timeout=120)
    assert run.stdout.splitlines() == [f"{[10, 11, 12, 13, 14, 15]} False {['1'] * 6}"], run.stderr


def test_processors_are_counted_where_none_can_be_set_apart(monkeypatch):
    monkeypatch.delattr(parallel.os, "sched_getaffinity", raising=False)
    monkeypatch.setattr(parallel.os, "cpu_count", lambda: None)
    assert parallel.processors() == 1


@pytest.mark.parametrize("name", ["roughness.py", "profiles.py", "profiles/__init__.py"])
def test_a_file_that_hides_a_package_is_named(name, tmp_path):
    (tmp_path / name).parent.mkdir(exist_ok=True)
    (tmp_path / name).touch()
    (tmp_path / "script.py").write_text("import mixedlub")
    run = subprocess.run([sys.executable, "script.py"], cwd=tmp_path, capture_output=True, text=True)
    assert run.returncode == 1
    assert run.stderr.splitlines()[-1].startswith(f"ImportError: {tmp_path / name} hides the package")
