"""Where simulation and recording part, which physics was left out, and how sure that is."""
