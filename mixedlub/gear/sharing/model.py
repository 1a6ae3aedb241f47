"""Interface of a load-sharing model."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mixedlub.gear.mesh import Sharing
from mixedlub.schema.section import Section


@dataclass(frozen=True)
class SharingModel:
    """A model of the load sharing between tooth pairs, as named in a file.

    ``keys``: its keys of ``[gears.load_sharing]``; ``build(section, folder)`` makes the sharing from their values. A
    model is chosen by ``model = "NAME"``, or by the presence of its key ``chosen_by``.
    """

    name: str
    meaning: str
    build: Callable[[Any, Path], Sharing]
    keys: type[Section] = Section
    chosen_by: str = ""
