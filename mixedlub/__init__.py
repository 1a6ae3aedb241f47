"""Mixed lubrication of rough surfaces: roughness, film, contact, friction, gear loss, and what a simulation lacks.

    import mixedlub as ml

Names of `PUBLIC` and the rooms of `ROOMS` are loaded when they are first used. Arguments and results carry their unit
in their name, as the files do (``torque_Nm``); the laws in ``ml.laws`` are plain functions of arrays in SI. A public
name is retired over one minor release: it moves to `RETIRED`, where it still works and warns of the name to use.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

PUBLIC = {
    "gear_pair": "mixedlub.api.rig",
    "oil": "mixedlub.api.rig",
    "surface": "mixedlub.api.rig",
    "power_loss": "mixedlub.api.loss",
    "along_path": "mixedlub.api.loss",
    "load_distribution": "mixedlub.api.gear",
    "evaluate_recording": "mixedlub.api.evaluation",
    "gearbox_efficiency": "mixedlub.api.efficiency",
    "plot": "mixedlub.api.plot",
    "diagnose": "mixedlub.api.diagnosis",
    "simulate": "mixedlub.api.diagnosis",
    "Answer": "mixedlub.api.diagnosis",
    "CautionWarning": "mixedlub.schema.findings",
}
"""Functions and types that notebooks and other packages may rely on, with the module that defines each."""
ROOMS = ("case", "effects", "ehl", "friction", "gear", "laws", "study")
"""Rooms whose own ``__all__`` is public as well."""
BESIDE = ("profiles", "roughness")
"""Packages of this distribution that are offered under this name too."""
RETIRED: dict[str, str] = {}
"""Names on their way out, each with the public name that takes its place."""

__all__ = [*PUBLIC, *ROOMS, *BESIDE]


def _refuse_hidden_packages() -> None:
    """Raise an error that names a file or folder which hides a package of this distribution."""
    from importlib.util import find_spec
    from pathlib import Path

    home = Path(__file__).parents[1]
    for name in BESIDE:
        found = find_spec(name)
        if found is not None and found.origin is not None and home not in Path(found.origin).parents[1:2]:
            raise ImportError(f"{found.origin} hides the package {name!r}, which mixedlub needs; rename it")


_refuse_hidden_packages()


def __getattr__(name: str) -> Any:
    if name in RETIRED:
        import warnings

        warnings.warn(f"mixedlub.{name} is now mixedlub.{RETIRED[name]}", DeprecationWarning, stacklevel=2)
        return __getattr__(RETIRED[name])
    if name in PUBLIC:
        return getattr(import_module(PUBLIC[name]), name)
    if name in ROOMS:
        return import_module(f"mixedlub.{name}")
    if name in BESIDE:
        return import_module(name)
    raise AttributeError(f"module 'mixedlub' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
