"""Full solutions as the base: film and film friction of the thermal, non-Newtonian solver through an emulator."""
