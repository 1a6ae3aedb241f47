"""Oil of a contact: viscosity, shear, density and thermal properties from one file."""
