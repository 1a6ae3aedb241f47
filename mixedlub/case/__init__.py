"""A case: its folder, its forward model, its defaults and the reference of its format."""
