"""Height maps: the type, and readers of areal files, one format a module."""

from profiles.maps.height_map import HeightMap
from profiles.maps.read import read_any, read_map

__all__ = ["HeightMap", "read_any", "read_map"]
