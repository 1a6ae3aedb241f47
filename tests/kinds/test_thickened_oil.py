"""Polymer in an oil, as its viscosity index shows it, before any film is seen."""

import shutil
from pathlib import Path

import pytest

from mixedlub.case.folder import read_case
from mixedlub.case.forward import Forward


@pytest.mark.parametrize(
    ("oil", "times"),
    [
        ("kinematic_viscosity_mm2_s = [67.0, 18.9]", 5.0),
        ("kinematic_viscosity_mm2_s = [67.0, 8.7]", 1.0),
        ('base = "pag"\nkinematic_viscosity_mm2_s = [67.0, 18.9]', 1.0),
    ],
)
def test_oils_that_show_polymer_by_their_index_thin_more_often(typed_in, tmp_path, oil, times):
    folder = Path(shutil.copytree(typed_in / "ehd_film_31C_50N", tmp_path / "case"))
    system = (folder / "system.toml").read_text(encoding="utf-8")
    (folder / "system.toml").write_text(system.replace("kinematic_viscosity_mm2_s = [67.0, 18.9]", oil), "utf-8")
    case = read_case(folder)
    forward = Forward(case, case.recordings)
    assert {e.id: forward.odds(e) / e.odds for e in forward.effects() if forward.odds(e) != e.odds} == (
        {"inlet_shear_thinning": times} if times > 1.0 else {}
    )
