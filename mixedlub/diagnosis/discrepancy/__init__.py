"""Model discrepancy: what no effect of the catalogue explains, as a flexible function of the conditions."""
