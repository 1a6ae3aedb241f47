"""Names and words of full solutions as a base, without the solver."""

FULL = "full_solution"
"""Name of this base in files."""
CONTAINED = ("film_heating", "inlet_shear_heating", "film_law", "contact_average")
"""Effects that full solutions contain or replace."""
FULL_INPUTS = {"film_ratio_factor": 1.0, "stress_ratio_factor": 1.0}
"""Inputs of the chain by which the errors of film and friction are calibrated."""
WORDS = (
    "Film and film friction of full thermal, non-Newtonian solutions of line contacts for the oil, by an emulator; "
    "walls at the temperature of the entering oil; asperities and their share of the friction as with the formulas."
)
"""The base as text."""
