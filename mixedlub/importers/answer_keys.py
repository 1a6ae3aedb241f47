"""Keys of the answers to an import, and examples where no likely answer is known."""

COLUMNS, UNIT_KEYS, VALUES = "import.columns.", "import.units.", "import.values."
"""Prefixes of a column in the answers that name its header, its unit, and the one value of all its rows."""
UNKNOWN_HEADER, UNKNOWN_UNIT = '"HEADER"', '"UNIT"'
"""Examples where no likely answer is known."""
