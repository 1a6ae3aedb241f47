"""Sharing of the torque between tooth pairs in contact: one model a file, discovered by its file. A sharing gives its
kinks along the path (so that no quadrature panel contains one), findings for the reader, and the share at the points of
a mesh."""
