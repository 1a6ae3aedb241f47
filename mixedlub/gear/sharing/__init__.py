"""How the torque is shared between the tooth pairs in contact: one model a file, found by its file.

A sharing says where along the path it has kinks (so that no quadrature panel contains one), what a reader
should know about it, and the share at the points of a mesh.
"""
