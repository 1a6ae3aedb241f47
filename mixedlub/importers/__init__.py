"""Instrument files into case folders."""

from mixedlub.importers.wizard import import_files
from mixedlub.importers.write import write_case

__all__ = ["import_files", "write_case"]
