"""A friction law."""

from mixedlub.chain.slots import MIXTURE


@MIXTURE.offers("film_only", "asperities without friction of their own")
def film_only(fluid_friction, area_ratio):
    """Friction coefficient of the contact (-).

    Source: none, it is made up.
    """
    return fluid_friction * (1.0 - area_ratio)
