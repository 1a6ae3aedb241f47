"""Loaded tooth contact of a gear pair: load shares, line loads, transmission error, stiffness and loss factors."""

from mixedlub.gear.analysis.tooth_contact import MeshConditions, ToothContact, tooth_contact

__all__ = ["MeshConditions", "ToothContact", "tooth_contact"]
