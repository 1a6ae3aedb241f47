"""What another package offers is found: an effect, a kind, laws, a load-sharing model, an importer, a reader."""

from __future__ import annotations

import csv
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal
from mixedlub.cli import main
from mixedlub.effects import catalogue
from mixedlub.ehl import EXAMPLE

ROOT = Path(__file__).resolve().parents[2]
FOREIGN = Path(__file__).with_name("foreign")
POINTS = {
    "mixedlub.effects": ("fan_effect",),
    "mixedlub.kinds": ("fan_kind",),
    "mixedlub.friction": ("fan_rubbing",),
    "mixedlub.parts": ("fan_blades",),
    "mixedlub.laws": ("fan_film", "fan_viscosity", "fan_shear", "fan_friction"),
    "mixedlub.ehl.oil": ("fan_oil",),
    "mixedlub.load_sharing": ("fan_sharing",),
    "mixedlub.evaluations": ("fan_evaluation",),
    "mixedlub.importers": ("fan_importer",),
    "mixedlub.readers": ("fan_reader:READER",),
}
"""Entry points of the foreign package by group: a module, or an object in it."""
STUDY = """
schema = "mixedlub-study/1"
conditions = { torque_Nm = [100], speed_rpm = [1500], oil_temperature_C = [60] }
gears = { teeth = [17, 26], normal_module_mm = 4.2, face_width_mm = 14.0 }
surfaces = { ground = { profile = "ground.fan", cutoff_mm = 0.8 } }
"""
LOSSY = STUDY.replace("14.0 }", '14.0, load_sharing = { model = "lossy", lost_share = 0.05 } }')
OPTIONS = """
[options]
film = "half_film"
viscosity_law = "linear"
viscosity_pressure = "mean"
effective_viscosity = "newton"
mixture = "film_only"
"""
RIVALS = ("sensor_offset", "sensor_gain", "churning")
"""Effects that a diagnosis weighs against those of the foreign package; all would take long."""
EFFECTS = """
[effects]
cooling_fan = { strength = 1000.0 }
"""


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the foreign package as an installer leaves it."""
    folder = tmp_path_factory.mktemp("fans")
    for file in FOREIGN.glob("*.py"):
        shutil.copy(file, folder)
    info = folder / "fans-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: fans\nVersion: 1.0\n", encoding="utf-8")
    groups = (f"[{group}]\n" + "".join(f"{m.partition(':')[0]} = {m}\n" for m in m_s) for group, m_s in POINTS.items())
    (info / "entry_points.txt").write_text("\n".join(groups), encoding="utf-8")
    return folder


def run(installed: Path, *arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """Python with the foreign package installed."""
    path = os.pathsep.join([str(installed), str(ROOT), os.environ.get("PYTHONPATH", "")])
    return subprocess.run(
        [sys.executable, *map(str, arguments)],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": path},
        check=False,
    )


def commands(installed: Path, *lines: Sequence[str | Path], then: str = "") -> subprocess.CompletedProcess[str]:
    """Commands of the program and then Python code in one process, with the foreign package installed."""
    words = [[str(word) for word in line] for line in lines]
    code = f"import sys; from mixedlub.cli import main; status = max(map(main, {words!r}))\n{then}\nsys.exit(status)"
    return run(installed, "-c", code)


def to_study(folder: Path, text: str, *options: str) -> list[str | Path]:
    """The command that runs a study of one condition, whose files are written."""
    folder.mkdir()
    heights = np.random.default_rng(1).integers(0, 2000, 12_000)
    (folder / "ground.fan").write_text("FANTRACE " + " ".join(f"{z:x}" for z in heights), encoding="utf-8")
    (folder / "study.toml").write_text(text, encoding="utf-8")
    return ["study", folder / "study.toml", "--out", folder / "out", *options]


def studied(folder: Path) -> dict[str, float]:
    """The numbers of a study of one condition."""
    with (folder / "out" / "results.csv").open(encoding="utf-8", newline="") as file:
        (row,) = csv.DictReader(file)
    return {name: float(cell) for name, cell in row.items() if "surface" not in name and name != "validity"}


def test_effect_of_another_package_appears_in_the_catalogue(installed: Path) -> None:
    code = (
        "from mixedlub.effects import catalogue; from mixedlub.report.effect_pages import effects_text, share;"
        "print(catalogue()['cooling_fan'].summary); print('cooling_fan' in effects_text());"
        "print((share('cooling_fan', 'gear_pair') > 0).all())"
    )
    said = run(installed, "-c", code)
    assert said.stdout.split("\n")[:3] == ["A fan on the shaft takes power.", "True", "True"], said.stderr


def test_a_study_runs_with_the_laws_and_the_trace_of_another_package(installed: Path, tmp_path: Path) -> None:
    said = commands(
        installed,
        to_study(tmp_path / "base", STUDY, "--no-figures"),
        to_study(tmp_path / "own", LOSSY + OPTIONS, "--no-figures"),
        to_study(tmp_path / "fanned", LOSSY + OPTIONS + EFFECTS, "--no-figures"),
        then="from mixedlub.report.page import content; from mixedlub.study import run\n"
        f"shown = content(run({str(tmp_path / 'own' / 'study.toml')!r}))\n"
        "print(shown['laws'], shown['options'], shown['gears'])",
    )
    assert said.returncode == 0, said.stderr
    base, own, fanned = (studied(tmp_path / name) for name in ("base", "own", "fanned"))
    # The film grows with the load to the power -0.1 and is half of that of the base model.
    assert own["film_thickness_um"] / base["film_thickness_um"] == pytest.approx(0.5 * 0.95**-0.1, rel=1e-9)
    assert fanned["power_loss_W"] - own["power_loss_W"] == pytest.approx(1000.0, rel=1e-9)
    for law in ("Half a film", "Taken at the mean Hertz pressure", "Principia", "asperities without friction"):
        assert law in said.stdout
    assert "lossy" in said.stdout
    assert "lost_share" in said.stdout


def test_a_study_follows_the_friction_law_of_another_package(installed: Path, tmp_path: Path) -> None:
    rubbing = STUDY + '[options]\nfriction = "fan_rubbing"\nfriction_coefficients = { grip = 0.07 }\n'
    study = to_study(tmp_path / "rubbing", rubbing, "--no-figures")
    said = commands(installed, study, ["friction-laws", "fan_rubbing"])
    found = studied(tmp_path / "rubbing")
    assert found["mean_friction"] == pytest.approx(0.07, rel=1e-12)
    assert "grip" in said.stdout
    assert "the maker of the fan" in said.stdout


def test_a_gearbox_takes_the_part_of_another_package(installed: Path) -> None:
    code = (
        "from mixedlub.parts import find; law = find('other', 'fan_blades');"
        "print(law.law(10.0, blades=7.0)); print('blades' in law.page());"
        "from mixedlub.cli import main; main(['parts', 'fan_blades'])"
    )
    said = run(installed, "-c", code).stdout
    assert said.split()[:2] == ["0.07", "True"]
    assert "the maker of the fan" in said


def test_the_solver_takes_the_oil_law_of_another_package(installed: Path, tmp_path: Path) -> None:
    text = EXAMPLE.read_text(encoding="utf-8")
    head, _, rest = text.partition("[shear]")
    shear = '[shear]\nlaw = "thinned"\nthinner_share = 0.5\n\n'
    (tmp_path / "oil.toml").write_text(head + shear + rest[rest.index("[density]") :], encoding="utf-8")
    code = (
        "import sys; import numpy as np; from mixedlub.ehl import read_oil; oil = read_oil(sys.argv[1]);"
        "print(float(oil.shear(np.array(4.0), 0.0)[0]), oil.newtonian)"
    )
    said = run(installed, "-c", code, tmp_path / "oil.toml")
    assert said.stdout.split() == ["5.0", "True"], said.stderr


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (('"lossy"', '"losy"'), "must be 'ldp', 'rigid' or 'lossy'; nearest known: 'lossy'"),
        (("0.05", "1.5"), "lost_share: 1.5: must be from 0 to 1"),
        (('"half_film"', '"half_films"'), "nearest known: 'half_film'"),
    ],
)
def test_wrong_values_of_foreign_keys_are_refused(
    installed: Path, tmp_path: Path, change: tuple[str, str], said: str
) -> None:
    (tmp_path / "study.toml").write_text((LOSSY + OPTIONS).replace(*change), encoding="utf-8")
    found = run(installed, "-m", "mixedlub", "study", tmp_path / "study.toml")
    assert found.returncode == 2
    assert said in found.stderr


def test_a_file_of_another_package_is_imported_and_its_kind_diagnosed(installed: Path, tmp_path: Path) -> None:
    """The drag is the base model's, and 20 mN m more at all speeds."""
    speed = np.repeat([500.0, 1000.0, 1500.0, 2000.0, 2500.0, 3000.0], 5)
    drag = 50.0 * (speed / 1000.0) ** 2 + 20.0
    noisy = drag * (1.0 + 0.005 * np.random.default_rng(3).standard_normal(speed.size))
    lines = ["FANLOG", *(f"{n:g} {t:.4f}" for n, t in zip(speed, noisy, strict=True))]
    (tmp_path / "log.fan").write_text("\n".join(lines) + "\n", encoding="utf-8")
    noise = ("--set", "recording.noise.relative=0.005")
    found = commands(
        installed,
        ["import", tmp_path / "log.fan", "--out", tmp_path / "case", *noise],
        ["diagnose", tmp_path / "case", "--out", tmp_path / "out"],
    )
    assert found.returncode == 0, found.stderr
    told = json.loads((tmp_path / "out" / "diagnosis.json").read_text(encoding="utf-8"))
    assert told["probabilities"]["sensor_offset"] > 0.5


