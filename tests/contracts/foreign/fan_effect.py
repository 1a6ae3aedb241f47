"""A fan on the pinion shaft."""

from mixedlub.chain.effect import Parameter, effect
from mixedlub.chain.priors import LogNormal


@effect(
    stage="loss",
    acts_on="power_loss",
    parameters=(Parameter("strength", "W", LogNormal(50.0, 0.5), "power of the fan", null=0.0),),
    equation="P + c",
    source="the maker of the fan",
    fingerprint={"load": "-"},
    separated_by="pulling the plug of the fan and reading again",
)
def cooling_fan(power_loss, *, strength):
    """A fan on the shaft takes power."""
    return power_loss + strength
