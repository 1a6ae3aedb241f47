"""The six shipped traces: synthetic, labelled so, with the Ra, Rq and Rz of six finished gear flanks.

Named after their Ra in nanometres, as in table 1 of Hong, Aneshansley and Talbot. They are not the authors'
measurements, which are not public: the recipes in ``recipes.toml`` state the ingredients and the reasons.
"""

from __future__ import annotations

from dataclasses import replace
from importlib import resources

from profiles.errors import InputError, nearest
from profiles.profile import Profile

SHIPPED = ("0036", "0122", "0219", "0258", "0302", "0450")
SHIPPED_MARK = "shipped:"
"""Prefix of the name of a shipped trace, where a file is allowed as well."""


def shipped(name: str, where: str = "shipped trace") -> Profile:
    """A shipped trace, by its name with or without the mark; ``where``: place of the name, for messages.

    >>> trace = shipped("0258")
    >>> trace.name, trace.origin["kind"], round(trace.length * 1e3, 3)
    ('0258', 'synthetic, not a measurement', 4.8)
    """
    from profiles.read import read_source
    from profiles.readers.base import Source

    wanted = name.removeprefix(SHIPPED_MARK)
    if wanted not in SHIPPED:
        raise InputError(f"no such shipped trace; {nearest(wanted, SHIPPED)}", where=where, value=name)
    data = resources.files("profiles.traces").joinpath(f"{wanted}.txt").read_bytes()
    return replace(read_source(Source(f"{wanted}.txt", data)), name=wanted)
