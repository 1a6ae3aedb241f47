"""Rigs that follow other published laws than the base model's, one module a step.

A law replaces a step of the base chain and adds nothing to it. Each is written from its paper, with formula, source and
range; parameters left open by the paper are drawn as knobs. Laws are put in place before planted effects act.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from mixedlub.validation.contact import Contact


def follow(c: Contact, step: str, law: Callable[..., Any]) -> Contact:
    """Contact of a rig that follows a law at one step."""
    return replace(c, rig=replace(c.rig, laws={**c.rig.laws, step: law}))
