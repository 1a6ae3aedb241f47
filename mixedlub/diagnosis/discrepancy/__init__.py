"""Model discrepancy: a flexible function of the conditions for a mismatch without an effect in the catalogue."""
