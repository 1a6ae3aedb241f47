"""The oil of a contact: viscosity, shear, density and heat from one file."""
