"""Mixed lubrication of rough gear contacts: physics, gears, studies, recordings and their diagnosis."""