def test_a_case_with_the_load_sharing_and_the_effect_of_another_package_is_diagnosed(
    installed: Path, tmp_path: Path
) -> None:
    """The readings of the template, and 60 W more each: the fan, or an offset of the instrument."""
    assert main(["new", "case", "--out", str(tmp_path / "case")]) == 0
    system = tmp_path / "case" / "system.toml"
    given = system.read_text(encoding="utf-8")
    lossy = given.replace("[lubricant]", 'load_sharing = { model = "lossy", lost_share = 0.05 }\n\n[lubricant]', 1)
    system.write_text(lossy, encoding="utf-8")
    head, *rows = (tmp_path / "case" / "recordings.csv").read_text(encoding="utf-8").splitlines()
    place = head.split(",").index("power_loss_W")
    cells = [row.split(",") for row in rows]
    more = [[*row[:place], str(float(row[place]) + 60.0), *row[place + 1 :]] for row in cells]
    lines = [head, *map(",".join, more)]
    (tmp_path / "case" / "recordings.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    others = (f"--exclude={name}" for name in catalogue() if name not in RIVALS)
    found = run(installed, "-m", "mixedlub", "diagnose", tmp_path / "case", "--out", tmp_path / "out", *others)
    assert found.returncode == 0, found.stderr
    told = json.loads((tmp_path / "out" / "diagnosis.json").read_text(encoding="utf-8"))
    assert told["probabilities"]["cooling_fan"] > 0.1
    assert "A fan on the shaft takes power." in (tmp_path / "out" / "report.html").read_text(encoding="utf-8")


@pytest.mark.long
def test_the_pages_of_the_docs_have_the_parts_of_another_package(installed: Path) -> None:
    extensions = ROOT / "docs" / "extensions"
    code = (
        f"import sys; sys.path.insert(0, {str(extensions)!r}); import generated;"
        "print(*generated.pages().values(), *generated.pieces().values())"
    )
    text = run(installed, "-c", code).stdout
    for part in ("A fan on the shaft takes power.", "fan_drag_mNm", "half_film", "fan_rubbing", "lost_share"):
        assert part in text


def test_the_format_reference_has_the_parts_of_another_package(installed: Path) -> None:
    text = commands(installed, ["kinds"], ["kinds", "study"]).stdout
    for part in ("fan_drag: drag of a fan against its speed", "fan_drag_mNm", "lost_share", '"lossy"'):
        assert part in text
    for law in ("half_film", "linear", "newton", "film_only", "fan_rubbing"):
        assert f'"{law}"' in text


def test_an_evaluation_of_another_package_has_its_template_and_runs(installed: Path, tmp_path: Path) -> None:
    rig, out = tmp_path / "rig", tmp_path / "out"
    said = commands(installed, ["new", "fan", "--out", rig], ["evaluate", "fan", rig / "fan.toml", "--out", out])
    assert "torque 0.2865 N m" in said.stdout, said.stderr
    assert (out / "figures" / "drag.svg").is_file()


def test_a_package_that_cannot_be_loaded_is_named(installed: Path) -> None:
    info = installed / "fans-1.0.dist-info" / "entry_points.txt"
    whole = info.read_text(encoding="utf-8")
    info.write_text(whole.replace("fan_kind = fan_kind", "fan_kind = fan_kinds"), encoding="utf-8")
    try:
        found = run(installed, "-m", "mixedlub", "kinds")
    finally:
        info.write_text(whole, encoding="utf-8")
    assert "entry point of mixedlub.kinds: 'fan_kinds': cannot be loaded" in found.stderr
    assert "Traceback" not in found.stderr


def declaration(**changed: Any) -> dict[str, Any]:
    return {
        "stage": "loss",
        "acts_on": "power_loss",
        "parameters": (Parameter("strength", "-", LogNormal(1.0, 0.5), "size", null=0.0),),
        "equation": "-",
        "source": "-",
        "fingerprint": {"load": "+"},
        "separated_by": "-",
    } | changed


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"stage": "mood"}, "stage 'mood'"),
        ({"acts_on": "mesh_loss"}, "what it acts on"),
        ({"parameters": ()}, "keyword-only arguments"),
    ],
)
def test_declaration_that_disagrees_with_the_signature_is_refused(changed: dict[str, Any], message: str) -> None:
    def cooling(power_loss, viscosity, *, strength):
        return power_loss

    with pytest.raises(TypeError, match=message):
        effect(**declaration(**changed))(cooling)


def test_argument_outside_the_glossary_names_the_nearest_word() -> None:
    def cooling(power_loss, viscosty, *, strength):
        return power_loss

    with pytest.raises(TypeError, match="viscosity"):
        effect(**declaration())(cooling)
