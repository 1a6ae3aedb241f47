"""How far the laws of line contacts are from full solutions: contacts, solutions of them, ratios, and fits of these."""
