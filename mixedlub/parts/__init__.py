"""Laws of machine parts: bearings, seals, and wheels in oil and air, one published formula a module."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from types import MappingProxyType
from typing import cast

from mixedlub.chain.part_law import GIVES, REGISTRY, Kind, PartLaw
from mixedlub.schema.discovery import loaded
from profiles.errors import InputError, nearest


@cache
def catalogue() -> Mapping[tuple[Kind, str], PartLaw]:
    """All laws of parts, by kind and name."""
    loaded(__name__, "mixedlub.parts")
    kinds = list(GIVES)
    return MappingProxyType(dict(sorted(REGISTRY.items(), key=lambda item: (kinds.index(item[0][0]), item[0][1]))))


def of_kind(kind: Kind) -> Mapping[str, PartLaw]:
    """The laws of a kind of parts by name.

    >>> list(of_kind("seal"))
    ['iso_tr_14179_1', 'iso_tr_14179_2', 'skf_bearing_seals']
    """
    return {name: law for (one, name), law in catalogue().items() if one == kind}


def find(kind: Kind, name: str, where: str = "law") -> PartLaw:
    """A law of a part by kind and name; an unknown one raises an error with the nearest known name.

    >>> find("windage", "dawsen")
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: law: 'dawsen': no such windage law; nearest known: 'dawson'
    """
    known = of_kind(kind)
    if name not in known:
        raise InputError(f"no such {kind} law; {nearest(name, known)}", where=where, value=name)
    return known[name]


@cache
def series() -> Mapping[str, Mapping[str, Mapping[str, float]]]:
    """Coefficients of series of bearings, by the name of their table and of the series."""
    text = files("mixedlub.parts").joinpath("series.toml").read_text(encoding="utf-8")
    tables = {name: table for name, table in tomllib.loads(text).items() if isinstance(table, dict)}
    return cast("Mapping[str, Mapping[str, Mapping[str, float]]]", tables)


def series_coefficients(law: PartLaw, name: str, where: str) -> Mapping[str, float]:
    """The coefficients of a series of bearings; an unknown series raises an error with the nearest known name.

    >>> series_coefficients(find("bearing", "skf_deep_groove"), "62", "series")["rolling"]
    3.9e-07
    """
    known = series().get(law.series, {})
    if not known:
        raise InputError(f"{law.name} has no table of series; give its coefficients", where=where, value=name)
    if name not in known:
        rule = f"no such series of {law.name}; {nearest(name, known)}; of another series give the coefficients"
        raise InputError(rule, where=where, value=name)
    return known[name]


__all__ = ["PartLaw", "catalogue", "find", "of_kind"]
