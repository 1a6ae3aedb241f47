"""A diagnosis reads each file of a rig once, however often it computes with what the file says."""

from collections import Counter
from collections.abc import Callable
from importlib import import_module, resources
from pathlib import Path

import pytest

from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.gear.sharing import table

SHARE = [(13.5, 0.5), (18.0, 0.5), (18.01, 1.0), (24.0, 1.0), (24.01, 0.5), (34.0, 0.5)]


def test_a_trace_and_a_load_share_table_are_read_once(
    make_case: Callable[..., Path], excluded: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = make_case(tmp_path / "case", "gear_pair")
    rows = "".join(f"100,{angle},{share}\n" for angle, share in SHARE)
    (case / "share.csv").write_text("torque_Nm,roll_angle_deg,load_share\n" + rows, encoding="utf-8")
    trace = resources.files("profiles.traces").joinpath("0302.txt").read_text(encoding="utf-8")
    (case / "flank.txt").write_text(trace, encoding="utf-8")
    text = (case / "system.toml").read_text(encoding="utf-8")
    text = text.replace('{ model = "rigid" }', '{ table = "share.csv" }')
    moments = "m0_um2 = 0.137\nm2 = 0.0031\nm4_per_um2 = 0.0021"
    assert moments in text
    (case / "system.toml").write_text(text.replace(moments, 'profile = "flank.txt"\ncutoff_mm = 0.8'), encoding="utf-8")
    read: Counter[str] = Counter()
    for module, name in ((import_module("profiles.read"), "read"), (table, "read_table")):
        original = getattr(module, name)

        def counted(path: Path, *rest: object, of: Callable[..., object] = original, **named: object) -> object:
            read[path.name] += 1
            return of(path, *rest, **named)

        monkeypatch.setattr(module, name, counted)
    diagnose_case(case, exclude=excluded)
    assert read == {"share.csv": 1, "flank.txt": 1}
