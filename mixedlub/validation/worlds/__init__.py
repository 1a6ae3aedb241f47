"""Rigs that follow other published laws than the base model's, one module a step.

A law takes the place of a step of the base chain and adds nothing to it. Each is written from its paper, with formula,
source and range; what a paper leaves open is drawn as a knob. The laws of a rig are put in place before anything else
happens, so that planted effects act in the world that they make.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from mixedlub.validation.contact import Contact


def follow(c: Contact, step: str, law: Callable[..., Any]) -> Contact:
    """The contact of a rig that follows a law at one step."""
    return replace(c, rig=replace(c.rig, laws={**c.rig.laws, step: law}))
