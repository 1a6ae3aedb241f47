"""Version of mixedlub."""

from __future__ import annotations


def installed_version() -> str:
    """Version of the installed package, or "from source"."""
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("mixedlub")
    except PackageNotFoundError:
        return "from source"
