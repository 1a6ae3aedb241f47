"""The built package: complete, described, and able to run all examples where no clone is."""

import os
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile
from email import message_from_bytes
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGES = ("mixedlub", "profiles", "roughness")
LEFT_OUT = {".git", ".venv", ".hypothesis", "__pycache__", "out", "build", "dist", "made", "node_modules"}
PROGRAMS = sorted(path.name for path in (ROOT / "examples").glob("[0-9]*.py"))
COMMANDS = (
    "mixedlub check case",
    "mixedlub simulate case --out simulated",
    "mixedlub profile shipped:0258 --out profile",
    "mixedlub study study_21_pairings.toml --out study",
    "python published/points.py",
    "python real/build.py --out real_cases",
    "python traces_rebuild.py",
)
"""Examples beside the numbered programs."""

pytestmark = pytest.mark.long


def installed(name: str) -> tuple[int, ...]:
    try:
        return tuple(map(int, re.findall(r"\d+", version(name))[:2]))
    except PackageNotFoundError:
        return (0,)


@pytest.fixture(scope="session")
def built(tmp_path_factory) -> Path:
    """Folder with the source distribution, and with the wheel that was built from it."""
    if installed("build") < (1,) or installed("setuptools") < (77,):
        pytest.skip("needs the packages build and setuptools>=77 of the extra dev")
    source, out = tmp_path_factory.mktemp("source") / "clone", tmp_path_factory.mktemp("dist")
    shutil.copytree(
        ROOT, source, ignore=lambda _, names: [n for n in names if n in LEFT_OUT or n.endswith((".egg-info", "_cache"))]
    )
    done = subprocess.run(
        [sys.executable, "-m", "build", "--no-isolation", "--outdir", str(out), str(source)],
        capture_output=True,
        text=True,
        check=False,
        env={name: value for name, value in os.environ.items() if name != "PYTHONPATH"},
    )
    assert done.returncode == 0, done.stderr
    assert "deprecat" not in (done.stdout + done.stderr).lower()
    return out


@pytest.fixture(scope="session")
def wheel(built: Path) -> Path:
    (found,) = built.glob("*.whl")
    return found


@pytest.fixture(scope="session")
def environment(wheel: Path, tmp_path_factory) -> Path:
    """Programs of an environment that holds the wheel, and beside it the dependencies of this one."""
    home = tmp_path_factory.mktemp("environment")
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", str(home)], check=True)
    python = home / "bin/python"
    install = [sys.executable, "-m", "pip", "--python", str(python), "install", "--no-deps", "--no-index"]
    subprocess.run([*install, "--quiet", str(wheel)], check=True)
    (packages,) = home.glob("lib/python*/site-packages")
    here = [path for path in sys.path if path.endswith("site-packages")]
    (packages / "dependencies.pth").write_text("\n".join(here) + "\n")
    return home / "bin"


def run(command: list[str], environment: Path, folder: Path) -> str:
    """Output of a command in the environment of the wheel, in a folder without the clone."""
    inherited = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "PYTHONHOME")}
    places = {"PATH": f"{environment}{os.pathsep}{os.environ['PATH']}", "MPLBACKEND": "agg"}
    done = subprocess.run(
        [str(environment / command[0]), *command[1:]],
        cwd=folder,
        env=inherited | places,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="session")
def copy(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("copy") / "examples"
    shutil.copytree(ROOT / "examples", folder, ignore=shutil.ignore_patterns("__pycache__"))
    return folder


def test_wheel_holds_every_file_of_the_packages_and_nothing_else(wheel: Path) -> None:
    there = {name for name in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in name}
    wanted = {
        path.relative_to(ROOT).as_posix()
        for package in PACKAGES
        for path in (ROOT / package).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    assert there == wanted


def test_source_distribution_holds_what_the_checks_need(built: Path) -> None:
    (file,) = built.glob("*.tar.gz")
    with tarfile.open(file) as archive:
        names = archive.getnames()
    there = {name.partition("/")[2] for name in names}
    folders = ("benchmarks", "docs", "examples", "tests")
    wanted = {
        path.relative_to(ROOT).as_posix()
        for folder in folders
        for path in (ROOT / folder).rglob("*")
        if path.is_file() and not {"__pycache__", "made"} & set(path.parts)
    }
    without_licence = {name for name in wanted if re.fullmatch(r"benchmarks/recordings/.*/recordings\.csv", name)}
    assert wanted - there == without_licence
    assert {"CHANGELOG.md", "CITATION.cff", "LICENSE", "Makefile", ".ci/run"} <= there
    assert not [name for name in there if name.startswith("docs/made") or name.endswith(".pyc")]


def test_metadata_describe_the_package(wheel: Path) -> None:
    archive = zipfile.ZipFile(wheel)
    (name,) = (name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
    found = message_from_bytes(archive.read(name))
    assert found["Description-Content-Type"] == "text/markdown"
    assert found["License-Expression"] == "MIT"
    assert found["Requires-Python"] == ">=3.11"
    description = found.get_payload()
    assert not re.findall(r"\]\((?!https?:)[^)]*\)", description)
    assert description.startswith("# mixedlub")


def test_index_would_take_the_files(built: Path) -> None:
    pytest.importorskip("twine")
    check = [sys.executable, "-m", "twine", "check", "--strict", *map(str, built.iterdir())]
    done = subprocess.run(check, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


def test_package_comes_from_the_wheel(environment: Path, copy: Path) -> None:
    code = "import mixedlub, profiles, roughness; print(mixedlub.__file__, profiles.__file__, roughness.__file__)"
    files = run(["python", "-c", code], environment, copy).split()
    assert all(Path(file).is_relative_to(environment.parent) for file in files), files


@pytest.mark.parametrize("program", PROGRAMS)
def test_numbered_examples_run_from_the_wheel(environment: Path, copy: Path, program: str) -> None:
    strict = ["-W", "error", "-W", "default:caution", "-W", "default:doubt"]
    assert run(["python", *strict, program], environment, copy).strip()


@pytest.mark.parametrize("command", COMMANDS)
def test_other_examples_run_from_the_wheel(environment: Path, copy: Path, command: str) -> None:
    run(command.split(), environment, copy)
