"""What a recording itself says: its conditions, its noise, and whether it is what it says it is."""
