"""Instrument files into case folders."""

from mixedlub.importers.write import write_case

__all__ = ["write_case"]
