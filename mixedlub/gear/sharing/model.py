"""What a load-sharing model is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mixedlub.gear.mesh import Sharing
from mixedlub.schema.section import Section


@dataclass(frozen=True)
class SharingModel:
    """A way to share the load between tooth pairs, as a file names it.

    ``keys`` are those of ``[gears.load_sharing]`` that it takes, and ``build(section, folder)`` makes the sharing of
    their values. A model is chosen by ``model = "NAME"``; one that is ``chosen_by`` a key of its own by giving that.
    """

    name: str
    meaning: str
    build: Callable[[Any, Path], Sharing]
    keys: type[Section] = Section
    chosen_by: str = ""
