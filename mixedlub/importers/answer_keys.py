"""Keys of the answers to an import, and placeholders for unknown answers."""

COLUMNS, UNIT_KEYS, VALUES = "import.columns.", "import.units.", "import.values."
"""Prefixes of the answers on a column: its header, its unit, and one value for all rows."""
UNKNOWN_HEADER, UNKNOWN_UNIT = '"HEADER"', '"UNIT"'
"""Placeholders for an answer without a likely value."""
