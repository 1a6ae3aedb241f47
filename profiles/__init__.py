"""Roughness profiles: the type, readers, synthesis and the shipped traces."""

from profiles.errors import InputError
from profiles.profile import Profile
from profiles.read import read
from profiles.traces import SHIPPED, SHIPPED_MARK, shipped

__all__ = ["SHIPPED", "SHIPPED_MARK", "InputError", "Profile", "read", "shipped"]
