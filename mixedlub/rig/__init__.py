"""The rig as objects in SI: gears, oil and surfaces from the sections of a file."""
