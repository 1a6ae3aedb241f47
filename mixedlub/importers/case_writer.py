"""Atomic writing of case folders: `system.toml`, `recordings.csv` and attached files."""

from __future__ import annotations

import csv
import io
import shutil
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from mixedlub.running.atomic import writing
from mixedlub.schema.findings import Finding, as_records
from mixedlub.schema.toml_file import Comments, to_toml
from profiles.errors import InputError


def write_case(
    out: Path,
    system: Mapping[str, Any],
    columns: Mapping[str, Sequence[Any] | np.ndarray],
    *,
    overwrite: bool = True,
    comments: Comments | None = None,
    attachments: Mapping[str, bytes] | None = None,
    check: Callable[[Path], None] | None = None,
) -> Path:
    """Write all files of a case folder or none; keep its other files. A folder without a case is an error.

    ``columns``: recording; a missing ``run`` is numbered from 1. ``comments``: lines below the tables of system.toml.
    ``attachments``: further files by path in the case. ``check``: called with the folder before its files appear.
    Without ``overwrite``, an existing file with other content is an error.
    """
    if not out.is_dir() and out.exists():
        raise InputError("exists and is no case folder; name another --out", where=str(out))
    if out.is_dir() and not (out / "system.toml").exists() and any(p for p in out.iterdir() if not _unfinished(p)):
        raise InputError("exists and is no case folder; name another --out", where=str(out))
    files = {
        "system.toml": to_toml({"schema": "mixedlub-case/1", **system}, comments=comments).encode(),
        "recordings.csv": _recordings(out, columns).encode(),
        **(attachments or {}),
    }
    differing = [
        name for name, content in files.items() if (out / name).exists() and _content_of(out / name) != content
    ]
    if differing and not overwrite:
        raise InputError(
            "exists and differs from what would be written, so it is kept; name another --out, or "
            f"replace it by --overwrite; with --answers {out / 'system.toml'} --overwrite its description is kept",
            where=str(out / differing[0]),
        )
    if not differing and all((out / name).exists() for name in files):
        return out
    created = [path for path in (out, *out.parents) if not path.exists()]
    try:
        out.mkdir(parents=True, exist_ok=True)
        with writing(out) as aside:
            _fill(aside, out, files)
            if check is not None:
                check(aside)
    except OSError as error:
        raise InputError(f"cannot be written to ({error.strerror})", where=str(out)) from None
    finally:
        _drop_empty(created)
    return out


def _fill(aside: Path, out: Path, files: Mapping[str, bytes]) -> None:
    """Write the files, and copy the other files of their subfolders, since folders are replaced as a whole."""
    for folder in {Path(name).parts[0] for name in files if len(Path(name).parts) > 1}:
        if (out / folder).is_dir():
            shutil.copytree(out / folder, aside / folder)
    for name, content in files.items():
        (aside / name).parent.mkdir(parents=True, exist_ok=True)
        (aside / name).write_bytes(content)


def _drop_empty(created: Sequence[Path]) -> None:
    """Remove empty folders created for a case not written."""
    for folder in created:
        if folder.is_dir() and not any(folder.iterdir()):
            folder.rmdir()


def _unfinished(path: Path) -> bool:
    return path.name.startswith(".writing-")


def _content_of(path: Path) -> bytes | None:
    return path.read_bytes() if path.is_file() else None


def _recordings(out: Path, columns: Mapping[str, Sequence[Any] | np.ndarray]) -> str:
    lengths = {len(values) for values in columns.values()}
    if len(lengths) != 1:
        raise InputError("columns differ in length", where=str(out), value=sorted(lengths))
    numbered = columns if "run" in columns else {"run": range(1, lengths.pop() + 1), **columns}
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(numbered)
    plain = [values.tolist() if isinstance(values, np.ndarray) else values for values in numbered.values()]
    writer.writerows(zip(*(map(cell, values) for values in plain), strict=True))
    return text.getvalue()


def cell(value: Any) -> Any:
    """Table cell of a value: a number in the fewest digits that read back equal, empty for nan.

    >>> cell(1619110000.1), cell(40.0), cell(0.1 + 0.2), cell(float("nan")), cell("ground")
    ('1619110000.1', '40', '0.30000000000000004', '', 'ground')
    """
    if not isinstance(value, float) and not isinstance(value, np.floating):
        return value
    number = float(value)
    return "" if number != number else repr(number).removesuffix(".0")


def findings_toml(found: Iterable[Finding]) -> str:
    """Findings of an import in the format of `import.toml`.

    >>> from mixedlub.schema.findings import finding
    >>> print(findings_toml([finding("file_incomplete", "line 7 breaks off", "rig.txt")]), end="")
    # What `mixedlub import` warned of. `check` and `diagnose` repeat it; delete what is resolved.
    <BLANKLINE>
    [[finding]]
    code = "file_incomplete"
    severity = "caution"
    place = "rig.txt"
    text = "line 7 breaks off"
    """
    head = "# What `mixedlub import` warned of. `check` and `diagnose` repeat it; delete what is resolved.\n"
    tables = ("\n[[finding]]\n" + to_toml(record) for record in as_records(found))
    return head + "".join(tables)
