"""Which mixedlub this is."""

from __future__ import annotations


def installed_version() -> str:
    """The version of the installed package; "from source" where it runs uninstalled."""
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("mixedlub")
    except PackageNotFoundError:
        return "from source"
