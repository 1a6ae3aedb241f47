"""Gears, oils and surfaces from Python: the keys of the files, checked by the same rules."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from mixedlub.api.signatures import with_keys_of
from mixedlub.rig import build
from mixedlub.rig.measured import Measured
from mixedlub.schema.findings import collected, warn_of
from mixedlub.schema.lubricant_section import Lubricant
from mixedlub.schema.oil_file import STOCKS
from mixedlub.schema.surface_file import SurfaceSection
from mixedlub.schema.system_file import Gears
from mixedlub.schema.toml_file import named_file, parse
from mixedlub.study.record import as_moments
from profiles import SHIPPED_MARK, Profile, shipped
from profiles.errors import InputError, as_path


@with_keys_of(Gears)
def gear_pair(**keys: Any) -> Gears:
    """A pair of gears; with a negative number of teeth the second is a ring gear.

    Parameters
    ----------
    keys : keyword arguments
        Keys of the section ``[gears]``, listed by `mixedlub kinds gear_pair`; pairs of values: pinion first. Required:
        ``teeth`` (-), ``normal_module_mm`` (mm) and ``face_width_mm`` (mm), unless a ``preset`` sets them. By default,
        tip diameters and centre distance follow from the profile shift, and teeth are rigid.

    Returns
    -------
    Gears
        Gear pair for ``ml.power_loss``, ``ml.along_path`` and ``ml.load_distribution``.

    Raises
    ------
    profiles.errors.InputError
        If a key is unknown, missing or outside its range.

    Examples
    --------
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


@with_keys_of(Lubricant)
def oil(named: str | None = None, /, **keys: Any) -> Lubricant:
    """An oil by name, by file or by base stock.

    Parameters
    ----------
    named : str, optional
        Name of a shipped oil, oil file (NAME.toml), or base stock.
    keys : keyword arguments
        Keys of the section ``[lubricant]``, e.g. ``kinematic_viscosity_mm2_s`` (mm²/s) at ``temperature_C`` (°C); they
        override the named oil. Other properties are typical of the ``base`` stock.

    Returns
    -------
    Lubricant
        Oil for ``ml.power_loss`` and ``ml.along_path``.

    Raises
    ------
    profiles.errors.InputError
        If the oil is unknown or a key is invalid.

    Warns
    -----
    CautionWarning
        If a property is doubtful, e.g. a viscosity under pressure that rises with temperature.

    Examples
    --------
    >>> import mixedlub as ml
    >>> ml.oil("pao", kinematic_viscosity_mm2_s=(32.0, 6.0), temperature_C=(40.0, 100.0)).base
    'pao'
    >>> ml.oil("n100").kinematic_viscosity_mm2_s
    (97.9, 8.61)
    """
    given = {} if named is None else {"base" if named in STOCKS else "oil": named}
    section = parse(Lubricant, given | keys, "oil")
    with collected() as notes:
        build.lubricant(section)
    warn_of(notes)
    return section


@with_keys_of(SurfaceSection, without="profile")
def surface(profile: str | PathLike[str] | Profile | None = None, **keys: Any) -> SurfaceSection:
    """A surface: a measured trace, or three spectral moments.

    Parameters
    ----------
    profile : str, PathLike or profiles.Profile, optional
        File of a trace, trace of the package (``shipped:NAME``), or heights with their spacing, of which the moments
        are computed at once.
    keys : keyword arguments
        Keys of a section ``[surfaces.NAME]``, e.g. ``cutoff_mm`` (mm) for a trace, ``map`` for a height map, the
        moments ``m0_um2`` (µm²), ``m2`` (-) and ``m4_per_um2`` (1/µm²), or ``Ra_um`` (µm) alone.

    Returns
    -------
    SurfaceSection
        Surface for ``ml.power_loss`` and ``ml.along_path``.

    Raises
    ------
    profiles.errors.InputError
        If the trace is missing or a key is invalid.

    Examples
    --------
    >>> import mixedlub as ml, numpy as np
    >>> ml.surface(m0_um2=0.137, m2=0.0031, m4_per_um2=0.0021).m0_um2
    0.137
    >>> ml.surface("shipped:0258", cutoff_mm=0.8).profile
    'shipped:0258'
    >>> wave = ml.profiles.Profile(1e-6 * np.sin(2 * np.pi * np.arange(8000) / 200), spacing=0.5e-6)
    >>> round(ml.surface(wave, cutoff_mm=0.8, short_cutoff_um=2.5).m0_um2, 2)
    0.5
    """
    if profile is None:
        return parse(SurfaceSection, keys, "surface")
    if isinstance(profile, Profile):
        return _of_trace(profile, keys)
    where = "surface: profile"
    if not isinstance(profile, str | PathLike):
        rule = (
            "needs the path of a trace, or heights with their spacing, ml.surface(profiles.Profile(heights, spacing))"
        )
        raise InputError(f"{rule}, not {type(profile).__name__}", where=where)
    name = str(as_path(profile, where))
    if name.startswith(SHIPPED_MARK):
        shipped(name, where)
    else:
        named_file(Path(), name, where)
    return parse(SurfaceSection, {"profile": name, **keys}, "surface")


def _of_trace(trace: Profile, keys: Mapping[str, Any]) -> SurfaceSection:
    """Surface from the moments of a trace, filtered like a file."""
    for key in ("unit", "spacing"):
        if key in keys:
            raise InputError("a Profile has its own; leave it out", where=f"surface: {key}", value=keys[key])
    section = parse(SurfaceSection, {"profile": trace.name, **keys}, "surface")
    with collected() as found:
        measured = build.surface(trace.name, section, Measured(build.filtered(trace.name, section, (trace,))))
    warn_of(found, stacklevel=4)
    return parse(SurfaceSection, as_moments(measured, section), "surface")
