"""`import.toml` in a case folder: warnings of `mixedlub import`, which later commands repeat."""

from __future__ import annotations

from pathlib import Path

from mixedlub.schema.findings import Finding
from mixedlub.schema.section import Section
from mixedlub.schema.toml_file import parse, read_toml

NAME = "import.toml"


class ImportFile(Section):
    """The file: one table ``[[finding]]`` per warning."""

    finding: tuple[Finding, ...] = ()


def read_import_file(folder: Path) -> tuple[Finding, ...]:
    """Warnings of the import of a case; empty where the case was not imported."""
    file = folder / NAME
    return parse(ImportFile, read_toml(file), str(file)).finding if file.exists() else ()
