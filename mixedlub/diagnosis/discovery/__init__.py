"""Laws without a name: search, fit and proof of a short expression that the model lacks."""
