"""Mixed lubrication of rough surfaces: roughness, film, contact, friction, gear loss, and diagnosis of recordings.

    import mixedlub as ml

Names of `PUBLIC` and the rooms of `ROOMS` are loaded on first use. Arguments and results carry their unit in their
name, like the files (``torque_Nm``); the laws in ``ml.laws`` are plain functions of arrays in SI. A public name is
retired over one minor release: it moves to `RETIRED`, still works, and warns of the new name.
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
    "fit_laws": "mixedlub.api.fit",
    "LawFit": "mixedlub.api.fit",
    "gearbox_efficiency": "mixedlub.api.efficiency",
    "plot": "mixedlub.api.plot",
    "diagnose": "mixedlub.api.diagnosis",
    "simulate": "mixedlub.api.diagnosis",
    "Answer": "mixedlub.api.diagnosis",
    "CautionWarning": "mixedlub.schema.findings",
}
"""Public functions and types, with the modules that define them."""
ROOMS = ("case", "effects", "ehl", "friction", "gear", "laws", "study")
"""Rooms with a public ``__all__``."""
BESIDE = ("profiles", "roughness")
"""Packages of this distribution also offered under this name."""
RETIRED: dict[str, str] = {}
"""Retired names, each with its public replacement."""

__all__ = [*PUBLIC, *ROOMS, *BESIDE]


def _refuse_hidden_packages() -> None:
    """Raise an error if a file or folder hides a package of this distribution."""
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
    return sorted(__all__)
