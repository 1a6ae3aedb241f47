"""Classes of the files read by commands, imported on demand."""

from __future__ import annotations

from importlib import import_module

from mixedlub.evaluate import EVALUATIONS
from mixedlub.schema.section import Section

STUDY = "study"
_CLASSES = {
    STUDY: "mixedlub.study.schema:StudyFile",
    "factors": "mixedlub.study.factor_file:FactorFile",
    "gear": "mixedlub.gear.analysis.file:GearAnalysisFile",
    "bevel": "mixedlub.skew_gears.file:BevelFile",
    "worm": "mixedlub.worm_gears.file:WormFile",
    "efficiency": "mixedlub.efficiency.file:EfficiencyFile",
    "ehl": "mixedlub.ehl.file:EhlFile",
    "law": "mixedlub.own_laws.file:LawFile",
}
_TITLES = {STUDY: "a study file", "law": "the file of a law of your own"}
FILES = tuple(_CLASSES)
"""Files other than cases, by command."""
EVERY_CASE = ("", "uncertainty", "recording")
"""Tables of `system.toml` that do not depend on its kind."""


def file_class(name: str) -> type[Section]:
    """The class of a file by its command or method."""
    if name not in _CLASSES:
        return EVALUATIONS[name].file
    module, _, own = _CLASSES[name].partition(":")
    found: type[Section] = getattr(import_module(module), own)
    return found


def file_title(name: str) -> str:
    """A file in words, by its command.

    >>> file_title("gear"), file_title("law")
    ('a file of `mixedlub gear`', 'the file of a law of your own')
    """
    return _TITLES.get(name, f"a file of `mixedlub {name}`")
