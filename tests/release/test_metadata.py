"""Files about the package agree with pyproject.toml: citation, recipe, container, workflow, data card."""

import ast
import re
import tomllib
from fnmatch import fnmatch
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
RECIPE = yaml.safe_load((ROOT / "conda/meta.yaml").read_text(encoding="utf-8"))
WORKFLOW = yaml.safe_load((ROOT / ".github/workflows/tests.yml").read_text(encoding="utf-8"))
CARD = (ROOT / "docs/reference/data.md").read_text(encoding="utf-8")
RENAMED = {"matplotlib": "matplotlib-base"}
"""Packages with another name on conda's channels."""
PACKAGES = ("mixedlub", "profiles", "roughness")
TEXT = {".py", ".html", ".css", ".js", ".typed"}
"""Suffixes of files that hold no data."""


def test_citation_states_the_same_as_the_package() -> None:
    assert CITATION["version"] == PROJECT["version"]
    assert CITATION["license"] == PROJECT["license"]
    assert [author["name"] for author in CITATION["authors"]] == [author["name"] for author in PROJECT["authors"]]
    assert set(PROJECT["keywords"]) <= set(CITATION["keywords"])


def test_stated_license_is_the_shipped_one() -> None:
    (file,) = PROJECT["license-files"]
    assert (ROOT / file).read_text(encoding="utf-8").startswith(f"{PROJECT['license']} License")


def test_oldest_python_is_the_same_everywhere() -> None:
    oldest = PROJECT["requires-python"].removeprefix(">=")
    assert f"Programming Language :: Python :: {oldest}" in PROJECT["classifiers"]
    assert f"python >={oldest}" in RECIPE["requirements"]["run"]
    assert set(re.findall(r"^FROM python:([\d.]+)", (ROOT / "Containerfile").read_text(), re.MULTILINE)) == {oldest}
    assert WORKFLOW["jobs"]["tests"]["strategy"]["matrix"]["python"][0] == oldest


def test_recipe_needs_the_packages_of_the_project() -> None:
    wanted = set()
    for needed in PROJECT["dependencies"]:
        name, bound = re.fullmatch(r"([\w-]+)>=([\d.]+)(?:;.*)?", needed).groups()
        wanted.add(f"{RENAMED.get(name, name)} >={bound}")
    assert set(RECIPE["requirements"]["run"]) - {f"python {PROJECT['requires-python']}"} == wanted
    assert RECIPE["package"] == {"name": PROJECT["name"], "version": PROJECT["version"]}
    ((name, target),) = PROJECT["scripts"].items()
    assert RECIPE["build"]["entry_points"] == [f"{name} = {target}"]


def test_workflow_takes_three_systems_and_four_pythons() -> None:
    matrix = WORKFLOW["jobs"]["tests"]["strategy"]["matrix"]
    assert {system.partition("-")[0] for system in matrix["os"]} == {"ubuntu", "macos", "windows"}
    assert matrix["python"] == ["3.11", "3.12", "3.13", "3.14"]


def test_workflow_uploads_nothing_to_an_index() -> None:
    commands = [step.get("run", "") for job in WORKFLOW["jobs"].values() for step in job["steps"]]
    assert not [line for line in commands if "upload" in line or "publish" in line]


def test_container_copies_what_the_build_needs() -> None:
    """The files that the ignore list lets through are the packages and the files that pyproject.toml names."""
    allowed = {line[1:] for line in (ROOT / ".containerignore").read_text().splitlines() if line.startswith("!")}
    assert allowed == {*PACKAGES, "pyproject.toml", "setup.py", "README.md", *PROJECT["license-files"]}


def shipped_data() -> list[str]:
    """Data files of the packages and of the folders beside them, by path in the clone."""
    folders = (*PACKAGES, "examples", "benchmarks")
    files = (path for folder in folders for path in (ROOT / folder).rglob("*") if path.is_file())
    return [
        path.relative_to(ROOT).as_posix()
        for path in files
        if path.suffix in {".csv", ".toml", ".txt", ".json"} and "__pycache__" not in path.parts
    ]


def test_data_card_names_every_data_file() -> None:
    patterns = re.findall(r"^\| `([^`]+)`", CARD, re.MULTILINE)
    files = shipped_data()
    if not [file for file in files if fnmatch(file, "benchmarks/recordings/*/recordings.csv")]:
        pytest.skip("a source distribution leaves measured readings out")
    assert len(files) > 200
    missed = [file for file in files if not any(fnmatch(file, pattern) for pattern in patterns)]
    assert not missed
    assert not [pattern for pattern in patterns if not any(fnmatch(file, pattern) for file in files)]


def readable(text: str) -> str:
    """The text as the wheel shows it, by the function in setup.py."""
    tree = ast.parse((ROOT / "setup.py").read_text(encoding="utf-8"))
    body = [node for node in tree.body if isinstance(node, ast.FunctionDef)]
    names: dict = {"re": re}
    exec(compile(ast.Module(body, []), "setup.py", "exec"), names)
    return names["for_a_wheel"](text)


@pytest.mark.parametrize(
    ("given", "shown"),
    [
        ("see [the page](docs/a.md)", "see the page"),
        ("see [the paper](https://doi.org/10)", "see [the paper](https://doi.org/10)"),
        ("![Loss over speed](a/b.svg)", "*Picture in the source: Loss over speed.*"),
        ("[two\nlines](LICENSE)", "two\nlines"),
    ],
)
def test_links_that_need_a_clone_become_words(given: str, shown: str) -> None:
    assert readable(given) == shown


def test_readme_of_the_wheel_has_no_link_into_the_clone() -> None:
    text = readable((ROOT / "README.md").read_text(encoding="utf-8"))
    assert not re.findall(r"\]\((?!https?:)[^)]*\)", text)
    assert "## Install" in text
