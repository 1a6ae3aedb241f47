"""A film law."""

from mixedlub.chain.slots import FILM
from mixedlub.laws.film import dowson_toyoda


@FILM.offers("half_film", "half of the film of Dowson and Toyoda")
def half_film(radius, entrainment_speed, line_load, viscosity, pressure_viscosity, reduced_modulus):
    """Half a film (m).

    Source: none, it is made up.
    """
    return 0.5 * dowson_toyoda(radius, entrainment_speed, line_load, viscosity, pressure_viscosity, reduced_modulus)
