"""What files may say: keys and columns, their ranges, units and messages."""
