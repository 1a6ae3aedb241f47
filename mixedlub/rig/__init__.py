"""The rig as objects in SI: gears, oil and surfaces built from the sections of a file."""
