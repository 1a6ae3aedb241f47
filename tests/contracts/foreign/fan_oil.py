"""A law of shear of the solver's oil."""

from mixedlub.ehl.oil.declared import SHEAR, Given, times


@SHEAR.offers("thinner by a share", Given("share", "thinner_share", "share by which the oil is thinner", times(0.5)))
def thinned(stress, pressure, *, share):
    r"""Shear of an oil that is thinner by half a share.

    .. math:: \eta\dot\gamma = (1 + s)\tau

    Source: none, it is made up.
    """
    return (1.0 + share) * stress, 1.0 + share + 0.0 * stress, 0.0 * stress
