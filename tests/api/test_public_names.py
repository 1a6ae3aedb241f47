"""The Python face: names load when they are used, in any order, and are retired with a warning."""

import subprocess
import sys
import warnings
from pathlib import Path

import pytest

import mixedlub as ml


def printed(code: str) -> str:
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.strip()


def test_importing_loads_nothing_heavy() -> None:
    heavy = {"numpy", "scipy", "pandas", "xarray", "matplotlib", "pydantic"}
    assert printed(f"import sys, mixedlub; print(sorted({heavy} & set(sys.modules)))") == "[]"


@pytest.mark.parametrize("first", [pytest.param("rooms", marks=pytest.mark.long), "names"])
def test_names_and_rooms_are_there_whichever_is_used_first(first: str) -> None:
    order = ("ml.ROOMS", "ml.PUBLIC") if first == "rooms" else ("ml.PUBLIC", "ml.ROOMS")
    code = "import mixedlub as ml, types\n"
    code += "".join(f"[getattr(ml, name) for name in {names}]\n" for names in order)
    code += "assert all(isinstance(getattr(ml, name), types.ModuleType) for name in (*ml.ROOMS, *ml.BESIDE))\n"
    code += "assert not any(isinstance(getattr(ml, name), types.ModuleType) for name in ml.PUBLIC)\n"
    assert printed(code + "print('all there')") == "all there"


@pytest.mark.parametrize("room", ml.ROOMS)
def test_every_name_that_a_room_offers_is_there_and_documented(room: str) -> None:
    found = getattr(ml, room)
    assert found.__doc__
    for name in found.__all__:
        assert getattr(found, name).__doc__, name


def test_laws_need_no_further_import() -> None:
    code = "import mixedlub as ml; print(ml.laws.film.dowson_toyoda.__name__)"
    assert printed(code) == "dowson_toyoda"


def test_a_folder_of_that_name_beside_a_script_does_not_hide_the_package(tmp_path: Path) -> None:
    """A clone is such a folder: a script beside it finds the package that is installed, from the clone or not."""
    (tmp_path / "mixedlub" / "docs").mkdir(parents=True)
    script = tmp_path / "script.py"
    script.write_text("import mixedlub as ml; print(ml.gear_pair.__name__)\n")
    found = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, check=False, cwd=tmp_path)
    assert found.stdout.strip() == "gear_pair", found.stderr


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="power_los"):
        ml.power_los  # noqa: B018


def test_a_retired_name_works_and_warns_of_its_successor(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(ml.RETIRED, "loss_of_power", "power_loss")
    with pytest.warns(DeprecationWarning, match=r"mixedlub\.power_loss"):
        assert ml.loss_of_power is ml.power_loss


def test_public_names_do_not_warn() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for name in ml.__all__:
            getattr(ml, name)
