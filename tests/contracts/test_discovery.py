"""An effect of another package is found; a wrong declaration is refused."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal

FOREIGN = '''
from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal

@effect(
    stage="loss",
    acts_on="power_loss",
    parameters=(Parameter("strength", "W", LogNormal(1.0, 0.5), "power of the fan", null=0.0),),
    equation="P + c",
    source="the maker of the fan",
    fingerprint={"load": "-"},
    separated_by="pulling the plug of the fan and reading again",
)
def cooling_fan(power_loss, *, strength):
    """A fan on the shaft takes power."""
    return power_loss + strength
'''


def test_effect_of_another_package_appears_in_the_catalogue(tmp_path: Path) -> None:
    (tmp_path / "fans.py").write_text(FOREIGN, encoding="utf-8")
    info = tmp_path / "fans-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: fans\nVersion: 1.0\n", encoding="utf-8")
    (info / "entry_points.txt").write_text("[mixedlub.effects]\nfans = fans\n", encoding="utf-8")
    code = (
        "from mixedlub.effects import catalogue; from mixedlub.report.effect_pages import effects_text, share;"
        "print(catalogue()['cooling_fan'].summary); print('cooling_fan' in effects_text());"
        "print((share('cooling_fan', 'gear_pair') > 0).all())"
    )
    root = Path(__file__).resolve().parents[2]
    path = os.pathsep.join([str(tmp_path), str(root), os.environ.get("PYTHONPATH", "")])
    run = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": path},
        check=False,
    )
    assert run.stdout.split("\n")[:3] == ["A fan on the shaft takes power.", "True", "True"], run.stderr


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
