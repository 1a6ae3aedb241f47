"""A constant friction coefficient."""

from mixedlub.chain.friction_law import Coefficient, friction_law


@friction_law(
    "Constant",
    "mesh",
    sources=0,
    status="yours",
    coefficients=(Coefficient("friction", "-", "friction coefficient", usual=(0.005, 0.3)),),
)
def constant(*, friction: float) -> float:
    r"""A friction coefficient that depends on nothing (-).

    .. math:: \mu = \mu_0

    Source: G. Amontons, Mém. Acad. R. Sci., 1699, 206.

    >>> constant(friction=0.05)
    0.05
    """
    return friction
