"""Laws of machine parts: bearings, seals, and wheels in oil and air, one published formula a module."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import cast

from mixedlub.chain.part_law import PART_LAWS, Kind, PartLaw
from profiles.errors import InputError, nearest


def catalogue() -> Mapping[tuple[Kind, str], PartLaw]:
    """All laws of parts, by kind and name."""
    return {(kind, name): law for kind, laws in PART_LAWS.items() for name, law in laws.all.items()}


def of_kind(kind: Kind) -> Mapping[str, PartLaw]:
    """The laws of a kind of parts by name.

    >>> list(of_kind("seal"))
    ['iso_tr_14179_1', 'iso_tr_14179_2', 'skf_bearing_seals']
    """
    return PART_LAWS[kind].all


def find(kind: Kind, name: str, where: str = "law") -> PartLaw:
    """A law of a part by kind and name; an unknown one raises an error with the nearest known name.

    >>> find("windage", "dawsen")
    Traceback (most recent call last):
    ...
    profiles.errors.InputError: law: 'dawsen': no such windage law; nearest known: 'dawson'
    """
    return PART_LAWS[kind].find(name, where)


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
