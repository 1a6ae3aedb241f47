"""What is computed from a profile: filters, ISO parameters, moments, asperities, diagnostics."""
