"""Gears, oils and surfaces as a notebook states them: the keys of the files, checked by the same rules."""

from __future__ import annotations

from os import PathLike
from typing import Any

from mixedlub.schema.oil_file import STOCKS
from mixedlub.schema.system_file import Gears, Lubricant, SurfaceSection
from mixedlub.schema.toml_file import parse


def gear_pair(**keys: Any) -> Gears:
    """A pair of external gears, by the keys of the section ``[gears]``; pinion first.

    Required are ``teeth``, ``normal_module_mm`` and ``face_width_mm``; tip diameters and centre distance follow from
    the profile shift where they are not given, and ``load_sharing`` is rigid teeth. `mixedlub kinds gear_pair` lists
    the keys. Wrong ones raise ``profiles.errors.InputError``.

    >>> import mixedlub as ml
    >>> pair = ml.gear_pair(teeth=(17, 26), normal_module_mm=4.2333, pressure_angle_deg=22.5, face_width_mm=14.0)
    >>> pair.helix_angle_deg
    0.0
    >>> ml.gear_pair(teeth=(17, 26), normal_module_mm=0.0042, face_width_mm=14.0)
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: gear_pair: normal_module_mm: 0.0042: must be from 0.01 to 200 mm; 0.0042 m would be \
4.2 mm: is it in that unit?
    """
    return parse(Gears, keys, "gear_pair")


def oil(named: str | None = None, /, **keys: Any) -> Lubricant:
    """An oil by name, by its file (NAME.toml), or by base stock, with the keys of the section ``[lubricant]``.

    What is left out is typical of its ``base`` stock; what the keys state wins over the oil of that name.

    >>> import mixedlub as ml
    >>> ml.oil("pao", kinematic_viscosity_mm2_s=(32.0, 6.0), temperature_C=(40.0, 100.0)).base
    'pao'
    >>> ml.oil("n100").kinematic_viscosity_mm2_s
    (97.9, 8.61)
    """
    given = {} if named is None else {"base" if named in STOCKS else "oil": named}
    return parse(Lubricant, given | keys, "oil")


def surface(profile: str | PathLike[str] | None = None, **keys: Any) -> SurfaceSection:
    """A surface, by the keys of a section ``[surfaces.NAME]``: a measured trace, or its three spectral moments.

    A trace that comes with the package is named ``shipped:NAME``.

    >>> import mixedlub as ml
    >>> ml.surface(m0_um2=0.137, m2=0.0031, m4_per_um2=0.0021).m0_um2
    0.137
    >>> ml.surface("shipped:0258", cutoff_mm=0.8).profile
    'shipped:0258'
    """
    return parse(SurfaceSection, {"profile": None if profile is None else str(profile), **keys}, "surface")
