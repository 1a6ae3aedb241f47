"""The base models: chains of laws in their order, and the balance of film and asperities."""
