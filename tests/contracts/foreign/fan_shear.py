"""A shear law."""

from mixedlub.chain.slots import SHEAR


@SHEAR.offers("newton", "a film that does not thin under shear")
def newton(contact_viscosity, sliding_speed, film_thickness):
    """Shear stress of the film (Pa).

    Source: I. Newton, Principia, 1687.
    """
    return contact_viscosity * sliding_speed / film_thickness
