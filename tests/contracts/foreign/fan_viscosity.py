"""A viscosity law."""

from mixedlub.chain.slots import VISCOSITY


@VISCOSITY.offers("linear", "viscosity that rises linearly with pressure")
def linear_viscosity(viscosity, pressure_viscosity, hertz_pressure):
    """Viscosity under pressure (Pa s).

    Source: none, it is made up.
    """
    return viscosity * (1.0 + pressure_viscosity * hertz_pressure)
