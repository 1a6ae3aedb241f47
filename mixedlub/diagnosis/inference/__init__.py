"""One explanation fitted to a recording, and its evidence."""
