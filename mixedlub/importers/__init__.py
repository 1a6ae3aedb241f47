"""Import of instrument files as case folders."""

from mixedlub.importers.case_writer import write_case
from mixedlub.importers.wizard import import_files

__all__ = ["import_files", "write_case"]
