"""Loaded tooth contact of a gear pair: load shares, line loads, transmission error, stiffness and loss factors."""

from mixedlub.tooth_contact.analysis import MeshConditions, ToothContact, tooth_contact

__all__ = ["MeshConditions", "ToothContact", "tooth_contact"]
