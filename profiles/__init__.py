"""Where a roughness profile comes from: the type, readers, synthesis and the shipped traces."""

from profiles.errors import InputError
from profiles.profile import Profile

__all__ = ["InputError", "Profile"]
