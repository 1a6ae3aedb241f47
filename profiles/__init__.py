"""Where a roughness profile comes from: the type, readers, synthesis and the shipped traces."""

from profiles.errors import InputError
from profiles.profile import Profile
from profiles.read import read

__all__ = ["InputError", "Profile", "read"]
