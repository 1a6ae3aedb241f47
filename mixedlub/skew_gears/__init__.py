"""Gears on skew axes: bevel and hypoid pairs, from the blank to contact lines, friction and efficiency."""
